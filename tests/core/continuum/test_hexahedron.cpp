#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "block.hpp"
#include "core/continuum/bad_element.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "core/continuum/hexahedron.hpp"
#include "random_numbers.hpp"

namespace polynya::continuum {
namespace {

const Elastic ice_like{900, 8.13e9, 4.44e9};
const Numerics bare{0, 0, 1, 0.05, 0.01};  // no bulk viscosity

ExplicitSolid distorted_block(Numerics numerics = {}, Law law = ice_like) {
  tests::Random random;
  return make_solid("block",
                    tests::block({4, 3, 5}, {4e-3, 3e-3, 5e-3},
                                 [&](double* x) {
                                   for (int i = 0; i < 3; ++i) x[i] += 2e-4 * random.symmetric();
                                 }),
                    law, numerics);
}

/// Volume of a trilinear hexahedron by 2 x 2 x 2 Gauss points, which is exact.
double volume_by_gauss(const NodalVectors<double>& x) {
  const int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                          {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  double volume = 0;
  for (const auto& point : sign) {
    double j[3][3] = {};
    for (int a = 0; a < 8; ++a)
      for (int d = 0; d < 3; ++d) {
        double n = 0.125 * sign[a][d];
        for (int o = 0; o < 3; ++o)
          if (o != d) n *= 1 + sign[a][o] * point[o] / std::sqrt(3.0);
        for (int i = 0; i < 3; ++i) j[d][i] += n * x[a][i];
      }
    volume += j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) - j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
              j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
  }
  return volume;
}

TEST(IceHexahedron, VolumeIsExactForDistortedShapes) {
  tests::Random random;
  const NodalVectors<double> cube{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  for (int trial = 0; trial < 20; ++trial) {
    auto x = cube;
    for (auto& node : x)
      for (double& component : node) component += 0.3 * random.symmetric();
    EXPECT_NEAR(geometry(modes_of(x)).volume, volume_by_gauss(x), 1e-14);
  }
}

TEST(IceHexahedron, PatchOfDistortedElementsFollowsALinearFieldExactly) {
  auto solid = distorted_block(bare);
  const double gradient[3][3] = {{900, -300, 200}, {500, 400, 100}, {-600, 250, 700}};  // 1/s
  const double dt = 1e-7;
  for (int step = 0; step < 200; ++step) {
    for (std::size_t n = 0; n < solid.node_count(); ++n)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          solid.velocities[3 * n + i] =
              (j ? solid.velocities[3 * n + i] : 0.0) + gradient[i][j] * solid.positions[3 * n + j];
    advance_positions(solid, dt);
    internal_forces(solid, dt);
  }
  const double scale = std::abs(solid.element.stress[0][0]);
  EXPECT_GT(scale, 1e7);
  for (const auto& component : solid.element.stress)
    for (std::size_t e = 1; e < solid.element_count(); ++e) EXPECT_NEAR(component[e], component[0], 1e-11 * scale);
  // Inner nodes feel no force; 1e-6 m^2 is the area of an element's face.
  for (std::size_t i = 0; i < solid.internal_force.size(); ++i) {
    const bool inner = solid.living_elements[i / 3] == 8;
    EXPECT_NEAR(inner ? solid.internal_force[i] : 0.0, 0, 1e-11 * scale * 1e-6);
  }
  const double elastic = 0.5 * scale * scale / ice_like.bulk_modulus * 60e-9;  // J, of the block's 60 mm^3
  EXPECT_NEAR(energies(solid).hourglass, 0, 1e-12 * elastic);
}

TEST(IceHexahedron, RigidRotationLeavesStressRotatedOnly) {
  auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 2e-3, 1.5e-3}), ice_like);
  const PointState<double> loaded{{-3e6, 1e6, 2e6, 0.5e6, -0.7e6, 0.2e6}};
  set_point_state(solid, 0, loaded);
  internal_forces(solid, 0.0);
  const int steps = 720;
  double work = 0;
  const double axis[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3}, dt = 1e-6;
  const auto turn = [&](const double* x, double angle, double* turned) {
    const double c = std::cos(angle), s = std::sin(angle), along = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      turned[i] = c * x[i] + s * (axis[j] * x[k] - axis[k] * x[j]) + (1 - c) * along * axis[i];
    }
  };
  for (int step = 1; step <= steps; ++step) {
    for (std::size_t n = 0; n < 8; ++n) {
      double to[3];
      turn(&solid.mesh.nodes[3 * n], 2 * M_PI * step / steps, to);
      for (std::size_t i = 0; i < 3; ++i) solid.velocities[3 * n + i] = (to[i] - solid.positions[3 * n + i]) / dt;
    }
    advance_positions(solid, dt);
    const auto before = solid.internal_force;
    internal_forces(solid, dt);
    for (std::size_t k = 0; k < 24; ++k) work -= 0.5 * dt * (before[k] + solid.internal_force[k]) * solid.velocities[k];
    if (step == steps / 3) {  // R s R^T after 120 degrees: turn the columns, then the rows
      double a[3][3], b[3][3];
      const auto& s = loaded.stress;
      const double full[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
      for (int j = 0; j < 3; ++j) turn(full[j], 2 * M_PI / 3, a[j]);
      for (int j = 0; j < 3; ++j) {
        const double column[3] = {a[0][j], a[1][j], a[2][j]};
        turn(column, 2 * M_PI / 3, b[j]);
      }
      const double expected[6] = {b[0][0], b[1][1], b[2][2], b[0][1], b[1][2], b[0][2]};
      for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(solid.element.stress[c][0], expected[c], 1e-3);
    }
  }
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(solid.element.stress[c][0], loaded.stress[c], 1e-3);  // of 3e6 Pa
  EXPECT_NEAR(work, 0, 1e-9 * 3e6 * 3e-9);
}

TEST(IceHexahedron, AtRestExertsNoForceAtAll) {
  const auto solid = distorted_block();
  for (double force : solid.internal_force) EXPECT_NEAR(force, 0, 1e-12);
  for (const auto& component : solid.element.stress)
    for (double s : component) EXPECT_EQ(s, 0);
}

TEST(IceHexahedron, InnerForcesGiveNoNetForceAndNoTorque) {
  auto solid = distorted_block();
  tests::Random random;
  for (double& v : solid.velocities) v = 5 * random.symmetric();
  for (int step = 0; step < 10; ++step) {
    advance_positions(solid, 1e-7);
    internal_forces(solid, 1e-7);
  }
  double force[3] = {}, torque[3] = {}, size = 0;
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    const double *f = &solid.internal_force[3 * n], *x = &solid.positions[3 * n];
    for (int i = 0; i < 3; ++i) {
      force[i] += f[i];
      size += std::abs(f[i]);
      torque[i] += x[(i + 1) % 3] * f[(i + 2) % 3] - x[(i + 2) % 3] * f[(i + 1) % 3];
    }
  }
  EXPECT_GT(size, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(force[i], 0, 1e-13 * size);
    EXPECT_NEAR(torque[i], 0, 1e-13 * size * 5e-3);
  }
}

TEST(IceHexahedron, PackedKernelEqualsThePlainOne) {
  const JohnsonHolmquist2 brittle =
      johnson_holmquist_2_from_card("test", {{"density", 900},
                                             {"shear_modulus", 4.4444e9},
                                             {"bulk_modulus", 8.1254e9},
                                             {"hugoniot_elastic_limit", 5.2e9},
                                             {"pressure_at_hugoniot_elastic_limit", 3.4381e9},
                                             {"intact_strength_constant", 1.4},
                                             {"intact_strength_exponent", 0.8918},
                                             {"strain_rate_constant", 0.05},
                                             {"fractured_strength_constant", 0.09},
                                             {"fractured_strength_exponent", 1.2},
                                             {"maximum_tensile_pressure", 1e6},
                                             {"damage_constant", 0.05},
                                             {"damage_exponent", 0.5},
                                             {"bulking_fraction", 1}});
  J2Plastic ductile{900, 8.1254e9, 4.4444e9};
  ductile.yield_stress = 1e6;
  for (const Law& law : {Law(ice_like), Law(ductile), Law(brittle)}) {
    auto packed = distorted_block({}, law);
    tests::Random random;
    for (double& v : packed.velocities) v = 4 * random.symmetric();
    auto plain = packed;
    for (int step = 0; step < 20; ++step) {
      plain = packed;  // step by step: fracture amplifies round-off
      for (auto* solid : {&packed, &plain}) advance_positions(*solid, 5e-8);
      internal_forces(packed, 5e-8);
      internal_forces_scalar(plain, 5e-8);
    }
    EXPECT_EQ(packed.element.damage[0] > 0.01, std::holds_alternative<JohnsonHolmquist2>(law));
    EXPECT_EQ(packed.element.plastic_strain[0] > 0, !std::holds_alternative<Elastic>(law));
    for (std::size_t i = 0; i < plain.internal_force.size(); ++i)
      EXPECT_NEAR(packed.internal_force[i], plain.internal_force[i], 1e-10);
    for (std::size_t e = 0; e < plain.element_count(); ++e) {
      EXPECT_NEAR(packed.element.damage[e], plain.element.damage[e], 1e-12);
      EXPECT_NEAR(packed.element.step_limit[e], plain.element.step_limit[e], 1e-16);
    }
    EXPECT_NEAR(packed.hourglass_energy, plain.hourglass_energy, 1e-16);
    EXPECT_NEAR(packed.viscous_energy, plain.viscous_energy, 1e-16);
    EXPECT_EQ(packed.step_limit, stable_step(packed));
  }
}

TEST(IceHexahedron, GivesTheSameBitsForAnyNumberOfThreads) {
  std::vector<double> first;
  for (int threads : {1, 2}) {
    omp_set_num_threads(threads);
    auto solid = make_solid("block", tests::block({13, 17, 19}, {1e-2, 1e-2, 1e-2}), ice_like);
    tests::Random random;
    for (double& v : solid.velocities) v = random.symmetric();
    const std::vector<double> none(solid.velocities.size(), 0.0);
    for (int step = 0; step < 20; ++step) {
      advance_positions(solid, 5e-8);
      internal_forces(solid, 5e-8);
      advance_velocities(solid, none, 5e-8, 5e-8);
    }
    auto bits = solid.positions;
    bits.push_back(energies(solid).kinetic);
    bits.push_back(energies(solid).internal);
    if (threads == 1) first = bits;
    EXPECT_EQ(first, bits);
  }
}

// Other neighbours, other chunks, other nodes shared by chunks: the same forces, stresses and accounts.
TEST(IceHexahedron, FollowsTheSameMotionWhateverTheOrderOfElementsAndNodes) {
  const auto mesh = tests::block({23, 17, 14}, {2.3e-2, 1.7e-2, 1.4e-2});
  std::vector<std::int32_t> element_from, node_from;
  auto plain = make_solid("plain", mesh, ice_like);
  auto blocks = make_solid("blocks", in_blocks(mesh, &element_from, &node_from), ice_like);
  ASSERT_GT(blocks.chunks.chunk_count(), 8u);
  EXPECT_LT(blocks.chunks.shares, plain.chunks.shares);
  tests::Random random;
  for (double& v : plain.velocities) v = random.symmetric();
  for (std::size_t n = 0; n < plain.node_count(); ++n)
    for (std::size_t i = 0; i < 3; ++i) blocks.velocities[3 * n + i] = plain.velocities[3 * node_from[n] + i];
  const std::vector<double> none(plain.velocities.size(), 0.0);
  for (auto* solid : {&plain, &blocks})
    for (int step = 0; step < 30; ++step) {
      advance_positions(*solid, 5e-8);
      internal_forces(*solid, 5e-8);
      advance_velocities(*solid, none, 5e-8, 5e-8);
    }
  double largest = 0;
  for (double f : plain.internal_force) largest = std::max(largest, std::abs(f));
  for (std::size_t n = 0; n < plain.node_count(); ++n)
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_NEAR(blocks.internal_force[3 * n + i], plain.internal_force[3 * node_from[n] + i], 1e-11 * largest);
  for (std::size_t e = 0; e < plain.element_count(); ++e)
    ASSERT_NEAR(blocks.element.stress[3][e], plain.element.stress[3][element_from[e]], 1e-4);  // of 1e7 Pa
  EXPECT_NEAR(energies(blocks).internal, energies(plain).internal, 1e-12 * energies(plain).kinetic);
}

TEST(IceHexahedron, InvertedElementIsNamedWithPlaceAndTime) {
  auto solid = make_solid("ice", tests::block({3, 3, 3}, {3e-3, 3e-3, 3e-3}), ice_like);
  solid.velocities[3 * 0 + 2] = 3e3;  // node 0 passes through the upper face of element 0
  advance_positions(solid, 2e-6);
  try {
    internal_forces(solid, 2e-6);
    FAIL() << "the inverted element was not noticed";
  } catch (const BadElement& bad) {
    EXPECT_EQ(bad.element, 0u);
    EXPECT_EQ(bad.time, 2e-6);
    EXPECT_NE(std::string(bad.what()).find("ice: element 0"), std::string::npos) << bad.what();
  }
}

TEST(IceHexahedron, MeshWithWrongNodeOrderIsRefused) {
  auto mesh = tests::block({1, 1, 1}, {1, 1, 1});
  std::swap_ranges(mesh.elements.begin(), mesh.elements.begin() + 4, mesh.elements.begin() + 4);
  EXPECT_THROW(make_solid("ice", mesh, ice_like), std::invalid_argument);
}

}  // namespace
}  // namespace polynya::continuum
