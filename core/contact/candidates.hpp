#pragma once
#include <span>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/contact/body.hpp"
#include "core/contact/box_hash.hpp"
#include "core/contact/surface_topology.hpp"

namespace polynya::contact {

/// Which triangles a point of the same body must not meet: those around itself (its own and those that share a vertex
/// with them), and those whose origin is nearer to the point's own than the sum of both reaches. Origins are places in
/// the reference configuration; leave them empty to have only the first rule.
struct Exclusion {
  bool neighbours = false;
  std::span<const double> point_origins{};     ///< [nv][3] m
  std::span<const double> point_reaches{};     ///< [nv] m
  std::span<const double> triangle_origins{};  ///< [nt][3] m
  std::span<const double> triangle_reaches{};  ///< [nt] m

  bool any() const { return neighbours || !point_origins.empty(); }
  bool excludes(const Body& surface, const SurfaceTopology& topology, std::size_t point, std::size_t triangle) const;
};

/// For each point near a surface the triangles within a reach of it, ascending. Buffers are kept between builds.
class Candidates {
 public:
  /// Triangles within radius + reach (m) of each point; reach as of now.
  void build(const Body& points, const Body& surface, const SurfaceTopology& topology, const Exclusion& exclusion,
             double reach);

  std::span<const std::int32_t> near_points() const { return near_; }  ///< those that have candidates, ascending
  /// Candidates of the k-th near point.
  std::span<const std::int32_t> of(std::size_t k) const {
    const auto begin = static_cast<std::size_t>(start_[k]);
    return std::span(list_).subspan(begin, static_cast<std::size_t>(start_[k + 1]) - begin);
  }

  void list_state(compute::StateArchive& archive) {
    if (archive.loading()) start_.clear();
    list_members(archive);
  }

 private:
  POLYNYA_STATE_MEMBERS_WITHOUT((hash_, boxes_, found_), hash_, boxes_, found_, near_, start_, list_)

  struct Found {
    std::vector<std::int32_t> points, counts, triangles;
  };
  void search(const Body& points, const Body& surface, const SurfaceTopology& topology, const Exclusion& exclusion,
              double reach, const Box& region, std::size_t begin, std::size_t end, Found& found) const;

  BoxHash hash_;
  std::vector<Box> boxes_;
  std::vector<Found> found_;
  std::vector<std::int32_t> near_, start_{0}, list_;
};

}  // namespace polynya::contact
