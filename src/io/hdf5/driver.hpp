#pragma once

#include <hdf5.h>

#include <cstdint>

namespace vesica::io::hdf5 {

/// What the driver has to know of a file; it must outlive the file.
struct DriverInfo {
  /// Takes the errno of the first failure; must be 0 at the beginning.
  int* first_error = nullptr;
  /// Path of the journal; null for a file that has none.
  const char* journal = nullptr;
};

/// Registers a file driver for the default file format whose flush is a commit: a kill, a full disk
/// or a loss of power leaves the file as it was after its last flush. HDF5 1.10 by itself leaves
/// anything, and crashes when it is closed after a failed write. This driver
///  - reserves the space on the disk when HDF5 extends the file;
///  - writes what is new behind the end of the last commit at once, since nothing refers to it, and
///    keeps changes of what is older in memory until the flush;
///  - flushes in this order: new parts reach the disk, then the journal with all changed pages,
///    then the pages themselves. Who opens the file takes the pages of a whole journal for those of
///    the file; a journal that is not whole belongs to a commit that has changed nothing yet;
///  - after the first failure keeps the error number, writes nothing more and lets HDF5 believe
///    that all is well, so it closes cleanly;
///  - lets a file that was cut be opened; what is missing reads as zeros, which checksums tell;
///  - takes no lock, so others can read what has been flushed.
/// Returns a negative value on failure; released by H5FDunregister.
[[nodiscard]] hid_t register_driver();

/// Selects the driver for the access properties of one file.
[[nodiscard]] herr_t select_driver(hid_t access_properties, hid_t driver, const DriverInfo& info);

}  // namespace vesica::io::hdf5
