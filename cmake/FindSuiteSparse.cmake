# Finds the components of SuiteSparse that are asked for (KLU, UMFPACK, AMD, ...) and defines SuiteSparse::<COMPONENT>.

find_path(SuiteSparse_INCLUDE_DIR SuiteSparse_config.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_CONFIG_LIBRARY suitesparseconfig)
mark_as_advanced(SuiteSparse_INCLUDE_DIR SuiteSparse_CONFIG_LIBRARY)

foreach(component IN LISTS SuiteSparse_FIND_COMPONENTS)
  string(TOLOWER "${component}" name)
  find_library(SuiteSparse_${component}_LIBRARY ${name})
  mark_as_advanced(SuiteSparse_${component}_LIBRARY)
  if(SuiteSparse_${component}_LIBRARY AND EXISTS "${SuiteSparse_INCLUDE_DIR}/${name}.h")
    set(SuiteSparse_${component}_FOUND TRUE)
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  SuiteSparse
  REQUIRED_VARS SuiteSparse_CONFIG_LIBRARY SuiteSparse_INCLUDE_DIR
  HANDLE_COMPONENTS)

if(SuiteSparse_FOUND)
  foreach(component IN LISTS SuiteSparse_FIND_COMPONENTS)
    if(NOT TARGET SuiteSparse::${component})
      add_library(SuiteSparse::${component} UNKNOWN IMPORTED)
      set_target_properties(
        SuiteSparse::${component}
        PROPERTIES IMPORTED_LOCATION "${SuiteSparse_${component}_LIBRARY}"
                   INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}"
                   INTERFACE_LINK_LIBRARIES "${SuiteSparse_CONFIG_LIBRARY}")
    endif()
  endforeach()
endif()
