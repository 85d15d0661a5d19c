#include "vesica/linalg/library_versions.hpp"

#include <fmt/format.h>
#include <klu.h>
#ifndef VESICA_WITHOUT_UMFPACK
#include <umfpack.h>
#endif
#ifndef VESICA_WITHOUT_MUMPS
#include <smumps_c.h>
#endif

namespace vesica::linalg {

std::string suitesparse_versions() {
  std::string klu =
      fmt::format("KLU {}.{}.{}", KLU_MAIN_VERSION, KLU_SUB_VERSION, KLU_SUBSUB_VERSION);
#ifndef VESICA_WITHOUT_MUMPS
  klu += fmt::format(", MUMPS {}", MUMPS_VERSION);
#endif
#ifndef VESICA_WITHOUT_UMFPACK
  return fmt::format("UMFPACK {}.{}.{}, {}", UMFPACK_MAIN_VERSION, UMFPACK_SUB_VERSION,
                     UMFPACK_SUBSUB_VERSION, klu);
#else
  return klu;
#endif
}

}  // namespace vesica::linalg
