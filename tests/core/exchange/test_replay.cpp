#include <cmath>
#include <thread>

#include "core/exchange/hub.hpp"
#include "core/exchange/participant.hpp"
#include "core/exchange/record_reader.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

constexpr int window_count = 20;
constexpr double step = 1e-6;  // s

/// A mass on which loads act, and what may be wrong with it.
struct Mass {
  double position = 0, velocity = 0;
  int wrong_window = -1;
  double error = 0;
  bool silent = false;           ///< leaves out the message of the wrong window
  std::vector<int> frames = {};  ///< asked for
  int windows = 0;

  void play(Participant& participant) {
    participant.send(Message("ready"));
    participant.receive("begin");
    for (bool finish = false; !finish; ++windows) {
      position += step * velocity;
      Message surface("surface");
      surface.header["window"] = windows;
      surface.header["time"] = (windows + 1) * step;
      const double sent = position * (windows == wrong_window ? 1 + error : 1);
      surface.add<double>("positions", {1, 3}, std::vector<double>{1, 2, sent});
      if (!silent || windows != wrong_window) participant.send(std::move(surface));
      const Message loads = participant.receive("loads");
      velocity += step * loads.view<double>("load.forces")[2];
      if (loads.header["frame"] >= 0) frames.push_back(loads.header["frame"]);
      finish = loads.header["finish"];
    }
    participant.send(Message("finished"));
    participant.receive("bye");
  }
};

/// Loads that depend on the answer, as in a coupled run. `last`: where the coupler breaks off, without `bye`.
void couple(Hub& hub, int last) {
  hub.await_participants(10);
  hub.receive("mass", "ready");
  hub.send("mass", Message("begin"));
  for (int window = 0; window < window_count && window <= last; ++window) {
    const double z = hub.receive("mass", "surface").view<double>("positions")[2];
    Message loads("loads");
    loads.header["window"] = window;
    loads.header["finish"] = window + 1 == window_count;
    loads.header["frame"] = window % 5 == 0 ? window / 5 : -1;
    loads.add<double>("load.forces", {1, 3}, std::vector<double>{0, 0, 1e6 * std::cos(1e3 * z)});
    hub.send("mass", std::move(loads));
  }
  if (last < window_count) return;
  hub.receive("mass", "finished");
  hub.send("mass", Message("bye"));
}

/// A run with a hub, a participant and sockets, on record.
struct RecordedRun {
  SocketFolder folder;
  Mass mass;

  explicit RecordedRun(int last = window_count, RecordSelection selection = {}) {
    std::thread solver;
    {
      Recorder::Options options;
      options.folder = record();
      options.selection = std::move(selection);
      Recorder recorder(options);
      Hub hub(folder.endpoint(), "r", {"mass"});
      hub.record(recorder);
      solver = std::thread([this] {
        Participant participant({folder.endpoint(), "r", "mass", 10});
        try {
          mass.play(participant);
        } catch (const CouplerLost&) {
        }
      });
      couple(hub, last);
      recorder.close();
    }
    solver.join();
  }

  std::string record() const { return folder.path / "record"; }

  /// Plays the mass against the record; the verdict.
  template <class Verdict>
  std::string replay(Mass& other, Replay how = {}) const {
    how.record = record();
    return message_of<Verdict>([&] {
      Participant participant({"", "", "mass", 10, how});
      other.play(participant);
    });
  }
};

bool holds(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(Replay, FollowsTheCoupledRunBitForBitWithoutACoupler) {
  const RecordedRun run;
  Mass again;
  const std::string verdict = run.replay<ReplayEnded>(again);
  EXPECT_TRUE(holds(verdict, "the end of the run: 22 messages, all equal bit for bit")) << verdict;
  EXPECT_EQ(again.position, run.mass.position);
  EXPECT_EQ(again.velocity, run.mass.velocity);
  EXPECT_EQ(again.frames, run.mass.frames);
}

TEST(Replay, GoesAsFarAsTheFirstIntervalOnRecord) {
  const RecordedRun run(window_count, {.times = {}, .windows = {0, 7, 12}});
  Mass again;
  const std::string verdict = run.replay<ReplayEnded>(again);
  EXPECT_TRUE(holds(verdict, "t = 8e-06 s, where the record leaves windows out: 9 messages, all equal")) << verdict;
  EXPECT_EQ(again.windows, 8);
}

TEST(Replay, OfAnIntervalThatBeginsLaterIsRefusedInOneSentence) {
  const RecordedRun run(window_count, {.times = {}, .windows = {5, 7}});
  Mass again;
  const std::string sentence = run.replay<RecordError>(again);
  EXPECT_TRUE(holds(sentence,
                    "begins at window 5; a replay needs the run from its start; run the scene again with "
                    "record.windows that begin at 0"))
      << sentence;
}

TEST(Replay, NamesTheFirstDifferenceAndStopsThere) {
  const RecordedRun run;
  Mass wrong{.wrong_window = 7, .error = 1e-15};
  const std::string sentence = run.replay<ReplayDifference>(wrong);
  EXPECT_TRUE(holds(sentence, "window 7, t = 8e-06 s: 'surface', array 'positions', value [0][2] is ")) << sentence;
  EXPECT_EQ(wrong.windows, 7);
}

TEST(Replay, ASolverThatSendsNothingWhereItSpokeIsNamed) {
  const RecordedRun run;
  Mass silent{.wrong_window = 3, .silent = true};
  EXPECT_TRUE(
      holds(run.replay<ReplayDifference>(silent), "window 3, t = 4e-06 s: 'surface' is on record, but mass waits"));
}

TEST(Replay, ToleranceAllowsSmallDifferencesAndTellsTheLargest) {
  const RecordedRun run;
  Mass wrong{.wrong_window = 7, .error = 1e-12};
  EXPECT_TRUE(holds(run.replay<ReplayEnded>(wrong, {.tolerance = 1e-9}), "1 of 22 messages differ, at most by"));
  Mass too_wrong{.wrong_window = 7, .error = 1};
  EXPECT_TRUE(holds(run.replay<ReplayDifference>(too_wrong, {.tolerance = 1e-16}), "window 7"));
}

TEST(Replay, KeepGoingReachesTheEndAndStillFails) {
  const RecordedRun run;
  Mass wrong{.wrong_window = 7, .error = 0.5};
  EXPECT_TRUE(holds(run.replay<ReplayDifference>(wrong, {.keep_going = true}), "largest: window 7"));
  EXPECT_EQ(wrong.windows, window_count);
}

TEST(Replay, BeforeFromNothingIsComparedAndNoFrameWritten) {
  const RecordedRun run;
  Mass wrong{.wrong_window = 4, .error = 1};  // of this window alone: its state is right
  const std::string verdict = run.replay<ReplayEnded>(wrong, {.from = 5.5 * step});
  EXPECT_TRUE(holds(verdict, "16 messages, all equal bit for bit")) << verdict;  // windows 5 to 19, finished
  EXPECT_EQ(run.mass.frames, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(wrong.frames, (std::vector<int>{1, 2, 3}));
}

TEST(Replay, EndsWithTheWindowThatReachesUntil) {
  const RecordedRun run;
  Mass again;
  EXPECT_TRUE(holds(run.replay<ReplayEnded>(again, {.until = 9.5 * step}), "11 messages"));  // ready, windows 0 to 9
  EXPECT_EQ(again.windows, 10);
}

TEST(Replay, GoesOnToWhereABrokenRunEnded) {
  const RecordedRun broken(12);
  Mass again;
  const std::string verdict = broken.replay<ReplayEnded>(again);
  EXPECT_TRUE(holds(verdict, "where the record ends: 14 messages, all equal bit for bit")) << verdict;
  EXPECT_EQ(again.windows, 13);
}

TEST(Replay, AnotherParticipantIsRefused) {
  const RecordedRun run;
  const auto open = [&] { Participant({"", "", "ice", 10, {.record = run.record()}}); };
  EXPECT_TRUE(holds(message_of<RecordError>(open), "nothing of ice is on record; recorded are mass"));
}

}  // namespace
}  // namespace polynya::exchange
