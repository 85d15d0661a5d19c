#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vesica/core/fields.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// How a mesh is changed. local: remeshing towards a size field; bisection: Section 3.5 of the
/// paper; conformal: the same, and images of a sphere mesh where the quality falls, Section 3.6.
enum class MeshMethod { local, bisection, conformal };

}  // namespace vesica::relax

namespace vesica {
template <>
struct EnumNames<relax::MeshMethod> {
  using enum relax::MeshMethod;
  static constexpr std::array<std::pair<relax::MeshMethod, std::string_view>, 3> names{
      {{local, "local"}, {bisection, "bisection"}, {conformal, "conformal"}}};
};
}  // namespace vesica

namespace vesica::relax {

/// Changes of the mesh during a run; sizes as in adapt::SizeFieldOptions and
/// paper::BisectionOptions. Each method reads its own keys, `max_size` and `max_nodes`.
struct AdaptionOptions {
  bool enabled = false;
  MeshMethod method = MeshMethod::local;
  double curvature_angle = 0.4;
  double interface_size = 0.85;
  double final_curvature_angle = 0.18;
  double final_interface_size = 0.2;
  double max_size = 0.3;
  int max_nodes = 14000;
  int min_steps = 8;
  double n_in = 1.6;
  double n_off = 0.3;
  double n_kappa = 0.4;
  int every = 5;
  double conformal_quality = 0.3;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    using enum MeshMethod;
    visit(Field{"enabled", "-",
                "new meshes where the surface needs them; not for method semi-implicit"},
          self.enabled);
    visit(Field{"method", "-",
                "local (towards a size field), bisection (3.5) or conformal (bisection, and the "
                "image of a sphere mesh, 3.6, for bad ones)"},
          self.method);
    visit(Field{"curvature_angle", "rad", "edge times curvature while the vesicle moves",
                Rule::positive, Users(local)},
          self.curvature_angle);
    visit(Field{"interface_size", "-",
                "edge in the phase interface over interface_width while the vesicle moves",
                Rule::positive, Users(local)},
          self.interface_size);
    visit(Field{"final_curvature_angle", "rad", "edge times curvature near the equilibrium",
                Rule::positive, Users(local)},
          self.final_curvature_angle);
    visit(Field{"final_interface_size", "-",
                "edge in the phase interface over interface_width near the equilibrium",
                Rule::positive, Users(local)},
          self.final_interface_size);
    visit(Field{"max_size", "R_c", "longest edge of an element", Rule::positive}, self.max_size);
    visit(Field{"max_nodes", "-",
                "elements are enlarged to stay within this number of nodes, as far as the surface "
                "allows",
                Rule::at_least_one},
          self.max_nodes);
    visit(
        Field{"min_steps", "-", "steps of a flow between changes of the mesh, but for emergencies",
              Rule::at_least_one, Users(local)},
        self.min_steps);
    bisection_fields(self, visit);
  }
  /// Throws ConfigError for fields that are changed but not used by the method.
  void check_together() const;

 private:
  template <class Self, class Visitor>
  static void bisection_fields(Self& self, Visitor&& visit) {
    using enum MeshMethod;
    visit(Field{"n_in", "-",
                "interface_width over the diameter of elements in the phase "
                "interface",
                Rule::positive, Users(bisection, conformal)},
          self.n_in);
    visit(Field{"n_off", "-", "interface_width over the diameter of elements elsewhere",
                Rule::positive, Users(bisection, conformal)},
          self.n_off);
    visit(Field{"n_kappa", "-", "diameter of elements times curvature", Rule::positive,
                Users(bisection, conformal)},
          self.n_kappa);
    visit(Field{"every", "-", "steps between changes of the mesh", Rule::at_least_one,
                Users(bisection, conformal)},
          self.every);
    visit(Field{"conformal_quality", "-",
                "quality (3.5) below which a sphere mesh is laid on the surface", Rule::fraction,
                Users(conformal)},
          self.conformal_quality);
  }
};

/// Asks for a new mesh when the present one no longer fits. With L the wanted size of edges, coarse
/// while the vesicle moves and fine near the equilibrium, at least min_steps after the last change:
///
///     quality (3.5) below 0.3 and below 0.75 of what it was after the last change
///     an edge longer than 1.9 L (of coarse meshes: a new mesh disturbs what is near rest)
///     fewer than 0.55 of the nodes are wanted
///     once, normal velocity without rigid motion below 0.03 (natural units): the fine mesh, until
///     the velocity is above 0.3 again
///
/// without waiting: an edge longer than 2.2 L, of a fine mesh below that velocity 3 L; after failed
/// steps, 5 times at most; and before the run ends in an equilibrium: the fine mesh if there is
/// none yet.
///
/// A minimiser has no velocity but a distance to the minimum (solve::StepReport::gradient), and
/// its steps are few and long. It gets the fine mesh below the distance 0.01, coarse ones again
/// above 0.3, at least 2 steps after the last change, and at once when it has been below 1e-3 on
/// the fine mesh and comes above 0.01: it has left a saddle and may have far to go. Once it is near
/// the minimum on the fine mesh, that mesh stays, whatever its edges, and below 1e-3 also after a
/// failed step.
class MeshController final : public Controller {
 public:
  /// Makes the controller. The `scales` of the case give the units of max_size and of the velocity.
  MeshController(const AdaptionOptions& options, model::Model model, const problem::Scales& scales);
  [[nodiscard]] std::vector<Request> respond(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_failure(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_rest(const StepView& view) override;

 private:
  [[nodiscard]] adapt::SizeFieldOptions size_options() const;
  [[nodiscard]] std::vector<Request> ask(const StepView& view, std::string reason);
  [[nodiscard]] std::optional<std::string> misfit(const StepView& view) const;
  [[nodiscard]] bool may_change(const StepView& view) const;
  [[nodiscard]] bool is_slow(const StepView& view) const;
  [[nodiscard]] bool is_moving(const StepView& view) const;
  [[nodiscard]] bool has_left_saddle(const StepView& view);
  [[nodiscard]] double speed(const StepView& view) const;

  AdaptionOptions options_;
  model::Model model_;
  problem::Scales scales_;
  bool is_final_ = false;
  bool was_at_equilibrium_ = false;    // a minimiser, on the fine mesh
  long last_change_ = 0;               // step
  std::optional<double> new_quality_;  // after the last change; absent until it is seen
  int changes_after_failures_ = 0;
};

}  // namespace vesica::relax
