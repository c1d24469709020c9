#pragma once
#include <unordered_map>
#include <vector>

#include "core/contact/candidates.hpp"
#include "core/contact/depth.hpp"
#include "core/contact/inheritance.hpp"
#include "core/contact/touch.hpp"

namespace polynya::contact {

/// Contact of the vertices of one body (nodes with radius 0, particles) with the triangles of a surface.
///
/// A free point comes into contact when it passes through a triangle during a step (both moving straight), or from
/// outside within its radius. From then on the patch it came through holds it: its depth is that of the nearest foot on
/// this patch, however near other sides of the body are, until the depth is 0. So it passes neither through a thin body
/// nor out at a side when it was pressed down near a rim.
///
/// A point that is inside without having come through (at the start, when it is new, or when the surface behind it
/// is) exerts no force at first: that depth becomes its offset, which shrinks as the point moves out. It is found to
/// depth_limit. The same holds for depth that comes without motion, when surface beside a point is uncovered.
class PointContact {
 public:
  struct Settings {
    double depth_limit = 0;  ///< m
    std::array<bool, 2> mirror{};
    bool swapped = false;  ///< the points are the primary body's
  };
  explicit PointContact(Settings settings) : settings_(settings) {}

  /// Points or surface are others than before; pairs whose point and triangle go on to exist are kept. Appends the
  /// forces of the others.
  void set_topology(const Body& points, const Body& surface, std::vector<LostForce>& lost);

  void search(const Body& points, const Body& surface, const SurfaceTopology& topology, const Exclusion& exclusion,
              double reach) {
    candidates_.build(points, surface, topology, exclusion, reach);
  }

  /// Appends the contacts of this time, in the order of the points. share(i): see Touch.
  void find(const Body& points, const Body& surface, const SurfaceTopology& topology, const Exclusion& exclusion,
            double dt, double share, std::vector<Touch>& touches);

  /// Energy that springs of pairs held when they ended, J, since the last call.
  double take_dropped_energy();

  POLYNYA_STATE_WITHOUT((active_, candidate_of_, found_, touched_), settings_, candidates_, states_, fresh_, ids_,
                        triangle_ids_, held_, active_, candidate_of_, found_, touched_, dropped_energy_)

 private:
  bool find_one(const Body& points, const Body& surface, const SurfaceTopology& topology, const Exclusion& exclusion,
                double dt, std::size_t point, std::span<const std::int32_t> candidates, Touch& touch);
  bool hold(const Body& points, const Body& surface, const SurfaceTopology& topology, const Exclusion& exclusion,
            double dt, std::size_t point, Touch& touch);
  void begin(std::size_t triangle, std::size_t point, bool inside, bool accepted);
  /// For each triangle of the old surface its number in the new one, -1 if it vanished.
  std::vector<std::int32_t> renumber_triangles(const Body& surface);
  bool follow(PairState& state, std::span<const std::int32_t> renumbered);

  Settings settings_;
  Candidates candidates_;
  std::vector<PairState> states_;
  std::vector<std::uint8_t> fresh_;  // [point] seen for the first time
  std::vector<std::int64_t> ids_;
  std::vector<std::int64_t> triangle_ids_;
  std::vector<std::int32_t> held_, active_, candidate_of_;
  std::vector<Touch> found_;
  std::vector<std::uint8_t> touched_;
  double dropped_energy_ = 0;
};

}  // namespace polynya::contact
