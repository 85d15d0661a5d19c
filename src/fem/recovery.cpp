#include "vesica/fem/recovery.hpp"

#include <cmath>
#include <vector>

#include "vesica/core/parallel.hpp"
#include "vesica/fem/block_assembly.hpp"
#include "vesica/fem/mass_matrix.hpp"
#include "vesica/fem/surface_integral.hpp"

namespace vesica::fem {

namespace {

constexpr std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// Adds up local vectors of three components a node, stored as (T, 6, 3).
NodalTriple gather(const NodeGraph& graph, const std::vector<double>& local, int threads) {
  NodalTriple result(graph.num_nodes(), 3);
  gather_nodal(graph, local, threads, result);
  return result;
}

/// Element mass matrices (T, 36) and the right-hand sides int grad phi_i of kappa_hat (T, 6, 3).
struct FirstPass {
  std::vector<double> mass;
  std::vector<double> gradients;
};

FirstPass first_pass(const mesh::Triangulation& triangulation, const mesh::Positions& positions,
                     int threads) {
  const auto count = at(triangulation.num_triangles());
  FirstPass pass{std::vector<double>(count * 36), std::vector<double>(count * 18)};
  parallel_for(triangulation.num_triangles(), threads, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto& triangle = triangulation.triangles()[at(t)];
      double* mass = &pass.mass[at(t) * 36];
      double* gradients = &pass.gradients[at(t) * 18];
      for_each_point(triangle, positions, [&](const SurfaceSample& sample) {
        for (std::size_t i = 0; i < 6; ++i) {
          const auto g = surface_gradient(sample.frame, sample.weight * sample.shape.du[i],
                                          sample.weight * sample.shape.dv[i]);
          gradients[3 * i] += g.x;
          gradients[3 * i + 1] += g.y;
          gradients[3 * i + 2] += g.z;
          for (std::size_t j = 0; j < 6; ++j)
            mass[6 * i + j] += sample.weight * sample.shape.value[i] * sample.shape.value[j];
        }
      });
    }
  });
  return pass;
}

/// Right-hand sides of Q_h, symmetric parts: diagonal components (T, 6, 3) and off-diagonal ones
/// (T, 6, 3).
struct SecondPass {
  std::vector<double> diagonal;
  std::vector<double> off_diagonal;
};

SecondPass second_pass(const mesh::Triangulation& triangulation, const mesh::Positions& positions,
                       const NodalTriple& kappa_hat, int threads) {
  const auto count = at(triangulation.num_triangles());
  SecondPass pass{std::vector<double>(count * 18), std::vector<double>(count * 18)};
  parallel_for(triangulation.num_triangles(), threads, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto& triangle = triangulation.triangles()[at(t)];
      double* diagonal = &pass.diagonal[at(t) * 18];
      double* off_diagonal = &pass.off_diagonal[at(t) * 18];
      for_each_point(triangle, positions, [&](const SurfaceSample& sample) {
        const auto kappa = to_vec3(combine<3>(kappa_hat, triangle, sample.shape.value));
        const auto& n = sample.frame.normal;
        for (std::size_t i = 0; i < 6; ++i) {
          // z = kappa_hat phi_i - grad phi_i;  Q_ab phi_i integrates nu_a z_b
          const auto gradient =
              surface_gradient(sample.frame, sample.shape.du[i], sample.shape.dv[i]);
          const auto z = sample.weight * (sample.shape.value[i] * kappa - gradient);
          diagonal[3 * i] += n.x * z.x;
          diagonal[3 * i + 1] += n.y * z.y;
          diagonal[3 * i + 2] += n.z * z.z;
          off_diagonal[3 * i] += 0.5 * (n.x * z.y + n.y * z.x);
          off_diagonal[3 * i + 1] += 0.5 * (n.y * z.z + n.z * z.y);
          off_diagonal[3 * i + 2] += 0.5 * (n.x * z.z + n.z * z.x);
        }
      });
    }
  });
  return pass;
}

}  // namespace

NodalShapeOperator recover_shape_operator(const mesh::Triangulation& triangulation,
                                          const NodeGraph& graph, const mesh::Positions& positions,
                                          int threads) {
  const FirstPass first = first_pass(triangulation, positions, threads);
  const MassMatrix mass = gather_mass_matrix(graph, first.mass, threads);
  const auto gradients = gather(graph, first.gradients, threads);
  const auto kappa_hat = solve_mass_matrix(mass, gradients, threads);
  const SecondPass second = second_pass(triangulation, positions, kappa_hat, threads);
  const auto diagonal = gather(graph, second.diagonal, threads);
  const auto off_diagonal = gather(graph, second.off_diagonal, threads);
  NodalShapeOperator result(graph.num_nodes(), 6);
  parallel_for(2, threads, [&](int begin, int end) {
    for (int part = begin; part < end; ++part) {
      if (part == 0) result.leftCols<3>() = solve_mass_matrix(mass, diagonal, 1);
      if (part == 1) result.rightCols<3>() = solve_mass_matrix(mass, off_diagonal, 1);
    }
  });
  return result;
}

double norm(const NodalShapeOperator& shape_operator, Eigen::Index node) {
  const auto q = shape_operator.row(node);
  return std::sqrt(q.head<3>().squaredNorm() + 2 * q.tail<3>().squaredNorm());
}

}  // namespace vesica::fem
