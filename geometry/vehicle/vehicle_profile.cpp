#include "geometry/vehicle/vehicle_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace polynya::geometry {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int ellipse_steps = 512;

/// Integral of f over [a, b] by the five-point Gauss rule.
template <class Function>
double gauss(double a, double b, Function&& f) {
  constexpr std::array<double, 3> node = {0.0, 0.53846931010568309104, 0.90617984593866399280};
  constexpr std::array<double, 3> weight = {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751};
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  double sum = weight[0] * f(middle);
  for (int i = 1; i < 3; ++i) sum += weight[i] * (f(middle - half * node[i]) + f(middle + half * node[i]));
  return half * sum;
}

template <class Function>
double integral(double a, double b, int panels, Function&& f) {
  double sum = 0;
  for (int p = 0; p < panels; ++p) sum += gauss(a + (b - a) * p / panels, a + (b - a) * (p + 1) / panels, f);
  return sum;
}

[[noreturn]] void reject(const std::string& what) {
  throw std::invalid_argument("vehicle: " + what);
}

}  // namespace

HeadShape head_shape(const std::string& name) {
  if (name == "ogive") return HeadShape::ogive;
  if (name == "hemisphere") return HeadShape::hemisphere;
  if (name == "ellipsoid") return HeadShape::ellipsoid;
  reject("head = \"" + name + "\" is unknown; it can be ogive, hemisphere or ellipsoid");
}

Meridian::Meridian(HeadShape head, double head_length, double diameter, double length)
    : head_(head), head_length_(head_length), radius_(0.5 * diameter), length_(length) {
  if (!(diameter > 0)) reject("the diameter must be positive");
  if (head == HeadShape::hemisphere) head_length_ = radius_;
  if (!(head_length_ > 0 && head_length_ < length)) reject("head_length must lie between 0 and the length");
  if (head == HeadShape::ellipsoid) {
    ellipse_arc_.assign(ellipse_steps + 1, 0.0);
    const auto speed = [this](double angle) {
      return std::hypot(radius_ * std::cos(angle), head_length_ * std::sin(angle));
    };
    for (int i = 0; i < ellipse_steps; ++i) {
      const double a = 0.5 * pi * i / ellipse_steps, b = 0.5 * pi * (i + 1) / ellipse_steps;
      ellipse_arc_[i + 1] = ellipse_arc_[i] + gauss(a, b, speed);
    }
    head_arc_ = ellipse_arc_.back();
    return;
  }
  if (head_length_ < radius_ * (1 - 1e-12)) reject("an ogive must be at least as long as its radius; use ellipsoid");
  arc_radius_ = 0.5 * (radius_ * radius_ + head_length_ * head_length_) / radius_;
  nose_angle_ = std::atan2(head_length_, arc_radius_ - radius_);
  head_arc_ = arc_radius_ * nose_angle_;
}

MeridianPoint Meridian::ellipse_point(double angle) const {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const double norm = std::hypot(sine * head_length_, cosine * radius_);
  return {radius_ * sine, head_length_ * (1 - cosine), sine * head_length_ / norm, -cosine * radius_ / norm};
}

MeridianPoint Meridian::head_point(double arc) const {
  arc = std::clamp(arc, 0.0, head_arc_);
  if (arc == head_arc_) return {radius_, head_length_, 1.0, 0.0};
  if (head_ != HeadShape::ellipsoid) {
    const double angle = (head_arc_ - arc) / arc_radius_;
    const double radius = radius_ - 2 * arc_radius_ * std::pow(std::sin(0.5 * angle), 2);
    return {arc == 0 ? 0.0 : radius, arc == 0 ? 0.0 : head_length_ - arc_radius_ * std::sin(angle), std::cos(angle),
            -std::sin(angle)};
  }
  // The table is fine enough that linear interpolation of the angle moves a node along the exact curve by less than
  // 1e-5 of the arc; the point itself is always on the curve.
  const auto above = std::upper_bound(ellipse_arc_.begin(), ellipse_arc_.end(), arc);
  const auto i = static_cast<int>(above - ellipse_arc_.begin()) - 1;
  const double share = (arc - ellipse_arc_[i]) / (ellipse_arc_[i + 1] - ellipse_arc_[i]);
  return ellipse_point(0.5 * pi * (i + share) / ellipse_steps);
}

double Meridian::radius_at(double depth) const {
  if (depth <= 0) return 0;
  if (depth >= head_length_) return radius_;
  const double rest = head_length_ - depth;
  if (head_ == HeadShape::ellipsoid) return radius_ * std::sqrt(1 - std::pow(rest / head_length_, 2));
  return std::sqrt(arc_radius_ * arc_radius_ - rest * rest) + radius_ - arc_radius_;
}

double Meridian::least_curvature_radius() const {
  if (head_ != HeadShape::ellipsoid) return arc_radius_;
  // A narrow nose is no obstacle (the offset is cut off at the axis); a narrow shoulder is.
  return head_length_ * head_length_ / radius_;
}

double enclosed_volume(const Meridian& outline) {
  const double section = pi * outline.radius() * outline.radius();
  if (outline.head() == HeadShape::ellipsoid) return section * (outline.length() - outline.head_length() / 3);
  // Along the arc the integrand is smooth also where the outline starts at right angles to the axis.
  const double head = integral(0, outline.head_arc(), 40, [&](double arc) {
    const MeridianPoint p = outline.head_point(arc);
    return pi * p.radius * p.radius * p.normal_radius;
  });
  return head + section * (outline.length() - outline.head_length());
}

InnerOutline::InnerOutline(const Meridian& outer, double wall_thickness) : outer_(outer), thickness_(wall_thickness) {
  if (!(wall_thickness > 0)) reject("the wall thickness must be positive");
  if (wall_thickness > 0.9 * outer.radius()) reject("the wall is thicker than 0.9 of the radius; use a solid interior");
  if (wall_thickness > 0.9 * outer.least_curvature_radius())
    reject("the wall is thicker than 0.9 of the head's radius of curvature; use a longer head or a thinner wall");
  const auto offset_radius = [&](double arc) {
    const MeridianPoint p = outer.head_point(arc);
    return p.radius - wall_thickness * p.normal_radius;
  };
  // The offset of a pointed nose starts beyond the axis and crosses it once (bisection; the shoulder is inside).
  double low = 0, high = outer.head_arc();
  if (outer.head_point(0).normal_radius > 1e-12 || offset_radius(1e-6 * high) < 0) {
    for (int i = 0; i < 200 && high - low > 0; ++i) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (offset_radius(middle) < 0 ? low : high) = middle;
    }
    first_arc_ = high;
  }
  if (head_point(first_arc_).depth >= base_depth()) reject("the wall leaves no cavity");
}

MeridianPoint InnerOutline::head_point(double outer_arc) const {
  MeridianPoint p = outer_.head_point(outer_arc);
  p.radius = std::max(0.0, p.radius - thickness_ * p.normal_radius);
  p.depth -= thickness_ * p.normal_depth;
  return p;
}

double enclosed_volume(const InnerOutline& cavity) {
  const Meridian& outer = cavity.outer();
  // d(depth) of the offset curve = normal_radius (1 - t kappa) d(arc); the curvature from a small difference would lose
  // digits, so the head is summed as frustums on a fine partition with one Richardson step.
  const auto frustums = [&](int count) {
    double sum = 0;
    MeridianPoint a = cavity.head_point(cavity.first_arc());
    for (int i = 1; i <= count; ++i) {
      const MeridianPoint b =
          cavity.head_point(cavity.first_arc() + (outer.head_arc() - cavity.first_arc()) * i / count);
      sum += pi / 3 * (b.depth - a.depth) * (a.radius * a.radius + a.radius * b.radius + b.radius * b.radius);
      a = b;
    }
    return sum;
  };
  const double coarse = frustums(2000), fine = frustums(4000);
  return fine + (fine - coarse) / 3 +
         pi * cavity.radius() * cavity.radius() * (cavity.base_depth() - outer.head_length());
}

}  // namespace polynya::geometry
