# The libraries vesica stands on. Eigen is the only one that consumers see; the others stay inside the shared library
# and are collected in `vesica_private`, which the unit tests of private headers link as well.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Spectra 1.0 REQUIRED)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(METIS REQUIRED)
find_package(pugixml REQUIRED)
find_package(ZLIB REQUIRED)

# The SUNDIALS package asks for OpenMP on behalf of components that are not used here, and Clang has OpenMP only with
# libomp installed. An empty target answers the question.
if(NOT TARGET OpenMP::OpenMP_C)
  add_library(OpenMP::OpenMP_C INTERFACE IMPORTED)
endif()
find_package(SUNDIALS 6.4 REQUIRED COMPONENTS generic ida kinsol nvecserial sunlinsolspgmr)

find_package(Ceres 2.1 REQUIRED)

set(suitesparse_components KLU AMD COLAMD BTF)
if(VESICA_WITH_UMFPACK)
  list(APPEND suitesparse_components UMFPACK CHOLMOD)
endif()
find_package(SuiteSparse REQUIRED COMPONENTS ${suitesparse_components})

set(HDF5_PREFER_PARALLEL OFF)
find_package(HDF5 REQUIRED COMPONENTS C)

add_library(vesica_private INTERFACE)
target_include_directories(vesica_private INTERFACE "${PROJECT_SOURCE_DIR}/src")
target_link_libraries(
  vesica_private
  INTERFACE Spectra::Spectra
            Threads::Threads
            TBB::tbb
            fmt::fmt
            tomlplusplus::tomlplusplus
            nlohmann_json::nlohmann_json
            METIS::METIS
            pugixml::pugixml
            ZLIB::ZLIB
            SUNDIALS::generic
            SUNDIALS::ida
            SUNDIALS::kinsol
            SUNDIALS::nvecserial
            SUNDIALS::sunlinsolspgmr
            Ceres::ceres
            HDF5::HDF5)
if(VESICA_WITH_MUMPS)
  find_package(MUMPS REQUIRED)
  target_link_libraries(vesica_private INTERFACE MUMPS::single)
endif()
foreach(component IN LISTS suitesparse_components)
  target_link_libraries(vesica_private INTERFACE SuiteSparse::${component})
endforeach()
