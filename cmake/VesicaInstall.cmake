# Install tree: headers, library, programs, cases and the package files that find_package(vesica) reads.

include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/vesica")

install(TARGETS vesica EXPORT vesica LIBRARY)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/vesica" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(
  EXPORT vesica
  NAMESPACE vesica::
  FILE vesicaTargets.cmake
  DESTINATION "${package_dir}")

configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/vesicaConfig.cmake.in" "${PROJECT_BINARY_DIR}/vesicaConfig.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/vesicaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/vesicaConfig.cmake" "${PROJECT_BINARY_DIR}/vesicaConfigVersion.cmake"
        DESTINATION "${package_dir}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
