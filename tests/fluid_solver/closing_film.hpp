#pragma once
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"
#include "tests/fluid_solver/slice_overlap.hpp"

/// Bodies that close on a wall under water at constant speed V, without friction. What lies between is squeezed out as
/// u = V r / (2 gap) (disc of radius a) or V x / gap (strip of half-width a) and leaves as a jet into water at rest, so that the
/// pressure at the rim is that of the surroundings: F = 3 pi rho V^2 a^4 / (16 gap^2) and 4 rho V^2 a^3 / (3 gap^2) per length.
/// That takes a jet which is there: right after the start the vortex at its head still sucks at the rim (a flow that did not
/// separate would give a third and a quarter of F). The bodies therefore start from gaps of 24 cells.
namespace polynya::fluid::test {

/// Mean force while the gap falls by a cell, over the formula's; the least and the most of its means over quarters of a cell.
struct Squeeze {
  int gap;  ///< at the end, cells
  double mean, least, most;
};

struct ClosingBody {
  double force_by_gap;        ///< the formula's force times gap^2, N m^2, of what the grid holds
  double speed, start, cell;  ///< m/s, m, m
};

/// Steps until the gap is `last` cells; what happens from `first` cells on is reported.
template <class OverlapAt>
std::vector<Squeeze> squeeze(Fluid& fluid, const ClosingBody& body, int first, int last, OverlapAt&& overlap_at) {
  const auto gap = [&] { return body.start - body.speed * fluid.time; };
  const auto at = [&](double time) { return overlap_at(body.start - body.speed * time); };
  const auto impulse = [&] { return fluid.account.body_impulse[0][2] + fluid.account.node_fix_impulse[2]; };
  fill_hydrostatic(fluid, at(0), 1.0);
  start_potential_flow(fluid);
  adapt_potential_flow(fluid, at(0), at(1e-9), 1.0);
  struct Mark {
    double impulse, gap;
  };
  const auto mark = [&] { return Mark{impulse(), gap()}; };
  const auto mean_since = [&](const Mark& from) {
    return (impulse() - from.impulse) * body.speed / (body.force_by_gap * (1 / gap() - 1 / from.gap));
  };
  const auto advance_to = [&](double cells) {
    while (gap() > cells * body.cell) {
      const double dt = 0.7 * stable_step(fluid);
      step(fluid, dt, at(fluid.time + dt));
    }
  };
  std::vector<Squeeze> all;
  advance_to(first);
  for (int cells = first - 1; cells >= last; --cells) {
    Squeeze one{cells, 0, 1e300, -1e300};
    const Mark begin = mark();
    for (int quarter = 3; quarter >= 0; --quarter) {
      const Mark from = mark();
      advance_to(cells + 0.25 * quarter);
      const double force = mean_since(from);
      one.least = std::min(one.least, force), one.most = std::max(one.most, force);
    }
    one.mean = mean_since(begin);
    std::printf("  gap %d to %d cells: force %.3f of the formula's (quarters of a cell: %.3f to %.3f), %ld steps\n",
                cells + 1, cells, one.mean, one.least, one.most, fluid.steps);
    std::fflush(stdout);
    all.push_back(one);
  }
  return all;
}

inline polynya::fluid::Setup film_setup(Boundary behind) {
  polynya::fluid::Setup setup;
  setup.pressure_floor = {-1e300, 0};
  setup.boundary = {Boundary::wall, Boundary::non_reflecting, Boundary::wall,
                    behind,         Boundary::wall,           Boundary::non_reflecting};
  return setup;
}

/// A strip in a slice one cell thick, half of it.
inline std::vector<Squeeze> close_strip(int half_width, double speed, int first, int last) {
  constexpr double h = 1e-3, start = 24 * h, thick = 4 * h;
  const double a = half_width * h;
  Fluid fluid{Grid(graded_line(0, 0, a + 24 * h, 6 * a, h, 1.1), {0, h}, graded_line(0, 0, start + thick + 6 * h, 6 * a, h, 1.1)),
              film_setup(Boundary::wall)};
  std::printf("strip of half-width %d cells\n", half_width);
  return squeeze(fluid, {2.0 / 3 * 1000 * speed * speed * a * a * a * h, speed, start, h}, first, last, [&](double gap) {
    return overlap_of(fluid.grid, Polygon{{-a, gap}, {a, gap}, {a, gap + thick}, {-a, gap + thick}}, {0, -speed});
  });
}

/// A disc, a quarter of it.
inline std::vector<Squeeze> close_disc(int radius, double speed, int first, int last) {
  constexpr double h = 1e-3, start = 24 * h, thick = 4 * h;
  const double a = radius * h;
  const auto side = graded_line(0, 0, a + 12 * h, 4 * a, h, 1.15);
  Fluid fluid{Grid(side, side, graded_line(0, 0, start + thick + 4 * h, 4 * a, h, 1.15)), film_setup(Boundary::non_reflecting)};
  std::printf("disc of radius %d cells in %d x %d x %d\n", radius, fluid.grid.nx, fluid.grid.ny, fluid.grid.nz);
  return squeeze(fluid, {3 * std::numbers::pi / 64 * 1000 * speed * speed * std::pow(a, 4), speed, start, h}, first, last,
                 [&](double gap) {
                   return overlap_of(fluid.grid, cylinder(a, gap, gap + thick), {0, 0, -speed}, {-a, -a, gap}, {a, a, gap + thick});
                 });
}

}  // namespace polynya::fluid::test
