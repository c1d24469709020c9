// The clipping of the production path with CGAL's exact rational numbers.
#include <CGAL/Exact_rational.h>

#include "geometry/clip_record.hpp"
#include "geometry/exact_cut.hpp"

namespace polynya::geometry {
namespace {

using Rational = CGAL::Exact_rational;

BasicCorner<Rational> exact(const Corner& corner) {
  return {{Rational(corner.x[0]), Rational(corner.x[1]), Rational(corner.x[2])}, corner.slab};
}

}  // namespace

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

void clip_exactly(const std::array<LineLocator, 3>& lines, std::span<const Corner> corners,
                  std::span<const std::int32_t> triangles, std::size_t begin, std::size_t end,
                  std::vector<PieceRecord>& records) {
  BasicClipper<Rational> clipper(lines, records);
  for (std::size_t t = begin; t < end; ++t) {
    const auto corner = [&](std::size_t c) { return exact(corners[static_cast<std::size_t>(triangles[3 * t + c])]); };
    const BasicCorner<Rational> a = corner(0), b = corner(1), c = corner(2);
    clipper.cut(static_cast<std::int32_t>(t), a, b, c);
  }
}

}  // namespace polynya::geometry
