// Ten hulls from files: five that are right, five that are broken in five ways.
#include "geometry/hull/import_hull.hpp"

#include <cmath>
#include <numbers>

#include "geometry/error.hpp"
#include "tests/geometry/hull/hull_files.hpp"

namespace polynya::geometry {
namespace {

using namespace hull_files;
using shapes::Shape;

const HullOptions millimetres{.scale = 1e-3};

std::string refusal(const std::string& path, Repair repair = Repair::safe) {
  try {
    import_hull(path, {.scale = 1e-3, .repair = repair});
  } catch (const GeometryError& error) {
    return error.what();
  }
  return {};
}

void expect_words(const std::string& message, const std::vector<std::string>& words) {
  for (const auto& word : words) EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks: " << word;
}

/// The hull has the volume, centre and inertia that fluxes through the intact surface (in mm) give.
void expect_properties(const ImportedHull& hull, const Shape& intact, double tolerance) {
  const Integrals exact = by_fluxes(intact);
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (std::size_t i = 0; i < intact.positions.size(); ++i)
    low[i % 3] = std::min(low[i % 3], intact.positions[i]), high[i % 3] = std::max(high[i % 3], intact.positions[i]);
  const double nose[3] = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), high[2]};
  EXPECT_NEAR(hull.solid.volume / (1e-9 * exact.volume), 1, tolerance);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(hull.solid.centre[d], 1e-3 * (exact.centre[d] - nose[d]), tolerance * 1e-3 * (high[2] - low[2]));
    EXPECT_NEAR(hull.solid.inertia[d][d] / (1e-15 * exact.inertia[d]), 1, tolerance);
    EXPECT_NEAR(hull.solid.inertia[d][(d + 1) % 3], 1e-15 * exact.inertia[3 + d], tolerance * 1e-15 * exact.inertia[0]);
  }
}

/// A slender body without symmetry, in mm.
Shape lopsided_hull() {
  Shape hull = shapes::sphere(3);
  hull.transform([](shapes::Vector p) {
    return shapes::Vector{5 * p[0] + 0.8 * p[2] * p[2], 4 * p[1] + 0.5 * p[0], 50 * p[2] + 3 * p[0]};
  });
  return hull;
}

TEST(ImportHull, ABoxHasTheVolumeAndInertiaOfTheTextbook) {
  Shape box = shapes::box(2);
  shapes::scale_and_move(box, {5, 10, 40}, {100, -30, 7});
  const ImportedHull hull = import_hull(write_binary_stl("box.stl", box), millimetres);
  const double a = 0.01, b = 0.02, c = 0.08, volume = a * b * c;
  EXPECT_NEAR(hull.solid.volume / volume, 1, 1e-12);
  EXPECT_NEAR(hull.solid.centre[2], -0.5 * c, 1e-12);
  EXPECT_NEAR(hull.solid.inertia[0][0] / (volume * (b * b + c * c) / 12), 1, 1e-12);
  EXPECT_NEAR(hull.solid.inertia[1][1] / (volume * (c * c + a * a) / 12), 1, 1e-12);
  EXPECT_NEAR(hull.solid.inertia[2][2] / (volume * (a * a + b * b) / 12), 1, 1e-12);
  EXPECT_EQ(hull.note, "The surface needed no repair.");
}

TEST(ImportHull, ASphereOfTextApproachesTheExactBall) {
  Shape ball = shapes::sphere(4);
  shapes::scale_and_move(ball, {6, 6, 6}, {1, 2, 3});
  const ImportedHull hull = import_hull(write_text_stl("ball.stl", ball), millimetres);
  expect_properties(hull, ball, 1e-11);
  const double r = 6e-3, volume = 4 * std::numbers::pi / 3 * r * r * r;
  EXPECT_NEAR(hull.solid.volume / volume, 1, 4e-3);  // inscribed: two fifths of a per cent at 5,120 triangles
  EXPECT_NEAR(hull.solid.inertia[1][1] / (0.4 * volume * r * r), 1, 6e-3);
}

TEST(ImportHull, ALopsidedBodyHasTheIntegralsThatFluxesGive) {
  expect_properties(import_hull(write_text_stl("lopsided.stl", lopsided_hull()), millimetres), lopsided_hull(), 1e-11);
}

TEST(ImportHull, TheNoseMayPointAlongAnyAxisOfTheFile) {
  for (const std::string nose : {"x", "-x", "y", "-y", "-z"}) {
    Shape turned = lopsided_hull();
    turned.transform([&](shapes::Vector p) {
      if (nose == "x") return shapes::Vector{p[2], p[0], p[1]};
      if (nose == "-x") return shapes::Vector{-p[2], p[0], -p[1]};
      if (nose == "y") return shapes::Vector{p[1], p[2], p[0]};
      if (nose == "-y") return shapes::Vector{-p[1], -p[2], p[0]};
      return shapes::Vector{p[0], -p[1], -p[2]};
    });
    const std::string path = write_text_stl("turned.stl", turned);
    expect_properties(import_hull(path, {.scale = 1e-3, .nose = nose}), lopsided_hull(), 1e-11);
  }
}

TEST(ImportHull, ACavityInsideIsNoMaterial) {
  Shape outer = shapes::sphere(3), inner = shapes::sphere(2);
  shapes::scale_and_move(outer, {10, 10, 10}, {0, 0, 0});
  shapes::scale_and_move(inner, {6, 6, 6}, {1, 0, 0});
  // The file has the cavity's triangles outward as well: only their place tells that it is one.
  const ImportedHull hull = import_hull(write_text_stl("hollow.stl", joined(outer, inner)), millimetres);
  turn(inner, 0, inner.triangles.size() / 3);
  expect_properties(hull, joined(outer, inner), 1e-11);
  EXPECT_EQ(hull.cavities, 1u);
  EXPECT_EQ(hull.outer.triangles.size(), outer.triangles.size() / 3);
  expect_words(hull.note, {"Cavities inside: 1."});
}

TEST(ImportHull, TurnedTrianglesAreTurnedBack) {
  for (const std::size_t count : {std::size_t{7}, lopsided_hull().triangles.size() / 3}) {
    Shape hull = lopsided_hull();
    turn(hull, 0, count);
    const std::string path = write_text_stl("turned.stl", hull);
    const ImportedHull found = import_hull(path, millimetres);
    expect_properties(found, lopsided_hull(), 1e-11);
    expect_words(found.note, {std::to_string(count) + " triangles the wrong way round"});
    expect_words(refusal(path, Repair::none), {std::to_string(count) + " triangles the wrong way round"});
  }
}

TEST(ImportHull, DoubleTrianglesAndDoublePointsAreJoined) {
  Shape hull = lopsided_hull();
  hull.triangles.insert(hull.triangles.end(), hull.triangles.begin(), hull.triangles.begin() + 30);
  // One triangle has corners of its own, a ten-millionth of the size away.
  for (std::size_t c = 0; c < 3; ++c) {
    shapes::Vector p = hull.vertex(hull.triangles[300 + c]);
    p[0] += 1e-5;
    hull.triangles[300 + c] = shapes::add_vertex(hull, p);
  }
  const ImportedHull found = import_hull(write_text_stl("double.stl", hull), millimetres);
  expect_properties(found, lopsided_hull(), 2e-6);
  expect_words(found.note, {"3 double points", "10 double triangles"});
}

TEST(ImportHull, AnOpenSurfaceIsRefusedWithItsPlaceOrWrapped) {
  Shape hull = lopsided_hull();
  hull.triangles.erase(hull.triangles.begin(), hull.triangles.begin() + 3);
  const std::string path = write_text_stl("open.stl", hull);
  expect_words(refusal(path), {path, "is open: 3 edge(s)", "near (", "vehicle.repair = \"wrap\""});
  const ImportedHull wrapped = import_hull(path, {.scale = 1e-3, .repair = Repair::wrap});
  const double exact = 1e-9 * by_fluxes(lopsided_hull()).volume;
  std::printf("open: wrap %.4f mm away, volume %.4f of the exact one\n", wrapped.wrapped_distance * 1e3,
              wrapped.solid.volume / exact);
  // The wrap lies outside by its offset; the distance it reports bounds what it may add (area about 2,200 mm^2).
  EXPECT_GT(wrapped.solid.volume, exact);
  EXPECT_LT(wrapped.solid.volume, exact + 2300e-6 * wrapped.wrapped_distance);
  EXPECT_LT(wrapped.wrapped_distance, 1e-3);
  expect_words(wrapped.note, {"Wrapped, as asked for, because: the surface is open", "mm apart"});
}

TEST(ImportHull, ASurfaceThatMeetsItselfIsRefusedWithItsPlaceOrWrapped) {
  Shape low = shapes::box(3), high = shapes::box(3);
  shapes::scale_and_move(low, {5, 5, 20}, {0, 0, 0});
  shapes::scale_and_move(high, {4.3, 4.2, 20}, {0.1, 0.2, 15.3});
  const std::string path = write_text_stl("crossing.stl", joined(low, high));
  expect_words(refusal(path), {path, "meets itself", "pair(s) of triangles", "near ("});
  const ImportedHull wrapped = import_hull(path, {.scale = 1e-3, .repair = Repair::wrap});
  // Union of both boxes.
  const double exact = 1e-9 * (10 * 10 * 40 + 8.6 * 8.4 * 15.3);
  std::printf("crossing: wrap %.4f mm away, volume %.4f of the exact one\n", wrapped.wrapped_distance * 1e3,
              wrapped.solid.volume / exact);
  EXPECT_NEAR(wrapped.solid.volume / exact, 1, 0.05);
}

TEST(ImportHull, AnEdgeOfThreeTrianglesIsRefusedWithItsPlace) {
  Shape hull = shapes::box(1);
  shapes::scale_and_move(hull, {5, 5, 40}, {0, 0, 0});
  const std::int32_t tip = shapes::add_vertex(hull, {20, 0, 0});
  hull.triangles.insert(hull.triangles.end(), {hull.triangles[0], hull.triangles[1], tip});
  const std::string path = write_text_stl("fin.stl", hull);
  expect_words(refusal(path), {path, "not manifold: 1 edge(s) with more than two triangles", "near ("});
}

/// A wrap lies outside, and no farther than it says: it adds at most a layer of that thickness (area in mm^2).
void expect_wrapped(const std::string& path, double exact, double area, double diagonal) {
  const ImportedHull wrapped = import_hull(path, {.scale = 1e-3, .repair = Repair::wrap});
  std::printf("wrap %.4f mm away, volume %.4f of the exact one\n", wrapped.wrapped_distance * 1e3,
              wrapped.solid.volume / (1e-9 * exact));
  EXPECT_GT(wrapped.solid.volume, 1e-9 * exact);
  EXPECT_LT(wrapped.solid.volume, 1e-9 * exact + 1e-6 * area * wrapped.wrapped_distance);
  EXPECT_GT(wrapped.wrapped_distance, 0);
  // Corners of the wrap lie at its offset (alpha / 30), and its triangles have circumradii of at most alpha.
  EXPECT_LT(wrapped.wrapped_distance, 1e-3 * 0.02 * diagonal * (1 + 1.0 / 30));
  expect_words(wrapped.note, {"Wrapped, as asked for, because: the surface"});
}

TEST(ImportHull, ASheetOnAHullIsWrappedAsAThinFin) {
  Shape hull = shapes::box(1);
  shapes::scale_and_move(hull, {5, 5, 40}, {0, 0, 0});
  const shapes::Vector a = hull.vertex(hull.triangles[0]), b = hull.vertex(hull.triangles[1]);
  const shapes::Vector tip{2 * (a[0] + b[0]), 2 * (a[1] + b[1]), a[2]};
  hull.triangles.insert(hull.triangles.end(), {hull.triangles[0], hull.triangles[1], shapes::add_vertex(hull, tip)});
  double square = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::size_t e = (d + 1) % 3, f = (d + 2) % 3;
    const double part = (b[e] - a[e]) * (tip[f] - a[f]) - (b[f] - a[f]) * (tip[e] - a[e]);
    square += part * part;
  }
  const double both_sides = std::sqrt(square);
  expect_wrapped(write_text_stl("fin.stl", hull), 10 * 10 * 80, 2 * 10 * 10 + 4 * 10 * 80 + both_sides,
                 std::hypot(10, 15, 80));
}

TEST(ImportHull, TwoPrismsThatShareAnEdgeAreRefusedOrWrapped) {
  Shape one = shapes::box(1), other = shapes::box(1);
  shapes::scale_and_move(one, {5, 5, 40}, {0, 0, 0});
  shapes::scale_and_move(other, {5, 5, 40}, {10, 10, 0});
  const std::string path = write_text_stl("edge.stl", joined(one, other));
  expect_words(refusal(path), {path, "not manifold: 1 edge(s) with more than two triangles", "near (5, 5, 0)"});
  expect_wrapped(path, 2 * 10 * 10 * 80, 2 * (2 * 10 * 10 + 4 * 10 * 80), std::hypot(20, 20, 80));
}

TEST(ImportHull, TwoPrismsThatShareACornerAreRefusedOrWrapped) {
  Shape one = shapes::box(1), other = shapes::box(1);
  shapes::scale_and_move(one, {5, 5, 40}, {0, 0, 0});
  shapes::scale_and_move(other, {5, 5, 40}, {10, 10, 80});
  const std::string path = write_text_stl("corner.stl", joined(one, other));
  expect_words(refusal(path), {path, "meets itself", "near ("});
  expect_wrapped(path, 2 * 10 * 10 * 80, 2 * (2 * 10 * 10 + 4 * 10 * 80), std::hypot(20, 20, 160));
}

TEST(ImportHull, TwoBodiesInOneFileAreRefused) {
  Shape one = shapes::box(1), other = shapes::box(1);
  shapes::scale_and_move(other, {1, 1, 1}, {5, 0, 0});
  expect_words(refusal(write_text_stl("two.stl", joined(one, other))), {"2 bodies apart"});
}

TEST(ImportHull, BrokenFilesAreRefusedWithTheirPlace) {
  const auto file = [](const std::string& name, const std::string& text) {
    const std::string path = path_of(name);
    std::ofstream(path) << text;
    return path;
  };
  expect_words(refusal("/no/such/hull.stl"), {"/no/such/hull.stl: cannot be read"});
  expect_words(refusal(file("hull.step", "x")), {"must end with .stl, .obj or .ply"});
  expect_words(refusal(file("bad.obj", "v 0 0 0\nv 1 zero 0\n")), {"line 2", "'zero' is no number"});
  expect_words(refusal(file("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n")), {"triangle 0 names vertex 3"});
  expect_words(refusal(file("empty.stl", "solid\nendsolid\n")), {"holds no triangle"});
  expect_words(refusal(file("short.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n1\n")),
               {"a number is missing"});
}

TEST(ImportHull, ObjAndPlyGiveTheSameBodyAsStl) {
  const Shape hull = lopsided_hull();
  const std::string obj = path_of("hull.obj"), ply = path_of("hull.ply");
  std::ofstream text(obj), binary(ply, std::ios::binary);
  text.precision(17);
  const std::size_t triangles = hull.triangles.size() / 3;
  binary << "ply\nformat binary_little_endian 1.0\nelement vertex " << hull.vertices()
         << "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nelement face " << triangles
         << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t v = 0; v < hull.vertices(); ++v) {
    const auto p = hull.vertex(static_cast<std::int32_t>(v));
    text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    binary.write(reinterpret_cast<const char*>(p.data()), 24).put('\7');
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    text << "f";
    for (std::size_t c = 0; c < 3; ++c) text << ' ' << hull.triangles[3 * t + c] + 1 << "//1";
    text << '\n';
    binary.put('\3').write(reinterpret_cast<const char*>(&hull.triangles[3 * t]), 12);
  }
  text.close(), binary.close();
  for (const std::string& path : {obj, ply}) expect_properties(import_hull(path, millimetres), hull, 1e-11);
}

TEST(ImportHull, HalvingLongEdgesKeepsTheBody) {
  ImportedHull hull = import_hull(write_text_stl("box.stl", shapes::box(1)), {});
  split_long_edges(hull.outer, 0.3);
  const SolidProperties finer = solid_properties(hull.outer);
  EXPECT_NEAR(finer.volume, 8, 1e-12);
  EXPECT_NEAR(finer.inertia[0][0] / hull.solid.inertia[0][0], 1, 1e-12);
  for (const Triangle& t : hull.outer.triangles)
    for (std::size_t e = 0; e < 3; ++e) {
      const Point p = hull.outer.points[t[e]], q = hull.outer.points[t[(e + 1) % 3]];
      EXPECT_LE(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]), 0.3);
    }
}

}  // namespace
}  // namespace polynya::geometry
