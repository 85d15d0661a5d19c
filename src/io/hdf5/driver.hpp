#pragma once

#include <hdf5.h>

namespace vesica::io::hdf5 {

/// Registers a file driver for the default file format that survives a full disk. HDF5 1.10 does
/// not: after a failed write it crashes when it is closed. This driver
///  - reserves the space on the disk when HDF5 extends the file, before anything of the last flush
///  is touched;
///  - after the first failure keeps the error number, writes nothing more and lets HDF5 believe
///  that all is well, so it
///    closes cleanly and the file stays as it was at the last flush, but for data that nothing
///    refers to;
///  - takes no lock, so others can read what has been flushed.
/// Returns a negative value on failure; released by H5FDunregister.
[[nodiscard]] hid_t register_driver();

/// Selects the driver for the access properties of one file. `first_error` takes the errno of the
/// first failure; it must be 0 and outlive the file.
[[nodiscard]] herr_t select_driver(hid_t access_properties, hid_t driver, int* first_error);

}  // namespace vesica::io::hdf5
