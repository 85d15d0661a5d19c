#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "equation_case.hpp"
#include "problem/element_equations.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::problem {
namespace {

using Residual =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate)>;

/// dF/dy and dF/dy' by central differences.
struct Differences {
  Eigen::MatrixXd value;
  Eigen::MatrixXd rate;
};

Eigen::MatrixXd differences(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residual,
                            const Eigen::VectorXd& at) {
  constexpr double h = 1e-5;
  Eigen::MatrixXd result(at.size(), at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    Eigen::VectorXd moved = at;
    moved[k] = at[k] + h;
    const Eigen::VectorXd plus = residual(moved);
    moved[k] = at[k] - h;
    result.col(k) = (plus - residual(moved)) / (2 * h);
  }
  return result;
}

Differences differences(const EquationCase& c, const Residual& residual) {
  return {
      differences([&](const Eigen::VectorXd& y) { return residual(y, c.y_rate); }, c.y),
      differences([&](const Eigen::VectorXd& y_rate) { return residual(c.y, y_rate); }, c.y_rate)};
}

/// The matrix that `jacobian` promises: unknowns without a time derivative enter with dF/dy.
Eigen::MatrixXd combined(const EquationCase& c, const Differences& d,
                         const JacobianWeights& weights) {
  const DofLayout layout(c.surface.triangulation->num_nodes(), c.model);
  const auto mask = layout.differential_mask();
  Eigen::MatrixXd result = d.value;
  for (Eigen::Index k = 0; k < layout.size(); ++k) {
    if (mask[k] == 1) result.col(k) = weights.value * d.value.col(k) + weights.rate * d.rate.col(k);
  }
  return result;
}

Eigen::MatrixXd assembled(const EquationCase& c, const JacobianWeights& weights) {
  const auto problem = c.problem();
  auto matrix = problem.make_matrix();
  problem.jacobian(c.settings, weights, c.time, c.y, c.y_rate, matrix);
  return linalg::to_dense(matrix);
}

/// The unknowns and, in the same places, the equations: x and (b), kappa and (a), c and (d),
/// multipliers and (e).
enum class Group { position, curvature, phase, multiplier };
constexpr std::array groups{Group::position, Group::curvature, Group::phase, Group::multiplier};
constexpr std::array<const char*, 4> equations{"(b)", "(a)", "(d)", "(e)"};
constexpr std::array<const char*, 4> unknowns{"x", "kappa", "c", "lambda"};

std::vector<Eigen::Index> indices(const EquationCase& c, Group group) {
  const DofLayout layout(c.surface.triangulation->num_nodes(), c.model);
  std::vector<Eigen::Index> result;
  for (Eigen::Index k = 0; k < layout.size(); ++k) {
    const auto component = k % layout.block_size();
    Group found = component < 3    ? Group::position
                  : component == 3 ? Group::curvature
                                   : Group::phase;
    if (k >= layout.num_nodal()) found = Group::multiplier;
    if (found == group) result.push_back(k);
  }
  return result;
}

/// Whether an equation depends on an unknown at all.
bool is_coupled(const EquationCase& c, Group equation, Group unknown) {
  switch (equation) {
    case Group::position:
      return unknown == Group::position || unknown == Group::curvature;
    case Group::curvature:
      return true;
    case Group::phase:
      return unknown != Group::multiplier ||
             c.model.targets.of<model::PhaseDifference>().has_value();
    case Group::multiplier:
      return unknown == Group::position ||
             (unknown == Group::phase && c.model.targets.of<model::PhaseDifference>().has_value());
  }
  return false;
}

/// The same with the weights {0, 1}: only rates of positions and order parameter count.
bool is_coupled_by_rate(const EquationCase& c, Group equation, Group unknown) {
  if (unknown == Group::curvature || unknown == Group::multiplier)
    return is_coupled(c, equation, unknown);
  if (equation == Group::multiplier && c.settings.form == ConstraintForm::original) return false;
  if (unknown == Group::phase)
    return equation == Group::phase ||
           (equation == Group::multiplier && is_coupled(c, equation, unknown));
  return equation != Group::phase;
}

/// Central differences with h = 1e-5: truncation about 1e-9, rounding about 1e-10 of the block.
constexpr double tolerance = 1e-6;

struct Block {
  Group equation;
  Group unknown;
  bool is_coupled = true;
};

void compare_block(const EquationCase& c, const Eigen::MatrixXd& jacobian,
                   const Eigen::MatrixXd& expected, const Block& which) {
  const auto rows = indices(c, which.equation);
  const auto columns = indices(c, which.unknown);
  if (rows.empty() || columns.empty()) return;
  SCOPED_TRACE(c.name + ": equation " + equations[static_cast<std::size_t>(which.equation)] +
               ", unknown " + unknowns[static_cast<std::size_t>(which.unknown)]);
  const Eigen::MatrixXd block = jacobian(rows, columns);
  const Eigen::MatrixXd difference = expected(rows, columns);
  if (!which.is_coupled) {
    EXPECT_EQ(block.norm(), 0);
    EXPECT_EQ(difference.norm(), 0);
    return;
  }
  ASSERT_GT(difference.norm(), 1e-3);
  EXPECT_LT((block - difference).norm(), tolerance * difference.norm());
}

/// Whether the block is exact although Q_h is not differentiated: only (a) and (d) hold Q_h, and it
/// depends on x alone.
bool is_free_of_the_surrogate(Group equation, Group unknown) {
  return unknown != Group::position || (equation != Group::curvature && equation != Group::phase);
}

const std::array<JacobianWeights, 4> shifts{{{1, 0.1}, {1, 10}, {1, 1e4}, {0, 1}}};

void compare(const EquationCase& c, const Differences& d, bool surrogate_blocks) {
  for (const auto& weights : shifts) {
    SCOPED_TRACE(std::to_string(weights.value) + ", " + std::to_string(weights.rate));
    const auto jacobian = assembled(c, weights);
    const auto expected = combined(c, d, weights);
    for (const auto equation : groups) {
      for (const auto unknown : groups) {
        if (is_free_of_the_surrogate(equation, unknown) == surrogate_blocks) continue;
        const bool is_coupled_at_all = weights.value != 0
                                           ? is_coupled(c, equation, unknown)
                                           : is_coupled_by_rate(c, equation, unknown);
        compare_block(c, jacobian, expected, {equation, unknown, is_coupled_at_all});
      }
    }
  }
}

Residual true_residual(const RelaxationProblem& problem, const EquationCase& c) {
  return [&](const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate) {
    return problem.residual(c.settings, c.time, y, y_rate);
  };
}

/// The residual whose exact derivative the Jacobian is: in place of Q_h(x) stands Q_h(x_0) + W(x) -
/// W(x_0), with the elementwise shape operator W.
class SurrogateResidual {
 public:
  SurrogateResidual(const RelaxationProblem& problem, const EquationCase& c)
      : problem_(problem),
        case_(c),
        graph_(*c.surface.triangulation),
        recovered_(fem::recover_shape_operator(*c.surface.triangulation, graph_,
                                               c.surface.positions, 1)) {}

  Eigen::VectorXd operator()(const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate) const {
    const auto& layout = problem_.layout();
    Eigen::VectorXd result = problem_.residual(case_.settings, case_.time, y, y_rate);  // for (e)
    result.head(layout.num_nodal()).setZero();
    const auto physics = problem_.model().at(case_.time);
    PointSettings point{physics, case_.settings.damping, {}};
    for (int i = 0; i < model::num_constraints; ++i) {
      if (layout.multiplier(i) >= 0)
        point.multipliers[static_cast<std::size_t>(i)] =
            y[layout.num_nodal() + layout.multiplier(i)];
    }
    const EquationContext context{point, recovered_, y, y_rate, layout.block_size()};
    const EquationContext start{point, recovered_, case_.y, y_rate, layout.block_size()};
    for (const auto& triangle : case_.surface.triangulation->triangles())
      add_element(context, element_values(context, triangle), element_values(start, triangle),
                  triangle, result);
    return result;
  }

 private:
  static Sym3<double> elementwise(const ElementValues& element, const fem::ShapeValues& shape) {
    const auto in = point_inputs(element, shape);
    return fem::element_shape_operator(fem::tangent_frame(in.x_u, in.x_v), in.x_uu, in.x_uv,
                                       in.x_vv);
  }

  static void add_element(const EquationContext& context, const ElementValues& element,
                          const ElementValues& start, const mesh::QuadraticTriangle& triangle,
                          Eigen::VectorXd& result) {
    for (const auto& point : fem::triangle_rule()) {
      const auto& shape = point.shape;
      const auto in = point_inputs(element, shape);
      const auto frame = fem::tangent_frame(in.x_u, in.x_v);
      const auto q = interpolated_shape_operator(element, shape);
      const auto w = elementwise(element, shape);
      const auto w0 = elementwise(start, shape);
      const Sym3<double> surrogate{q.xx + w.xx - w0.xx, q.yy + w.yy - w0.yy, q.zz + w.zz - w0.zz,
                                   q.xy + w.xy - w0.xy, q.yz + w.yz - w0.yz, q.xz + w.xz - w0.xz};
      const auto out = point_equations(context.point, in, frame, surrogate);
      for (std::size_t i = 0; i < 6; ++i) {
        for (int r = 0; r < context.block_size; ++r) {
          const auto& integrand = out[static_cast<std::size_t>(r)];
          result[triangle[i] * context.block_size + r] +=
              point.weight * (shape.value[i] * integrand[0] + shape.du[i] * integrand[1] +
                              shape.dv[i] * integrand[2]);
        }
      }
    }
  }

  const RelaxationProblem& problem_;
  const EquationCase& case_;
  fem::NodeGraph graph_;
  fem::NodalShapeOperator recovered_;
};

class RelaxationJacobian : public ::testing::TestWithParam<ConstraintForm> {
 protected:
  static std::vector<EquationCase> cases() {
    auto result = equation_cases();
    for (auto& c : result) c.settings.form = GetParam();
    return result;
  }
};

TEST_P(RelaxationJacobian, IsTheDifferenceOfTheResidualWhereQhIsNotDifferentiated) {
  for (const auto& c : cases()) {
    const auto problem = c.problem();
    compare(c, differences(c, true_residual(problem, c)), false);
  }
}

TEST_P(RelaxationJacobian, DifferentiatesTheElementwiseShapeOperatorInPlaceOfQh) {
  for (const auto& c : cases()) {
    const auto problem = c.problem();
    const SurrogateResidual surrogate(problem, c);
    const auto expected = problem.residual(c.settings, c.time, c.y, c.y_rate);
    ASSERT_GT(expected.norm(), 1);
    ASSERT_LT((surrogate(c.y, c.y_rate) - expected).norm(), 1e-12 * expected.norm());
    compare(c, differences(c, surrogate), true);
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, RelaxationJacobian,
                         ::testing::Values(ConstraintForm::differentiated,
                                           ConstraintForm::original),
                         [](const auto& info) {
                           return info.param == ConstraintForm::original ? "original"
                                                                         : "differentiated";
                         });

/// kappa = kappa_s in both phases, no line tension, k_g equal, total mean curvature free: every
/// term with Q_h vanishes together with its derivative.
TEST(RelaxationJacobianWithoutQh, IsExactInEveryBlock) {
  auto model = two_phase_model();
  model.material.spontaneous_curvature = {-1.7, -1.7};
  model.material.gaussian_rigidity = {0.5, 0.5};
  model.material.line_tension = 0;
  model.targets.of<model::TotalMeanCurvature>().reset();
  auto c = make_equation_case("kappa = kappa_s", model);
  for (const auto k : indices(c, Group::curvature)) c.y[k] = -1.7;
  const auto problem = c.problem();
  const auto d = differences(c, true_residual(problem, c));
  const JacobianWeights weights{1, 10};
  const auto jacobian = assembled(c, weights);
  const auto expected = combined(c, d, weights);
  compare_block(c, jacobian, expected, {Group::curvature, Group::position});
  compare_block(c, jacobian, expected, {Group::phase, Group::position});
}

}  // namespace
}  // namespace vesica::problem
