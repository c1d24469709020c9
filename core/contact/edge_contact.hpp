#pragma once
#include <vector>

#include "core/contact/body.hpp"
#include "core/contact/box_hash.hpp"
#include "core/contact/inheritance.hpp"
#include "core/contact/surface_topology.hpp"
#include "core/contact/touch.hpp"

namespace polynya::contact {

/// Contact of convex edges of two surfaces that cross each other between their vertices, where no vertex is inside the
/// other body. At least one of the two turns by more than 30 degrees. A pair is born when the edges pass through each
/// other in a step, both moving straight, with a common normal that lies between the normals of both edges' faces,
/// and the end of either that is nearer to the crossing is not in contact itself: what vertices hold is left to them.
/// It holds until they separate, goes over to the next edge at a vertex, and fades beyond the end of an edge as a point
/// does beyond a rim (faded_depth). Edges that are nearly parallel, or cross each other when first seen, are left to
/// the vertices too.
class EdgeContact {
 public:
  /// Keeps the pairs whose vertices go on to exist. Appends the forces of the others.
  void set_topology(const Body& primary, const Body& secondary, const SurfaceTopology& first,
                    const SurfaceTopology& second, std::vector<LostForce>& lost);
  /// Candidates within reach (m) as of now.
  void search(const Body& primary, const Body& secondary, const SurfaceTopology& first, const SurfaceTopology& second,
              double reach);
  /// Appends to the contacts of points, which are there already.
  void find(const Body& primary, const Body& secondary, const SurfaceTopology& first, const SurfaceTopology& second,
            double dt, std::vector<Touch>& touches);
  double take_dropped_energy();

  void list_state(compute::StateArchive& archive) {
    if (archive.loading()) start_.clear();
    list_members(archive);
  }

 private:
  POLYNYA_STATE_MEMBERS_WITHOUT((next_, hash_, boxes_), held_, next_, touched_first_, touched_second_, dropped_energy_,
                                names_first_, names_second_, start_, list_, at_vertex_start_first_, at_vertex_first_,
                                at_vertex_start_second_, at_vertex_second_, hash_, boxes_)
  struct Pair {
    std::int32_t first = 0, second = 0;  ///< edges of the primary and of the secondary surface
    PairState state;
    std::uint64_t order() const { return static_cast<std::uint64_t>(second) << 32 | static_cast<std::uint32_t>(first); }
  };
  struct Names {  // vertex ids of an edge
    std::int64_t a = 0, b = 0;
  };
  /// Follows a pair; false if it ended, with its depth (infinity: edges became parallel) in the touch.
  bool hold(const Body& primary, const Body& secondary, const SurfaceTopology& first, const SurfaceTopology& second,
            Pair& pair, Touch& touch) const;

  void mark_vertices_in_contact(const Body& primary, const Body& secondary, std::span<const Touch> touches);

  std::vector<Pair> held_, next_;
  std::vector<std::uint8_t> touched_first_, touched_second_;
  double dropped_energy_ = 0;
  std::vector<Names> names_first_, names_second_;
  std::vector<std::int32_t> start_{0}, list_, at_vertex_start_first_, at_vertex_first_, at_vertex_start_second_,
      at_vertex_second_;
  BoxHash hash_;
  std::vector<Box> boxes_;
};

}  // namespace polynya::contact
