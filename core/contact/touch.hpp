#pragma once
#include <array>
#include <cstdint>

#include "core/contact/vector3.hpp"

namespace polynya::contact {

/// What a pair in contact remembers.
struct PairState {
  std::int32_t feature = -1;   ///< triangle (or edge) of the surface that holds the point; -1: free
  bool born = false;           ///< the law has not seen it yet
  bool inside = false;         ///< the point itself was behind the surface
  bool accepted = false;       ///< found inside without having come through the surface
  double stiffness = 0;        ///< N/m
  double depth = 0;            ///< m, in the last step
  double offset = 0;           ///< m, depth that exerts no force
  double inherited_force = 0;  ///< N, of vanished neighbours whose place the point takes
  double normal_force = 0;     ///< N, in the last step
  double friction_force = 0;   ///< N, likewise
  double elastic_slip = 0;     ///< m, length of the tangential spring
  double compressed = 0;       ///< m, depth beyond the offset
  double held_energy = 0;      ///< J, in both springs
  double dropped = 0;          ///< J, see ended(), not yet booked
  Vector3 place{};             ///< m, where it acted in the last step
  Vector3 slip{};              ///< m, stretch of the tangential spring, in the frame of Touch
};

/// Energy to book when a pair parts, its depth now being `depth` (m, not above 0): what the tangential spring holds,
/// less what the last step gives to the bodies beyond what the normal spring held (see ContactSprings).
inline double ended(const PairState& state, double depth) {
  return 0.5 * state.stiffness * (state.elastic_slip * state.elastic_slip - state.compressed * (state.offset - depth));
}

/// One contact in one step: up to two vertices are pushed along `push`, up to three of the other body against it.
struct Touch {
  enum class Kind : std::uint8_t { point, edges };
  Kind kind = Kind::point;
  bool swapped = false;  ///< the pushed vertices are the primary body's
  std::array<std::int32_t, 2> pushed{};
  std::array<double, 2> pushed_weights{1, 0};
  std::array<std::int32_t, 3> opposed{};
  std::array<double, 3> opposed_weights{};
  Vector3 push{};       ///< minus the gradient of the depth, length 1 but on a rim
  double depth = 0;     ///< m
  Vector3 slip{};       ///< m, stretch of the tangential spring at the last step, turned with the material since
  std::array<Vector3, 3> frame{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};  ///< turns with the material
  double share = 1;     ///< of the stiffness of a pair: half where both surfaces' vertices are looked at
  PairState* state = nullptr;
  // Filled in by the law.
  double stiffness = 0;      ///< N/m
  double damping_force = 0;  ///< N, beyond that of the spring
  double approach = 0;       ///< m/s, rate of depth
};

}  // namespace polynya::contact
