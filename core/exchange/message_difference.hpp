#pragma once
#include <string>

#include "core/exchange/message.hpp"

namespace polynya::exchange {

/// How a message departs from the one on record.
struct MessageDifference {
  std::string first;    ///< empty: equal bit for bit. "array 'positions', value [17][2] is 0.5, on record is 0.25"
  std::string largest;  ///< the same for the largest difference
  /// The largest difference: of a number in the header relative to the recorded one, of a value of an array relative to
  /// the largest magnitude in the recorded array; infinite where something is missing, new, of another size or no
  /// floating-point number. Numbers of `finished` have no size: they follow from what was compared before, and some are
  /// errors about 0, where nothing is relative.
  double size = 0;
};

/// Compares all fields of the header and all arrays, found by name. 0 and -0 differ, a NaN equals itself.
MessageDifference compare(const Message& sent, const Message& recorded);

}  // namespace polynya::exchange
