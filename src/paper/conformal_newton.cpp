#include "conformal_newton.hpp"

#include <Eigen/Geometry>
#include <vector>

#include "vesica/core/error.hpp"
#include "vesica/linalg/bordered_solver.hpp"

namespace vesica::paper {
namespace {

constexpr int max_steps = 15;
constexpr double tolerance = 1e-10;  // of forces; the energy is near 4 pi
constexpr double shift = 1e-6;
constexpr int num_conditions = 6;

/// The equations at (u, rho, multipliers of the conditions).
class SaddlePoint {
 public:
  SaddlePoint(const VertexNumbers& numbers, const Sparse& stiffness, const Eigen::VectorXd& areas,
              const mesh::Positions& guess)
      : numbers_(numbers),
        stiffness_(stiffness),
        u_(guess),
        rho_(-0.5 * guess.cwiseProduct(stiffness * guess).rowwise().sum()),
        conditions_(Eigen::MatrixXd::Zero(4 * guess.rows(), num_conditions)) {
    for (Eigen::Index i = 0; i < guess.rows(); ++i) {
      const double weight = areas[i] / areas.sum();
      const Eigen::Vector3d u = guess.row(i);
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
        conditions_.block<3, 1>(4 * i, k) = weight * axis;
        conditions_.block<3, 1>(4 * i, 3 + k) = weight * axis.cross(u);
      }
    }
  }

  [[nodiscard]] const mesh::Positions& images() const { return u_; }

  [[nodiscard]] Eigen::VectorXd residual() const {
    const Eigen::Index n = u_.rows();
    const mesh::Positions forces = stiffness_ * u_;
    Eigen::VectorXd result(4 * n + num_conditions);
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(4 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector3d u = u_.row(i);
      result.segment<3>(4 * i) = forces.row(i).transpose() + 2 * rho_[i] * u;
      result[4 * i + 3] = u.squaredNorm() - 1;
      unknowns.segment<3>(4 * i) = u;
    }
    result.head(4 * n) += conditions_ * multipliers_;
    result.tail(num_conditions) = conditions_.transpose() * unknowns;
    return result;
  }

  [[nodiscard]] linalg::BorderedMatrix matrix() const {
    std::vector<Eigen::Triplet<double, linalg::SparseIndex>> entries;
    entries.reserve(static_cast<std::size_t>(3 * stiffness_.nonZeros() + 10 * u_.rows()));
    for (Eigen::Index column = 0; column < stiffness_.cols(); ++column) {
      for (Sparse::InnerIterator entry(stiffness_, column); entry; ++entry) {
        for (int k = 0; k < 3; ++k)
          entries.emplace_back(4 * entry.row() + k, 4 * column + k, entry.value());
      }
    }
    const Eigen::VectorXd image_areas = vertex_areas(numbers_, u_);
    for (Eigen::Index i = 0; i < u_.rows(); ++i) {
      for (int k = 0; k < 3; ++k) {
        entries.emplace_back(4 * i + k, 4 * i + k, 2 * rho_[i] + shift * image_areas[i]);
        entries.emplace_back(4 * i + k, 4 * i + 3, 2 * u_(i, k));
        entries.emplace_back(4 * i + 3, 4 * i + k, 2 * u_(i, k));
      }
      entries.emplace_back(4 * i + 3, 4 * i + 3, 0.0);
    }
    Sparse block(4 * u_.rows(), 4 * u_.rows());
    block.setFromTriplets(entries.begin(), entries.end());
    return {to_linalg(block), conditions_, conditions_.transpose(), {}};
  }

  void move(const Eigen::VectorXd& step) {
    for (Eigen::Index i = 0; i < u_.rows(); ++i) {
      u_.row(i) += step.segment<3>(4 * i).transpose();
      rho_[i] += step[4 * i + 3];
    }
    multipliers_ += step.tail(num_conditions);
  }

 private:
  const VertexNumbers& numbers_;
  const Sparse& stiffness_;
  mesh::Positions u_;
  Eigen::VectorXd rho_;
  Eigen::VectorXd multipliers_ = Eigen::VectorXd::Zero(num_conditions);
  Eigen::MatrixXd conditions_;  ///< derivatives of the six conditions, shape (4 N, 6)
};

}  // namespace

ConformalSolution solve_conformal(const VertexNumbers& numbers, const Sparse& stiffness,
                                  const Eigen::VectorXd& areas, const mesh::Positions& guess) {
  SaddlePoint point(numbers, stiffness, areas, guess);
  linalg::BorderedSolver solver(linalg::default_direct_solver, point.matrix(), 4);
  ConformalSolution solution{guess, point.residual().lpNorm<Eigen::Infinity>(), 0, false};
  double residual = solution.residual;
  try {
    while (residual > tolerance && solution.num_steps < max_steps) {
      solver.factorise(point.matrix());
      point.move(-solver.solve(point.residual()));
      residual = point.residual().lpNorm<Eigen::Infinity>();
      ++solution.num_steps;
    }
  } catch (const RecoverableError&) {
    return solution;
  }
  if (!(residual <= tolerance)) return solution;
  return {point.images().rowwise().normalized(), residual, solution.num_steps, true};
}

}  // namespace vesica::paper
