#include "vesica/relax/make_mesh_controller.hpp"

#include "vesica/relax/bisection_controller.hpp"

namespace vesica::relax {

std::unique_ptr<Controller> make_mesh_controller(const AdaptionOptions& options,
                                                 const model::Model& model,
                                                 const problem::Scales& scales) {
  if (options.method == MeshMethod::local)
    return std::make_unique<MeshController>(options, model, scales);
  return std::make_unique<BisectionController>(options, model, scales);
}

}  // namespace vesica::relax
