#include "structure_solver/conversation.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <thread>

#include "core/exchange/hub.hpp"
#include "tests/structure_solver/test_scene.hpp"

namespace polynya::structure {
namespace {

using exchange::Message;

/// A folder of its own, removed at the end.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("polynya_structure_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_ / "logs");
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// The solver's side of a run, in a thread; the test plays the coupler.
class Solver {
 public:
  Solver(const Folder& folder, bool deformable)
      : hub("ipc://" + (folder / "socket"), "run", {"structure"}), thread_([this, &folder, deformable] {
          scene::Scene scene = vehicle_scene();
          scene.vehicle->deformable = deformable;
          BuiltVehicle vehicle = build_vehicle(scene);
          Output output(folder.path(), "structure", 1e-4, vehicle);
          exchange::Participant coupler({"ipc://" + (folder / "socket"), "run", "structure"});
          try {
            run_coupled(vehicle, scene.run.step_factor, coupler, output);
          } catch (const std::exception& error) {
            failure = error.what();
          }
          output.close(coupler.waits().intervals());
        }) {
    hub.await_participants(20);
  }
  void join() { thread_.join(); }

  exchange::Hub hub;
  std::string failure;

 private:
  std::thread thread_;
};

double entry(const Message& message, const std::vector<std::string>& names, const std::string& name) {
  const auto values = message.view<double>("account");
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return values[i];
  ADD_FAILURE() << "no account " << name;
  return 0;
}

TEST(StructureConversation, WindowsFollowTheProtocolAndMomentumIsTheImpulse) {
  for (const bool deformable : {true, false}) {
    const Folder folder;
    Solver solver(folder, deformable);
    const Message ready = solver.hub.receive("structure", "ready");
    EXPECT_EQ(ready.header.at("role"), "solid");
    EXPECT_EQ(ready.header.at("body"), "vehicle");
    const auto names = ready.header.at("account").get<std::vector<std::string>>();
    const std::size_t vertices = ready.view<std::int64_t>("surface.ids").size();
    EXPECT_EQ(ready.view<double>("positions").size(), 3 * vertices);
    EXPECT_EQ(ready.view<double>("surface.masses").size(), vertices);
    double dt = 4e-8, impulse = 0, time = 0;
    const double start = entry(ready, names, "momentum_z");
    Message begin("begin");
    begin.header["time"] = 0.0;
    begin.header["step"] = dt;
    begin.add("load.vertices", {0}, std::vector<std::int64_t>{});
    begin.add("load.forces", {0, 3}, std::vector<double>{});
    solver.hub.send("structure", begin);
    std::vector<double> before(ready.view<double>("positions").begin(), ready.view<double>("positions").end());
    constexpr long windows = 200;
    for (long window = 0; window < windows; ++window) {
      const Message surface = solver.hub.receive("structure", "surface");
      time += dt;
      EXPECT_EQ(surface.header.at("window"), window);
      EXPECT_DOUBLE_EQ(surface.header.at("time").get<double>(), time);
      const auto positions = surface.view<double>("positions");
      const auto velocities = surface.view<double>("velocities");
      for (std::size_t i = 0; i < positions.size(); ++i)
        ASSERT_NEAR(positions[i], before[i] + dt * velocities[i], 1e-16);
      before.assign(positions.begin(), positions.end());
      EXPECT_NEAR(entry(surface, names, "momentum_z") - start, impulse, 1e-11 * std::abs(start));
      const double next = dt * (window % 3 == 1 ? 1.05 : 1.0), force = -50;
      const std::int64_t vertex[] = {0, 5};
      const double forces[] = {0, 0, 0.5 * force, 0, 0, 0.5 * force};
      Message loads("loads");
      loads.header["window"] = window;
      loads.header["next_step"] = window % 3 == 1 ? next : (window % 3 == 2 ? dt / 1.05 : dt);
      loads.header["finish"] = window == windows - 1;
      loads.header["frame"] = window == 100 ? 0 : -1;
      loads.add<std::int64_t>("load.vertices", {2}, vertex);
      loads.add<double>("load.forces", {2, 3}, forces);
      impulse += 0.5 * (dt + loads.header["next_step"].get<double>()) * force;
      dt = loads.header["next_step"];
      solver.hub.send("structure", loads);
    }
    const Message finished = solver.hub.receive("structure", "finished");
    solver.hub.send("structure", Message("bye"));
    solver.join();
    EXPECT_EQ(solver.failure, "");
    EXPECT_EQ(finished.header.at("steps"), windows);
    EXPECT_NEAR(finished.header.at("account").at("momentum_z").get<double>() - start, impulse, 1e-11 * std::abs(start));
    EXPECT_LT(std::abs(finished.header.at("energy_error").get<double>()), 1e-12);
    if (deformable) {
      EXPECT_GT(finished.header.at("peak_head_stress").get<double>(), 1e6);
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "fields/vehicle_0000.vtkhdf"));
    EXPECT_TRUE(std::filesystem::exists(folder / "series/structure.csv"));
    EXPECT_TRUE(std::filesystem::exists(folder / "logs/structure.json"));
  }
}

/// A few windows under load, so that the vehicle rings, then a time without loads: one free window, or windows of the
/// given lengths. Returns the last `surface`.
Message after_a_quiet_time(bool deformable, const std::vector<double>& quiet, bool free) {
  const Folder folder;
  Solver solver(folder, deformable);
  const Message ready = solver.hub.receive("structure", "ready");
  EXPECT_TRUE(ready.header.at("can_subdivide").get<bool>());
  constexpr double dt = 4e-8;
  Message begin("begin");
  begin.header.update({{"time", 0.0}, {"step", dt}});
  begin.add("load.vertices", {0}, std::vector<std::int64_t>{});
  begin.add("load.forces", {0, 3}, std::vector<double>{});
  solver.hub.send("structure", begin);
  constexpr long loaded = 50;
  const long windows = loaded + static_cast<long>(quiet.size());
  Message surface;
  for (long window = 0; window <= windows; ++window) {
    surface = solver.hub.receive("structure", "surface");
    const bool finish = window == windows;
    Message loads("loads");
    loads.header.update({{"window", window}, {"finish", finish}, {"frame", -1}});
    loads.header["next_step"] = window < loaded || finish ? dt : quiet[static_cast<std::size_t>(window - loaded)];
    if (free && window == loaded) loads.header["free"] = true;
    const std::int64_t vertex[] = {0};
    const double forces[] = {0, 0, window < loaded ? -50.0 : 0.0};
    loads.add<std::int64_t>("load.vertices", {1}, vertex);
    loads.add<double>("load.forces", {1, 3}, forces);
    solver.hub.send("structure", loads);
  }
  const Message finished = solver.hub.receive("structure", "finished");
  EXPECT_LT(std::abs(finished.header.at("energy_error").get<double>()), 1e-12);
  solver.hub.send("structure", Message("bye"));
  solver.join();
  return surface;
}

TEST(StructureConversation, FreeWindowIsTheSameAsWindowsOfItsOwnStepsWithoutLoads) {
  double stable = 0;
  {
    scene::Scene scene = vehicle_scene();
    stable = build_vehicle(scene).body->stable_step();
  }
  // 21 steps as long as the stable step of the ringing body is within 4.6 % of that at rest.
  const double length = 20.02 * 0.9 * stable;
  const Message free = after_a_quiet_time(true, {length}, true);
  const Message bound = after_a_quiet_time(true, std::vector<double>(21, length / 21), false);
  EXPECT_EQ(free.header.at("window"), 51);
  for (const char* name : {"positions", "velocities", "account"}) {
    const auto a = free.view<double>(name), b = bound.view<double>(name);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i], b[i], 1e-9 * std::abs(b[i]) + 1e-13) << name << ' ' << i;
  }
  EXPECT_NEAR(free.header.at("time").get<double>(), bound.header.at("time").get<double>(), 1e-15);
}

TEST(StructureConversation, StopEndsTheRunWithItsReason) {
  const Folder folder;
  Solver solver(folder, true);
  solver.hub.receive("structure", "ready");
  solver.hub.stop_all("the test says so");
  solver.join();
  EXPECT_NE(solver.failure.find("the test says so"), std::string::npos);
}

TEST(StructureConversation, LoadsOnVerticesThatAreNotThereAreRefused) {
  const Folder folder;
  Solver solver(folder, false);
  solver.hub.receive("structure", "ready");
  Message begin("begin");
  begin.header["time"] = 0.0;
  begin.header["step"] = 1e-7;
  begin.add("load.vertices", {0}, std::vector<std::int64_t>{});
  begin.add("load.forces", {0, 3}, std::vector<double>{});
  solver.hub.send("structure", begin);
  solver.hub.receive("structure", "surface");
  Message loads("loads");
  loads.header.update({{"window", 0}, {"next_step", 1e-7}, {"finish", false}, {"frame", -1}});
  const std::int64_t vertex[] = {1000000};
  const double forces[] = {0, 0, 1};
  loads.add<std::int64_t>("load.vertices", {1}, vertex);
  loads.add<double>("load.forces", {1, 3}, forces);
  solver.hub.send("structure", loads);
  solver.join();
  EXPECT_NE(solver.failure.find("load.vertices"), std::string::npos) << solver.failure;
}

}  // namespace
}  // namespace polynya::structure
