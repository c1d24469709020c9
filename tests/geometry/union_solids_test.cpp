// Round bodies that overlap: against CGAL's corefinement, chance, buoyancy and swept volume.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include "closure.hpp"
#include "geometry/exact_cut.hpp"
#include "shapes.hpp"

using namespace polynya::geometry;
using shapes::Shape;
using shapes::Vector;

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

const GridLines grid{
    {shapes::lines(-1.6, 1.7, 13), shapes::lines(-1.65, 1.6, 11, 0.9), shapes::lines(-1.7, 1.6, 15, 1.1)}};

Mesh mesh_of(const Shape& shape) {
  Mesh mesh;
  for (std::size_t v = 0; v < shape.vertices(); ++v) {
    const Vector p = shape.vertex(static_cast<std::int32_t>(v));
    mesh.add_vertex({p[0], p[1], p[2]});
  }
  for (std::size_t t = 0; t < shape.triangles.size(); t += 3)
    mesh.add_face(Mesh::Vertex_index(static_cast<unsigned>(shape.triangles[t])),
                  Mesh::Vertex_index(static_cast<unsigned>(shape.triangles[t + 1])),
                  Mesh::Vertex_index(static_cast<unsigned>(shape.triangles[t + 2])));
  return mesh;
}

/// By CGAL's corefinement of the whole surfaces, in exact numbers.
double union_by_corefinement(const Shape& a, const Shape& b) {
  Mesh first = mesh_of(a), second = mesh_of(b), both;
  EXPECT_TRUE(CGAL::Polygon_mesh_processing::corefine_and_compute_union(first, second, both));
  return CGAL::to_double(CGAL::exact(CGAL::Polygon_mesh_processing::volume(both)));
}

CutCells cut_of(const Shape& a, const Shape& b, bool exactly = false) {
  Cutter cutter(grid);
  cutter.set_exact_union(add_below_exactly, exactly);
  CutCells cut;
  cutter.cut(std::array{a.surface(), b.surface()}, cut);
  return cut;
}

void expect_closed(const CutCells& cut) {
  const Closure closure = check_closure(cut, grid);
  EXPECT_LT(closure.area, 1e-12);
  EXPECT_LT(closure.pieces, 1e-12);
  EXPECT_LE(closure.fraction, 0.0);
  EXPECT_EQ(cut.doubted_unions, 0);
  EXPECT_EQ(cut.overlapping_cells, 0);
}

Shape random_body(int kind, std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  Shape body = kind == 0 ? shapes::sphere(2) : kind == 1 ? shapes::cylinder(20) : shapes::box(2);
  shapes::scale_and_move(body, kind == 1 ? Vector{0.3, 0.35, 0.9} : Vector{0.7, 0.6, 0.5}, {0, 0, 0});
  shapes::rotate_randomly(body, random);
  shapes::scale_and_move(body, {1, 1, 1}, {shift(random), shift(random), shift(random)});
  return body;
}

/// All these bodies are convex.
bool holds(const Shape& s, const Vector& p) {
  for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
    const Vector a = s.vertex(s.triangles[t]), b = s.vertex(s.triangles[t + 1]), c = s.vertex(s.triangles[t + 2]);
    double side = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t u = (d + 1) % 3, w = (d + 2) % 3;
      side += ((b[u] - a[u]) * (c[w] - a[w]) - (b[w] - a[w]) * (c[u] - a[u])) * (p[d] - a[d]);
    }
    if (side > 0) return false;
  }
  return true;
}

}  // namespace

TEST(UnionOfSolids, HasTheVolumeOfCorefinementInRandomPositions) {
  std::mt19937 random(11);
  double worst = 0;
  std::int64_t united = 0, exactly = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Shape a = random_body(trial % 3, random), b = random_body(trial / 3 % 3, random);
    const CutCells cut = cut_of(a, b);
    worst = std::max(worst, std::abs(total_volume(cut) - union_by_corefinement(a, b)));
    expect_closed(cut);
    united += cut.united_cells;
    exactly += cut.united_exactly;
  }
  std::printf("%ld cells united, %ld exactly; largest error %.1e m^3\n", long(united), long(exactly), worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(UnionOfSolids, OfSpheresConvergesToTheLens) {
  const double r = 0.8, apart = 1.0;
  const double lens = M_PI * (4 * r + apart) * (2 * r - apart) * (2 * r - apart) / 12;
  const double ideal = 2 * (4.0 / 3) * M_PI * r * r * r - lens;
  std::vector<double> errors;
  for (const int level : {2, 3, 4}) {
    Shape a = shapes::sphere(level), b = a;
    shapes::scale_and_move(a, {r, r, r}, {0.02, -0.03, -0.5 * apart});
    shapes::scale_and_move(b, {r, r, r}, {0.02, -0.03, 0.5 * apart});
    const CutCells cut = cut_of(a, b);
    expect_closed(cut);
    errors.push_back(std::abs(total_volume(cut) - ideal));
  }
  EXPECT_LT(errors[1], 0.3 * errors[0]);
  EXPECT_LT(errors[2], 0.3 * errors[1]);
}

TEST(UnionOfSolids, OfCrossingCylindersConvergesToSteinmetz) {
  const double r = 0.6, length = 2.6;
  const double ideal = 2 * M_PI * r * r * length - 16.0 / 3 * r * r * r;
  std::vector<double> errors;
  for (const int sides : {24, 48, 96}) {
    Shape a = shapes::cylinder(sides), b = a;
    shapes::scale_and_move(a, {r, r, 0.5 * length}, {0, 0, 0});
    shapes::scale_and_move(b, {r, r, 0.5 * length}, {0, 0, 0});
    b.transform([](Vector p) { return Vector{p[2], p[0], p[1]}; });
    const CutCells cut = cut_of(a, b);
    expect_closed(cut);
    errors.push_back(std::abs(total_volume(cut) - ideal));
  }
  EXPECT_LT(errors[1], 0.3 * errors[0]);
  EXPECT_LT(errors[2], 0.3 * errors[1]);
}

TEST(UnionOfSolids, AgreesWithChanceInEveryCellThatHoldsBoth) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int points = 2000;
  int cells = 0, beyond = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Shape a = random_body(trial % 3, random), b = random_body((trial + 1) % 3, random);
    const CutCells cut = cut_of(a, b);
    for (std::size_t e = 0; e < cut.cell.size(); ++e) {
      if (cut.body_volume[2 * e] <= 0 || cut.body_volume[2 * e + 1] <= 0 || !cut.walled[e]) continue;
      const auto p = grid.cell_position(cut.cell[e]);
      int hits = 0;
      for (int n = 0; n < points; ++n) {
        Vector x;
        for (std::size_t d = 0; d < 3; ++d)
          x[d] = grid.lines[d][static_cast<std::size_t>(p[d])] + unit(random) * grid.width(static_cast<int>(d), p[d]);
        hits += holds(a, x) || holds(b, x);
      }
      const double f = cut.solid_volume[e] / grid.cell_volume(cut.cell[e]);
      const double deviation = std::sqrt(std::max(f * (1 - f), 1.0 / points) / points);
      EXPECT_LT(std::abs(static_cast<double>(hits) / points - f), 5 * deviation);
      beyond += std::abs(static_cast<double>(hits) / points - f) > 2 * deviation;
      ++cells;
    }
  }
  EXPECT_GT(cells, 100);
  EXPECT_LT(beyond, 0.1 * cells);
}

TEST(UnionOfSolids, ExactNumbersThroughoutGiveTheSame) {
  std::mt19937 random(17);
  const Shape a = random_body(1, random), b = random_body(2, random);
  const CutCells packed = cut_of(a, b), exact = cut_of(a, b, true);
  EXPECT_EQ(packed.united_cells, exact.united_cells);
  EXPECT_GT(exact.united_exactly, 0);
  ASSERT_EQ(packed.cell, exact.cell);
  for (std::size_t e = 0; e < packed.cell.size(); ++e) {
    const double cell = grid.cell_volume(packed.cell[e]);
    EXPECT_NEAR(packed.solid_volume[e], exact.solid_volume[e], 1e-12 * cell);
    for (std::size_t w = 6 * e; w < 6 * e + 6; ++w)
      EXPECT_NEAR(packed.wall_area[w], exact.wall_area[w], 1e-12 * std::cbrt(cell * cell));
  }
}

TEST(UnionOfSolids, SweepsTheVolumeByWhichItChanges) {
  std::mt19937 random(19);
  for (int trial = 0; trial < 6; ++trial) {
    Shape a = random_body(trial % 3, random), b = random_body((trial + 1) % 3, random);
    const Vector u{0.3, -0.2, 0.5}, v{-0.4, 0.1, -0.7};
    for (std::size_t n = 0; n < a.velocities.size(); ++n) a.velocities[n] = u[n % 3];
    for (std::size_t n = 0; n < b.velocities.size(); ++n) b.velocities[n] = v[n % 3];
    const CutCells cut = cut_of(a, b);
    double sweep = 0;
    for (const double s : cut.wall_sweep) sweep -= s;
    const double dt = 1e-5;
    std::array<double, 2> volume;
    for (const int side : {0, 1}) {
      const double t = side == 0 ? -dt : dt;
      Shape first = a, second = b;
      shapes::scale_and_move(first, {1, 1, 1}, {t * u[0], t * u[1], t * u[2]});
      shapes::scale_and_move(second, {1, 1, 1}, {t * v[0], t * v[1], t * v[2]});
      volume[static_cast<std::size_t>(side)] = total_volume(cut_of(first, second));
    }
    EXPECT_NEAR(sweep, (volume[1] - volume[0]) / (2 * dt), 1e-8);
  }
}

TEST(UnionOfSolids, FeelsTheBuoyancyOfItsVolume) {
  std::mt19937 random(23);
  const double gradient = 9810;
  for (int trial = 0; trial < 6; ++trial) {
    const Shape a = random_body(trial % 3, random), b = random_body((trial + 1) % 3, random);
    const CutCells cut = cut_of(a, b);
    std::vector<double> pressure(cut.cell.size()), gradients(cut.cell.size(), gradient);
    for (std::size_t e = 0; e < cut.cell.size(); ++e) {
      const auto k = static_cast<std::size_t>(grid.cell_position(cut.cell[e])[2]);
      pressure[e] = 1e5 - gradient * 0.5 * (grid.lines[2][k] + grid.lines[2][k + 1]);
    }
    Vector force{};
    for (const WallForces& f : pressure_forces(cut, std::array{a.surface(), b.surface()}, pressure, gradients))
      for (std::size_t n = 0; n < f.on_vertices.size(); ++n) force[n % 3] += f.on_vertices[n];
    const double buoyancy = gradient * total_volume(cut);
    EXPECT_NEAR(force[0] / buoyancy, 0, 1e-11);
    EXPECT_NEAR(force[1] / buoyancy, 0, 1e-11);
    EXPECT_NEAR(force[2] / buoyancy, 1, 1e-11);
  }
}

TEST(UnionOfSolids, IsCutOffByTheWallsOfTheGrid) {
  Shape a = shapes::box(3), b = shapes::sphere(2);
  shapes::scale_and_move(a, {4, 0.51, 0.43}, {0.1, 0.03, 0.02});  // beyond both walls normal to x
  shapes::scale_and_move(b, {0.9, 0.9, 0.9}, {1.4, -0.2, 0.21});  // beyond the last one
  for (const bool along_y : {false, true}) {
    if (along_y)
      for (Shape* s : {&a, &b}) s->transform([](Vector p) { return Vector{-p[1], p[0], p[2]}; });
    const CutCells cut = cut_of(a, b);
    EXPECT_GT(cut.united_cells, 0);
    expect_closed(cut);
  }
}
