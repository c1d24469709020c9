#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/document.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/units.hpp"

namespace polynya::scene {

/// One value that a law needs.
struct LawValue {
  std::string name;
  Dimension dimension;
  double lower;     ///< smallest allowed
  bool lower_open;  ///< lower itself is not allowed
  bool optional = false;
};

/// The values of a law. Throws std::out_of_range for an unknown law.
const std::vector<LawValue>& law_values(const std::string& law);
const std::vector<std::string>& law_names();

/// The folder of cards that comes with the project.
std::filesystem::path project_materials();

/// Reads and checks a card. Throws SceneError naming file, line and key.
MaterialCard load_card(const std::filesystem::path& file);

/// Reads card `name` from the first folder that has it. `asked` ("file:line: vehicle.material") starts the message
/// of the SceneError if none has.
MaterialCard find_card(const std::string& name, const std::vector<std::filesystem::path>& folders,
                       const std::string& asked);

/// Replaces values of a card by those that a scene gives (keys are the names of values). Throws SceneError.
void override_values(MaterialCard& card, const Document& values);

/// Throws std::invalid_argument if the constants contradict one another.
void check_card(const MaterialCard& card);

}  // namespace polynya::scene
