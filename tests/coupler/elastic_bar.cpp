#include "elastic_bar.hpp"

#include <fstream>
#include <numeric>

#include "core/exchange/participant.hpp"

using namespace polynya;

ElasticBar::ElasticBar(const std::string& name, double low, double high, double width, int elements, double speed) {
  continuum::HexMesh mesh;
  const double half = 0.5 * width, stiffer = 0.01 * 0.01 / (width * width);
  const double corner[4][2] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  for (int k = 0; k <= elements; ++k)
    for (const auto& c : corner) {
      const double point[3] = {c[0], c[1], low + (high - low) * k / elements};
      mesh.nodes.insert(mesh.nodes.end(), point, point + 3);
    }
  for (int k = 0; k < elements; ++k)
    for (int n = 0; n < 8; ++n) mesh.elements.push_back(4 * k + n);
  const continuum::FaceNeighbours neighbours = continuum::face_neighbours(mesh);
  const std::vector<double> alive(static_cast<std::size_t>(elements), 1.0);
  const continuum::BoundarySurface boundary = continuum::boundary_surface(mesh, neighbours, alive, {});
  surface_nodes = boundary.nodes;
  triangles = boundary.triangles;
  const continuum::Law law = continuum::law_from_card(
      "steel", "elastic", {{"density", 7800 * stiffer}, {"youngs_modulus", 2e11 * stiffer}, {"poisson_ratio", 0.3}});
  solid = continuum::make_solid(name, std::move(mesh), law);
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    solid.fixed[n] = 1 | 2;  // uniaxial strain
    solid.velocities[3 * n + 2] = speed;
  }
}

std::vector<double> ElasticBar::gather(const std::vector<double>& nodal) const {
  std::vector<double> rows;
  for (const std::int32_t n : surface_nodes) rows.insert(rows.end(), &nodal[3 * n], &nodal[3 * n] + 3);
  return rows;
}

void ElasticBar::scatter(std::span<const std::int64_t> vertices, std::span<const double> forces,
                         std::vector<double>& nodal) const {
  nodal.assign(3 * solid.node_count(), 0.0);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (int d = 0; d < 3; ++d)
      nodal[3 * surface_nodes[static_cast<std::size_t>(vertices[i])] + d] += forces[3 * i + d];
}

exchange::Message ElasticBar::ready(const std::string& body) const {
  exchange::Message message("ready");
  message.header["role"] = "solid";
  message.header["body"] = body;
  message.header["stable_step"] = continuum::stable_step(solid);
  message.header["account"] = {"momentum_z", "mass"};
  const auto count = static_cast<std::int64_t>(surface_nodes.size());
  std::vector<std::int64_t> ids(surface_nodes.begin(), surface_nodes.end());
  std::vector<double> masses;
  for (const std::int32_t n : surface_nodes) masses.push_back(solid.masses[n]);
  const std::vector<double> zero(surface_nodes.size(), 0.0);
  const double mass = std::accumulate(solid.masses.begin(), solid.masses.end(), 0.0);
  const double account[] = {mass * solid.velocities[2], mass};
  message.add<double>("account", {2}, account);
  message.add<std::int64_t>("surface.ids", {count}, ids);
  message.add<double>("surface.masses", {count}, masses);
  message.add<double>("surface.radius", {count}, zero);
  message.add<double>("surface.volume", {count}, zero);
  message.add<std::int32_t>("surface.triangles", {static_cast<std::int64_t>(triangles.size() / 3), 3}, triangles);
  message.add<double>("positions", {count, 3}, gather(solid.positions));
  message.add<double>("velocities", {count, 3}, gather(solid.velocities));
  return message;
}

exchange::Message ElasticBar::surface(long window) const {
  exchange::Message message("surface");
  message.header["window"] = window;
  message.header["time"] = solid.time;
  message.header["stable_step"] = continuum::stable_step(solid);
  message.header["topology_changed"] = false;
  double momentum = 0, mass = 0;
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    momentum += solid.masses[n] * solid.velocities[3 * n + 2];
    mass += solid.masses[n];
  }
  const double account[] = {momentum, mass};
  const auto count = static_cast<std::int64_t>(surface_nodes.size());
  message.add<double>("account", {2}, account);
  message.add<double>("positions", {count, 3}, gather(solid.positions));
  message.add<double>("velocities", {count, 3}, gather(solid.velocities));
  return message;
}

void play_bar(ElasticBar bar, const std::string& body, const std::string& endpoint, const std::string& run,
              const std::string& name, const std::string& result_file) {
  exchange::Participant participant({.endpoint = endpoint, .run = run, .name = name, .timeout_seconds = 20});
  participant.send(bar.ready(body));
  double step = participant.receive("begin").header.at("step");
  std::vector<double> external;
  for (long window = 0;; ++window) {
    continuum::advance_positions(bar.solid, step);
    participant.send(bar.surface(window));
    continuum::internal_forces(bar.solid, step);
    const exchange::Message loads = participant.receive("loads");
    bar.scatter(loads.view<std::int64_t>("load.vertices"), loads.view<double>("load.forces"), external);
    const double next = loads.header.at("next_step");
    continuum::advance_velocities(bar.solid, external, step, next);
    step = next;
    if (loads.header.at("finish").get<bool>()) break;
  }
  participant.send(exchange::Message("finished"));
  participant.receive("bye");
  std::ofstream file(result_file, std::ios::binary);
  const auto write = [&](const std::vector<double>& values) {
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(double)));
  };
  write(bar.solid.positions);
  write(bar.solid.velocities);
}
