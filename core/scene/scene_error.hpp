#pragma once
#include <stdexcept>
#include <string>

namespace polynya::scene {

/// Wrong input. The message is one line: where (file:line or the command-line option), which key, what is wrong, what
/// is allowed. Programs print it and exit with code 2.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace polynya::scene
