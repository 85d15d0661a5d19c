#pragma once

#include "io/hdf5/writable_file.hpp"
#include "vesica/config/config.hpp"
#include "vesica/setup/case.hpp"

namespace vesica::io {

/// Writes `/configuration`; in place of an older one.
void write_configuration(hdf5::WritableFile& file, const config::RunConfig& config);
/// Writes `/origin`.
void write_origin(hdf5::WritableFile& file, const setup::Origin& origin);
/// Adds a group to `/provenance`: who made this part of the run, from which other one.
void add_provenance(hdf5::WritableFile& file, const setup::Case& vesicle);
/// Writes `/versions`; in place of older ones.
void write_versions(hdf5::WritableFile& file);

}  // namespace vesica::io
