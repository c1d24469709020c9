#include "structure_solver/vehicle_body.hpp"

namespace polynya::structure {

std::array<double, account_entries.size()> account_values(const Account& a) {
  return {a.kinetic,          a.internal,    a.hourglass,   a.viscous,           a.external_work,   a.gravity_work,
          a.step_change,      a.momentum[0], a.momentum[1], a.momentum[2],       a.gravity_impulse, a.mass,
          a.centre_of_mass_z, a.speed_z,     a.head_stress, a.head_stress_vertex};
}

}  // namespace polynya::structure
