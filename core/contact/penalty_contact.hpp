#pragma once
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/contact/surface_normals.hpp"
#include "core/contact/triangle_grid.hpp"

namespace polynya::contact {

/// The surface that others may not enter, at one time. Arrays by vertex; triangles outward oriented.
struct PrimarySurface {
  std::span<const double> positions;   ///< [nv][3] m
  std::span<const double> velocities;  ///< [nv][3] m/s
  std::span<const double> masses;      ///< [nv] kg
  std::span<const std::int32_t> triangles;  ///< [nt][3]
};

/// Points that may not enter it: nodes (radius 0) and particles.
struct SecondaryPoints {
  std::span<const double> positions, velocities;  ///< [ns][3]
  std::span<const double> masses;                 ///< [ns] kg
  std::span<const double> radii;                  ///< [ns] m
  std::span<const std::int64_t> ids;              ///< [ns] identity that survives renumbering
};

struct PenaltyLaw {
  double friction = 0;           ///< Coulomb coefficient
  double stiffness_factor = 0.1; ///< of (reduced mass) / dt^2, the bound that keeps a force held over the window stable
  double depth_limit = 0;        ///< m, how deep below the surface a point is still found
  std::array<bool, 2> mirror{};  ///< symmetry planes x = 0, y = 0 of the primary surface
};

struct ContactForces {
  std::vector<double> primary;    ///< [nv][3] N
  std::vector<double> secondary;  ///< [ns][3] N
  double stored_energy = 0;       ///< J, sum of k depth^2 / 2
  double friction_power = 0;      ///< W, rate at which friction dissipates
  double released_energy = 0;     ///< J, given up when a pair's stiffness had to fall with the window
  std::size_t active = 0;         ///< points in contact
  double deepest = 0;             ///< m
};

/// Penalty contact of points against a surface: F = k depth along the surface's normal, Coulomb friction limited by
/// what stops the sliding within a few steps. Forces on the two sides cancel to rounding. A pair keeps the stiffness it
/// was born with unless a longer window forces it down.
class PenaltyContact {
 public:
  explicit PenaltyContact(PenaltyLaw law) : law_(law) {}

  /// Call when the triangles of the primary surface changed.
  void set_topology(std::span<const std::int32_t> triangles, std::size_t vertices);

  /// Forces for the configuration given, held over a step dt (s).
  const ContactForces& evaluate(const PrimarySurface& primary, const SecondaryPoints& secondary, double dt);

 private:
  struct Touch {
    std::size_t point = 0, triangle = 0;
    Vector3 weights{}, normal{};
    double depth = 0;
  };
  void collect_candidates(const PrimarySurface& primary, const SecondaryPoints& secondary);
  bool find_touch(const PrimarySurface& primary, const SecondaryPoints& secondary, std::size_t point,
                  Touch& touch) const;
  void apply(const PrimarySurface& primary, const SecondaryPoints& secondary, const Touch& touch, double dt);

  PenaltyLaw law_;
  SurfaceNormals normals_;
  TriangleGrid grid_;
  std::vector<std::size_t> candidates_;
  std::vector<Touch> touches_;
  std::vector<char> touched_;
  std::unordered_map<std::int64_t, double> stiffness_, stiffness_before_;
  ContactForces forces_;
};

}  // namespace polynya::contact
