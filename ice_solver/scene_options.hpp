#pragma once
#include "core/scene/scene.hpp"
#include "ice_solver/ice_body.hpp"

namespace polynya::ice {

/// What the scene says about the ice. Throws std::invalid_argument or std::runtime_error naming key or card at fault.
IceOptions options_from_scene(const scene::Scene& scene);

/// How many such parts make the full model: 1, 2 or 4.
double multiplicity(const scene::Scene& scene);

}  // namespace polynya::ice
