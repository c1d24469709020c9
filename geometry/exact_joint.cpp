// Where surfaces lie in one another, with CGAL's exact rational numbers.
#include "geometry/exact_cut.hpp"
#include "geometry/exact_number.hpp"
#include "geometry/joint_clip.hpp"

namespace polynya::geometry {

bool add_below_exactly(const JointCell& cell, const JointTriangle& piece, std::span<const JointTriangle> others,
                       JointSum& sum) {
  return JointClip<Rational>(cell).add_below(piece, others, sum);
}

}  // namespace polynya::geometry
