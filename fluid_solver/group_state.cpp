// Groups of cells share one thermodynamic state: what they hold together, the pressure inside them, what
// they give through faces, and how their content is spread again after the remap.
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"

namespace polynya::fluid {
namespace {

constexpr double prediction = 0.6;          ///< theta
constexpr double within = 0.5;                       ///< zeta: brings wall motion to the nodes inside a group
constexpr double linear_viscosity = 0.06, quadratic_viscosity = 1.5;

struct Range {
  const Groups::Member *first, *last;
  const Groups::Member* begin() const { return first; }
  const Groups::Member* end() const { return last; }
};

Range members_of(const Groups& groups, std::size_t g) {
  return {groups.members.data() + groups.first[g], groups.members.data() + groups.first[g + 1]};
}

double height_of(const Grid& grid, std::ptrdiff_t cell) { return grid.centre_z(static_cast<int>(cell / grid.sz)); }

}  // namespace

void evaluate_groups(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  fluid.group_states.assign(fluid.groups.count(), {});
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
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      fluid.pressure[c] = filled ? state.point.pressure + rho * fluid.setup.gravity * (state.height - height_of(grid, c))
                                 : state.volume > 0 ? fluid.setup.pressure_floor[water] : 0.0;
      fluid.density[c] = rho;
      fluid.bulk_modulus[c] = state.point.bulk_modulus;
      fluid.sound_speed[c] = state.point.sound_speed;
      int i, j, k;
      grid.position(c, i, j, k);
      fluid.row_materials[static_cast<std::size_t>(j + (grid.ny + 3) * k)] |= static_cast<unsigned char>(held);
    }
  }
}

void predict_group_pressure(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  for (std::size_t g = 0; g < fluid.groups.count(); ++g) {
    const GroupState& state = fluid.group_states[g];
    double rate = 0, bounded_volume = 0;
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      rate += fluid.rate[c];
      bounded_volume += std::max(fluid.before.volume[c], 0.5 * full_volume(grid, c));
    }
    const double floor = std::max(state.content.mass[0] > 0 ? fluid.setup.pressure_floor[0] : -1e300,
                                  state.content.mass[1] > 0 ? fluid.setup.pressure_floor[1] : -1e300);
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      const double full = full_volume(grid, c), strain = rate / std::max(state.volume, 0.5 * full);
      const double inner = fluid.rate[c] / std::max(fluid.before.volume[c], 0.5 * full) - rate / bounded_volume;
      int i, j, k;
      grid.position(c, i, j, k);
      const double length = std::min({grid.dx[i], grid.dy[j], grid.dz[k]}), closing = std::max(0.0, -strain);
      const double q = fluid.density[c] * length * closing *
                       (quadratic_viscosity * length * closing + linear_viscosity * fluid.sound_speed[c]);
      const double ahead = fluid.pressure[c] - fluid.bulk_modulus[c] * dt * (prediction * strain + within * inner);
      fluid.predicted_pressure[c] = std::max(ahead, floor) + q;
      fluid.viscosity[c] = 0;
    }
  }
}

void set_group_donors(Fluid& fluid, double dt) {
  for (std::size_t g = 0; g < fluid.groups.count(); ++g) {
    const GroupState& state = fluid.group_states[g];
    double change = 0, work = 0;
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      change += dt * fluid.rate[c];
      work += dt * fluid.rate[c] * fluid.predicted_pressure[c];
    }
    const std::array<double, 2> share = volume_shares(fluid.setup.law, fluid.setup.pressure_floor, state.content, change);
    const double volume = state.volume + change, inverse = volume > 0 ? 1.0 / volume : 0.0;
    bool root = true;
    for (const auto& [c, parent] : members_of(fluid.groups, g)) {
      double mixture = 0;
      for (int m = 0; m < 2; ++m) {
        const double energy = state.content.energy[m] - share[m] * work;
        const double own = state.content.volume[m] + share[m] * change;
        fluid.donor[m].mass[c] = state.content.mass[m] * inverse;
        fluid.donor[m].energy[c] = energy * inverse;
        fluid.donor[m].volume[c] = own * inverse;
        mixture += fluid.donor[m].mass[c];
        // Only the sum over the group matters until it is spread again; the masses stay where they are.
        fluid.material[m].energy[c] = root ? energy : 0.0;
        fluid.material[m].volume[c] = root ? own : 0.0;
      }
      fluid.donor_mass[c] = mixture;
      root = false;
    }
  }
}

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
      if (mass[0] + mass[1] > 0) throw FluidError("solids have closed the last room of " + std::to_string(mass[0] + mass[1]) + " kg of fluid");
      continue;
    }
    // From the leaves to the root: what a cell has too much goes through the face to its parent.
    const Range range = members_of(fluid.groups, g);
    std::vector<double> surplus(static_cast<std::size_t>(range.last - range.first));
    for (std::size_t m = 0; m < surplus.size(); ++m) {
      const std::ptrdiff_t c = range.first[m].cell;
      surplus[m] = fluid.material[0].mass[c] + fluid.material[1].mass[c] - (mass[0] + mass[1]) * (fluid.after.volume[c] / volume);
    }
    for (std::size_t m = surplus.size() - 1; m > 0; --m) {
      const auto& [c, parent] = range.first[m];
      const std::ptrdiff_t step = c - parent, stride = std::abs(step);
      const int axis = stride == 1 ? 0 : stride == fluid.grid.sy ? 1 : 2;
      fluid.face_mass[axis][std::max(c, parent)] += step > 0 ? -surplus[m] : surplus[m];
      std::size_t at = m;
      while (range.first[at].cell != parent) --at;
      surplus[at] += surplus[m];
    }
    for (const auto& [c, parent] : range) {
      const double share = fluid.after.volume[c] / volume;
      for (int m = 0; m < 2; ++m) {
        fluid.material[m].mass[c] = mass[m] * share;
        fluid.material[m].energy[c] = energy[m] * share;
        fluid.material[m].volume[c] = held[m] * share;
      }
    }
  }
}

}  // namespace polynya::fluid
