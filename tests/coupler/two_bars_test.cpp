#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/contact/penalty_contact.hpp"
#include "core/scene/scene.hpp"
#include "coupler/coupled_run.hpp"
#include "coupler/time_keeper.hpp"
#include "elastic_bar.hpp"

using namespace polynya;

namespace {

constexpr double speed = 10;  // m/s

// The target is narrower: nodes exactly above the striker's rim would be as near to its sides as to its end.
ElasticBar striker() {
  return {"striker", -0.1, 0, 0.01, 40, speed};
}
ElasticBar target() {
  return {"target", 1e-6, 0.100001, 0.008, 40, 0};
}

scene::Scene two_bar_scene() {
  scene::Scene scene;
  scene.run.end = "time";
  scene.run.end_time = 60e-6;
  scene.run.frame_interval = 1e-3;
  scene.run.step_factor = 0.8;
  scene.resolution.ice_element = 0.0025;
  scene.contact.stiffness_factor = 0.1;
  scene.effects["friction"] = {};
  scene.vehicle.emplace();
  scene.vehicle->length = 0.1;
  scene.ice.emplace();
  return scene;
}

/// The same collision in one process, without exchange and coupler.
std::pair<ElasticBar, ElasticBar> one_process(const scene::Scene& scene) {
  ElasticBar a = striker(), b = target();
  const auto masses = [](const ElasticBar& bar) {
    std::vector<double> rows;
    for (const std::int32_t n : bar.surface_nodes) rows.push_back(bar.solid.masses[n]);
    return rows;
  };
  const std::vector<double> mass_a = masses(a), mass_b = masses(b), radii(b.surface_nodes.size(), 0.0);
  const std::vector<std::int64_t> ids(b.surface_nodes.begin(), b.surface_nodes.end());
  contact::PenaltyContact contact(
      {.stiffness_factor = 0.1, .depth_limit = 0.5 * 0.0025, .skin = 0.25 * 0.0025, .edges = true});
  const std::vector<double> radii_a(mass_a.size(), 0.0);
  const std::vector<std::int64_t> ids_a(a.surface_nodes.begin(), a.surface_nodes.end());
  coupler::StepLimits limits{.solid_stable = 0,
                             .solid_factor = scene.run.step_factor,
                             .fluid_stable = 0,
                             .fluid_factor = 1,
                             .lag_limit = 0,
                             .longest_span = scene.run.frame_interval / 100};
  const auto refresh = [&] {
    limits.solid_stable = std::min(continuum::stable_step(a.solid), continuum::stable_step(b.solid));
  };
  refresh();
  coupler::SpanPlan plan = coupler::plan_span(limits);
  double step = plan.step, time = 0;
  bool finished = false;
  std::vector<std::int64_t> all_a(mass_a.size()), all_b(mass_b.size());
  std::iota(all_a.begin(), all_a.end(), 0);
  std::iota(all_b.begin(), all_b.end(), 0);
  std::vector<double> external;
  long left = plan.windows;
  while (!finished) {
    continuum::advance_positions(a.solid, step);
    continuum::advance_positions(b.solid, step);
    refresh();
    time += step;
    const auto xa = a.gather(a.solid.positions), va = a.gather(a.solid.velocities);
    const auto xb = b.gather(b.solid.positions), vb = b.gather(b.solid.velocities);
    const contact::Body body_a{xa, va, mass_a, radii_a, ids_a, a.triangles},
        body_b{xb, vb, mass_b, radii, ids, b.triangles};
    if (time == step) contact.set_topology(body_a, body_b);
    const contact::ContactForces& forces = contact.evaluate(body_a, body_b, step);
    if (--left == 0) {
      finished = time >= scene.run.end_time - 5e-10;
      plan = coupler::plan_span(limits);
      left = plan.windows;
    }
    const double next = coupler::next_step(limits, plan.step, step);
    continuum::internal_forces(a.solid, step);
    continuum::internal_forces(b.solid, step);
    a.scatter(all_a, forces.primary, external);
    continuum::advance_velocities(a.solid, external, step, next);
    b.scatter(all_b, forces.secondary, external);
    continuum::advance_velocities(b.solid, external, step, next);
    step = next;
  }
  return {std::move(a), std::move(b)};
}

std::vector<double> read_result(const std::string& file, std::size_t count) {
  std::vector<double> values(count);
  std::ifstream(file, std::ios::binary)
      .read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(double)));
  return values;
}

pid_t start(const ElasticBar& bar, const std::string& body, const std::string& endpoint, const std::string& name,
            const std::string& file) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      play_bar(bar, body, endpoint, "two-bars", name, file);
      _exit(0);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
      _exit(1);
    }
  }
  return child;
}

/// Columns of the last row of a CSV file, by name without unit.
std::map<std::string, double> last_row(const std::string& path) {
  std::ifstream file(path);
  std::string header, line, last;
  std::getline(file, header);
  while (std::getline(file, line)) last = line;
  std::map<std::string, double> row;
  std::istringstream names(header), values(last);
  std::string name, value;
  while (std::getline(names, name, ',') && std::getline(values, value, ','))
    row[name.substr(0, name.find(' '))] = std::stod(value);
  return row;
}

}  // namespace

TEST(TwoBars, InTwoProcessesMoveAsInOne) {
  const scene::Scene scene = two_bar_scene();
  char pattern[] = "/tmp/polynya-two-bars-XXXXXX";
  const std::string folder = mkdtemp(pattern);
  const std::string endpoint = "ipc://" + folder + "/coupler";
  const pid_t first = start(striker(), "vehicle", endpoint, "structure", folder + "/a");
  const pid_t second = start(target(), "ice", endpoint, "ice", folder + "/b");
  coupler::run_coupled(scene, folder, endpoint, "two-bars", 20);
  for (const pid_t child : {first, second}) {
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }

  const auto [a, b] = one_process(scene);
  const auto check = [&](const ElasticBar& bar, const std::string& file) {
    const std::size_t n = bar.solid.positions.size();
    const std::vector<double> result = read_result(folder + file, 2 * n);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(result[i], bar.solid.positions[i], 1e-15);
      EXPECT_NEAR(result[n + i], bar.solid.velocities[i], 1e-12 * speed);
    }
  };
  check(a, "/a");
  check(b, "/b");

  // Equal bars exchange their velocities: after 2 L / c the striker rests and the target moves at its speed.
  double momentum_a = 0, momentum_b = 0, mass = 0;
  for (std::size_t n = 0; n < a.solid.node_count(); ++n) {
    momentum_a += a.solid.masses[n] * a.solid.velocities[3 * n + 2];
    momentum_b += b.solid.masses[n] * b.solid.velocities[3 * n + 2];
    mass += a.solid.masses[n];
  }
  EXPECT_NEAR(momentum_a / mass, 0, 0.03 * speed);
  EXPECT_NEAR(momentum_b / mass, speed, 0.03 * speed);

  // The ledger: equal and opposite, and equal to the momentum that changed hands.
  const auto ledger = last_row(folder + "/series/ledger.csv");
  const double given = ledger.at("contact_impulse_ice_z");
  EXPECT_NEAR(ledger.at("contact_impulse_vehicle_z"), -given, 1e-12 * given);
  EXPECT_NEAR(given, momentum_b, 1e-9 * mass * speed);
  EXPECT_FALSE(std::filesystem::exists(folder + "/coupler"));
  std::filesystem::remove_all(folder);
}
