#pragma once
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/contact/body.hpp"
#include "core/contact/vector3.hpp"

namespace polynya::contact {

/// Says when candidates that were found at an earlier time may miss one: when a vertex has moved farther, relative to
/// the other body, than it was allowed to. Near vertices are allowed the skin, far ones their distance.
class MotionWatch {
 public:
  /// Candidates are searched now, out to `reach` plus `skin` (m).
  void restart(const Body& primary, const Body& secondary, double reach, double skin);
  /// True if candidates within `reach` may be missing by now, or if a vertex moved by more than `margin` (m) in the
  /// last step alone, which took dt.
  bool outdated(const Body& primary, const Body& secondary, double dt, double margin);
  /// Longest relative motion of a vertex in the last step, m, as the last `outdated` found it.
  double step_motion() const { return step_motion_; }

  POLYNYA_STATE(primary_, secondary_, allowance_, chunk_excess_, chunk_motion_, step_motion_)

 private:
  struct Spread {  // of displacements of the primary: |displacement - centre| <= most
    Vector3 centre{};
    double most = 0;
  };
  template <class Displacement>
  static Spread spread(std::size_t count, Displacement&& of);

  std::vector<double> primary_, secondary_, allowance_, chunk_excess_, chunk_motion_;
  double step_motion_ = 0;
};

}  // namespace polynya::contact
