#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "coupler/account.hpp"

namespace polynya::coupler {

enum class Body { vehicle = 0, ice = 1 };
inline constexpr int body_count = 2;

/// What the coupler knows of a solid participant: its surface now, the loads it was given last, its account.
/// Vertices are surface nodes followed by particles; arrays [nv] or [nv][3].
struct SolidSide {
  std::string name;  ///< participant name: "structure", "ice"
  Body body = Body::vehicle;
  double stable_step = 0;      ///< s
  bool can_subdivide = false;  ///< may take steps of its own within a free window
  bool can_checkpoint = false;
  double ready_time = 0;  ///< s, that of `ready`: above 0 where it goes on from a checkpoint
  int new_threads = 0;    ///< number of threads to suggest with the next loads; 0: nothing new
  Account account;

  std::vector<std::int64_t> ids;
  std::vector<double> masses, radii, volumes;  ///< kg, m, m^3
  std::vector<double> rigid_masses;            ///< kg, of a body that moves as one: its resistance at a vertex; else empty
  std::vector<std::int32_t> triangles;         ///< [nt][3], outward oriented
  std::vector<double> positions;               ///< m, at the end of the window
  std::vector<double> velocities;              ///< m/s, in the middle of the window
  bool topology_changed = false;

  std::vector<double> contact_force;   ///< N, of this window
  std::vector<double> fluid_force;     ///< N, of this window
  std::vector<double> fluid_impulse;   ///< N s, given by the fluid and not yet handed on
  std::vector<double> start_force;     ///< N, of the fluid at time 0; empty once the fluid's answers have come
  std::vector<double> expected_force;  ///< N, forecast of the fluid for the next span
  std::vector<double> span_force;      ///< N, what the fluid's load of this span starts from
  std::vector<double> impedance;       ///< [nv][6] kg/s: xx, yy, zz, xy, yz, zx; resistance of the fluid to a vertex
  std::vector<double> kept_share;      ///< [nv][6]: share of its last window's force that a vertex keeps
  std::vector<double> seen_velocity;   ///< m/s, mean over the span that the fluid answered last
  std::vector<double> velocity_sum;    ///< m, integral of the velocity over the current span so far
  double sum_time = 0;                 ///< s, of that integral

  /// Mean velocity over the current span so far, [nv][3] m/s.
  std::vector<double> mean_velocity() const;
  void add_to_mean(double step);
  void restart_mean();

  std::size_t vertices() const { return ids.size(); }

  POLYNYA_STATE_WITHOUT((ready_time), name, body, stable_step, can_subdivide, can_checkpoint, ready_time, new_threads,
                        account, ids, masses, radii, volumes, rigid_masses, triangles, positions, velocities, topology_changed,
                        contact_force, fluid_force, fluid_impulse, start_force, expected_force, span_force, impedance,
                        kept_share, seen_velocity, velocity_sum, sum_time)
};

void read_ready(SolidSide& side, const exchange::Message& ready);

/// Adds impulses ([n][3], N s) of the vertices `ids`, which were at `positions` ([n][3], m), to the side's outstanding
/// fluid impulses. The impulse of a vertex that vanished goes to the nearest vertex there is: none is lost.
void add_fluid_impulses(SolidSide& side, std::span<const std::int64_t> ids, std::span<const double> positions,
                        std::span<const double> impulses);

/// Takes over the surface of a new window; what is known of the fluid at a vertex follows it by its id.
void read_surface(SolidSide& side, const exchange::Message& surface);

/// Adds the loads of this window: contact plus fluid forces of all vertices where they are not zero.
void add_loads(exchange::Message& message, const SolidSide& side);

}  // namespace polynya::coupler
