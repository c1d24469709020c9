#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/clip.hpp"
#include "geometry/cut_cells.hpp"

namespace polynya::geometry {

/// Edges of a surface that have not as many triangles on one side as on the other. Internal to the room.
std::vector<std::array<std::int32_t, 2>> open_edges(std::span<const std::int32_t> triangles, std::size_t vertices);

/// The vertices of one body with their slabs of the grid: every coincidence with a plane is decided here, once per
/// vertex, so that all triangles agree about it. Internal to the room.
class PlacedSurface {
 public:
  /// Throws GeometryError on bad indices or positions that are not finite.
  void place(const BodySurface& surface, const std::array<LineLocator, 3>& lines);

  const std::vector<Corner>& corners() const { return corners_; }
  /// True if the triangles [begin, end) lie where they lay when the surface was placed before, among the same planes.
  bool unmoved(std::size_t begin, std::size_t end) const;
  /// Other planes or another way to cut follow: nothing counts as unmoved at the next place.
  void forget() { known_ = false; }
  std::int64_t loose_edges() const { return loose_edges_; }
  /// Largest coordinate of the vertices and the grid, m: what rounding is measured with.
  double reach(const std::array<LineLocator, 3>& lines) const;

 private:
  struct Coincidence {
    std::int32_t vertex, axis, plane;
  };
  bool update_topology(const BodySurface& surface);  ///< true if it is another one
  void find_moved(const std::vector<Corner>& before);
  void place_vertices(const BodySurface& surface, const std::array<LineLocator, 3>& lines);
  void settle_coincidences(const std::array<LineLocator, 3>& lines);
  void attach_facing_sides(const std::array<LineLocator, 3>& lines);
  void attach_open_edges(const std::array<LineLocator, 3>& lines);

  std::vector<Corner> corners_;
  std::vector<std::int32_t> triangles_;  ///< copy: the topology below belongs to it
  std::size_t vertices_ = 0;
  std::vector<std::array<std::int32_t, 2>> open_edges_;
  std::vector<std::vector<Coincidence>> coincidences_;  ///< per chunk of vertices
  std::vector<Coincidence> facing_;  ///< vertices of sides that rest on a wall; plane: 0 the first, 1 the last
  std::vector<std::array<double, 3>> normals_;  ///< [vertices], scratch, of those that coincide with a plane
  std::vector<std::uint8_t> coincides_;          ///< [vertices], scratch
  std::int64_t loose_edges_ = 0;
  std::vector<Corner> before_;       ///< scratch: corners of the place before
  std::vector<std::uint8_t> moved_;  ///< [vertices], 1 if not where it was
  bool known_ = false;               ///< corners_ are of a surface with these triangles among these planes
};

}  // namespace polynya::geometry
