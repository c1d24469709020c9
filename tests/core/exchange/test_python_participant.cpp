#include <fcntl.h>

#include "core/exchange/hub.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

/// Starts examples/tetrahedron_solid.py with the interpreter that has pyzmq and numpy.
int play_python(const std::string& endpoint, const std::string& run) {
  // Python looks for its packages from argv[0]: a bare name would lead it to another python that is first on PATH.
  const int quiet = open("/dev/null", O_WRONLY);
  dup2(quiet, STDERR_FILENO);
  execl("/usr/bin/python3", "/usr/bin/python3", POLYNYA_SOURCE_DIR "/examples/tetrahedron_solid.py", "--scene", "none",
        "--out", "none", "--connect", endpoint.c_str(), "--run", run.c_str(), "--name", "vehicle", nullptr);
  return 127;
}

/// A message `loads` that pushes vertex 0 with (1, 2, 3) N, or nothing.
Message loads(int window, double step, bool push, bool finish) {
  Message message("loads");
  message.header["window"] = window;
  message.header["next_step"] = step;
  message.header["finish"] = finish;
  message.header["frame"] = -1;
  const std::vector<std::int64_t> vertices(push ? 1 : 0, 0);
  const std::vector<double> forces = push ? std::vector<double>{1, 2, 3} : std::vector<double>{};
  message.add<std::int64_t>("load.vertices", {push}, vertices);
  message.add<double>("load.forces", {push, 3}, forces);
  return message;
}

TEST(PythonExample, FollowsCentralDifferencesUnderConstantLoad) {
  const SocketFolder folder;
  Process python([&] { return play_python(folder.endpoint(), "r"); });
  Hub hub(folder.endpoint(), "r", {"vehicle"});
  hub.await_participants(60);

  const Message ready = hub.receive("vehicle", "ready");
  EXPECT_EQ(ready.header["role"], "solid");
  const auto start = ready.view<double>("positions");
  const double mass = ready.view<double>("surface.masses")[0];
  EXPECT_EQ(ready.array("surface.triangles").shape, (std::vector<std::int64_t>{4, 3}));

  const double step = 1e-6;
  Message begin("begin");
  begin.header["time"] = 0.0;
  begin.header["step"] = step;
  begin.add("load.vertices", {0}, std::vector<std::int64_t>{});
  begin.add("load.forces", {0, 3}, std::vector<double>{});
  hub.send("vehicle", std::move(begin));
  // The load acts at the times 1, 2, 3 ... steps, so position n has gained dt^2 F/m (0 + 1 + ... + (n - 1)).
  for (int window = 0; window < 5; ++window) {
    const Message surface = hub.receive("vehicle", "surface");
    const int n = window + 1;
    EXPECT_EQ(surface.header["window"], window);
    EXPECT_NEAR(surface.header["time"].get<double>(), n * step, 1e-18);
    const auto x = surface.view<double>("positions");
    const double gained = step * step / mass * n * (n - 1) / 2;
    EXPECT_NEAR(x[0], start[0] + gained * 1, 1e-16);
    EXPECT_NEAR(x[1], start[1] + gained * 2, 1e-16);
    EXPECT_NEAR(x[2], start[2] + gained * 3 + n * step * 40, 1e-16);
    EXPECT_NEAR(x[5], start[5] + n * step * 40, 1e-16);
    hub.send("vehicle", loads(window, step, true, window == 4));
  }
  EXPECT_EQ(hub.receive("vehicle", "finished").header["windows"], 5);
  hub.send("vehicle", Message("bye"));
  EXPECT_EQ(python.wait(), 0);
}

TEST(PythonExample, TakesEmptyLoadsAndEndsOnStop) {
  const SocketFolder folder;
  Process python([&] { return play_python(folder.endpoint(), "r"); });
  Hub hub(folder.endpoint(), "r", {"vehicle"});
  hub.await_participants(60);
  hub.receive("vehicle", "ready");
  Message begin("begin");
  begin.header["time"] = 0.0;
  begin.header["step"] = 1e-6;
  begin.add("load.vertices", {0}, std::vector<std::int64_t>{});
  begin.add("load.forces", {0, 3}, std::vector<double>{});
  hub.send("vehicle", std::move(begin));
  hub.receive("vehicle", "surface");
  hub.send("vehicle", loads(0, 1e-6, false, false));
  hub.receive("vehicle", "surface");
  hub.stop_all("enough");
  EXPECT_EQ(python.wait(), 1);
}

TEST(PythonExample, EndsWhenItIsRefusedAndWhenTheCouplerGoes) {
  const SocketFolder folder;
  Process stranger([&] { return play_python(folder.endpoint(), "another run"); });
  Process python([&] { return play_python(folder.endpoint(), "r"); });
  {
    Hub hub(folder.endpoint(), "r", {"vehicle", "never"});
    EXPECT_THROW(hub.await_participants(2), ParticipantMissing);
    EXPECT_EQ(stranger.wait(), 1);
  }
  EXPECT_EQ(python.wait(), 1);
}

}  // namespace
}  // namespace polynya::exchange
