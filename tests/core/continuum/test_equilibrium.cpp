// Bodies that start under load without a wave.
#include "core/continuum/equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"

namespace polynya::continuum {
namespace {

constexpr double gravity = 9.81, density = 900, size = 0.01;

/// A free block that floats: weight of its nodes, and as much upward on its lower face.
struct Floating {
  ExplicitSolid solid;
  std::vector<double> loads;
  explicit Floating(std::array<int, 3> cells)
      : solid(make_solid("block", tests::block(cells, {size * cells[0], size * cells[1], size * cells[2]}),
                         Elastic{density, 8.13e9, 4.44e9})),
        loads(solid.positions.size(), 0.0) {
    const std::size_t layers = static_cast<std::size_t>(cells[2]);
    for (std::size_t n = 0; n < solid.node_count(); ++n) {
      loads[3 * n + 2] = -gravity * solid.masses[n];
      // A node of a lower or upper face has half the mass of one within: 2 x layers of the former make up a column.
      if (solid.mesh.nodes[3 * n + 2] == 0)
        loads[3 * n + 2] += 2 * gravity * static_cast<double>(layers) * solid.masses[n];
    }
    internal_forces(solid, 0);
  }
};

TEST(Equilibrium, FloatingBlocksOfAnyThicknessComeToRest) {
  for (const std::array<int, 3> cells : {std::array<int, 3>{6, 6, 1}, {6, 6, 2}, {6, 6, 3}, {8, 2, 2}, {1, 1, 1}}) {
    Floating block(cells);
    bring_into_equilibrium(block.solid, block.loads);
    internal_forces(block.solid, 0);
    double largest = 0, load = 0;
    for (std::size_t i = 0; i < block.loads.size(); ++i) {
      largest = std::max(largest, std::abs(block.solid.internal_force[i] + block.loads[i]));
      load = std::max(load, std::abs(block.loads[i]));
    }
    EXPECT_LT(largest, 3e-6 * load) << cells[0] << " " << cells[1] << " " << cells[2];
    for (const double v : block.solid.velocities) EXPECT_EQ(v, 0);
  }
}

TEST(Equilibrium, StressOfAFloatingColumnIsTheWeightAbove) {
  Floating block({2, 2, 4});
  for (std::uint8_t& held : block.solid.fixed) held |= 3;  // sideways: uniaxial strain, which the mesh holds exactly
  bring_into_equilibrium(block.solid, block.loads);
  for (std::size_t e = 0; e < block.solid.element_count(); ++e) {
    const double above = 4 * size - element_centre(block.solid, e)[2];
    EXPECT_NEAR(block.solid.element.stress[2][e], -density * gravity * above, 1e-4 * density * gravity * 4 * size);
  }
}

}  // namespace
}  // namespace polynya::continuum
