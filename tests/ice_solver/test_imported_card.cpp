// A deck of another code, through ./polynya card import, is the law that the programs compute with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/continuum/law.hpp"
#include "core/scene/material_cards.hpp"
#include "core/scene/resolve.hpp"

namespace polynya::ice {
namespace {

using continuum::JohnsonHolmquist2;

// Cronin et al. 2003, 4th European LS-DYNA Conf., in the table's own units mm, ton, s; density as in
// materials/alumina.toml.
const char* const deck =
    "*KEYWORD\n*MAT_JOHNSON_HOLMQUIST_CERAMICS_TITLE\nalumina\n"
    "         1   3.70E-9   90160.0      0.93      0.31       0.0      0.60      0.60\n"
    "       1.0     200.0       0.2    2790.0    1460.0       1.0\n"
    "     0.005       1.0  130950.0       0.0       0.0       0.0\n*END\n";

/// A scene whose ice is the imported card, which lies in materials beside it.
std::filesystem::path scene_with_imported_card() {
  const auto folder = std::filesystem::path(testing::TempDir()) / "polynya_imported_card";
  std::filesystem::create_directories(folder / "materials");
  std::ofstream(folder / "deck.k") << deck;
  std::ofstream(folder / "scene.toml") << "[ice]\nmaterial = \"alumina.imported\"\n[run]\nend_time = \"1 ms\"\n";
  const std::string command = "/usr/bin/python3 -B " POLYNYA_SOURCE_DIR "/polynya card import " +
                              (folder / "deck.k").string() + " --units ton,mm,s -o " +
                              (folder / "materials" / "alumina.imported.toml").string() + " > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return folder / "scene.toml";
}

JohnsonHolmquist2 law_of(const scene::MaterialCard& card) {
  return continuum::johnson_holmquist_2_from_card(card.name, card.values);
}

/// Stresses along x of one point that is pressed together along x by 5 % and let go again.
std::vector<double> pressed_and_released(const JohnsonHolmquist2& law) {
  continuum::PointState<double> state;
  std::vector<double> stresses;
  constexpr int steps = 200;
  for (int i = 0; i < 2 * steps; ++i) {
    const double step = (i < steps ? -1 : 1) * 0.05 / steps;
    state.relative_volume *= 1 + step;
    continuum::advance_stress(law, state, {step, 0, 0, 0, 0, 0}, 1e-8);
    stresses.push_back(state.stress[0]);
  }
  return stresses;
}

TEST(ImportedCard, OfTheDeckIsFoundByASceneAndGivesTheLawOfTheProjectsCard) {
  const auto resolved = scene::resolve(scene_with_imported_card());
  const JohnsonHolmquist2 imported = law_of(resolved.material("alumina.imported"));
  const JohnsonHolmquist2 own = law_of(scene::load_card(scene::project_materials() / "alumina.toml"));
  EXPECT_DOUBLE_EQ(imported.density, own.density);
  EXPECT_DOUBLE_EQ(imported.maximum_fractured_strength, own.maximum_fractured_strength);

  const auto found = pressed_and_released(imported), expected = pressed_and_released(own);
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NEAR(found[i], expected[i], 1e-9 * 7e9) << i;
  EXPECT_LT(*std::min_element(expected.begin(), expected.end()), -5e9);  // it was pressed beyond the elastic limit
}

}  // namespace
}  // namespace polynya::ice
