#include "geometry/clip_record.hpp"

namespace polynya::geometry {

template class BasicClipper<double>;

}  // namespace polynya::geometry
