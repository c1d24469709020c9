// The clipping of the production path with CGAL's exact rational numbers.
#include "geometry/clip_record.hpp"
#include "geometry/exact_cut.hpp"
#include "geometry/exact_number.hpp"

namespace polynya::geometry {
namespace {

BasicCorner<Rational> exact(const Corner& corner) {
  return {{Rational(corner.x[0]), Rational(corner.x[1]), Rational(corner.x[2])}, corner.slab};
}

}  // namespace

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
