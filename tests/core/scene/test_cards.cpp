#include <cmath>

#include "core/scene/material_cards.hpp"
#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

MaterialCard project_card(const std::string& name) {
  return load_card(project_materials() / (name + ".toml"));
}

std::string card_error(const std::string& text) {
  try {
    load_card(scene_file(text));
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

TEST(MaterialCards, AllLoadAndEveryValueHasAnOrigin) {
  int count = 0;
  for (const auto& item : std::filesystem::directory_iterator(project_materials())) {
    const MaterialCard card = load_card(item.path());
    EXPECT_NO_THROW(check_card(card));
    EXPECT_FALSE(card.values.empty());
    for (const auto& [name, value] : card.values) {
      const auto& origin = card.origin.at(name);
      EXPECT_TRUE(origin.starts_with("literature: ") || origin.starts_with("calibrated: ") ||
                  origin.starts_with("assumed: "))
          << card.name << ' ' << name;
      EXPECT_TRUE(std::isfinite(value));
    }
    EXPECT_EQ(card.values.size(), card.origin.size());
    ++count;
  }
  EXPECT_EQ(count, 13);
}

/// Johnson & Holmquist 1994: HEL = P_HEL + 2/3 sigma_HEL, sigma_HEL = 2 G mu / (1 + mu), P_HEL = K1 mu + K2 mu^2 + K3
/// mu^3.
TEST(MaterialCards, IceFulfilsTheIdentitiesOfTheHugoniotElasticLimit) {
  for (const std::string name : {"ice.paper", "ice.fresh"}) {
    const MaterialCard card = project_card(name);
    const double pressure = card.value("pressure_at_hugoniot_elastic_limit"), shear = card.value("shear_modulus");
    const double stress = 1.5 * (card.value("hugoniot_elastic_limit") - pressure);
    EXPECT_NEAR(stress, 2642.85e6, 1);
    const double mu = stress / (2 * shear - stress);
    EXPECT_NEAR(mu, 0.423, 5e-4);
    const double from_state =
        mu * (card.value("bulk_modulus") + mu * (card.value("bulk_modulus_2") + mu * card.value("bulk_modulus_3")));
    EXPECT_NEAR(from_state / pressure, 1, 1e-5);
    EXPECT_NEAR(card.value("bulk_modulus"), 8.13e9, 0.01e9);
  }
}

/// Unconfined strength where q = sigma_HEL A ((p + T) / P_HEL)^N with p = q/3 (compression) or -q/3 (tension), at 1/s.
double unconfined_strength(const MaterialCard& card, double sign) {
  const double limit = card.value("pressure_at_hugoniot_elastic_limit");
  const double scale = 1.5 * (card.value("hugoniot_elastic_limit") - limit) * card.value("intact_strength_constant");
  double q = 0;
  for (int i = 0; i < 500; ++i) {
    const double base = (sign * q / 3 + card.value("maximum_tensile_pressure")) / limit;
    q += 0.5 * (scale * std::pow(base, card.value("intact_strength_exponent")) - q);
  }
  return q;
}

TEST(MaterialCards, IceHasTheMeasuredUnconfinedStrengths) {
  for (const std::string name : {"ice.paper", "ice.fresh"}) {
    EXPECT_NEAR(unconfined_strength(project_card(name), -1), 1.43e6, 0.03e6);  // Petrovic 2003, mean
    EXPECT_NEAR(unconfined_strength(project_card(name), 1), 8.9e6, 0.1e6);     // Jones 1997 at 1/s
  }
}

TEST(MaterialCards, AirIsAtAtmosphericPressureAtItsStart) {
  const MaterialCard air = project_card("air");
  EXPECT_NEAR(air.value("c4") * air.value("initial_energy"), 101325, 1e-6);
}

TEST(MaterialCards, IcePaperHasNoLimitOfItsFracturedStrength) {
  EXPECT_FALSE(project_card("ice.paper").has("maximum_fractured_strength"));
  EXPECT_THROW(project_card("ice.paper").value("maximum_fractured_strength"), std::runtime_error);
}

TEST(MaterialCards, MistakesAreNamed) {
  const std::string head = "law = \"elastic\"\nsummary = \"x\"\n";
  const std::string e = "[youngs_modulus]\nvalue = \"1 GPa\"\norigin = \"assumed: test\"\n";
  const std::string nu = "[poisson_ratio]\nvalue = 0.3\norigin = \"assumed: test\"\n";
  const std::string rho = "[density]\nvalue = 900\norigin = \"assumed: test\"\n";
  EXPECT_EQ(card_error(head + e + nu + rho), "");
  EXPECT_NE(card_error(head + e + nu).find("density: missing"), std::string::npos);
  EXPECT_NE(card_error(head + e + nu + "[densty]\nvalue = 900\n").find("did you mean 'density'?"), std::string::npos);
  EXPECT_NE(card_error(head + e + nu + "[density]\nvalue = 900\n").find("density.origin: missing"), std::string::npos);
  EXPECT_NE(card_error(head + e + nu + "[density]\nvalue = 900\norigin = \"somebody\"\n").find("literature: "),
            std::string::npos);
  EXPECT_NE(card_error("law = \"elastc\"\n").find("unknown law 'elastc'"), std::string::npos);
}

TEST(MaterialCards, ACardBesideTheSceneWins) {
  const auto file = scene_file("[ice]\nmaterial = \"mine\"\n[run]\nend_time = \"1 ms\"\n");
  std::filesystem::create_directories(file.parent_path() / "materials");
  std::filesystem::copy_file(project_materials() / "ice.fresh.toml", file.parent_path() / "materials" / "mine.toml",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(resolve(file).material("mine").value("strain_rate_constant"), 0.05);
}

}  // namespace
}  // namespace polynya::scene
