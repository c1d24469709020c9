#include "core/contact/closest_point.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace polynya::contact;

namespace {

/// Independent path: dense sampling of the triangle.
double sampled_squared_distance(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  double least = 1e300;
  constexpr int steps = 200;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const double u = double(i) / steps, v = double(j) / steps;
      const Vector3 d = p - ((1 - u - v) * a + u * b + v * c);
      least = std::min(least, dot(d, d));
    }
  return least;
}

}  // namespace

TEST(ClosestPoint, IsNoFartherThanAnySampleOfTheTriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vector3{uniform(random), uniform(random), uniform(random)}; };
  for (int n = 0; n < 200; ++n) {
    const Vector3 a = point(), b = point(), c = point(), p = 2.0 * point();
    const ClosestPoint found = closest_point_on_triangle(p, a, b, c);
    const double sampled = sampled_squared_distance(p, a, b, c);
    EXPECT_LE(found.squared_distance, sampled + 1e-12);
    EXPECT_NEAR(std::sqrt(found.squared_distance), std::sqrt(sampled), 0.02);
    EXPECT_NEAR(found.weights[0] + found.weights[1] + found.weights[2], 1.0, 1e-12);
    for (double w : found.weights) EXPECT_GE(w, -1e-12);
  }
}
