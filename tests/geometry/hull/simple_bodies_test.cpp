#include "geometry/hull/simple_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "geometry/hull/solid_properties.hpp"

using namespace polynya::geometry;

namespace {

TriangleSoup moved(TriangleSoup surface, const Point& by) {
  for (Point& p : surface.points)
    for (std::size_t d = 0; d < 3; ++d) p[d] += by[d];
  return surface;
}

void expect_closed(const TriangleSoup& surface) {
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const Triangle& t : surface.triangles)
    for (std::size_t e = 0; e < 3; ++e) ++edges[{t[e], t[(e + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ((edges.count({edge.second, edge.first})), 1u);
  }
}

}  // namespace

TEST(SimpleBodies, AreClosedFaceOutwardAndHoldTheirVolume) {
  const double pi = std::numbers::pi, l = 0.03, w = 0.02, h = 0.01, d = 0.012;
  const std::vector<std::pair<TriangleSoup, double>> bodies{{sphere_surface(d, 1e-3), pi / 6 * d * d * d},
                                                            {cylinder_surface(d, h, 1e-3), pi / 4 * d * d * h},
                                                            {box_surface(l, w, h), l * w * h},
                                                            {wedge_surface(l, w, h), 0.5 * l * w * h}};
  for (const auto& [surface, volume] : bodies) {
    expect_closed(surface);
    EXPECT_NEAR(solid_properties(surface).volume / volume, 1, 1e-12);
  }
}

TEST(SimpleBodies, CentresAreThoseOfTheShapes) {
  for (const TriangleSoup& surface :
       {sphere_surface(0.01, 1e-3), cylinder_surface(0.01, 0.02, 1e-3), box_surface(0.01, 0.02, 0.03)})
    for (const double x : solid_properties(surface).centre) EXPECT_NEAR(x, 0, 1e-14);
  EXPECT_NEAR(solid_properties(wedge_surface(0.02, 0.01, 0.03)).centre[2], 0.02, 1e-14);  // two thirds up
}

TEST(SimpleBodies, TrianglesOfASphereAreOfOneSize) {
  const double edge = 0.5e-3;
  const TriangleSoup ball = sphere_surface(0.01, edge);
  for (const Triangle& t : ball.triangles)
    for (std::size_t e = 0; e < 3; ++e) {
      const Point &a = ball.points[t[e]], &b = ball.points[t[(e + 1) % 3]];
      const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      EXPECT_GT(length, 0.4 * edge);
      EXPECT_LT(length, 2.0 * edge);
    }
}

TEST(SimpleBodies, MeetWhereTheyCrossTouchOrLieInEachOther) {
  const TriangleSoup ball = sphere_surface(0.01, 1e-3), small = sphere_surface(0.004, 1e-3), box = box_surface(1, 1, 1);
  EXPECT_TRUE(bodies_meet(ball, moved(small, {0, 0, 0.0069})));
  EXPECT_FALSE(bodies_meet(ball, moved(small, {0, 0, 0.0072})));
  EXPECT_TRUE(bodies_meet(ball, moved(small, {0, 0, 0.0005})));
  EXPECT_TRUE(bodies_meet(moved(small, {0, 0, 0.0005}), ball));
  EXPECT_TRUE(bodies_meet(box, moved(box, {1, 0, 0})));
  EXPECT_FALSE(bodies_meet(box, moved(box, {1 + 1e-9, 0, 0})));
}
