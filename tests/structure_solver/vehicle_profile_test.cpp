#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/vehicle/vehicle_profile.hpp"

namespace polynya::geometry {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double a = 5e-3, length = 0.1;  // m, radius and length

TEST(VehicleProfile, HemisphereAndEllipsoidEncloseTheVolumeOfTheTextbook) {
  const double cylinder = pi * a * a;
  EXPECT_NEAR(enclosed_volume(Meridian(HeadShape::hemisphere, 0.01, 2 * a, length)) /
                  (2.0 / 3 * pi * a * a * a + cylinder * (length - a)),
              1, 1e-13);
  EXPECT_NEAR(enclosed_volume(Meridian(HeadShape::ellipsoid, 0.02, 2 * a, length)) /
                  (2.0 / 3 * pi * a * a * 0.02 + cylinder * (length - 0.02)),
              1, 1e-13);
}

TEST(VehicleProfile, OgiveEnclosesTheClosedFormOfItsArc) {
  const double h = 0.01, big = (a * a + h * h) / (2 * a), shift = big - a;
  // Integral of (sqrt(R^2 - x^2) - shift)^2 from 0 to h.
  const double root = std::sqrt(big * big - h * h);
  const double head =
      pi * (big * big * h - h * h * h / 3 + shift * shift * h - shift * (h * root + big * big * std::asin(h / big)));
  EXPECT_NEAR(enclosed_volume(Meridian(HeadShape::ogive, h, 2 * a, length)) / (head + pi * a * a * (length - h)), 1,
              1e-12);
}

TEST(VehicleProfile, PointsOfTheHeadLieOnTheOutlineAndNormalsAcrossIt) {
  for (const HeadShape head : {HeadShape::ogive, HeadShape::hemisphere, HeadShape::ellipsoid}) {
    const Meridian outline(head, 0.012, 2 * a, length);
    for (double share = 0.02; share < 1; share += 0.07) {
      const double arc = share * outline.head_arc(), step = 1e-6 * outline.head_arc();
      const MeridianPoint p = outline.head_point(arc), q = outline.head_point(arc + step);
      EXPECT_NEAR(p.radius, outline.radius_at(p.depth), 1e-12);
      const double chord = std::hypot(q.radius - p.radius, q.depth - p.depth);
      EXPECT_NEAR(chord / step, 1, 1e-3) << "arc length";
      EXPECT_NEAR(((q.radius - p.radius) * p.normal_radius + (q.depth - p.depth) * p.normal_depth) / chord, 0, 1e-5);
      EXPECT_NEAR(std::hypot(p.normal_radius, p.normal_depth), 1, 1e-14);
      EXPECT_GT(p.normal_radius, 0);
    }
  }
}

TEST(VehicleProfile, CavityOfAHemisphereIsAHemisphere) {
  const double t = 0.7e-3, inner = a - t;
  const Meridian outline(HeadShape::hemisphere, 0, 2 * a, length);
  EXPECT_NEAR(enclosed_volume(InnerOutline(outline, t)) /
                  (2.0 / 3 * pi * inner * inner * inner + pi * inner * inner * (length - t - a)),
              1, 1e-9);
}

TEST(VehicleProfile, CavityOfAnOgiveIsCutOffWhereItsWallsMeet) {
  const double t = 0.7e-3, h = 0.01, big = (a * a + h * h) / (2 * a);
  const Meridian outline(HeadShape::ogive, h, 2 * a, length);
  const InnerOutline cavity(outline, t);
  const MeridianPoint tip = cavity.head_point(cavity.first_arc());
  EXPECT_NEAR(tip.radius, 0, 1e-12);
  // The offset of an arc is an arc of the radius R - t about the same centre.
  EXPECT_NEAR(tip.depth, h - std::sqrt(std::pow(big - t, 2) - std::pow(big - a, 2)), 1e-12);
}

TEST(VehicleProfile, ImpossibleShapesAreRefusedWithAReason) {
  EXPECT_THROW(Meridian(HeadShape::ogive, 0.004, 2 * a, length), std::invalid_argument);
  EXPECT_THROW(Meridian(HeadShape::ellipsoid, 0.2, 2 * a, length), std::invalid_argument);
  EXPECT_THROW(Meridian(HeadShape::ellipsoid, 0.01, -1, length), std::invalid_argument);
  EXPECT_THROW(head_shape("flat"), std::invalid_argument);
  const Meridian outline(HeadShape::ellipsoid, 0.003, 2 * a, length);
  EXPECT_THROW(InnerOutline(outline, 0.0048), std::invalid_argument);
  EXPECT_THROW(InnerOutline(outline, 0.0018), std::invalid_argument) << "shoulder's radius of curvature is 1.8 mm";
}

}  // namespace
}  // namespace polynya::geometry
