#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "fluid_solver/volume_correction.hpp"

namespace polynya::fluid {
namespace {

constexpr std::array<Boundary, 6> walls_around{Boundary::wall, Boundary::wall, Boundary::wall,
                                               Boundary::wall, Boundary::wall, Boundary::wall};

/// A channel along x, its cells up to sixteen times as long as they are wide or high.
struct Channel {
  explicit Channel(int length) : grid(lines(length, 0.016), lines(5, 0.001), lines(5, 0.004)) {}
  static std::vector<double> lines(int cells, double width) {
    std::vector<double> at;
    for (int i = 0; i <= cells; ++i) at.push_back(width * i);
    return at;
  }
  Grid grid;
  CutGeometry before{grid, walls_around}, after{grid, walls_around};
  std::vector<StepWall> walls;
  std::vector<std::int32_t> label = std::vector<std::int32_t>(grid.size, -1);

  /// In the middle of the channel's floor cells change by parts of their volume that no wall explains.
  template <class Part>
  void change(int first, int last, Part&& part) {
    for (int i = first; i <= last; ++i) {
      const std::ptrdiff_t c = grid.at(i, 3, 1);
      after.volume[c] *= 1.0 + part(i);
      walls.push_back({c});
    }
  }
  VolumeCorrection correct() { return correct_volumes(grid, before, after, walls, 1e-6, label); }
};

/// Room that opens over half the length and closes over the other half.
VolumeCorrection correct_wave(int length) {
  Channel channel(length);
  channel.change(1, length,
                 [&](int i) { return 1e-5 * std::cos(std::numbers::pi * (i - 0.5) / length); });
  const VolumeCorrection correction = channel.correct();
  double worst = 0, sum = 0;
  for (std::size_t c = 0; c < correction.cells.size(); ++c) {
    const std::ptrdiff_t cell = correction.cells[c];
    const double wanted = channel.before.volume[cell] - channel.after.volume[cell];
    worst = std::max(worst, std::abs(correction.outflow[c] - wanted) / channel.grid.cell_volume[cell]);
    sum += correction.outflow[c];
  }
  EXPECT_LT(worst, 1e-11 + 1e-14) << length;  // the mean that cannot be moved is rounding here
  EXPECT_LT(std::abs(sum), 1e-15 * channel.grid.cell_volume[channel.grid.at(1, 1, 1)] * length);
  return correction;
}

TEST(VolumeCorrection, MovesRoomAlongAWallWithoutAnIterationPerCell) {
  const int near = correct_wave(25).iterations, far = correct_wave(400).iterations;
  std::printf("iterations along 25 cells %d, along 400 %d\n", near, far);
  EXPECT_LT(far, 2 * near);
  EXPECT_LT(far, 60);
}

TEST(VolumeCorrection, KeepsToThePartOfTheFluidThatHasTheRoom) {
  Channel channel(40);
  channel.change(5, 8, [](int i) { return i < 7 ? 1e-5 : -1e-5; });
  channel.change(30, 30, [](int) { return 1e-5; });  // beyond two layers from the others: nobody to take it
  const VolumeCorrection correction = channel.correct();
  double at_first = 0, at_second = 0, largest = 0;
  for (std::size_t c = 0; c < correction.cells.size(); ++c) {
    int i, j, k;
    channel.grid.position(correction.cells[c], i, j, k);
    (i < 20 ? at_first : at_second) += correction.outflow[c];
    if (i >= 20) largest = std::max(largest, std::abs(correction.outflow[c]));
  }
  const double cell = channel.grid.cell_volume[channel.grid.at(1, 1, 1)];
  EXPECT_LT(std::abs(at_first), 1e-15 * cell);
  EXPECT_LT(std::abs(at_second), 1e-15 * cell);
  // All but its share of what all of them have to bear.
  EXPECT_GT(largest, 0.9e-5 * cell);
  EXPECT_LT(largest, 1e-5 * cell);
  for (const std::int32_t each : channel.label) ASSERT_EQ(each, -1);
}

}  // namespace
}  // namespace polynya::fluid
