#pragma once
#include <cstdint>
#include <vector>

#include "core/contact/penalty_contact.hpp"

namespace polynya::ice {

struct IceBody;

/// Contact of the ice with itself: of particles with the surface of intact elements that they are not bonded to (by
/// their origins, as in NeighbourList), and of surface nodes with faces that are not around them.
struct OwnContact {
  bool active = false;
  bool stale = true;  ///< the surface or the particles are others than when it was set up
  contact::SelfContact contact{{}};
  double stored = 0;      ///< J, in its springs
  double dissipated = 0;  ///< J, by friction, damping, and what falling stiffness released

  // The surface in reference to which it was set up, nodes first, then particles.
  std::vector<std::int32_t> nodes, triangles;
  std::vector<std::int64_t> ids;
  std::vector<double> masses, radii, positions, velocities;
  std::vector<double> point_origins, point_reaches, triangle_origins, triangle_reaches;

  POLYNYA_STATE(active, stale, contact, stored, dissipated, nodes, triangles, ids, masses, radii, positions, velocities,
                point_origins, point_reaches, triangle_origins, triangle_reaches)
};

/// Adds the forces of the present configuration, reached in a step of dt (s), to the ice's pair forces and to the
/// forces on its particles, and keeps the energies. Nothing happens before there are particles.
void add_own_contact(IceBody& ice, double dt);

}  // namespace polynya::ice
