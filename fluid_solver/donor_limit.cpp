// Cells that solids cut give, through all their faces at once, what they held at the end of the Lagrange phase. Where a
// wall gives way all at once (a breaking element leaves most of a cell) volumes that the correction moves about may ask
// a nearly empty cell for more than it holds. It then gives what it has, in proportion: the donor's densities are
// lowered, so what leaves one cell still enters another.
#include <algorithm>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// Volume that leaves a cell in the step through faces whose other cell is not in the set, m^3.
template <class InSet>
double outflow(const Fluid& fluid, std::ptrdiff_t cell, double dt, InSet&& in_set) {
  double out = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::ptrdiff_t s = fluid.grid.stride(axis);
    const std::vector<double>& rate = fluid.face_rate[axis];
    if (!in_set(cell - s)) out += dt * std::max(0.0, -rate[cell]);
    if (!in_set(cell + s)) out += dt * std::max(0.0, rate[cell + s]);
  }
  return out;
}

void lower(Fluid& fluid, std::ptrdiff_t cell, double factor) {
  for (auto& donor : fluid.donor) {
    donor.mass[cell] *= factor;
    donor.energy[cell] *= factor;
    donor.volume[cell] *= factor;
  }
}

/// Rounding of the sums may not make what remains negative.
constexpr double most = 1.0 - 1e-9;

}  // namespace

void limit_donors(Fluid& fluid, double dt) {
  const Groups& groups = fluid.groups;
  for (std::size_t g = 0; g < groups.count(); ++g)
    for (std::size_t m = groups.first[g]; m < groups.first[g + 1]; ++m)
      fluid.label[groups.members[m].cell] = static_cast<std::int32_t>(g);
  for (std::size_t g = 0; g < groups.count(); ++g) {
    const auto own = [&](std::ptrdiff_t c) { return fluid.label[c] == static_cast<std::int32_t>(g); };
    double volume = 0, out = 0;
    for (std::size_t m = groups.first[g]; m < groups.first[g + 1]; ++m) {
      const std::ptrdiff_t c = groups.members[m].cell;
      volume += fluid.sweep_volume[c];
      out += outflow(fluid, c, dt, own);
    }
    if (out <= most * volume) continue;
    ++fluid.limited_donors;
    for (std::size_t m = groups.first[g]; m < groups.first[g + 1]; ++m)
      lower(fluid, groups.members[m].cell, std::max(0.0, most * volume) / out);
  }
  for (const std::ptrdiff_t c : fluid.held_cells) {
    if (fluid.label[c] >= 0) continue;
    const double volume = fluid.sweep_volume[c];
    const double out = outflow(fluid, c, dt, [](std::ptrdiff_t) { return false; });
    if (out <= most * volume) continue;
    ++fluid.limited_donors;
    lower(fluid, c, std::max(0.0, most * volume) / out);
  }
  for (const Groups::Member& member : groups.members) fluid.label[member.cell] = -1;
}

}  // namespace polynya::fluid
