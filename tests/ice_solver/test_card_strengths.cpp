#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/continuum/law.hpp"
#include "core/scene/material_cards.hpp"

namespace polynya::ice {
namespace {

struct Strengths {
  double tension, at_1, at_10, at_100;  // MPa
};

Strengths strengths_of(const std::string& name) {
  const scene::MaterialCard card = scene::load_card(scene::project_materials() / (name + ".toml"));
  const auto law = continuum::johnson_holmquist_2_from_card(card.name, card.values);
  const auto crushed = [&](double rate) { return 1e-6 * continuum::unconfined_compressive_strength(law, rate); };
  const Strengths s{1e-6 * continuum::uniaxial_tensile_strength(law, 1), crushed(1), crushed(10), crushed(100)};
  std::printf("%s: tension %.2f MPa, compression %.1f, %.1f, %.1f, %.1f, %.1f MPa at 0.1 to 1000/s\n", name.c_str(),
              s.tension, crushed(0.1), s.at_1, s.at_10, s.at_100, crushed(1000));
  return s;
}

// Jones 1997, J. Phys. Chem. B 101:6099; Petrovic 2003, J. Mater. Sci. 38:1.
TEST(IceCards, FreshIceCrushesAsJonesAndBreaksAsPetrovicMeasured) {
  const Strengths s = strengths_of("ice.fresh");
  EXPECT_NEAR(s.tension, 1.43, 0.05);
  EXPECT_NEAR(s.at_1, 8.9, 0.02 * 8.9);
  EXPECT_NEAR(s.at_10, 8.9 * std::pow(10, 0.15), 0.02 * 12.6);
  EXPECT_NEAR(s.at_100, 8.9 * std::pow(100, 0.15), 0.05 * 17.8);
}

// Jones 1997; Kujala et al. 1990, mean bending strength 0.58 MPa.
TEST(IceCards, BalticIceCrushesAsJonesAndBreaksAsKujalaMeasured) {
  const Strengths s = strengths_of("ice.baltic");
  EXPECT_NEAR(s.tension, 0.58, 0.02);
  EXPECT_NEAR(s.at_1, 6.0, 0.06 * 6.0);
  EXPECT_NEAR(s.at_10, 6.0 * std::pow(10, 0.19), 0.06 * 9.3);
  EXPECT_NEAR(s.at_100, 6.0 * std::pow(100, 0.19), 0.06 * 14.4);
}

// The printed rate constant C = 0.2287 makes the surface steeper than the uniaxial path.
TEST(IceCards, ThePrintedCardHardlyCrushesAtAHundredPerSecond) {
  const Strengths s = strengths_of("ice.paper");
  EXPECT_NEAR(s.tension, 1.43, 0.05);
  EXPECT_GT(s.at_100, 30 * 17.8);
}

}  // namespace
}  // namespace polynya::ice
