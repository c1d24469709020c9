#include "fluid_solver/account.hpp"

namespace polynya::fluid {

const std::vector<std::string>& account_names() {
  static const std::vector<std::string> names{
      "kinetic", "internal", "gravity", "remap_loss", "hourglass", "node_fix", "put_to_rest", "boundary_work", "boundary_energy",
      "wall_work_vehicle", "wall_work_ice", "swept_defect",
      "momentum_x", "momentum_y", "momentum_z",
      "impulse_vehicle_x", "impulse_vehicle_y", "impulse_vehicle_z", "impulse_ice_x", "impulse_ice_y", "impulse_ice_z",
      "boundary_impulse_x", "boundary_impulse_y", "boundary_impulse_z",
      "node_fix_impulse_x", "node_fix_impulse_y", "node_fix_impulse_z", "rest_impulse_x", "rest_impulse_y", "rest_impulse_z",
      "gravity_impulse",
      "mass_water", "mass_air", "boundary_mass_water", "boundary_mass_air", "released_room", "swept_volume_vehicle", "swept_volume_ice"};
  return names;
}

std::vector<double> account_values(const Account& a) {
  return {a.kinetic, a.internal, a.gravity, a.remap_loss, a.hourglass, a.node_fix, a.put_to_rest, a.boundary_work, a.boundary_energy,
          a.wall_work[0], a.wall_work[1], a.swept_defect,
          a.momentum[0], a.momentum[1], a.momentum[2],
          a.body_impulse[0][0], a.body_impulse[0][1], a.body_impulse[0][2],
          a.body_impulse[1][0], a.body_impulse[1][1], a.body_impulse[1][2],
          a.boundary_impulse[0], a.boundary_impulse[1], a.boundary_impulse[2],
          a.node_fix_impulse[0], a.node_fix_impulse[1], a.node_fix_impulse[2], a.rest_impulse[0], a.rest_impulse[1], a.rest_impulse[2],
          a.gravity_impulse,
          a.mass[0], a.mass[1], a.boundary_mass[0], a.boundary_mass[1], a.released_room, a.swept_volume[0], a.swept_volume[1]};
}

}  // namespace polynya::fluid
