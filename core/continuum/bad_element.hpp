#pragma once
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace polynya::continuum {

/// The first element of a body that left the range of the equations: inverted, or a stress that is no number.
struct BadElement : std::runtime_error {
  BadElement(const std::string& message, std::size_t which, std::array<double, 3> where, double when)
      : std::runtime_error(message), element(which), position(where), time(when) {}
  std::size_t element;
  std::array<double, 3> position;  ///< m, of its centre
  double time;                     ///< s
};

}  // namespace polynya::continuum
