#include "core/contact/closest_point.hpp"

namespace polynya::contact {
namespace {

ClosestPoint make(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& weights,
                  Feature feature) {
  const Vector3 q = weights[0] * a + weights[1] * b + weights[2] * c;
  const Vector3 d = p - q;
  return {weights, feature, dot(d, d)};
}

}  // namespace

ClosestPoint closest_point_on_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return make(p, a, b, c, {1, 0, 0}, Feature::vertex0);

  const Vector3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return make(p, a, b, c, {0, 1, 0}, Feature::vertex1);

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return make(p, a, b, c, {1 - v, v, 0}, Feature::edge01);
  }

  const Vector3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return make(p, a, b, c, {0, 0, 1}, Feature::vertex2);

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return make(p, a, b, c, {1 - w, 0, w}, Feature::edge20);
  }

  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return make(p, a, b, c, {0, 1 - w, w}, Feature::edge12);
  }

  const double denominator = 1 / (va + vb + vc);
  const double v = vb * denominator, w = vc * denominator;
  return make(p, a, b, c, {1 - v - w, v, w}, Feature::face);
}

}  // namespace polynya::contact
