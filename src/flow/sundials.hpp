#pragma once

#include <fmt/format.h>
#include <ida/ida.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_version.h>

#include <Eigen/Core>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "vesica/core/error.hpp"
#include "vesica/core/handle.hpp"

/// Handles and checks for SUNDIALS: the only place that frees its objects or reads its return
/// codes.
namespace vesica::flow::sundials {

inline void free_context(SUNContext context) { SUNContext_Free(&context); }
inline void free_ida(void* memory) { IDAFree(&memory); }
inline void free_kinsol(void* memory) { KINFree(&memory); }
inline void free_linear_solver(SUNLinearSolver solver) { SUNLinSolFree(solver); }

using Context = Handle<SUNContext, free_context>;
using Vector = Handle<N_Vector, N_VDestroy>;
using IdaMemory = Handle<void*, free_ida>;
using KinsolMemory = Handle<void*, free_kinsol>;
using LinearSolver = Handle<SUNLinearSolver, free_linear_solver>;
using Matrix = Handle<SUNMatrix, SUNMatDestroy>;

using NameOfCode = char* (*)(long);

/// Name and number of a return code of IDA or another package, "IDA_CONV_FAIL (-4)".
inline std::string code_text(long code, NameOfCode name_of = IDAGetReturnFlagName) {
  const std::unique_ptr<char, decltype(&std::free)> name(name_of(code), &std::free);
  return fmt::format("{} ({})", name ? name.get() : "error", code);
}

inline void check(int code, std::string_view call, NameOfCode name_of = IDAGetReturnFlagName) {
  if (code < 0) throw SolverError(fmt::format("{}: {}", call, code_text(code, name_of)));
}

inline void silence(int, const char*, const char*, char*, void*) {}

template <class Pointer>
Pointer not_null(Pointer object, std::string_view call) {
  if (object == nullptr) throw SolverError(fmt::format("{}: out of memory or illegal input", call));
  return object;
}

inline Context make_context() {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  return Context(context);
}

inline Vector make_vector(Eigen::Index size, const Context& context) {
  return Vector(not_null(N_VNew_Serial(size, context.get()), "N_VNew_Serial"));
}

inline Eigen::Map<Eigen::VectorXd> view(N_Vector v) {
  return {N_VGetArrayPointer(v), N_VGetLength(v)};
}

}  // namespace vesica::flow::sundials
