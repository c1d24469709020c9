#include <gtest/gtest.h>

#include <numeric>

#include "core/exchange/errors.hpp"
#include "coupler/fluid_side.hpp"

using namespace polynya;

namespace {

using Integers = std::vector<std::int64_t>;

/// A grid of 6 x 6 x 6 cells of 1 m, cut by a cube that reaches from 0.5 to 4.5 m along each axis and rises at 2 m/s.
struct Cube {
  geometry::GridLines grid;
  geometry::CutCells cut;
  exchange::Message message{"span"};

  Cube() {
    for (auto& line : grid.lines) {
      line.resize(7);
      std::iota(line.begin(), line.end(), 0.0);
    }
    std::vector<double> positions, velocities;
    for (int corner = 0; corner < 8; ++corner)
      for (int axis = 0; axis < 3; ++axis) {
        positions.push_back(corner >> axis & 1 ? 4.5 : 0.5);
        velocities.push_back(axis == 2 ? 2.0 : 0.0);
      }
    const std::vector<std::int32_t> triangles{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                              2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    const std::vector<geometry::BodySurface> bodies{{positions, velocities, triangles}, {}};
    geometry::Cutter(grid).cut(bodies, cut);
    coupler::add_overlap(message, cut, grid);
  }
  template <class T>
  std::vector<T> values(const std::string& name) const {
    const auto view = message.view<T>(name);
    return {view.begin(), view.end()};
  }
  std::int64_t in_runs(const std::string& name) const {
    const Integers runs = values<std::int64_t>(name);
    std::int64_t sum = 0;
    for (std::size_t r = 1; r < runs.size(); r += 2) sum += runs[r];
    return sum;
  }
};

}  // namespace

TEST(OverlapMessage, WallsAreSentForTheCellsOfTheHullAloneAndTheInsideInRuns) {
  const Cube cube;
  // 5 x 5 x 5 cells hold solid, of which 3 x 3 x 3 are inside: nine rows of three.
  EXPECT_EQ(cube.values<std::int64_t>("wall").size(), 125 - 27);
  EXPECT_EQ(cube.values<std::int64_t>("cell"), cube.values<std::int64_t>("wall"));
  const Integers runs = cube.values<std::int64_t>("cell.full");
  ASSERT_EQ(runs.size(), 2 * 9);
  EXPECT_EQ(runs[0], 1 + 6 * (1 + 6 * 1));
  EXPECT_EQ(runs[1], 3);
  const std::vector<double> solid = cube.values<double>("solid_volume");
  EXPECT_NEAR(std::accumulate(solid.begin(), solid.end(), 0.0) + 27, 4.0 * 4 * 4, 1e-12);
}

TEST(OverlapMessage, WallsOfAClosedBodyAddUpToNothingAndToItsSidesOneByOne) {
  const Cube cube;
  const std::vector<double> area = cube.values<double>("wall_area"), velocity = cube.values<double>("wall_velocity");
  double sum = 0, up = 0, volume_rate = 0;
  for (std::size_t w = 0; w < area.size(); w += 6) {
    sum += area[w + 2];
    up += std::max(0.0, area[w + 2]);
    volume_rate += area[w + 2] * velocity[w + 2];
    EXPECT_EQ(area[w + 5], 0.0);  // there is no second body
  }
  EXPECT_NEAR(sum, 0, 1e-12);
  EXPECT_NEAR(up, 16, 1e-12);
  EXPECT_NEAR(volume_rate, 0, 1e-12);
}

TEST(OverlapMessage, SolidPartsOfFacesAddUpToTheSectionsOfTheBody) {
  const Cube cube;
  for (const std::string name : {"face_x", "face_y", "face_z"}) {
    const std::vector<double> solid = cube.values<double>(name + ".solid");
    EXPECT_EQ(cube.in_runs(name + ".full"), 4 * 3 * 3)
        << name;  // four planes cross the body, 3 x 3 faces of each inside
    EXPECT_NEAR(std::accumulate(solid.begin(), solid.end(), 0.0) + 4 * 3 * 3, 4 * 16, 1e-12) << name;
  }
}

TEST(OverlapMessage, PressuresOfWallsComeBackToTheirCells) {
  const Cube cube;
  const Integers walls = cube.values<std::int64_t>("wall");
  std::vector<double> pressure(walls.begin(), walls.end());  // Pa, as many as the cell's number
  exchange::Message answer("pressure");
  answer.add<double>("pressure.values", {98}, pressure);
  answer.add<double>("pressure.gradient_z", {98}, std::vector<double>(98, 3.0));
  const coupler::WallPressure read = coupler::read_pressure(answer, "pressure.", cube.cut);
  ASSERT_EQ(read.value.size(), 125U);
  for (std::size_t e = 0; e < 125; ++e) {
    EXPECT_EQ(read.value[e], cube.cut.walled[e] ? static_cast<double>(cube.cut.cell[e]) : 0.0);
    EXPECT_EQ(read.gradient_z[e], cube.cut.walled[e] ? 3.0 : 0.0);
  }
  for (const geometry::WallPiece& piece : cube.cut.pieces) EXPECT_EQ(cube.cut.walled[piece.entry], 1);
}

TEST(OverlapMessage, PressuresOfAnotherNumberOfWallsAreRefused) {
  const Cube cube;
  exchange::Message answer("pressure");
  answer.add<double>("pressure.values", {125}, std::vector<double>(125, 0.0));
  answer.add<double>("pressure.gradient_z", {125}, std::vector<double>(125, 0.0));
  EXPECT_THROW(coupler::read_pressure(answer, "pressure.", cube.cut), exchange::ProtocolError);
}
