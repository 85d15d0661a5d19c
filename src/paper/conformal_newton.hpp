#pragma once

#include <Eigen/Core>

#include "vertex_stiffness.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::paper {

struct ConformalSolution {
  mesh::Positions images;  ///< u at the vertices
  double residual = 0;
  int num_steps = 0;
  bool converged = false;
};

/// Newton's method on the saddle point of (3.6) with the six conditions of conformal_map. Unknowns
/// u_i and rho_i of each vertex; the conditions are the border. The block gets `1e-6` times the
/// areas of the image on the diagonal of u, without which the conformal group makes it singular;
/// convergence stays as quick as Newton's to that factor. Where it does not converge the guess is
/// the result.
[[nodiscard]] ConformalSolution solve_conformal(const VertexNumbers& numbers,
                                                const Sparse& stiffness,
                                                const Eigen::VectorXd& areas,
                                                const mesh::Positions& guess);

}  // namespace vesica::paper
