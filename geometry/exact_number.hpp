#pragma once
#include <CGAL/Exact_rational.h>

#include "geometry/clip.hpp"

/// CGAL's exact rational numbers in clipping. Internal to the room.
namespace polynya::geometry {

using Rational = CGAL::Exact_rational;

template <>
struct NumberKind<Rational> {
  static double nearest(const Rational& x) { return CGAL::to_double(x); }
  static std::int32_t slab(const LineLocator& lines, const Rational& x, std::int32_t first, std::int32_t last) {
    std::int32_t slab = std::clamp(lines.below(CGAL::to_double(x)), first, last);
    while (slab > first && !(x > lines.line(slab))) --slab;  // where x and its double lie beside a plane
    while (slab < last && x > lines.line(slab + 1)) ++slab;
    return slab;
  }
};

}  // namespace polynya::geometry
