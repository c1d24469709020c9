// Every defect of a checkpoint is one sentence that names the file and what is wrong.
#include "core/results/checkpoint_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>

#include "core/results/checkpoint_folder.hpp"
#include "core/results/frame_series.hpp"
#include "core/results/time_series.hpp"
#include "tests/core/results/temporary_folder.hpp"

namespace polynya::results {
namespace {

enum class Phase { solid, fluid };
struct Point {
  double x;
  std::int32_t n;
};
struct Inner {
  std::vector<double> values;
  std::string name;
  POLYNYA_STATE(values, name)
};
struct State {
  double time = 0;
  Phase phase = Phase::solid;
  std::vector<double> grid = std::vector<double>(3);
  std::vector<std::int32_t> list;
  std::vector<Point> points;
  std::vector<std::vector<std::int32_t>> rows;
  std::array<std::vector<float>, 2> pair;
  std::optional<Inner> inner;
  std::vector<Inner> many;
  std::vector<double> scratch;
  POLYNYA_STATE_WITHOUT((scratch), time, phase, grid, list, points, rows, pair, inner, many, scratch)
};
struct LaterState {
  double time = 0, more = 0;
  POLYNYA_STATE(time, more)
};
struct EarlierState {
  double time = 0;
  POLYNYA_STATE(time)
};

State sample() {
  State s;
  s.time = 1.0 / 3;
  s.phase = Phase::fluid;
  s.grid = {-0.0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::infinity()};
  s.list = {4, -5};
  s.points = {{0.1, 1}, {0.2, 2}};
  s.rows = {{1, 2, 3}, {}, {4}};
  s.pair = {std::vector<float>{0.5f}, {}};
  s.inner = Inner{{7, 8}, "a name, with a comma"};
  s.many = {{{1}, "one"}, {{}, ""}};
  s.scratch = {1, 2};
  return s;
}

const std::string scene = R"({"name": "a", "run": {"end_time": 1.0, "gravity": 9.81}, "vehicle": {"speed": 60.0}})";

template <class T>
std::string error_of(const std::string& path, T&& target, const std::string& program = "fluid_solver",
                     const std::string& now = scene) {
  try {
    CheckpointReader(path, program, now).load(target);
  } catch (const CheckpointError& error) {
    return error.what();
  }
  return "no error";
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
}

class Checkpoint : public ::testing::Test {
 protected:
  void SetUp() override { save_checkpoint(path, {"fluid_solver", scene, 2.5e-5, 12}, state); }
  TemporaryFolder folder;
  std::string path = folder / "fluid.h5";
  State state = sample();
};

TEST_F(Checkpoint, KeepsEveryValueToTheBit) {
  State loaded;
  CheckpointReader reader(path, "fluid_solver", scene);
  EXPECT_EQ(reader.time(), 2.5e-5);
  EXPECT_EQ(reader.step(), 12);
  EXPECT_EQ(reader.remark(), "");
  reader.load(loaded);
  EXPECT_EQ(loaded.time, 1.0 / 3);
  EXPECT_EQ(loaded.phase, Phase::fluid);
  EXPECT_EQ(0, std::memcmp(loaded.grid.data(), state.grid.data(), 24));
  EXPECT_EQ(loaded.list, state.list);
  ASSERT_EQ(loaded.points.size(), 2u);
  EXPECT_EQ(loaded.points[1].x, 0.2);
  EXPECT_EQ(loaded.points[1].n, 2);
  EXPECT_EQ(loaded.rows, state.rows);
  EXPECT_EQ(loaded.pair, state.pair);
  ASSERT_TRUE(loaded.inner);
  EXPECT_EQ(loaded.inner->name, "a name, with a comma");
  ASSERT_EQ(loaded.many.size(), 2u);
  EXPECT_EQ(loaded.many[0].values, std::vector<double>{1});
  EXPECT_TRUE(loaded.scratch.empty());
}

TEST_F(Checkpoint, NamesAFileThatIsMissing) {
  expect_part(error_of(folder / "ice.h5", State{}), "ice.h5: is missing");
}

TEST_F(Checkpoint, NamesAFileThatWasCutShort) {
  for (const double part : {0.0, 0.01, 0.5, 0.9, 0.999}) {
    const std::string cut = folder / "cut.h5";
    std::filesystem::copy_file(path, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(
        cut, static_cast<std::uintmax_t>(part * static_cast<double>(std::filesystem::file_size(path))));
    expect_part(error_of(cut, State{}), "cut.h5: ");
  }
}

TEST_F(Checkpoint, NamesAValueThatWasDamaged) {
  std::string bytes = read_text(path);
  const double value = 0.2;  // of points[1]
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&value), 8));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 3] = static_cast<char>(bytes[at + 3] ^ 1);
  std::ofstream(path, std::ios::binary) << bytes;
  expect_part(error_of(path, State{}), "is damaged: 'state.points' is not what was written");
}

TEST_F(Checkpoint, NamesTheKeyInWhichTheSceneDiffers) {
  std::string other = scene;
  other.replace(other.find("60.0"), 4, "40.0");
  expect_part(error_of(path, State{}, "fluid_solver", other), "vehicle.speed is 60.0 there and 40.0 here");
  std::string longer = scene;
  longer.replace(longer.find("1.0"), 3, "2.0");
  EXPECT_EQ(error_of(path, State{}, "fluid_solver", longer), "no error");
}

TEST_F(Checkpoint, LetsOnlyCommandLaunchAndThreadsOfParticipantsChange) {
  const std::string before = R"({"participants": {"ice": {"command": "", "launch": "", "threads": 0, "seed": 1}}})";
  const std::string freed = R"({"participants": {"ice": {"command": "a", "launch": "b", "threads": 2, "seed": 1}}})";
  EXPECT_EQ(scene_difference(before, freed), "");
  std::string other = before;
  other.replace(other.find("\"seed\": 1"), 9, "\"seed\": 2");
  EXPECT_EQ(scene_difference(before, other), "participants.ice.seed is 1 there and 2 here");
  EXPECT_NE(scene_difference(before, R"({"participants": {}})"), "");
  std::string more = before;
  more.replace(more.find("{\"ice\""), 1, "{\"fluid\": {\"command\": \"\"}, ");
  EXPECT_EQ(scene_difference(before, more), "participants.fluid is absent there and null here");
}

TEST_F(Checkpoint, KeepsRowsOfNumbersInOneDataSet) {
  struct Rows {
    std::vector<std::array<std::array<double, 3>, 2>> forces;
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::array<std::array<double, 2>, 3> ends{};
    POLYNYA_STATE(forces, triangles, ends)
  };
  Rows rows{{}, {{1, 2, 3}, {4, 5, 6}}, {{{1, 2}, {3, 4}, {5, 6}}}};
  for (int n = 0; n < 1000; ++n) rows.forces.push_back({{{n + 0.1, n + 0.2, n + 0.3}, {0.4, 0.5, 0.6}}});
  const std::string file = folder / "rows.h5";
  save_checkpoint(file, {"fluid_solver", scene, 0, 0}, rows);
  EXPECT_LT(std::filesystem::file_size(file), 1000 * 48 + 20000);  // a data set each would take 400 bytes more
  Rows loaded;
  EXPECT_EQ(error_of(file, loaded), "no error");
  EXPECT_EQ(loaded.forces, rows.forces);
  EXPECT_EQ(loaded.triangles, rows.triangles);
  EXPECT_EQ(loaded.ends, rows.ends);
  Rows shorter;
  shorter.triangles.resize(1);
  expect_part(error_of(file, shorter), "'state.triangles' holds 6 values, 3 are needed");
  struct Pairs {
    std::vector<std::array<std::int32_t, 4>> triangles;
    POLYNYA_STATE(triangles)
  } fours;
  expect_part(error_of(file, fours), "'state.triangles' holds 6 values, which are no whole rows of 4");
}

TEST_F(Checkpoint, NamesTheProgramThatWroteIt) {
  expect_part(error_of(path, State{}, "ice_solver"), "was written by fluid_solver, this is ice_solver");
}

TEST_F(Checkpoint, NamesAnArrayOfAnotherLength) {
  State other;
  other.grid.resize(5);
  expect_part(error_of(path, other), "'state.grid' holds 3 values, 5 are needed");
}

TEST_F(Checkpoint, NamesWhatItDoesNotHoldAndWhatTheProgramDoesNotKnow) {
  EarlierState earlier;
  LaterState later;
  save_checkpoint(folder / "earlier.h5", {"fluid_solver", scene, 0, 0}, earlier);
  save_checkpoint(folder / "later.h5", {"fluid_solver", scene, 0, 0}, later);
  expect_part(error_of(folder / "earlier.h5", LaterState{}), "it holds no 'state.more'");
  expect_part(error_of(folder / "later.h5", EarlierState{}), "it holds 'state.more', which this program does not know");
}

TEST(Checkpoints, KeepTheLastTwoThatAreValid) {
  const TemporaryFolder run;
  const auto there = [&](std::int64_t step) { return std::filesystem::exists(run / checkpoint_folder(step)); };
  for (const std::int64_t step : {5, 90, 100, 1200}) {
    EarlierState state;
    save_checkpoint(run / (checkpoint_folder(step) + "/ice.h5"), {"ice_solver", "{}", 1, step}, state);
    if (step == 100) continue;  // killed before it was valid
    commit_checkpoint(run.path(), step, 1, {"ice.h5"});
  }
  EXPECT_FALSE(there(5));
  EXPECT_TRUE(there(90));
  EXPECT_FALSE(there(100));
  EXPECT_TRUE(there(1200));
  EXPECT_THROW(commit_checkpoint(run.path(), 1300, 1, {"ice.h5"}), ResultsError);
}

TEST(Checkpoints, AreDueAfterSimulatedTimeOrWallTime) {
  CheckpointSchedule simulated(0.1, 0, 1.0), never(0, 0, 0), wall(0, 1e-9, 0);
  EXPECT_FALSE(simulated.due(1.05));
  EXPECT_TRUE(simulated.due(1.35));
  simulated.taken(1.35);
  EXPECT_FALSE(simulated.due(1.38));
  EXPECT_TRUE(simulated.due(1.41));
  EXPECT_FALSE(never.due(1e9));
  EXPECT_TRUE(wall.due(0));
}

TEST(Checkpoints, CutATimeSeriesToTheRowsOfThen) {
  const TemporaryFolder run;
  const std::string path = run / "series/a.csv";
  const std::vector<Column> columns{{"time", "s"}, {"force", "N"}};
  {
    TimeSeries series(path, columns);
    series.append(std::array{0.0, 1.0});
    save_checkpoint(run / "a.h5", {"p", "{}", 0, 0}, series);
    series.append(std::array{0.1, 2.0});
  }
  TimeSeries series(path, columns, Opening::continued);
  const std::string before = read_text(path);
  CheckpointReader(run / "a.h5", "p", "{}").load(series);
  EXPECT_EQ(read_text(path), before);  // the run may not go on after all
  series.append(std::array{0.2, 3.0});
  EXPECT_EQ(read_text(path), "time [s],force [N]\n0,1\n0.2,3\n");
  EXPECT_THROW(TimeSeries(path, {{"time", "s"}}, Opening::continued), ResultsError);
}

TEST(Checkpoints, RemoveFieldFramesThatCameLater) {
  const TemporaryFolder run;
  UnstructuredFields fields;
  fields.points = {0, 0, 0};
  {
    FrameSeries frames(run.path(), "ice");
    frames.write(0, fields, 0);
    save_checkpoint(run / "a.h5", {"p", "{}", 0, 0}, frames);
    frames.write(1, fields, 0.1);
  }
  FrameSeries frames(run.path(), "ice");
  CheckpointReader(run / "a.h5", "p", "{}").load(frames);
  EXPECT_TRUE(std::filesystem::exists(run / "fields/ice_0001.vtkhdf"));  // the run may not go on after all
  frames.write(2, fields, 0.2);
  EXPECT_TRUE(std::filesystem::exists(run / "fields/ice_0000.vtkhdf"));
  EXPECT_FALSE(std::filesystem::exists(run / "fields/ice_0001.vtkhdf"));
  EXPECT_EQ(read_text(run / "fields/ice.json").find("0001"), std::string::npos);
}

}  // namespace
}  // namespace polynya::results
