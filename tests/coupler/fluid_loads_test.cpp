// What the fluid gives to the walls reaches the vertices whole, and as geometry spreads it.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <numeric>

#include "coupler/overlap_exchange.hpp"

using namespace polynya;
using coupler::Body;

namespace {

constexpr auto vehicle = static_cast<std::size_t>(Body::vehicle);
constexpr double span = 2e-6;  // s

struct Endpoint {
  std::string folder;
  Endpoint() {
    char name[] = "/tmp/polynya-test-XXXXXX";
    folder = mkdtemp(name);
  }
  ~Endpoint() { std::filesystem::remove_all(folder); }
  std::string address() const { return "ipc://" + folder + "/socket"; }
};

/// A cube from 0.5 to 4.5 m in 6 x 6 x 6 cells of 1 m, which has risen by 0.25 m since the cut before.
struct RisingCube {
  Endpoint endpoint;
  exchange::Hub hub{endpoint.address(), "run", {"structure"}};
  coupler::Conversation conversation{hub, {}, std::nullopt};
  compute::Stopwatch watch;
  std::optional<coupler::OverlapExchange> overlap;
  coupler::Ledger ledger;
  geometry::CutCells before, now;

  RisingCube() {
    coupler::FluidSide fluid;
    for (auto& line : fluid.grid.lines) {
      line.resize(7);
      std::iota(line.begin(), line.end(), 0.0);
    }
    coupler::SolidSide side;
    for (int corner = 0; corner < 8; ++corner) {
      side.ids.push_back(corner);
      for (int axis = 0; axis < 3; ++axis) side.positions.push_back(corner >> axis & 1 ? 4.5 : 0.5);
    }
    side.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                      2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    side.velocities.assign(24, 1.0);
    side.volumes.assign(8, 0.0);
    side.fluid_impulse.assign(24, 0.0);
    side.impedance.assign(48, 0.0);
    side.velocity_sum.assign(24, 0.0);
    conversation.solids.push_back(side);
    overlap.emplace(fluid, false, 0.0, false);
    before = cut();
    for (std::size_t v = 0; v < 8; ++v) cube().positions[3 * v + 2] += 0.25;
    now = cut();
  }
  coupler::SolidSide& cube() { return conversation.solids.front(); }
  geometry::CutCells cut() {
    const geometry::CutCells& cells = overlap->cut(conversation, watch);
    overlap->prepare();
    return cells;
  }
  /// Impulse on all vertices along one axis.
  double total(std::size_t axis) {
    double sum = 0;
    for (std::size_t v = 0; v < 8; ++v) sum += cube().fluid_impulse[3 * v + axis];
    return sum;
  }
};

/// Pressures that differ from wall to wall.
struct Pressures {
  std::vector<double> value, gradient;
  explicit Pressures(std::size_t walls, double seed) : value(walls), gradient(walls) {
    for (std::size_t w = 0; w < walls; ++w) {
      value[w] = seed + 37.0 * static_cast<double>(w * w % 11);
      gradient[w] = seed * static_cast<double>(w % 5);
    }
  }
  coupler::WallPressureView view() const { return {value, gradient}; }
};

/// From walls to all entries of a cut.
std::vector<double> by_entry(const geometry::CutCells& cut, const std::vector<double>& by_wall) {
  std::vector<double> all(cut.cell.size(), 0.0);
  for (std::size_t e = 0, wall = 0; e < all.size(); ++e)
    if (cut.walled[e]) all[e] = by_wall[wall++];
  return all;
}

}  // namespace

TEST(FluidLoads, OfPressuresAreTheMeanForceOfBothCutsTimesTheSpan) {
  RisingCube rising;
  ASSERT_EQ(rising.overlap->walls(), 125U - 27U);  // all cells with solid but those wholly inside
  const Pressures at_start(rising.overlap->walls_before(), 1e5), at_end(rising.overlap->walls(), 3e5);
  rising.overlap->take(rising.conversation, {at_start.view(), at_end.view(), {}, {}, {}}, span, rising.ledger);

  std::vector<double> expected(24, 0.0);
  double weight = 0;
  const std::vector<double> still(24, 0.0);
  for (const auto& [cut, pressure, lift] :
       {std::tuple(&rising.before, &at_start, -0.25), std::tuple(&rising.now, &at_end, 0.0)}) {
    std::vector<double> positions = rising.cube().positions;
    for (std::size_t v = 0; v < 8; ++v) positions[3 * v + 2] += lift;
    const std::vector<geometry::BodySurface> bodies{{positions, still, rising.cube().triangles}, {}};
    const auto forces =
        geometry::pressure_forces(*cut, bodies, by_entry(*cut, pressure->value), by_entry(*cut, pressure->gradient));
    double vertical = 0;
    for (std::size_t i = 0; i < 24; ++i) expected[i] += 0.5 * span * forces[0].on_vertices[i];
    for (std::size_t i = 2; i < 24; i += 3) vertical += forces[0].on_vertices[i];
    weight += 0.5 * span * (vertical - forces[0].without_gradient);
  }
  for (std::size_t i = 0; i < 24; ++i) EXPECT_NEAR(rising.cube().fluid_impulse[i], expected[i], 1e-12) << i;
  EXPECT_NEAR(rising.ledger.fluid_weight[vehicle], weight, 1e-12);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(rising.ledger.fluid_given[vehicle][axis], rising.total(axis), 1e-14);
}

TEST(FluidLoads, OfAUniformPressureDoNotMoveAClosedBody) {
  RisingCube rising;
  const std::vector<double> value(rising.overlap->walls(), 1e6), none(rising.overlap->walls(), 0.0);
  rising.overlap->take(rising.conversation, {{value, none}, {value, none}, {}, {}, {}}, span, rising.ledger);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(rising.total(axis), 0, 1e-13);
}

TEST(FluidLoads, WhatWallsCarryArrivesWhole) {
  RisingCube rising;
  const std::size_t walls = rising.overlap->walls();
  const std::vector<double> none(walls, 0.0);
  std::vector<double> impulse(6 * walls, 0.0);
  std::array<double, 3> given{};
  for (std::size_t w = 0; w < walls; ++w)
    for (std::size_t d = 0; d < 3; ++d) given[d] += impulse[6 * w + d] = static_cast<double>(w + d) * 1e-3;
  rising.overlap->take(rising.conversation, {{none, none}, {none, none}, impulse, {}, {}}, span, rising.ledger);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(rising.total(axis), given[axis], 1e-11);
  EXPECT_NEAR(rising.ledger.fluid_carried[vehicle], given[2], 1e-11);
}

TEST(FluidLoads, ImpedanceOfACubeResistsMotionAlongEachAxisWithTwoOfItsSides) {
  RisingCube rising;
  const std::size_t walls = rising.overlap->walls();
  const std::vector<double> none(walls, 0.0), impedance(walls, 1.5e6);  // kg/(m^2 s), water
  rising.overlap->take(rising.conversation, {{none, none}, {none, none}, {}, none, impedance}, span, rising.ledger);
  std::array<double, 6> sum{};
  for (std::size_t v = 0; v < 8; ++v)
    for (std::size_t c = 0; c < 6; ++c) sum[c] += rising.cube().impedance[6 * v + c];
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], 1.5e6 * 2 * 4 * 4, 1e-6);
  for (std::size_t c = 3; c < 6; ++c) EXPECT_NEAR(sum[c], 0, 1e-6);
}

TEST(FluidLoads, AnswersForAnotherNumberOfWallsAreRefused) {
  exchange::Message answer("pressure");
  for (const std::string prefix : {"pressure.", "pressure.previous_"})
    for (const std::string name : {"values", "gradient_z"})
      answer.add<double>(prefix + name, {98}, std::vector<double>(98, 0.0));
  EXPECT_NO_THROW(coupler::read_answer(answer, 98, 98, false));
  EXPECT_THROW(coupler::read_answer(answer, 97, 98, false), exchange::ProtocolError);
  EXPECT_THROW(coupler::read_answer(answer, 98, 99, false), exchange::ProtocolError);
}
