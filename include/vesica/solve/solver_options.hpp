#pragma once

#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "vesica/core/fields.hpp"
#include "vesica/linalg/direct_solver.hpp"
#include "vesica/solve/time_step.hpp"

namespace vesica::solve {

/// Method that solves the equations: adaptive flow with IDA, the semi-implicit scheme of the paper,
/// or minimisation of the discrete energy. The automatic choice stands in configurations alone:
/// config::choose_method makes it, and no stepper takes it.
enum class Method { automatic, ida, semi_implicit, minimize };
/// Equations of the flow: the weak form of the paper, or the gradient flow of the discrete energy.
enum class Scheme { paper, variational };
/// How Newton's linear systems are solved: by GMRES with the factors as preconditioner, or
/// directly.
enum class NewtonMode { krylov, direct };
/// What stands for the inverse of the Jacobian: sparse LU factors, or, for the flow of
/// Scheme::variational, the preconditioner from Cholesky factors of second-order operators. The
/// automatic choice is the preconditioner where it can be had.
enum class LinearSolver { automatic, preconditioned, umfpack, klu, mumps };

}  // namespace vesica::solve

namespace vesica {
template <>
struct EnumNames<solve::Method> {
  using enum solve::Method;
  static constexpr std::array<std::pair<solve::Method, std::string_view>, 4> names{
      {{automatic, "auto"},
       {ida, "ida"},
       {semi_implicit, "semi-implicit"},
       {minimize, "minimize"}}};
};
template <>
struct EnumNames<solve::Scheme> {
  using enum solve::Scheme;
  static constexpr std::array<std::pair<solve::Scheme, std::string_view>, 2> names{
      {{paper, "paper"}, {variational, "variational"}}};
};
template <>
struct EnumNames<solve::NewtonMode> {
  using enum solve::NewtonMode;
  static constexpr std::array<std::pair<solve::NewtonMode, std::string_view>, 2> names{
      {{krylov, "krylov"}, {direct, "direct"}}};
};
template <>
struct EnumNames<solve::LinearSolver> {
  using enum solve::LinearSolver;
  static constexpr std::array<std::pair<solve::LinearSolver, std::string_view>, 5> names{
      {{automatic, "auto"},
       {preconditioned, "preconditioned"},
       {umfpack, "umfpack"},
       {klu, "klu"},
       {mumps, "mumps"}}};
};
}  // namespace vesica

namespace vesica::solve {

/// Options that tell how the equations are solved. Times are in [length^4/energy]: the mobility of
/// the gradient flow is 1.
struct SolverOptions {
  Method method = Method::ida;
  Scheme scheme = Scheme::paper;
  double rtol = 1e-3;
  double atol = 1e-6;
  int max_order = 5;
  double initial_step = 0;
  double max_step = std::numeric_limits<double>::infinity();
  double constraint_rate = 100;
  TimeStep time_step{};
  bool tangential_fields = true;
  NewtonMode newton = NewtonMode::krylov;
  LinearSolver linear_solver = LinearSolver::automatic;
  bool final_constraint_solve = true;
  bool polish = false;
  bool leave_saddles = true;
  bool mend_start = true;
  int threads = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    using enum Method;
    visit(Field{"method", "-",
                "auto (minimize for an equilibrium, ida where time matters), ida (adaptive flow), "
                "semi-implicit (the paper's own) or minimize (Ceres)"},
          self.method);
    visit(Field{"scheme", "-",
                "paper (weak form of Problem 3.1) or variational (gradient flow of the discrete "
                "energy)",
                Rule::any, Users(ida)},
          self.scheme);
    visit(Field{"rtol", "-",
                "error allowed in a step, relative to the diameter 2 R_c and to the range of c",
                Rule::positive, Users(ida)},
          self.rtol);
    visit(Field{"atol", "R_c", "absolute error, added to it (for c: a pure number)",
                Rule::non_negative, Users(ida)},
          self.atol);
    visit(
        Field{"max_order", "-", "largest order of the BDF method", Rule::between(1, 5), Users(ida)},
        self.max_order);
    visit(Field{"initial_step", "length^4/energy", "first step; 0: chosen by IDA",
                Rule::non_negative, Users(ida)},
          self.initial_step);
    visit(Field{"max_step", "length^4/energy", "largest step", Rule::positive_or_infinite,
                Users(ida)},
          self.max_step);
    visit(
        Field{"constraint_rate", "k/R_c^4", "gamma of d/dt C + gamma C = 0, pulls constraints back",
              Rule::positive, Users(ida)},
        self.constraint_rate);
    other_fields(self, visit);
  }
  /// Tells whether the flow is solved without LU factors, p eliminated.
  [[nodiscard]] bool is_preconditioned() const;
  /// Returns the library of LU factors where these are needed, exact to round-off.
  [[nodiscard]] linalg::DirectSolverKind direct_solver() const;
  /// Returns the library of LU factors for Newton's method of a flow: with GMRES they are a
  /// preconditioner, and single precision is enough.
  [[nodiscard]] linalg::DirectSolverKind flow_solver() const;
  /// Refuses options that the method cannot carry out. Throws ConfigError.
  void check_together() const;

 private:
  template <class Self, class Visitor>
  static void other_fields(Self& self, Visitor&& visit) {
    using enum Method;
    visit(Field{"time_step", "length^4/energy",
                "fixed step, a number or \"(eps/30)^2\" with eps = interface_width", Rule::positive,
                Users(semi_implicit)},
          self.time_step);
    visit(Field{"tangential_fields", "-",
                "keep the fields beta_1, beta_2 of (3.4); false: eliminate them", Rule::any,
                Users(semi_implicit)},
          self.tangential_fields);
    visit(Field{"newton", "-", "krylov (GMRES, factors as preconditioner) or direct", Rule::any,
                Users(ida)},
          self.newton);
    visit(
        Field{"linear_solver", "-",
              "auto, preconditioned (variational scheme: Cholesky factors of second-order "
              "operators), or a sparse LU factorisation: umfpack, klu or mumps (single precision, "
              "refined)"},
        self.linear_solver);
    visit(Field{"final_constraint_solve", "-", "take the constraints to round-off at the end"},
          self.final_constraint_solve);
    visit(Field{"polish", "-", "at the end, Newton's method on the equations of the equilibrium"},
          self.polish);
    visit(Field{"leave_saddles", "-",
                "from a saddle of the energy, go on along its lowest mode; false: end there",
                Rule::any, Users(minimize)},
          self.leave_saddles);
    visit(Field{"mend_start", "-",
                "take a start that is far from its targets to them, and a rough one to where the "
                "flow can begin; false: begin from the start as it is"},
          self.mend_start);
    visit(Field{"threads", "-", "threads of the assembly; 0: all cores", Rule::non_negative},
          self.threads);
  }
};

}  // namespace vesica::solve
