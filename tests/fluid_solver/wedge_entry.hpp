#pragma once
#include <cmath>
#include <numbers>

#include "tests/fluid_solver/acoustic_entry.hpp"
#include "tests/fluid_solver/slice_entry.hpp"

/// A wedge that enters water at constant speed V without gravity: the flow only grows (Zhao & Faltinsen 1993).
namespace polynya::fluid::test {

/// Of their table.
struct Similarity {
  double deadrise;        ///< degrees
  double force;           ///< per length, over rho V^3 t
  double peak;            ///< largest pressure over rho V^2 / 2
  double height_of_peak;  ///< of that place above the waterline, over V t
};
inline constexpr Similarity at_20{20, 42.485, 17.774, 0.5087}, at_30{30, 14.139, 6.927, 0.4243},
    at_40{40, 5.477, 3.266, 0.2866};

/// Over what similarity says.
struct Entered {
  double force, median, raw;  ///< mean over the last tenth of the time; at the end
  double acoustic_force;      ///< what linear acoustics says for `force`
  double inside;              ///< water inside the body over the displaced volume
};

/// Until c, the half-width up to the largest pressure, has `cells` cells. The grid is even around the wedge and reaches
/// eight c aside and down. `mach`: speed over the sound speed of water, and of air, 344 m/s. The wedge starts above the water,
/// twice as far as it falls while sound runs along its half: air that starts at rest would press on it like a piston.
inline Entered enter(const Similarity& exact, double cells, double mach, const std::string& field = {}) {
  const double slope = std::tan(exact.deadrise * std::numbers::pi / 180), sound = 344, speed = mach * sound, h = 1e-3;
  const double c = cells * h, end = c * slope / (1 + exact.height_of_peak) / speed, depth = speed * end;
  const double width = 1.5 * c, height = width * slope, reach = 8 * c, above = 2 * mach * width;
  const auto whole = [&](double length) { return h * std::ceil(length / h); };
  Fluid fluid{Grid(graded_line(0, 0, whole(1.45 * c), reach, h, 1.1), {0, h},
                   graded_line(-reach, -whole(1.1 * depth), whole(0.7 * depth), above + height + 0.8 * c, h, 1.1)),
              slice_setup(sound, false)};
  const auto at = [&](double t) {
    const double apex = above - speed * t, edge = apex + height, top = edge + 0.1 * c;
    return overlap_of(fluid.grid, Polygon{{0, apex}, {width, edge}, {width, top}, {-width, top}, {-width, edge}},
                      {0, -speed});
  };
  fill_hydrostatic(fluid, at(0), 0.0);
  const double contact = above / speed;
  double impulse = 0, expected = 0;
  while (fluid.time < contact + end) {
    const double dt = 0.8 * stable_step(fluid), before = lift_impulse(fluid), from = fluid.time - contact, to = from + dt;
    step(fluid, dt, at(fluid.time + dt));
    if (from < 0.9 * end) continue;
    impulse += lift_impulse(fluid) - before;
    expected += 0.25 * exact.force * 1000 * std::pow(speed, 3) * (to * to - from * from);
  }
  if (!field.empty()) write_field(fluid, field);
  const auto along = pressure_below(fluid);
  const double peak = exact.peak * 500 * speed * speed;
  const Entered entered{impulse / expected, median_peak(along) / peak, raw_peak(along) / peak,
                        acoustic_entry(exact.deadrise, mach).force,
                        water_inside(fluid) / (0.5 * depth * depth / slope * h)};
  std::printf(
      "wedge %g deg, c %g cells, Mach %g, %ld steps of %zu cells: force %.3f (acoustics: %.3f), peak %.3f (median of 5), %.3f (raw) "
      "of theory; water inside %.1e\n",
      exact.deadrise, cells, mach, fluid.steps, fluid.grid.cells(), entered.force, entered.acoustic_force, entered.median,
      entered.raw, entered.inside);
  std::fflush(stdout);
  return entered;
}

}  // namespace polynya::fluid::test
