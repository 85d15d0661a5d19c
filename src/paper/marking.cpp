#include <algorithm>

#include "adapt/nodal_fields.hpp"
#include "bisected_edges.hpp"

namespace vesica::paper {
namespace {

/// Growth of the wanted diameters until the mesh is small enough.
constexpr double growth = 1.05;
constexpr int nodes_per_bisected_edge = 4;  // a vertex, and three edges

std::vector<Mark> marks_for(const Eigen::VectorXd& diameters, const Eigen::VectorXd& wanted) {
  std::vector<Mark> marks(static_cast<std::size_t>(diameters.size()), Mark::keep);
  for (Eigen::Index t = 0; t < diameters.size(); ++t) {
    Mark& mark = marks[static_cast<std::size_t>(t)];
    if (diameters[t] > wanted[t]) mark = Mark::refine;
    if (diameters[t] < 0.5 * wanted[t]) mark = Mark::coarsen;
  }
  return marks;
}

}  // namespace

Eigen::VectorXd diameters(const mesh::Surface& surface) {
  Eigen::VectorXd result(surface.triangulation->num_triangles());
  Eigen::Index t = 0;
  for (const mesh::QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    const auto sides = side_lengths(surface, nodes);
    result[t++] = *std::max_element(sides.begin(), sides.end());
  }
  return result;
}

Eigen::VectorXd wanted_diameters(const mesh::Surface& surface,
                                 const fem::NodalShapeOperator& shape_operator,
                                 const adapt::PhaseInterface& phases,
                                 const BisectionOptions& options) {
  const bool has_phases = phases.order_parameter.size() > 0;
  adapt::check_nodal_fields("marking", surface, shape_operator, phases);
  Eigen::VectorXd wanted(surface.triangulation->num_triangles());
  Eigen::Index t = 0;
  for (const mesh::QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    double mean_curvature = 0;
    bool is_in_interface = false;
    for (const mesh::NodeIndex node : nodes) {
      mean_curvature += fem::norm(shape_operator, node) / 6;
      is_in_interface |= phases.contains(node);
    }
    // Without curvature infinite, which max_size replaces.
    double diameter = std::min(options.max_size, options.n_kappa / mean_curvature);
    if (has_phases)
      diameter =
          std::min(diameter, phases.width / (is_in_interface ? options.n_in : options.n_off));
    wanted[t++] = diameter;
  }
  return wanted;
}

std::vector<Mark> marks(const mesh::Surface& surface, const Eigen::VectorXd& wanted_diameters,
                        double max_nodes) {
  const Eigen::VectorXd present = diameters(surface);
  const double limit = (max_nodes - surface.triangulation->num_nodes()) / nodes_per_bisected_edge;
  Eigen::VectorXd wanted = wanted_diameters;
  while (true) {
    std::vector<Mark> result = marks_for(present, wanted);
    const int num_bisected = bisected_edges(surface, result).count;
    if (num_bisected == 0 || num_bisected <= limit) return result;
    wanted *= growth;
  }
}

}  // namespace vesica::paper
