#pragma once
#include <stdexcept>

namespace polynya::results {

/// A result could not be written. The text names the file and the reason.
class ResultsError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace polynya::results
