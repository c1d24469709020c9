#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace polynya::scene {

struct ResolveOptions {
  std::string level;                  ///< "quick", "standard" or "fine"; empty: quick
  std::vector<std::string> settings;  ///< "key=value", applied after the level, the last one wins
  std::string mesh = {};              ///< JSON object with the facts of the ice's mesh file, as the launcher found them
};

/// What must be known of a mesh file before the scene can be resolved.
struct WantedMesh {
  std::string file;               ///< full path
  std::string unit;               ///< of its coordinates
  long pieces = 1;                ///< that it may fall into
  std::vector<int> planes;        ///< axes (0: x, 1: y) whose planes of symmetry cut it
  std::vector<std::string> sets;  ///< that the scene names
};

/// The mesh file of a scene whose ice has one, and no facts in the options. Throws SceneError.
std::optional<WantedMesh> wanted_mesh(const std::filesystem::path& scene, const ResolveOptions& options);
nlohmann::json to_json(const WantedMesh& wanted);

/// Reads a scene file (or FOLDER/scene.toml), applies level and settings, checks everything, fills in every default and
/// decides the effects. Throws SceneError with one line naming place, key and what is allowed.
Scene resolve(const std::filesystem::path& scene, const ResolveOptions& options = {});

}  // namespace polynya::scene
