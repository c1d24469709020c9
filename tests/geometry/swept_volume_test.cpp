// What walls sweep as they move is what the cells lose and gain: the change of a body's volume in a cell is the
// integral over time of the flux of the walls' velocity through its pieces of wall.
#include <gtest/gtest.h>

#include <functional>

#include "geometry/cut_cells.hpp"
#include "shapes.hpp"

using namespace polynya::geometry;
using shapes::Shape;

namespace {

const GridLines grid{
    {shapes::lines(-1.3, 1.4, 7), shapes::lines(-1.35, 1.3, 6, 0.9), shapes::lines(-1.4, 1.3, 8, 1.1)}};

struct State {
  std::vector<double> volume;  ///< of the body by cell
  std::vector<double> rate;    ///< swept by its wall, m^3/s
};

/// A body whose vertices are at place(t) and move with their true velocities.
using Motion = std::function<Shape(double)>;

State state_at(const Motion& motion, double t) {
  static Cutter cutter(grid);
  const Shape body = motion(t);
  CutCells cut;
  cutter.cut(std::array{body.surface()}, cut);
  State state;
  state.volume.assign(static_cast<std::size_t>(grid.cell_count()), 0.0);
  state.rate = state.volume;
  for (std::size_t e = 0; e < cut.cell.size(); ++e)
    state.volume[static_cast<std::size_t>(cut.cell[e])] = cut.body_volume[e];
  for (const WallPiece& piece : cut.pieces) {
    double& rate = state.rate[static_cast<std::size_t>(cut.cell[static_cast<std::size_t>(piece.entry)])];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(body.triangles[3 * static_cast<std::size_t>(piece.triangle) + c]);
      for (std::size_t d = 0; d < 3; ++d) rate += piece.weights[c] * body.velocities[3 * v + d] * piece.area[d];
    }
  }
  return state;
}

/// Simpson's rule, halved until both halves agree with the whole.
void integrate(const Motion& motion, double t0, double t1, const State& s0, const State& middle, const State& s1,
               int depth, std::vector<double>& swept) {
  const double width = t1 - t0, centre = 0.5 * (t0 + t1);
  const State left = state_at(motion, t0 + 0.25 * width), right = state_at(motion, t1 - 0.25 * width);
  double difference = 0;
  const std::size_t cells = swept.size();
  std::vector<double> fine(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const double whole = width / 6 * (s0.rate[c] + 4 * middle.rate[c] + s1.rate[c]);
    fine[c] = width / 12 * (s0.rate[c] + 4 * left.rate[c] + 2 * middle.rate[c] + 4 * right.rate[c] + s1.rate[c]);
    difference = std::max(difference, std::abs(whole - fine[c]));
  }
  if (difference < 1e-14 || depth == 0) {
    for (std::size_t c = 0; c < cells; ++c) swept[c] += fine[c];
    return;
  }
  integrate(motion, t0, centre, s0, left, middle, depth - 1, swept);
  integrate(motion, centre, t1, middle, right, s1, depth - 1, swept);
}

void expect_swept_is_change(const Motion& motion, double time) {
  const State start = state_at(motion, 0), end = state_at(motion, time);
  std::vector<double> swept(start.volume.size(), 0.0);
  integrate(motion, 0, time, start, state_at(motion, 0.5 * time), end, 30, swept);
  double most = 0, worst = 0;
  for (std::size_t c = 0; c < swept.size(); ++c) {
    const double change = end.volume[c] - start.volume[c], cell = grid.cell_volume(static_cast<std::int64_t>(c));
    most = std::max(most, std::abs(change) / cell);
    worst = std::max(worst, std::abs(change - swept[c]) / cell);
  }
  EXPECT_LT(worst, 1e-10);
  EXPECT_GT(most, 0.1);  // it has moved by a good part of a cell
}

}  // namespace

TEST(SweptVolume, OfABodyThatMovesStraightIsTheChangeOfVolume) {
  std::mt19937 random(47);
  for (int trial = 0; trial < 4; ++trial) {
    Shape body = trial % 2 ? shapes::box(1) : shapes::cylinder(6);
    shapes::scale_and_move(body, {0.6, 0.5, 0.55}, {0, 0, 0});
    shapes::rotate_randomly(body, random);
    const shapes::Vector velocity{0.7, -0.4, 0.9};
    expect_swept_is_change(
        [=](double t) {
          Shape now = body;
          shapes::scale_and_move(now, {1, 1, 1}, {t * velocity[0], t * velocity[1], t * velocity[2]});
          for (std::size_t i = 0; i < now.velocities.size(); ++i) now.velocities[i] = velocity[i % 3];
          return now;
        },
        0.1);
  }
}

TEST(SweptVolume, OfABodyThatTurnsAndStretchesIsTheChangeOfVolume) {
  std::mt19937 random(53);
  Shape body = shapes::box(1);
  shapes::scale_and_move(body, {0.6, 0.5, 0.55}, {0, 0, 0});
  shapes::rotate_randomly(body, random);
  expect_swept_is_change(
      [=](double t) {
        Shape now = body;
        const double c = std::cos(t), s = std::sin(t), growth = 1 + 0.3 * t;
        for (std::size_t v = 0; v < now.vertices(); ++v) {
          const auto p = body.vertex(static_cast<std::int32_t>(v));
          const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
          const std::array<double, 3> place{x, y, growth * p[2]}, velocity{-y, x, 0.3 * p[2]};
          for (std::size_t d = 0; d < 3; ++d)
            now.positions[3 * v + d] = place[d], now.velocities[3 * v + d] = velocity[d];
        }
        return now;
      },
      0.25);
}
