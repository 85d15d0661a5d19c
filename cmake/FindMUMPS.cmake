# Finds the sequential MUMPS (sparse LU factorisation) in single precision and defines MUMPS::single.

find_path(MUMPS_INCLUDE_DIR smumps_c.h)
find_library(MUMPS_LIBRARY smumps_seq)
mark_as_advanced(MUMPS_INCLUDE_DIR MUMPS_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MUMPS REQUIRED_VARS MUMPS_LIBRARY MUMPS_INCLUDE_DIR)

if(MUMPS_FOUND AND NOT TARGET MUMPS::single)
  add_library(MUMPS::single UNKNOWN IMPORTED)
  set_target_properties(
    MUMPS::single PROPERTIES IMPORTED_LOCATION "${MUMPS_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES
                                                                  "${MUMPS_INCLUDE_DIR}")
endif()
