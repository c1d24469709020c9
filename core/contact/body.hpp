#pragma once
#include <cstdint>
#include <span>

namespace polynya::contact {

/// A body at one time: vertices of its outward oriented triangles, and loose particles that no triangle refers to.
struct Body {
  std::span<const double> positions;        ///< [nv][3] m
  std::span<const double> velocities;       ///< [nv][3] m/s, with which the positions were reached in the last step
  std::span<const double> masses;           ///< [nv] kg; `rigid`: with which the whole resists a force at the vertex
  std::span<const double> radii;            ///< [nv] m, 0 for a bare node
  std::span<const std::int64_t> ids;        ///< [nv] identity that survives renumbering
  std::span<const std::int32_t> triangles;  ///< [nt][3]
  bool rigid = false;                       ///< all vertices move as one body

  std::size_t vertex_count() const { return masses.size(); }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

}  // namespace polynya::contact
