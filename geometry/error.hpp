#pragma once
#include <stdexcept>

namespace polynya::geometry {

/// A surface or a grid that cannot be used. The text says what is wrong and where.
class GeometryError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace polynya::geometry
