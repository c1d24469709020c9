#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace polynya::scene {

struct ResolveOptions {
  std::string level;                  ///< "quick", "standard" or "fine"; empty: quick
  std::vector<std::string> settings;  ///< "key=value", applied after the level, the last one wins
};

/// Reads a scene file (or FOLDER/scene.toml), applies level and settings, checks everything, fills in every default and
/// decides the effects. Throws SceneError with one line naming place, key and what is allowed.
Scene resolve(const std::filesystem::path& scene, const ResolveOptions& options = {});

}  // namespace polynya::scene
