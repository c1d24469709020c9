// Planes in shared cells: volumes against quadrature, transport against exact motion.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fluid_solver/interface_plane.hpp"
#include "tests/fluid_solver/transport.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

/// Volume below a plane by columns along z: exact along a column, midpoints across.
double volume_by_columns(const InterfacePlane& plane, int columns) {
  double sum = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double rest = plane.offset - plane.normal[0] * (i + 0.5) / columns - plane.normal[1] * (j + 0.5) / columns;
      const double height =
          plane.normal[2] == 0 ? (rest > 0 ? 1.0 : 0.0) : std::clamp(rest / plane.normal[2], 0.0, 1.0);
      sum += plane.normal[2] < 0 ? 1.0 - height : height;
    }
  }
  return sum / (columns * columns);
}

std::vector<std::array<double, 3>> normals() {
  std::vector<std::array<double, 3>> all{{1, 0, 0}, {0, -1, 0},       {0, 0, 1},        {1, 1, 0},    {0.5, 0, -0.5},
                                         {1, 1, 1}, {1, 1e-9, 1e-12}, {0.3, -0.3, 0.6}, {1e-7, 1, 1}, {0.2, 0.3, 0.5}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 0; n < 40; ++n) all.push_back({uniform(random), uniform(random), uniform(random)});
  return all;
}

}  // namespace

TEST(InterfacePlane, CutsOffTheVolumeOfItsColumns) {
  for (const auto& normal : normals()) {
    for (const double fraction : {0.003, 0.1, 0.37, 0.5, 0.81, 0.999}) {
      const InterfacePlane plane{normal, offset_for(normal, fraction)};
      EXPECT_NEAR(volume_by_columns(plane, 400), fraction, 3e-3) << normal[0] << " " << normal[1] << " " << normal[2];
    }
  }
}

TEST(InterfacePlane, OffsetInvertsTheVolume) {
  for (const auto& normal : normals()) {
    for (const double fraction : {0.0, 1e-9, 1e-6, 1e-3, 0.02, 0.166, 0.3, 0.5, 0.7, 0.98, 1 - 1e-6, 1.0}) {
      EXPECT_NEAR(fraction_below({normal, offset_for(normal, fraction)}), fraction,
                  1e-14 + 1e-10 * std::min(fraction, 1 - fraction))
          << normal[0] << " " << normal[1] << " " << normal[2];
    }
  }
}

TEST(InterfacePlane, SlabsAddUpToTheCell) {
  for (const auto& normal : normals()) {
    for (const double fraction : {0.01, 0.2, 0.5, 0.9}) {
      const InterfacePlane plane{normal, offset_for(normal, fraction)};
      for (int axis = 0; axis < 3; ++axis) {
        const double lower = 0.3 * fraction_of_slab(plane, axis, false, 0.3),
                     upper = 0.7 * fraction_of_slab(plane, axis, true, 0.7);
        EXPECT_NEAR(lower + upper, fraction, 1e-13);
      }
    }
  }
}

TEST(Interface, PlaneTranslatedDiagonallyStaysAPlane) {
  const std::array<double, 3> normal{0.48, 0.6, 0.64}, velocity{1.0, 0.7, -0.45};
  const int cells = 24;
  const double h = 1.0 / cells;
  const auto water_part = [&](double i, double j, double k,
                              double time) {  // of the cell with this lower corner, in cells
    const double speed = normal[0] * velocity[0] + normal[1] * velocity[1] + normal[2] * velocity[2];
    const double corner = h * (normal[0] * i + normal[1] * j + normal[2] * k);
    return fraction_below({normal, (0.8 + speed * time - corner) / h});
  };
  Fluid fluid = transported(cells, [&](int i, int j, int k) { return water_part(i - 1, j - 1, k - 1, 0); });
  const double dt = 0.3 * h;
  for (int n = 0; n < 24; ++n) {
    transport(fluid, dt, [&](int axis, int, int, int) { return velocity[axis] * h * h; });
  }
  const double time = 24 * dt;
  double worst = 0;
  for (int k = 10; k <= 15; ++k) {
    for (int j = 10; j <= 15; ++j) {
      for (int i = 10; i <= 15; ++i) {  // no flow from the boundary has come here
        const double found = fluid.material[water].volume[fluid.grid.at(i, j, k)] / (h * h * h);
        worst = std::max(worst, std::abs(found - water_part(i - 1, j - 1, k - 1, time)));
      }
    }
  }
  EXPECT_LT(worst, 0.01);  // of a cell; without planes several tenths
}

TEST(Interface, SphereReturnsFromTheVortexWithItsVolume) {
  // The 3-D deforming vortex at a resolution at which the film is thinner than a cell: the volume stays nonetheless.
  const VortexResult result = run_vortex(24);
  EXPECT_LT(result.volume_error, 1e-12);
  EXPECT_LT(result.bound_error, 1e-12);
  EXPECT_LT(result.shape_error, 1.2e-2);
}
