#pragma once
#include <array>
#include <string>
#include <vector>

namespace polynya::fluid {

/// Where energy, momentum and mass are, SI. The energies from `kinetic` to `vapour` add up to a constant.
/// Works and impulses are sums since the start; an energy is positive once it has left the fluid into that reservoir.
struct Account {
  double kinetic = 0, internal = 0;
  double gravity = 0;                 ///< minus the work of gravity
  double remap_loss = 0;              ///< kinetic energy lost by mixing momentum in the remap (and carried out)
  double hourglass = 0;               ///< dissipated by the viscosity of hourglass modes
  double node_fix = 0;                ///< kinetic energy removed from nodes nearly covered by solid and at walls
  double put_to_rest = 0;             ///< kinetic energy of nodes that fell asleep, or are held beside sleeping cells
  double boundary_work = 0;           ///< pressure on open boundaries
  double boundary_energy = 0;         ///< internal energy carried out through open boundaries
  std::array<double, 2> wall_work{};  ///< into vehicle and ice, by absolute pressure
  std::array<double, 2> swept_volume{};  ///< that the walls of vehicle and ice gave way, m^3
  double swept_defect = 0;   ///< pressure times the change of volume, debris too, that is neither wall motion nor
                             ///< balanced among neighbours
  double vapour = 0;         ///< minus the work of water's least pressure in cells that cavitate
  double released_room = 0;  ///< volume that breaking solids left at once, m^3
  std::array<double, 3> momentum{};
  std::array<std::array<double, 3>, 2> body_impulse{};  ///< to vehicle and ice (absolute pressure)
  std::array<double, 3> boundary_impulse{};  ///< to the surroundings: open boundaries, walls, what flowed out
  std::array<double, 3> node_fix_impulse{};  ///< to bodies by nodes nearly covered
  std::array<double, 3> rest_impulse{};      ///< dropped: of nodes that fell asleep, and what would move nodes at rest
  double gravity_impulse = 0;                ///< minus the weight's impulse along z
  std::array<double, 2> mass{};              ///< water, air
  std::array<double, 2> boundary_mass{};     ///< carried out

  double energy_sum() const {
    return kinetic + internal + gravity + remap_loss + hourglass + node_fix + put_to_rest + boundary_work +
           boundary_energy + wall_work[0] + wall_work[1] + swept_defect + vapour;
  }
};

const std::vector<std::string>& account_names();
std::vector<double> account_values(const Account& account);

}  // namespace polynya::fluid
