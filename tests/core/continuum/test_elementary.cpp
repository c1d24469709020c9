#include <gtest/gtest.h>

#include <cmath>

#include "core/compute/pack.hpp"
#include "core/continuum/elementary.hpp"

namespace polynya::continuum {
namespace {

using compute::Pack;

TEST(Elementary, LogarithmAgreesWithTheLibrary) {
  for (double x = 1e-290; x < 1e290; x *= 1.37) {
    EXPECT_NEAR(log2_of(x), std::log2(x), 4e-16 * std::max(1.0, std::abs(std::log2(x)))) << x;
    EXPECT_NEAR(log2_of(Pack(x))[0], std::log2(x), 4e-16 * std::max(1.0, std::abs(std::log2(x)))) << x;
  }
  for (double x = 0.6; x < 1.6; x += 1e-3) EXPECT_NEAR(log2_of(x), std::log2(x), 2.5e-16) << x;
}

TEST(Elementary, ExponentialAgreesWithTheLibrary) {
  for (double x = -999; x < 999; x += 0.377) {
    EXPECT_NEAR(exp2_of(x) / std::exp2(x), 1.0, 5e-16) << x;
    EXPECT_NEAR(exp2_of(Pack(x))[0] / std::exp2(x), 1.0, 5e-16) << x;
  }
  EXPECT_EQ(exp2_of(-5000.0), 0.0);
  EXPECT_EQ(exp2_of(0.0), 1.0);
}

}  // namespace
}  // namespace polynya::continuum
