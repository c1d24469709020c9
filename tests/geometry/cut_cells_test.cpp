#include "geometry/cut_cells.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "closure.hpp"
#include "shapes.hpp"

using namespace polynya::geometry;
using shapes::Shape;

namespace {

CutCells cut_once(const GridLines& grid, const std::vector<Shape>& bodies) {
  Cutter cutter(grid);
  std::vector<BodySurface> surfaces;
  for (const Shape& body : bodies) surfaces.push_back(body.surface());
  CutCells out;
  cutter.cut(surfaces, out);
  return out;
}

void expect_closed(const CutCells& cut, const GridLines& grid) {
  const Closure closure = check_closure(cut, grid);
  EXPECT_LT(closure.area, 1e-12);
  EXPECT_LT(closure.pieces, 1e-12);
  EXPECT_LE(closure.fraction, 0.0);
  EXPECT_TRUE(closure.sorted);
  EXPECT_EQ(cut.corrected_faces, 0);
  EXPECT_EQ(cut.overlapping_cells, 0);
  EXPECT_EQ(cut.loose_edges, 0);
}

}  // namespace

TEST(CutCells, SphereVolumeIsThatOfItsFacetsAndConvergesToTheBall) {
  const GridLines grid{
      {shapes::lines(-1.3, 1.4, 17), shapes::lines(-1.2, 1.3, 19, 1.05), shapes::lines(-1.5, 1.2, 21)}};
  double previous = 0;
  for (int level : {1, 2, 3, 4}) {
    const Shape ball = shapes::sphere(level);
    const CutCells cut = cut_once(grid, {ball});
    EXPECT_NEAR(total_volume(cut), shapes::volume(ball), 1e-12);
    expect_closed(cut, grid);
    const double error = 4.0 / 3.0 * M_PI - total_volume(cut);
    if (previous > 0) {
      EXPECT_NEAR(previous / error, 4.0, 0.3);  // inscribed facets: second order
    }
    previous = error;
  }
}

TEST(CutCells, TrianglesThatLieWhereTheyLayAreNotClippedAgain) {
  const GridLines grid{{shapes::lines(-1.3, 1.4, 17), shapes::lines(-1.2, 1.3, 19), shapes::lines(-1.5, 1.2, 21)}};
  Shape ball = shapes::sphere(4), other = shapes::cylinder(24);
  const auto expect_same = [](const CutCells& a, const CutCells& b) {
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.solid_volume, b.solid_volume);
    EXPECT_EQ(a.wall_area, b.wall_area);
    EXPECT_EQ(a.wall_velocity, b.wall_velocity);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(a.faces[axis].solid, b.faces[axis].solid);
    ASSERT_EQ(a.pieces.size(), b.pieces.size());
    for (std::size_t p = 0; p < a.pieces.size(); ++p) EXPECT_EQ(a.pieces[p].area, b.pieces[p].area);
  };
  Cutter cutter(grid);
  const auto all = static_cast<std::int64_t>(ball.surface().triangles.size() / 3);
  ASSERT_GT(all, 2048);
  CutCells cut;
  const auto cut_ball = [&] {
    const std::array bodies{ball.surface()};
    cutter.cut(bodies, cut);
  };
  cut_ball();
  EXPECT_EQ(cut.kept_triangles, 0);
  cut_ball();
  EXPECT_EQ(cut.kept_triangles, all);
  expect_same(cut, cut_once(grid, {ball}));
  // Velocities are no matter of where the surface is.
  for (double& v : ball.velocities) v += 1;
  cut_ball();
  EXPECT_EQ(cut.kept_triangles, all);
  expect_same(cut, cut_once(grid, {ball}));
  ball.positions[0] += 1e-3;
  cut_ball();
  EXPECT_LT(cut.kept_triangles, all);
  EXPECT_GT(cut.kept_triangles, 0);
  expect_same(cut, cut_once(grid, {ball}));
  // Another body, other planes, an error in between.
  const std::array two{other.surface(), ball.surface()};
  cutter.cut(two, cut);
  EXPECT_EQ(cut.kept_triangles, 0);
  GridLines shifted = grid;
  for (double& z : shifted.lines[2]) z += 0.01;
  cut_ball();
  cutter.set_lines(shifted);
  cut_ball();
  EXPECT_EQ(cut.kept_triangles, 0);
  expect_same(cut, cut_once(shifted, {ball}));
  const double right = ball.positions[4];
  ball.positions[1] += 1e-3;
  ball.positions[4] = std::nan("");
  EXPECT_THROW(cut_ball(), GeometryError);
  ball.positions[4] = right;
  cut_ball();
  EXPECT_EQ(cut.kept_triangles, 0);
  expect_same(cut, cut_once(shifted, {ball}));
}

TEST(CutCells, VolumeAndAreasCloseForAnyPosition) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  const GridLines grid{
      {shapes::lines(-1.6, 1.7, 13), shapes::lines(-1.65, 1.6, 11, 0.9), shapes::lines(-1.7, 1.6, 15, 1.1)}};
  for (int trial = 0; trial < 60; ++trial) {
    Shape body = trial % 3 == 0   ? shapes::sphere(2)
                 : trial % 3 == 1 ? shapes::cylinder(24)
                                  : shapes::box(1 + trial % 4);
    shapes::scale_and_move(body, {0.8, 0.6, 0.7}, {0, 0, 0});
    shapes::rotate_randomly(body, random);
    shapes::scale_and_move(body, {1, 1, 1}, {uniform(random), uniform(random), uniform(random)});
    const CutCells cut = cut_once(grid, {body});
    EXPECT_NEAR(total_volume(cut) / shapes::volume(body), 1.0, 1e-12);
    expect_closed(cut, grid);
  }
}

TEST(CutCells, FacesOfTheBodyOnGridPlanesAreExactAndWetTheFluidSide) {
  // 10 cells of 1/5: the box fills cells 3..6 along every axis.
  const GridLines grid = shapes::cube_grid(1.0, 10);
  Shape body = shapes::box(4);
  shapes::scale_and_move(body, {0.4, 0.4, 0.4}, {0, 0, 0});
  const CutCells cut = cut_once(grid, {body});
  expect_closed(cut, grid);
  std::size_t full = 0, wall = 0;
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    const auto p = grid.cell_position(cut.cell[e]);
    const bool inside = std::ranges::all_of(p, [](std::int64_t i) { return i >= 3 && i <= 6; });
    const double area = std::hypot(cut.wall_area[3 * e], cut.wall_area[3 * e + 1], cut.wall_area[3 * e + 2]);
    if (inside) {
      ++full;
      EXPECT_DOUBLE_EQ(cut.solid_volume[e], grid.cell_volume(cut.cell[e]));
      EXPECT_NEAR(area, 0.0, 1e-15);
    } else {
      ++wall;
      EXPECT_EQ(cut.solid_volume[e], 0.0);
      if (area > 1e-12) {
        EXPECT_NEAR(area, 0.04, 1e-15);
      }
    }
  }
  EXPECT_EQ(full, 64u);
  EXPECT_GE(wall, 6u * 16u);
}

TEST(CutCells, SurfaceOnTheWallsOfTheGridIsNotWetted) {
  // A plate that fills the grid laterally: only its upper and lower face are wetted.
  const GridLines grid = shapes::cube_grid(1.0, 8);
  Shape plate = shapes::box(3);
  shapes::scale_and_move(plate, {1, 1, 0.3}, {0, 0, 0.05});
  const CutCells cut = cut_once(grid, {plate});
  expect_closed(cut, grid);
  EXPECT_NEAR(total_volume(cut), 4 * 0.6, 1e-12);
  double up = 0, down = 0;
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    EXPECT_NEAR(cut.wall_area[3 * e], 0.0, 1e-15);
    EXPECT_NEAR(cut.wall_area[3 * e + 1], 0.0, 1e-15);
    (cut.wall_area[3 * e + 2] > 0 ? up : down) += cut.wall_area[3 * e + 2];
  }
  EXPECT_NEAR(up, 4.0, 1e-12);
  EXPECT_NEAR(down, -4.0, 1e-12);
}

TEST(CutCells, QuarterOfABodyIsAQuarterOfTheCut) {
  const Shape whole = [] {
    Shape s = shapes::cylinder(32);
    shapes::scale_and_move(s, {0.5, 0.5, 0.6}, {0, 0, 0.013});
    return s;
  }();
  Shape quarter;
  quarter.positions = whole.positions;
  quarter.rest();
  for (std::size_t t = 0; t < whole.triangles.size(); t += 3) {
    double x = 0, y = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      x += whole.vertex(whole.triangles[t + c])[0];
      y += whole.vertex(whole.triangles[t + c])[1];
    }
    if (x > 0 && y > 0)
      quarter.triangles.insert(quarter.triangles.end(), whole.triangles.begin() + static_cast<std::ptrdiff_t>(t),
                               whole.triangles.begin() + static_cast<std::ptrdiff_t>(t) + 3);
  }
  const GridLines all = shapes::cube_grid(1.0, 20);
  const GridLines part{{shapes::lines(0, 1, 10), shapes::lines(0, 1, 10), shapes::lines(-1, 1, 20)}};
  const CutCells full = cut_once(all, {whole}), cut = cut_once(part, {quarter});
  expect_closed(cut, part);
  EXPECT_NEAR(4 * total_volume(cut), shapes::volume(whole), 1e-12);
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    const auto p = part.cell_position(cut.cell[e]);
    const std::int64_t cell = all.cell_index(p[0] + 10, p[1] + 10, p[2]);
    const auto found = std::ranges::lower_bound(full.cell, cell);
    if (found == full.cell.end() || *found != cell) {
      EXPECT_NEAR(cut.solid_volume[e], 0.0, 1e-15);
      continue;
    }
    const auto f = static_cast<std::size_t>(found - full.cell.begin());
    EXPECT_NEAR(cut.solid_volume[e], full.solid_volume[f], 1e-15);
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(cut.wall_area[3 * e + d], full.wall_area[3 * f + d], 1e-14);
  }
}

TEST(CutCells, SidesThatShrinkFromTheWallsStayCutOffThere) {
  // The sides of the plate have moved in by 1e-4 of a cell.
  const GridLines grid = shapes::cube_grid(1.0, 8);
  Shape plate = shapes::box(4), open;
  shapes::scale_and_move(plate, {1 - 2.5e-5, 1 - 2.5e-5, 0.3}, {0, 0, 0.05});
  open.positions = plate.positions;
  open.rest();
  for (std::size_t t = 0; t < plate.triangles.size(); t += 3) {
    const double z0 = plate.vertex(plate.triangles[t])[2], z1 = plate.vertex(plate.triangles[t + 1])[2],
                 z2 = plate.vertex(plate.triangles[t + 2])[2];
    if (z0 == z1 && z1 == z2)
      open.triangles.insert(open.triangles.end(), plate.triangles.begin() + static_cast<std::ptrdiff_t>(t),
                            plate.triangles.begin() + static_cast<std::ptrdiff_t>(t) + 3);
  }
  for (const Shape& body : {open, plate}) {  // with and without its sides
    const CutCells cut = cut_once(grid, {body});
    expect_closed(cut, grid);
    EXPECT_NEAR(total_volume(cut), 4 * 0.6, 1e-12);
    for (std::size_t e = 0; e < cut.cell.size(); ++e) EXPECT_NEAR(std::abs(cut.wall_area[3 * e]), 0.0, 1e-15);
  }
}

TEST(CutCells, DegenerateConfigurationsStayConsistent) {
  // Vertices on multiples of half a cell: planes, edges and corners of the grid are hit all the time.
  std::mt19937 random(11);
  std::uniform_int_distribution<int> step(-4, 4), kind(0, 3);
  for (int trial = 0; trial < 400; ++trial) {
    const GridLines grid = shapes::cube_grid(1.0, 8);  // cells of 1/4
    Shape body = kind(random) == 0   ? shapes::sphere(1)
                 : kind(random) == 1 ? shapes::cylinder(8)
                                     : shapes::box(1 + trial % 3);
    shapes::scale_and_move(body, {0.45, 0.4, 0.35}, {0, 0, 0});
    if (trial % 2) shapes::rotate_randomly(body, random);
    const double unit = trial % 3 == 0 ? 0.25 : 0.125;
    const shapes::Vector shift{0.0625 * step(random), 0.0625 * step(random), 0.0625 * step(random)};
    body.transform([&](shapes::Vector p) {
      for (std::size_t d = 0; d < 3; ++d) p[d] = unit * std::round((p[d] + shift[d]) / unit);
      return p;
    });
    const CutCells cut = cut_once(grid, {body});
    const Closure closure = check_closure(cut, grid);
    // Rounding the vertices may turn a body inside out in places: then faces are corrected, but everything still
    // closes.
    EXPECT_LT(closure.area, 1e-12) << trial;
    EXPECT_LT(closure.pieces, 1e-12) << trial;
    EXPECT_LE(closure.fraction, 0.0) << trial;
    double volume = 0;
    for (double v : cut.body_volume) volume += v;
    EXPECT_NEAR(volume, shapes::volume(body), 1e-13) << trial;
  }
}

TEST(CutCells, CoincidenceUpToRoundingIsTakenAsCoincidence) {
  const GridLines grid = shapes::cube_grid(1.0, 10);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1e-16, 1e-16);
  Shape body = shapes::box(4);
  shapes::scale_and_move(body, {0.4, 0.4, 0.4}, {0, 0, 0});
  const CutCells exact = cut_once(grid, {body});
  body.transform([&](shapes::Vector p) {
    return shapes::Vector{p[0] + noise(random), p[1] + noise(random), p[2] + noise(random)};
  });
  const CutCells disturbed = cut_once(grid, {body});
  expect_closed(disturbed, grid);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(disturbed.faces[axis].face, exact.faces[axis].face);
    EXPECT_EQ(disturbed.faces[axis].solid, exact.faces[axis].solid);
  }
}

TEST(CutCells, VolumeSweptByTheWallIsTheChangeOfVolume) {
  const GridLines grid = shapes::cube_grid(1.5, 15);
  std::mt19937 random(5);
  Shape body = shapes::sphere(3);
  shapes::rotate_randomly(body, random);
  const shapes::Vector velocity{0.3, -0.2, 0.9};
  for (std::size_t v = 0; v < body.vertices(); ++v)
    for (std::size_t d = 0; d < 3; ++d) body.velocities[3 * v + d] = velocity[d];
  const double dt = 1e-5;
  Shape before = body, after = body;
  const auto moved = [&](Shape& s, double time) {
    shapes::scale_and_move(s, {1, 1, 1}, {time * velocity[0], time * velocity[1], time * velocity[2]});
  };
  moved(before, -dt / 2);
  moved(after, dt / 2);
  const CutCells cut = cut_once(grid, {body}), cut0 = cut_once(grid, {before}), cut1 = cut_once(grid, {after});
  const auto solid_of = [](const CutCells& c, std::int64_t cell) {
    const auto found = std::ranges::lower_bound(c.cell, cell);
    return found != c.cell.end() && *found == cell ? c.solid_volume[static_cast<std::size_t>(found - c.cell.begin())]
                                                   : 0.0;
  };
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    double swept = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      if (cut.wall_area[3 * e + d] != 0) {
        EXPECT_NEAR(cut.wall_velocity[3 * e + d], velocity[d], 1e-12);
      }
      swept -= dt * cut.wall_area[3 * e + d] * cut.wall_velocity[3 * e + d];
    }
    // Wall leaving or entering a cell during the step sweeps a second-order volume.
    EXPECT_NEAR(solid_of(cut1, cut.cell[e]) - solid_of(cut0, cut.cell[e]), swept, 20 * 0.2 * dt * dt);
  }
}

TEST(CutCells, PartsOfAWallThatMoveApartSweepTheChangeOfVolume) {
  // A box that swells about a point inside: in most cells, least where it lies in one cell alone, area times mean
  // velocity is not what it sweeps.
  for (const double size : {0.5, 0.04}) {
    const GridLines grid = shapes::cube_grid(1.0, 10);
    const double dt = 1e-6;
    const auto swollen = [&](double time) {
      Shape body = shapes::box(1);
      const double now = 1 + time;
      shapes::scale_and_move(body, {now * size, now * size, now * 0.9 * size}, {0.07, 0.11, 0.09});
      for (std::size_t v = 0; v < body.vertices(); ++v) {
        const auto p = body.vertex(static_cast<std::int32_t>(v));
        body.velocities[3 * v] = (p[0] - 0.07) / now, body.velocities[3 * v + 1] = (p[1] - 0.11) / now;
        body.velocities[3 * v + 2] = (p[2] - 0.09) / now;
      }
      return body;
    };
    const CutCells cut = cut_once(grid, {swollen(0)}), before = cut_once(grid, {swollen(-dt)}),
                   after = cut_once(grid, {swollen(dt)});
    ASSERT_EQ(before.cell, after.cell);
    double sum = 0;
    for (std::size_t e = 0; e < cut.cell.size(); ++e) {
      const double growth = (after.solid_volume[e] - before.solid_volume[e]) / (2 * dt);
      EXPECT_NEAR(cut.wall_sweep[e], -growth, 1e-8 * size * size);
      sum += cut.wall_sweep[e];
    }
    EXPECT_NEAR(sum, -3 * 8 * 0.9 * size * size * size, 1e-12);  // volume times divergence
  }
}

TEST(CutCells, WallVelocityOfARotationIsThatOfTheWallsCentre) {
  // One flat wall: the mean of a linear velocity over a piece is its value at the centroid.
  const GridLines grid = shapes::cube_grid(1.0, 10);
  Shape body = shapes::box(1);
  shapes::scale_and_move(body, {0.5, 0.5, 0.45}, {0, 0, 0});
  for (std::size_t v = 0; v < body.vertices(); ++v) {
    const auto p = body.vertex(static_cast<std::int32_t>(v));
    body.velocities[3 * v] = -p[1], body.velocities[3 * v + 1] = p[0], body.velocities[3 * v + 2] = 1;
  }
  const CutCells cut = cut_once(grid, {body});
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    const auto p = grid.cell_position(cut.cell[e]);
    if (p[2] != 7 || p[0] < 3 || p[0] > 6 || p[1] < 3 || p[1] > 6) continue;  // upper side, whole cells
    EXPECT_NEAR(cut.wall_velocity[3 * e], -(-0.9 + 0.2 * static_cast<double>(p[1])), 1e-12);
    EXPECT_NEAR(cut.wall_velocity[3 * e + 1], -0.9 + 0.2 * static_cast<double>(p[0]), 1e-12);
    EXPECT_NEAR(cut.wall_velocity[3 * e + 2], 1.0, 1e-12);
  }
}

TEST(CutCells, ResultsDoNotDependOnEarlierCuts) {
  const GridLines grid = shapes::cube_grid(1.4, 12);
  Cutter cutter(grid);
  CutCells reused;
  const Shape large = shapes::sphere(3);
  Shape small = shapes::cylinder(9);
  shapes::scale_and_move(small, {0.3, 0.4, 0.5}, {0.1, 0.2, 0.3});
  const std::array first{large.surface(), small.surface()}, second{small.surface(), large.surface()};
  cutter.cut(first, reused);
  cutter.cut(second, reused);
  Cutter fresh(grid);
  CutCells once;
  fresh.cut(second, once);
  EXPECT_EQ(reused.cell, once.cell);
  EXPECT_EQ(reused.body_volume, once.body_volume);
  EXPECT_EQ(reused.wall_area, once.wall_area);
  EXPECT_EQ(reused.faces[0].solid, once.faces[0].solid);
  EXPECT_EQ(reused.pieces.size(), once.pieces.size());
}

TEST(CutCells, ResultsDoNotDependOnTheNumberOfThreads) {
  const GridLines grid = shapes::cube_grid(1.2, 24);
  std::mt19937 random(13);
  Shape body = shapes::sphere(4);  // several chunks of triangles and columns
  shapes::rotate_randomly(body, random);
  for (std::size_t v = 0; v < body.velocities.size(); ++v) body.velocities[v] = std::sin(static_cast<double>(v));
  const int usual = omp_get_max_threads();
  omp_set_num_threads(1);
  const CutCells one = cut_once(grid, {body});
  omp_set_num_threads(3);
  const CutCells three = cut_once(grid, {body});
  omp_set_num_threads(usual);
  EXPECT_EQ(one.cell, three.cell);
  EXPECT_EQ(one.solid_volume, three.solid_volume);
  EXPECT_EQ(one.wall_area, three.wall_area);
  EXPECT_EQ(one.wall_velocity, three.wall_velocity);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(one.faces[axis].solid, three.faces[axis].solid);
  ASSERT_EQ(one.pieces.size(), three.pieces.size());
  for (std::size_t p = 0; p < one.pieces.size(); ++p) {
    EXPECT_EQ(one.pieces[p].triangle, three.pieces[p].triangle);
    EXPECT_EQ(one.pieces[p].area, three.pieces[p].area);
  }
}

TEST(CutCells, BadSurfacesAreRefusedByName) {
  Cutter cutter(shapes::cube_grid(1.0, 4));
  CutCells out;
  Shape body = shapes::box();
  body.triangles[4] = 99;
  EXPECT_THROW(cutter.cut(std::array{body.surface()}, out), GeometryError);
  body = shapes::box();
  body.positions[7] = std::nan("");
  try {
    cutter.cut(std::array{body.surface()}, out);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("vertex 2"), std::string::npos) << error.what();
  }
  EXPECT_THROW(Cutter(GridLines{{std::vector{0.0, 1.0}, std::vector{0.0, 0.0}, std::vector{0.0, 1.0}}}), GeometryError);
}

TEST(CutCells, AnOpenEdgeInsideTheGridIsReported) {
  Shape body = shapes::box(2);
  shapes::scale_and_move(body, {0.3, 0.3, 0.3}, {0, 0, 0});
  body.triangles.resize(body.triangles.size() - 3);
  EXPECT_GT(cut_once(shapes::cube_grid(1.0, 10), {body}).loose_edges, 0);
}
