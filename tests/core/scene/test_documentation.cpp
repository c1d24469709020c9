#include <sstream>

#include "core/scene/effects.hpp"
#include "core/scene/material_cards.hpp"
#include "core/scene/schema.hpp"
#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

std::string documentation() {
  std::ifstream file(std::filesystem::path(POLYNYA_SOURCE_DIR) / "docs" / "scene.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

bool names(const std::string& text, const std::string& word) {
  std::string code("`");
  code.append(word).append("`");
  return text.find(code) != std::string::npos;
}

TEST(Documentation, HoldsTheTableOfAllKeysAsTheProgramPrintsIt) {
  const auto text = documentation();
  std::istringstream lines(schema_as_markdown());
  for (std::string line; std::getline(lines, line);)
    EXPECT_NE(text.find(line), std::string::npos) << "docs/scene.md lacks: " << line;
}

TEST(Documentation, NamesEveryEffectLawValueAndCard) {
  const auto text = documentation();
  for (const auto& name : effect_names()) EXPECT_TRUE(names(text, name)) << name;
  for (const auto& law : law_names()) {
    EXPECT_TRUE(names(text, law)) << law;
    for (const auto& value : law_values(law)) EXPECT_TRUE(names(text, value.name)) << value.name;
  }
  for (const auto& item : std::filesystem::directory_iterator(project_materials()))
    EXPECT_TRUE(names(text, item.path().stem().string())) << item.path();
}

TEST(Documentation, EveryDefaultIsAllowed) {
  for (const KeyRule& rule : schema()) {
    if (rule.fallback == "auto" || rule.fallback == "required" || rule.kind == Kind::text) continue;
    if (rule.kind == Kind::choice) {
      EXPECT_NE(std::find(rule.choices.begin(), rule.choices.end(), rule.fallback), rule.choices.end()) << rule.path;
      continue;
    }
    const Quantity quantity = parse_quantity(rule.fallback);
    EXPECT_TRUE(quantity.bare || quantity.dimension == rule.dimension) << rule.path;
    EXPECT_TRUE(quantity.value >= rule.lower && quantity.value <= rule.upper) << rule.path;
  }
}

}  // namespace
}  // namespace polynya::scene
