#include "fluid_solver/prescribed_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "geometry/exact_cut.hpp"

namespace polynya::fluid {
namespace {

constexpr double edge_of_cell = 0.5;  // triangles of round bodies over the fine cells

scene::Vector cross(const scene::Vector& a, const scene::Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

PrescribedBodies::PrescribedBodies(const scene::Scene& scene, const Grid& grid)
    : cutter_(geometry::GridLines{{grid.x, grid.y, grid.z}}), exact_(scene.overlap.method == "exact") {
  if (exact_) cutter_.set_method(geometry::clip_exactly);
  cutter_.set_exact_union(geometry::add_below_exactly, exact_);
  for (const auto& [name, body] : *scene.fluid->bodies) {
    Surface surface{name, body, {scene::mirrored(scene, body, 0), scene::mirrored(scene, body, 1)}, {}, {}, {}, {}};
    geometry::TriangleSoup soup = scene::body_surface(body, edge_of_cell * scene.resolution.cell);
    surface.points = std::move(soup.points);
    for (const geometry::Triangle& t : soup.triangles)
      for (const std::size_t corner : t) surface.triangles.push_back(static_cast<std::int32_t>(corner));
    bodies_.push_back(std::move(surface));
  }
  given_.resize(bodies_.size());
}

bool PrescribedBodies::moves_at_start() const {
  return std::ranges::any_of(bodies_, [](const Surface& s) {
    return scene::velocity_at(s.body, 0) != scene::Vector{} || scene::rotation_at(s.body, 0) != 0;
  });
}

const Overlap& PrescribedBodies::start() {
  for (Surface& s : bodies_) {
    const scene::Vector velocity = scene::velocity_at(s.body, 0);
    scene::Vector turning{};
    turning[static_cast<std::size_t>(s.body.rotation_axis[0] - 'x')] = scene::rotation_at(s.body, 0);
    s.velocities.clear();
    for (const scene::Vector& point : s.points) {
      const scene::Vector around = cross(turning, point);
      for (std::size_t d = 0; d < 3; ++d) s.velocities.push_back(velocity[d] + around[d]);
    }
  }
  cut(0);
  return now_.overlap;
}

const Overlap& PrescribedBodies::advance(double time, double dt) {
  if (now_.time != time) {  // a run that goes on
    for (Surface& s : bodies_) s.velocities.assign(3 * s.points.size(), 0.0);
    const Counts counted = counts_;
    cut(time);
    counts_ = counted;
  }
  std::swap(before_, now_);
  for (Surface& s : bodies_) {
    const scene::Pose first = scene::pose_at(s.body, time), last = scene::pose_at(s.body, time + dt);
    s.velocities.clear();
    for (const scene::Vector& point : s.points) {
      const scene::Vector a = scene::placed(s.body, first, point), b = scene::placed(s.body, last, point);
      for (std::size_t d = 0; d < 3; ++d) s.velocities.push_back((b[d] - a[d]) / dt);
    }
  }
  cut(time + dt);
  return now_.overlap;
}

void PrescribedBodies::cut(double time) {
  now_.time = time;
  now_.centre.clear();
  std::vector<geometry::BodySurface> views;
  for (Surface& s : bodies_) {
    const scene::Pose pose = scene::pose_at(s.body, time);
    s.positions.clear();
    for (const scene::Vector& point : s.points) {
      const scene::Vector p = scene::placed(s.body, pose, point);
      s.positions.insert(s.positions.end(), p.begin(), p.end());
    }
    now_.centre.push_back(pose.position);
    views.push_back({s.positions, s.velocities, s.triangles});
  }
  cutter_.cut(views, now_.cells);
  const std::size_t recut = geometry::recut_uncertain(now_.cells, views, cutter_.grid());
  const long walled = std::count(now_.cells.walled.begin(), now_.cells.walled.end(), std::uint8_t{1});
  counts_.cells += walled;
  counts_.exact += exact_ ? walled : static_cast<long>(recut);
  counts_.shared += static_cast<long>(now_.cells.shared_cells);
  counts_.united += static_cast<long>(now_.cells.united_cells);
  counts_.united_exactly += static_cast<long>(now_.cells.united_exactly);
  counts_.doubted += static_cast<long>(now_.cells.doubted_unions);
  if (now_.cells.overlapping_cells > 0 || now_.cells.doubted_unions > 0) {
    std::ostringstream text;
    text << "bodies overlap in " << std::max(now_.cells.overlapping_cells, now_.cells.doubted_unions)
         << " cells at time " << time
         << " s so that their union is not certain: three of them in one place, or an open "
         << "surface; two closed bodies may overlap";
    throw geometry::GeometryError(text.str());
  }
  now_.lever.clear();
  for (const geometry::WallPiece& piece : now_.cells.pieces) {
    const Surface& s = bodies_[static_cast<std::size_t>(piece.body)];
    scene::Vector lever{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto vertex = static_cast<std::size_t>(s.triangles[3 * static_cast<std::size_t>(piece.triangle) + c]);
      for (std::size_t d = 0; d < 3; ++d) lever[d] += piece.weights[c] * s.positions[3 * vertex + d];
    }
    for (std::size_t d = 0; d < 3; ++d) lever[d] -= now_.centre[static_cast<std::size_t>(piece.body)][d];
    now_.lever.push_back(lever);
  }
  now_.overlap = overlap_of(now_.cells);
}

void PrescribedBodies::take(const Fluid& fluid, double dt) {
  add(fluid, before_, 0.5 * dt, false);
  add(fluid, now_, 0.5 * dt, true);
}

/// Pressures that acted for `time` on the pieces of a cut; after the last cut also what carried nodes gave, spread over
/// a cell's pieces by area.
void PrescribedBodies::add(const Fluid& fluid, const Cut& cut, double time, bool last) {
  std::vector<double> pressure, gradient;
  overlap_pressure(fluid, cut.overlap.walled, pressure, gradient);
  std::vector<std::size_t> wall_of(cut.cells.cell.size()), grid_wall(cut.cells.cell.size());
  for (std::size_t e = 0, wall = 0, at = 0; e < wall_of.size(); ++e) {
    if (!cut.cells.walled[e]) continue;
    wall_of[e] = wall++;
    if (!last) continue;
    const std::ptrdiff_t cell = fluid.grid.from_message(cut.cells.cell[e]);
    while (fluid.after.walls[at].cell != cell) ++at;  // both ascend, and cells without wall have a piece as well
    grid_wall[e] = at;
  }
  std::vector<double> together(2 * wall_of.size(), 0.0);
  const auto size_of = [](const geometry::WallPiece& p) { return std::hypot(p.area[0], p.area[1], p.area[2]); };
  if (last)
    for (const geometry::WallPiece& piece : cut.cells.pieces)
      together[2 * static_cast<std::size_t>(piece.entry) + (piece.body > 0)] += size_of(piece);
  for (std::size_t p = 0; p < cut.cells.pieces.size(); ++p) {
    const geometry::WallPiece& piece = cut.cells.pieces[p];
    const auto entry = static_cast<std::size_t>(piece.entry), wall = wall_of[entry];
    const std::size_t place = piece.body > 0;
    const double push = time * (pressure[wall] - gradient[wall] * piece.height);
    scene::Vector impulse{-push * piece.area[0], -push * piece.area[1], -push * piece.area[2]};
    if (last && together[2 * entry + place] > 0) {
      const double share = size_of(piece) / together[2 * entry + place];
      const auto& other = fluid.wall_impulse[grid_wall[entry]][place];
      for (std::size_t d = 0; d < 3; ++d) impulse[d] += share * other[d];
    }
    give(static_cast<std::size_t>(piece.body), impulse, cut.lever[p]);
  }
}

void PrescribedBodies::give(std::size_t body, const scene::Vector& impulse, const scene::Vector& lever) {
  const scene::Vector moment = cross(lever, impulse);
  const auto& mirrored = bodies_[body].mirrored;
  for (std::size_t d = 0; d < 3; ++d) {
    // A mirror image doubles what lies in its plane; turning is the other way round.
    double along = 1, around = 1;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (!mirrored[axis]) continue;
      along *= axis == d ? 0 : 2;
      around *= axis == d ? 2 : 0;
    }
    given_[body].linear[d] += along * impulse[d];
    given_[body].angular[d] += around * moment[d];
  }
}

}  // namespace polynya::fluid
