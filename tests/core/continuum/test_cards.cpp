#include <gtest/gtest.h>

#include "core/continuum/law.hpp"

namespace polynya::continuum {
namespace {

std::string message_of(const std::string& law, const std::map<std::string, double>& values) {
  try {
    law_from_card("ice.test", law, values);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(MaterialCard, NamesTheMissingConstant) {
  EXPECT_EQ(message_of("elastic", {{"density", 900}, {"youngs_modulus", 9e9}}),
            "material card 'ice.test': poisson_ratio is missing");
}

TEST(MaterialCard, RefusesUnphysicalConstants) {
  EXPECT_NE(message_of("elastic", {{"density", -1}, {"youngs_modulus", 9e9}, {"poisson_ratio", 0.3}}).find("density"),
            std::string::npos);
  EXPECT_NE(message_of("elastic", {{"density", 1}, {"youngs_modulus", 9e9}, {"poisson_ratio", 0.5}}).find("poisson"),
            std::string::npos);
  EXPECT_NE(message_of("johnson_holmquist_2", {{"density", 900},
                                               {"shear_modulus", 4e9},
                                               {"bulk_modulus", 8e9},
                                               {"pressure_at_hugoniot_elastic_limit", 3e9},
                                               {"hugoniot_elastic_limit", 2e9}})
                .find("hugoniot_elastic_limit must exceed"),
            std::string::npos);
}

TEST(MaterialCard, RefusesAnUnknownLaw) {
  EXPECT_EQ(message_of("rubber", {}),
            "material card 'ice.test': law is 'rubber', a solid needs elastic, j2_plastic or johnson_holmquist_2");
}

TEST(MaterialCard, ElasticConstantsGiveTheWaveSpeeds) {
  const Law law = law_from_card("ice", "elastic", {{"density", 900}, {"youngs_modulus", 9e9}, {"poisson_ratio", 0.3}});
  EXPECT_NEAR(longitudinal_wave_speed(law), std::sqrt(9e9 * 0.7 / (900 * 1.3 * 0.4)), 1e-9);
  EXPECT_NEAR(shear_wave_speed(law), std::sqrt(9e9 / (900 * 2.6)), 1e-9);
}

}  // namespace
}  // namespace polynya::continuum
