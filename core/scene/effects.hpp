#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace polynya::scene {

/// Names of all effects, in the order of the documentation.
const std::vector<std::string>& effect_names();

/// What the decision about the effects looks at: the requests and what the scene file contains.
struct EffectRequest {
  std::map<std::string, std::string> requested;  ///< effect -> "auto", "on", "off"; absent: auto
  bool has_fluid_section = false;                ///< [water] and [air], or [tube]
};

/// Thrown when an effect is requested that cannot be had, or shall go where it cannot; `effect` names it, what() says
/// why and what is allowed.
struct ImpossibleEffect : std::runtime_error {
  ImpossibleEffect(std::string name, const std::string& what) : std::runtime_error(what), effect(std::move(name)) {}
  std::string effect;
};

/// Decides every effect of a scene whose parts are filled in, and makes the scene agree with the decision (fluid off:
/// no fluid; gravity off: 0; friction off: 0; rigid vehicle; sides that reflect). Throws ImpossibleEffect.
void decide_effects(Scene& scene, const EffectRequest& request);

}  // namespace polynya::scene
