# The one library, and the functions with which modules, programs and tests are declared.

add_library(vesica SHARED)
add_library(vesica::vesica ALIAS vesica)
target_compile_features(vesica PUBLIC cxx_std_20)
target_include_directories(
  vesica PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
target_link_libraries(vesica PUBLIC Eigen3::Eigen PRIVATE $<BUILD_INTERFACE:vesica_private>)

# Eigen takes the alignment of arrays, and with it how it allocates and frees, from the instruction set. Library and
# consumer may be compiled for different ones: both are held to the same values (docs/decisions/library-type.md).
target_compile_definitions(vesica PUBLIC EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=16)

# Decides the default solver in a public header, so consumers see it too.
if(NOT VESICA_WITH_UMFPACK)
  target_compile_definitions(vesica PUBLIC VESICA_WITHOUT_UMFPACK)
endif()
if(NOT VESICA_WITH_MUMPS)
  target_compile_definitions(vesica PUBLIC VESICA_WITHOUT_MUMPS)
endif()

# Only names in namespace vesica leave the library, and it calls its own copies of them: instances of Eigen and
# standard templates compiled for this processor never mix with the consumer's.
set(vesica_exports "${PROJECT_SOURCE_DIR}/cmake/vesica.map")
target_link_options(
  vesica PRIVATE "LINKER:--version-script=${vesica_exports}" LINKER:-Bsymbolic-functions LINKER:--as-needed)
set_target_properties(
  vesica PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                    LINK_DEPENDS "${vesica_exports}")

# Warnings and instruction set for one target of this project; never part of the exported interface.
function(vesica_compile_options target)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic)
  if(VESICA_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(VESICA_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
    # GCC 12 takes the deliberately undefined operand inside its own AVX-512 intrinsics for a mistake of the caller
    # (GCC bug 105593); builds for the base instruction set keep the warning.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
  else()
    # Packs of numbers (src/core/pack.hpp) never cross the border of a library, so how they are passed does not matter.
    target_compile_options(${target} PRIVATE -Wno-psabi)
  endif()
endfunction()

vesica_compile_options(vesica)

# Parsing Eigen, fmt and the standard library is most of the work of a small source file.
set(vesica_common_headers
    <Eigen/Core> <fmt/format.h> <algorithm> <array> <cmath> <memory> <optional> <span> <string> <vector>)
target_precompile_headers(vesica PRIVATE ${vesica_common_headers})

# Adds the sources of the current folder to the library; further arguments are files to leave out.
function(vesica_add_module)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  foreach(name IN LISTS ARGN)
    list(REMOVE_ITEM sources "${CMAKE_CURRENT_SOURCE_DIR}/${name}")
  endforeach()
  target_sources(vesica PRIVATE ${sources})
endfunction()

# Adds a program from the sources of the current folder and installs it.
function(vesica_add_app name)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE vesica_app_common)
  vesica_compile_options(${name})
  file(RELATIVE_PATH libdir "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${libdir}")
  install(TARGETS ${name} RUNTIME)
endfunction()

# Adds one GoogleTest program from the sources of `folder` and its tests under `label`. Tests whose suite begins with
# Slow have the label `slow` alone.
function(vesica_add_tests name folder label)
  file(GLOB sources CONFIGURE_DEPENDS "${folder}/*.cpp")
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE vesica_test_support GTest::gtest_main)
  vesica_compile_options(${name})
  target_precompile_headers(${name} REUSE_FROM vesica_test_headers)
  set(common DISCOVERY_MODE PRE_TEST WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  gtest_discover_tests(
    ${name} ${common} TEST_FILTER "-Slow*:*/Slow*" PROPERTIES LABELS ${label} TIMEOUT 300)
  gtest_discover_tests(
    ${name} ${common} TEST_FILTER "Slow*:*/Slow*" PROPERTIES LABELS slow TIMEOUT 3600)
endfunction()
