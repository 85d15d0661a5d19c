#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vesica/model/model.hpp"
#include "vesica/paper/bisection.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/relax/controller.hpp"
#include "vesica/relax/mesh_controller.hpp"

namespace vesica::relax {

/// Asks for the mesh changes of the paper, Sections 3.5 and 3.6: every `every` steps one bisection
/// of elements that are larger than wanted and one coarsening of those below half of that. With
/// method conformal the conformal image of a sphere mesh instead, when the quality (3.5) is below
/// `conformal_quality` and below 0.75 of what it was after the last one was asked for; where the
/// image is no better, the bisection. Without waiting: after failed steps, 5 times at most, an
/// image (conformal) or a bisection; and before the run ends in an equilibrium, 10 times at most, a
/// bisection as long as elements are larger than wanted.
class BisectionController final : public Controller {
 public:
  /// Makes the controller. The `scales` of the case give the unit of max_size.
  BisectionController(const AdaptionOptions& options, model::Model model,
                      const problem::Scales& scales);
  [[nodiscard]] std::vector<Request> respond(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_failure(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_rest(const StepView& view) override;

 private:
  [[nodiscard]] paper::BisectionOptions marking() const;
  [[nodiscard]] BisectionPlan bisection(const StepView& view) const;
  [[nodiscard]] std::vector<Request> ask(const StepView& view, MeshPlan plan, std::string reason);
  [[nodiscard]] std::vector<Request> ask_for_bisection(const StepView& view, std::string reason);
  [[nodiscard]] std::vector<Request> ask_for_image(const StepView& view, std::string reason);
  [[nodiscard]] bool has_low_quality(const StepView& view) const;

  AdaptionOptions options_;
  model::Model model_;
  problem::Scales scales_;
  std::shared_ptr<const mesh::Triangulation> first_mesh_;  // not made by bisection
  long last_change_ = 0;                                   // step
  double image_quality_ = 1;                               // after the last image
  bool is_new_image_ = false;
  int changes_after_failures_ = 0;
  int changes_at_rest_ = 0;
};

}  // namespace vesica::relax
