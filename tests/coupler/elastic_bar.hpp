#pragma once
#include <string>

#include "core/continuum/explicit_solid.hpp"
#include "core/exchange/message.hpp"

/// A straight elastic bar along z of square section, moving along z only: the smallest honest solid participant.
/// All bars have the wave speed of steel and the impedance (density x wave speed x area) of a 10 mm steel bar, whatever
/// their width, so that any two of them exchange their velocities when they collide.
struct ElasticBar {
  polynya::continuum::ExplicitSolid solid;
  std::vector<std::int32_t> surface_nodes, triangles;

  /// `elements` along z from `low` to `high` (m), square of this `width` (m), moving at `speed` (m/s).
  ElasticBar(const std::string& name, double low, double high, double width, int elements, double speed);

  std::vector<double> gather(const std::vector<double>& nodal) const;  ///< rows of the surface nodes
  void scatter(std::span<const std::int64_t> vertices, std::span<const double> forces,
               std::vector<double>& nodal) const;

  polynya::exchange::Message ready(const std::string& body) const;
  polynya::exchange::Message surface(long window) const;
};

/// Plays a bar as a participant of a coupled run and writes its final positions and velocities to a file.
void play_bar(ElasticBar bar, const std::string& body, const std::string& endpoint, const std::string& run,
              const std::string& name, const std::string& result_file);
