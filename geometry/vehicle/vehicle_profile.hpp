#pragma once
#include <string>
#include <vector>

namespace polynya::geometry {

enum class HeadShape {
  ogive,       ///< tangent ogive: a circular arc that meets the cylinder smoothly, pointed at the nose
  hemisphere,  ///< its head length is the radius, whatever was asked for
  ellipsoid    ///< half an ellipsoid of revolution of the given head length
};

/// "ogive", "hemisphere" or "ellipsoid"; std::invalid_argument otherwise.
HeadShape head_shape(const std::string& name);

/// A point of the meridian: distance from the axis, depth below the nose, and the unit normal pointing out of the body
/// (all in the plane of the meridian, m).
struct MeridianPoint {
  double radius = 0, depth = 0;
  double normal_radius = 0, normal_depth = 0;
};

/// The outline of a body of revolution: head, cylinder, flat base. Depth counts from the nose towards the base.
class Meridian {
 public:
  /// std::invalid_argument names the dimension at fault (m): diameter > 0, 0 < head_length < length, and an ogive at
  /// least as long as its radius (a shorter tangent arc does not exist).
  Meridian(HeadShape head, double head_length, double diameter, double length);

  HeadShape head() const { return head_; }
  double head_length() const { return head_length_; }
  double radius() const { return radius_; }
  double length() const { return length_; }
  /// Length of the head's outline from the nose to the shoulder.
  double head_arc() const { return head_arc_; }
  /// Point of the head at this arc length from the nose, 0..head_arc().
  MeridianPoint head_point(double arc) const;
  /// Distance of the outline from the axis at this depth, 0..length().
  double radius_at(double depth) const;
  /// Smallest radius of curvature of the head's outline; a wall as thick has no inner surface of its own.
  double least_curvature_radius() const;

 private:
  MeridianPoint ellipse_point(double angle) const;

  HeadShape head_;
  double head_length_, radius_, length_;
  double arc_radius_ = 0, nose_angle_ = 0;  ///< ogive and hemisphere: circle and the angle it turns through
  std::vector<double> ellipse_arc_;         ///< ellipsoid: arc length at equal steps of the eccentric angle
  double head_arc_ = 0;
};

/// Volume enclosed by the outline, m^3 (Gauss quadrature of pi r^2 along the head; exact to rounding).
double enclosed_volume(const Meridian& outline);

/// Outline of the cavity of a shell of this wall thickness: the meridian moved inwards along its normal, cut off where
/// it meets the axis (behind a pointed nose) and at the inner face of the base.
class InnerOutline {
 public:
  /// std::invalid_argument when the wall leaves no cavity or is thicker than the head is curved.
  InnerOutline(const Meridian& outer, double wall_thickness);

  /// Arc length (of the outer head) whose offset point lies on the axis: 0 unless the nose is pointed.
  double first_arc() const { return first_arc_; }
  /// Offset of the outer head point at this arc length: (radius, depth).
  MeridianPoint head_point(double outer_arc) const;
  const Meridian& outer() const { return outer_; }
  double radius() const { return outer_.radius() - thickness_; }
  double base_depth() const { return outer_.length() - thickness_; }
  double thickness() const { return thickness_; }

 private:
  Meridian outer_;
  double thickness_;
  double first_arc_ = 0;
};

/// Volume of the cavity, m^3, by quadrature.
double enclosed_volume(const InnerOutline& cavity);

}  // namespace polynya::geometry
