#pragma once

#include <memory>

#include "vesica/model/model.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/relax/controller.hpp"
#include "vesica/relax/mesh_controller.hpp"

namespace vesica::relax {

/// Makes the controller of `options.method`. It does not look at `options.enabled`.
[[nodiscard]] std::unique_ptr<Controller> make_mesh_controller(const AdaptionOptions& options,
                                                               const model::Model& model,
                                                               const problem::Scales& scales);

}  // namespace vesica::relax
