// Groups of cells share one thermodynamic state: what they hold together, the pressure inside them, what
// they give through faces, and how their content is spread again after the remap.
#include <algorithm>
#include <cmath>

#include "fluid_solver/group_strain.hpp"
#include "fluid_solver/phases.hpp"
#include "fluid_solver/prediction.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"

namespace polynya::fluid {
namespace {

double height_of(const Grid& grid, std::ptrdiff_t cell) {
  return grid.centre_z(static_cast<int>(cell / grid.sz));
}

void member_strains(const Fluid& fluid, std::size_t g, std::vector<double>& strain) {
  member_strains(
      fluid, g, fluid.before.volume, [&](std::ptrdiff_t c) { return fluid.rate[c]; }, strain);
}

/// Water bears differences of pressure inside a group, and a member may cavitate beside one that does not.
bool bears_differences(const GroupState& state) {
  return state.content.mass[air] == 0 && state.content.mass[water] > void_density * state.volume;
}

bool cavitates(const GroupState& state) {
  return bears_differences(state) && state.point.bulk_modulus <= 0;
}

/// How much more than its group a member is compressed by the weight of the fluid between them.
double weight_compression(const Fluid& fluid, const GroupState& state, std::ptrdiff_t cell) {
  if (!bears_differences(state) || cavitates(state)) return 0;
  const double rho = (state.content.mass[0] + state.content.mass[1]) / state.volume;
  return rho * fluid.setup.gravity * (state.height - height_of(fluid.grid, cell)) / state.point.bulk_modulus;
}

/// The state of a member of a cavitating group by its own density: void in one cell is no reason for the next to give
/// way. Were all given the mean, a void would hide the compression of its neighbours until the group parts, at once.
void evaluate_cavitating_member(Fluid& fluid, const GroupState& state, std::ptrdiff_t cell, double share) {
  if (!(share * state.content.mass[water] > void_density * state.volume)) {  // a member that holds nothing
    fluid.pressure[cell] = fluid.setup.pressure_floor[water];
    fluid.density[cell] = fluid.bulk_modulus[cell] = fluid.sound_speed[cell] = 0;
    return;
  }
  const PointState own =
      point_state(fluid.setup.law[water], fluid.setup.pressure_floor[water], share * state.content.mass[water],
                  share * state.content.energy[water], state.volume);
  fluid.pressure[cell] = own.pressure;
  fluid.density[cell] = share * state.content.mass[water] / state.volume;
  fluid.bulk_modulus[cell] = own.bulk_modulus;
  fluid.sound_speed[cell] = own.sound_speed;
}

}  // namespace

void evaluate_groups(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  fluid.group_states.assign(fluid.groups.count(), {});
  fluid.own_compression.assign(fluid.groups.members.size(), 0.0);
  for (std::size_t g = 0; g < fluid.groups.count(); ++g) {
    GroupState& state = fluid.group_states[g];
    double moment = 0, centre = 0;
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      const double volume = fluid.before.volume[c];
      state.volume += volume;
      moment += volume * height_of(grid, c);
      centre += height_of(grid, c);
      for (int m = 0; m < 2; ++m) {
        state.content.mass[m] += fluid.material[m].mass[c];
        state.content.energy[m] += fluid.material[m].energy[c];
        state.content.volume[m] += fluid.material[m].volume[c];
      }
    }
    const double mass = state.content.mass[0] + state.content.mass[1];
    const bool filled = state.volume > 0 && mass > void_density * state.volume;
    state.height = filled ? moment / state.volume : centre / (fluid.groups.first[g + 1] - fluid.groups.first[g]);
    if (filled) state.point = settle(fluid.setup.law, fluid.setup.pressure_floor, state.volume, state.content);
    const double rho = filled ? mass / state.volume : 0.0;
    const int held = (state.content.mass[0] > 0 ? 1 : 0) | (state.content.mass[1] > 0 ? 2 : 0);
    const bool differs = bears_differences(state);
    double* compression = fluid.own_compression.data() + fluid.groups.first[g];
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      if (differs && fluid.before.volume[c] > 0)
        *compression = fluid.total_mass[c] / (rho * fluid.before.volume[c]) - 1.0 - weight_compression(fluid, state, c);
      const double own = state.point.bulk_modulus * *compression;
      fluid.pressure[c] =
          filled ? state.point.pressure + rho * fluid.setup.gravity * (state.height - height_of(grid, c)) + own
          : state.volume > 0 ? fluid.setup.pressure_floor[water]
                             : 0.0;
      fluid.density[c] = rho;
      fluid.bulk_modulus[c] = state.point.bulk_modulus;
      fluid.sound_speed[c] = state.point.sound_speed;
      if (cavitates(state)) evaluate_cavitating_member(fluid, state, c, 1.0 + *compression);
      ++compression;
      int i, j, k;
      grid.position(c, i, j, k);
      fluid.row_materials[static_cast<std::size_t>(j + (grid.ny + 3) * k)] |= static_cast<unsigned char>(held);
    }
  }
}

void predict_group_pressure(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const double linear = linear_viscosity(fluid);
  std::vector<double> strains;
  for (std::size_t g = 0; g < fluid.groups.count(); ++g) {
    const GroupState& state = fluid.group_states[g];
    member_strains(fluid, g, strains);
    const double* strain_of = strains.data();
    const double floor = std::max(state.content.mass[0] > 0 ? fluid.setup.pressure_floor[0] : -1e300,
                                  state.content.mass[1] > 0 ? fluid.setup.pressure_floor[1] : -1e300);
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      const double strain = *strain_of++;
      int i, j, k;
      grid.position(c, i, j, k);
      const double length = std::min({grid.dx[i], grid.dy[j], grid.dz[k]}), closing = std::max(0.0, -strain);
      const double q = fluid.density[c] * length * closing *
                       (quadratic_viscosity * length * closing + linear * fluid.sound_speed[c]);
      const double ahead = fluid.pressure[c] - fluid.bulk_modulus[c] * dt * group_prediction * strain;
      fluid.predicted_pressure[c] = std::max(ahead, floor) + q;
      fluid.viscosity[c] = 0;
    }
  }
}

void set_group_donors(Fluid& fluid, double dt) {
  std::vector<double> strains;
  for (std::size_t g = 0; g < fluid.groups.count(); ++g) {
    const GroupState& state = fluid.group_states[g];
    double change = 0, work = 0;
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      change += dt * fluid.rate[c];
      work += dt * fluid.rate[c] * (fluid.predicted_pressure[c] - pressure_of_vapour(fluid, c));
    }
    const std::array<double, 2> share =
        volume_shares(fluid.setup.law, fluid.setup.pressure_floor, state.content, change);
    const double volume = state.volume + change, inverse = volume > 0 ? 1.0 / volume : 0.0;
    if (bears_differences(state)) {
      member_strains(fluid, g, strains);
      double* compression = fluid.own_compression.data() + fluid.groups.first[g];
      // A member that is nearly void thins out as densities do, so that it does not come to less than nothing.
      for (const double strain : strains) {
        const double own = dt * strain, thinner = own > 0 ? 1.0 / (1.0 + own) : 1.0 - own;
        *compression = (1.0 + *compression) * (1.0 + change / state.volume) * thinner - 1.0;
        ++compression;
      }
    }
    const int materials = (state.content.mass[0] > 0 ? 1 : 0) | (state.content.mass[1] > 0 ? 2 : 0);
    bool root = true;
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      fluid.row_materials[static_cast<std::size_t>(c / fluid.grid.sy)] |= static_cast<unsigned char>(materials);
      for (int m = 0; m < 2; ++m) {
        const double energy = state.content.energy[m] - share[m] * work;
        const double own = state.content.volume[m] + share[m] * change;
        fluid.donor[m].mass[c] = state.content.mass[m] * inverse;
        fluid.donor[m].energy[c] = energy * inverse;
        fluid.donor[m].volume[c] = own * inverse;
        // Only the sum over the group matters until it is spread again; the masses stay where they are.
        fluid.material[m].energy[c] = root ? energy : 0.0;
        fluid.material[m].volume[c] = root ? own : 0.0;
      }
      root = false;
    }
  }
}

namespace {

/// From the leaves to the root each member shares its excess over its parent with it.
std::vector<double> shares_of_cavitating(const Fluid& fluid, const MembersOfGroup& range, const double* compression) {
  const auto volume = [&](std::size_t m) { return fluid.after.volume[range.first[m].cell]; };
  const auto count = static_cast<std::size_t>(range.end() - range.begin());
  std::vector<double> share(count);
  for (std::size_t m = 0; m < count; ++m) share[m] = volume(m) * (1.0 + compression[m]);
  for (std::size_t m = count - 1; m > 0; --m) {
    const auto& [c, parent] = range.first[m];
    const std::size_t p = position_of(range, parent, m);
    const double own = volume(m), other = volume(p), together = own + other;
    if (!(together > 0)) continue;
    const double kept = std::min(kept_share(fluid.grid, c, own), kept_share(fluid.grid, parent, other));
    const double moved = (1.0 - kept) * (share[m] * other - share[p] * own) / together;
    share[m] -= moved;
    share[p] += moved;
  }
  double sum = 0;
  for (const double one : share) sum += one;
  for (double& one : share) one /= sum;
  return share;
}

/// Shares of the group's mass that its members get: by volume, more below, and where a member is compressed by itself.
/// The emptier a cell under half full, the more of that is evened out: all of it in an empty cell, nothing in a
/// half-full one, which would be a cell of its own. So cells join and leave groups without a jolt. In a group that
/// cavitates the difference is evened out with the parent: a full void has a density of its own, but it is what the
/// water of a film beside it spreads into.
std::vector<double> mass_shares(const Fluid& fluid, std::size_t g) {
  const MembersOfGroup range = members_of(fluid.groups, g);
  const double* compression = fluid.own_compression.data() + fluid.groups.first[g];
  if (cavitates(fluid.group_states[g])) return shares_of_cavitating(fluid, range, compression);
  std::vector<double> share;
  double sum = 0;
  for (const auto& [c, parent] : range) {
    const double volume = fluid.after.volume[c], kept = kept_share(fluid.grid, c, volume);
    share.push_back(volume * (1.0 + weight_compression(fluid, fluid.group_states[g], c) + kept * *compression++));
    sum += share.back();
  }
  for (double& one : share) one /= sum;
  return share;
}

}  // namespace

void mix_groups(Fluid& fluid) {
  for (std::size_t g = 0; g < fluid.groups.count(); ++g) {
    std::array<double, 2> mass{}, energy{}, held{};
    double volume = 0;
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      volume += fluid.after.volume[c];
      for (int m = 0; m < 2; ++m) {
        mass[m] += fluid.material[m].mass[c];
        energy[m] += fluid.material[m].energy[c];
        held[m] += fluid.material[m].volume[c];
      }
    }
    if (!(volume > 0)) {
      if (mass[0] + mass[1] > 0)
        throw FluidError("solids have closed the last room of " + std::to_string(mass[0] + mass[1]) + " kg of fluid");
      continue;
    }
    // From the leaves to the root: what a cell has too much goes through the face to its parent.
    const MembersOfGroup range = members_of(fluid.groups, g);
    const std::vector<double> share = mass_shares(fluid, g);
    std::vector<double> surplus(share.size());
    for (std::size_t m = 0; m < surplus.size(); ++m) {
      const std::ptrdiff_t c = range.first[m].cell;
      surplus[m] = fluid.material[0].mass[c] + fluid.material[1].mass[c] - (mass[0] + mass[1]) * share[m];
    }
    for (std::size_t m = surplus.size() - 1; m > 0; --m) {
      const auto& [c, parent] = range.first[m];
      const std::ptrdiff_t step = c - parent, stride = std::abs(step);
      const int axis = stride == 1 ? 0 : stride == fluid.grid.sy ? 1 : 2;
      fluid.face_mass[axis][std::max(c, parent)] += step > 0 ? -surplus[m] : surplus[m];
      surplus[position_of(range, parent, m)] += surplus[m];
    }
    for (std::size_t at = 0; at < share.size(); ++at) {
      const std::ptrdiff_t c = range.first[at].cell;
      for (int m = 0; m < 2; ++m) {
        fluid.material[m].mass[c] = mass[m] * share[at];
        fluid.material[m].energy[c] = energy[m] * share[at];
        fluid.material[m].volume[c] = held[m] * (fluid.after.volume[c] / volume);
      }
    }
  }
}

void pressures_after_step(const Fluid& fluid, std::size_t g, double dt, std::vector<double>& pressure) {
  const MembersOfGroup range = members_of(fluid.groups, g);
  const GroupState& state = fluid.group_states[g];
  const double* compression = fluid.own_compression.data() + fluid.groups.first[g];
  const double rho = (state.content.mass[0] + state.content.mass[1]) / std::max(state.volume, 1e-300);
  const bool differs = bears_differences(state) && !cavitates(state);
  std::vector<double> own, strains;
  double change = 0, volume = 0, mean = 0;
  for (const auto& [c, parent] : range) {
    const double after = fluid.after.volume[c];
    own.push_back(differs ? kept_share(fluid.grid, c, after) * *compression++ : 0.0);
    change += dt * fluid.rate[c];
    volume += after;
    mean += after * own.back();
  }
  member_strains(fluid, g, strains);
  pressure.clear();
  for (std::size_t m = 0; m < own.size(); ++m) {
    const std::ptrdiff_t c = range.first[m].cell;
    const double bulk = fluid.bulk_modulus[c], strain = differs ? change / state.volume : dt * strains[m];
    const double before =
        differs ? state.point.pressure + rho * fluid.setup.gravity * (state.height - height_of(fluid.grid, c))
                : fluid.pressure[c];
    pressure.push_back(before - bulk * strain + bulk * (own[m] - (volume > 0 ? mean / volume : 0.0)));
  }
}

}  // namespace polynya::fluid
