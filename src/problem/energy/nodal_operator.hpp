#pragma once

#include <vector>

#include "element_packs.hpp"
#include "vesica/fem/block_assembly.hpp"

namespace vesica::problem {

/// Weights of grad . grad and of the product in an operator of second order.
struct OperatorWeights {
  Pack stiffness;
  Pack mass;
};

/// Assembles int stiffness grad phi_i . grad phi_j + mass phi_i phi_j, shape (N, N), on the surface
/// of `fields`. weights_at(c, cosine) gives the weights at a point, the cosine being that between
/// the normal and `directions`, shape (N, 3).
template <class WeightsAt>
linalg::SparseMatrix assemble_operator(const EnergyProblem& problem, const EnergyFields& fields,
                                       const mesh::Positions& directions, int threads,
                                       const WeightsAt& weights_at) {
  const auto& triangulation = problem.triangulation();
  std::vector<double> local(triangulation.triangles().size() * 36);
  const EnergyFields surface{fields.positions, directions, fields.order_parameter, fields.time};
  for_each_pack(triangulation.num_triangles(), threads, [&](int first) {
    const auto element = element_pack<Pack>(triangulation, first, surface, {});
    std::array<Pack, 36> table{};
    for (const auto& point : fem::triangle_rule()) {
      const auto& shape = point.shape;
      const auto frame = fem::tangent_frame(interpolate_nodes(element.x, shape.du),
                                            interpolate_nodes(element.x, shape.dv));
      const Pack cosine = dot(frame.normal, interpolate_nodes(element.p, shape.value));
      const OperatorWeights weights =
          weights_at(interpolate_nodes(element.c, shape.value), abs(cosine));
      const Pack area = point.weight * frame.area_element;
      std::array<Vec3<Pack>, 6> gradient;
      for (std::size_t i = 0; i < 6; ++i) {
        gradient[i] = fem::surface_gradient(frame, Pack(shape.du[i]), Pack(shape.dv[i]));
      }
      for (std::size_t i = 0; i < 6; ++i) {
        const Vec3<Pack> along = (area * weights.stiffness) * gradient[i];
        const Pack row = shape.value[i] * area * weights.mass;
        for (std::size_t j = 0; j < 6; ++j)
          table[6 * i + j] += dot(along, gradient[j]) + shape.value[j] * row;
      }
    }
    store(table, first, local);
  });
  auto matrix = problem.graph().block_pattern(1);
  fem::gather_blocks<1>(problem.graph(), local, threads, matrix);
  return matrix;
}

}  // namespace vesica::problem
