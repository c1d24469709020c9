#include <thread>

#include "core/exchange/environment.hpp"
#include "core/exchange/hub.hpp"
#include "core/exchange/participant.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

using Clock = std::chrono::steady_clock;

int join_and_wait(const std::string& endpoint, const std::string& name) {
  Participant participant({endpoint, "r", name, 10});
  participant.receive("bye");
  return 0;
}

/// Kills or freezes the process a little later, so that the hub is already waiting.
std::jthread later(const std::function<void()>& action) {
  return std::jthread([action] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    action();
  });
}

TEST(Loss, KilledParticipantIsNamedEvenWhileTheHubWaitsForAnother) {
  const SocketFolder folder;
  Process vehicle([&] { return join_and_wait(folder.endpoint(), "vehicle"); });
  Process ice([&] { return join_and_wait(folder.endpoint(), "ice"); });
  Hub hub(folder.endpoint(), "r", {"vehicle", "ice"});
  hub.await_participants(10);
  const auto start = Clock::now();
  const auto killer = later([&] { ice.kill(); });
  try {
    hub.receive("vehicle");
    ADD_FAILURE() << "the loss went unnoticed";
  } catch (const ParticipantLost& lost) {
    EXPECT_EQ(lost.name, "ice");
  }
  EXPECT_LT(seconds_since(start), 1.3);
  hub.stop_all("ice is gone");
}

TEST(Loss, ParticipantKilledWhileTheCouplerComputesIsFoundBySendOrReceive) {
  const SocketFolder folder;
  Process ice([&] { return join_and_wait(folder.endpoint(), "ice"); });
  Hub hub(folder.endpoint(), "r", {"ice"});
  hub.await_participants(10);
  ice.kill();
  ice.wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_THROW(hub.send("ice", Message("loads")), ParticipantLost);
  EXPECT_THROW(hub.receive("ice"), ParticipantLost);
}

TEST(Loss, OverTcpKilledAndFrozenParticipantsAreFound) {
  for (const bool frozen : {false, true}) {
    // The child learns the port through a pipe: the hub may only be made after the fork.
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    Process ice([&] {
      char endpoint[100] = {};
      if (read(ends[0], endpoint, sizeof endpoint - 1) <= 0) return 1;
      return join_and_wait(endpoint, "ice");
    });
    Hub hub("tcp://127.0.0.1:*", "r", {"ice"});
    ASSERT_GT(write(ends[1], hub.endpoint().data(), hub.endpoint().size()), 0);
    hub.await_participants(10);
    const auto start = Clock::now();
    const auto killer = later([&] { frozen ? ice.pause() : ice.kill(); });
    EXPECT_THROW(hub.receive("ice"), ParticipantLost);
    EXPECT_LT(seconds_since(start), 5.0);
  }
}

TEST(Loss, DeadProcessWhoseConnectionAChildKeepsOpenIsFound) {
  const SocketFolder folder;
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  Process ice([&] {
    Participant participant({folder.endpoint(), "r", "ice", 10});
    const pid_t child = fork();
    if (child == 0) {
      pause();
      _exit(0);
    }
    if (write(ends[1], &child, sizeof child) <= 0) return 1;
    participant.receive("bye");
    return 0;
  });
  Hub hub(folder.endpoint(), "r", {"ice"});
  hub.await_participants(10);
  pid_t child = 0;
  ASSERT_EQ(read(ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
  const auto start = Clock::now();
  const auto killer = later([&] { ice.kill(); });
  EXPECT_THROW(hub.receive("ice"), ParticipantLost);
  EXPECT_LT(seconds_since(start), 5.0);
  kill(child, SIGKILL);
}

TEST(Loss, ParticipantThatGivesUpTellsWhy) {
  const SocketFolder folder;
  Process ice([&] {
    Participant participant({folder.endpoint(), "r", "ice", 10});
    participant.fail("element 7 turned inside out at 1.2e-5 s");
    return 1;
  });
  Hub hub(folder.endpoint(), "r", {"ice"});
  hub.await_participants(10);
  EXPECT_EQ(message_of<ParticipantLost>([&] { hub.receive("ice"); }), "ice: element 7 turned inside out at 1.2e-5 s");
  EXPECT_EQ(ice.wait(), 1);
}

/// A participant that needs 3.7 s for its answer, longer than any heartbeat.
void wait_for_a_slow_participant(const std::string& endpoint_to_bind) {
  Hub hub(endpoint_to_bind, "r", {"ice"});
  std::jthread ice([endpoint = hub.endpoint()] {
    Participant participant({endpoint, "r", "ice", 10});
    std::this_thread::sleep_for(std::chrono::milliseconds(3700));
    participant.send(Message("surface"));
    participant.receive("bye");
  });
  hub.await_participants(10);
  EXPECT_EQ(hub.receive("ice").kind(), "surface");
  hub.send("ice", Message("bye"));
}

TEST(Loss, SlowParticipantIsNotDead) {
  const SocketFolder folder;
  std::jthread local([&] { wait_for_a_slow_participant(folder.endpoint()); });
  std::jthread remote([&] { wait_for_a_slow_participant("tcp://127.0.0.1:*"); });
}

TEST(Loss, FrozenLocalParticipantGoesOnWhenADebuggerReleasesIt) {
  const SocketFolder folder;
  Process ice([&] {
    Participant participant({folder.endpoint(), "r", "ice", 10});
    participant.receive("loads");
    participant.send(Message("surface"));
    participant.receive("bye");
    return 0;
  });
  Hub hub(folder.endpoint(), "r", {"ice"});
  hub.await_participants(10);
  ice.pause();
  hub.send("ice", Message("loads"));
  std::jthread release([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(3500));
    kill(ice.pid(), SIGCONT);
  });
  EXPECT_EQ(hub.receive("ice").kind(), "surface");
  hub.send("ice", Message("bye"));
  EXPECT_EQ(ice.wait(), 0);
}

TEST(Loss, KilledCouplerIsNoticedByTheParticipant) {
  const SocketFolder folder;
  Process coupler([&] {
    Hub hub(folder.endpoint(), "r", {"ice"});
    hub.await_participants(10);
    hub.receive("ice");
    return 0;
  });
  Participant participant({folder.endpoint(), "r", "ice", 10});
  const auto start = Clock::now();
  const auto killer = later([&] { coupler.kill(); });
  EXPECT_THROW(participant.receive(), CouplerLost);
  EXPECT_LT(seconds_since(start), 1.3);
}

TEST(Loss, ParticipantWithQueuedMessagesForALostCouplerEndsAtOnce) {
  const SocketFolder folder;
  Process coupler([&] {
    Hub hub(folder.endpoint(), "r", {"ice"});
    hub.await_participants(10);
    return 0;
  });
  const auto start = Clock::now();
  {
    Participant participant({folder.endpoint(), "r", "ice", 10});
    EXPECT_EQ(coupler.wait(), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    participant.send(Message("surface"));
    EXPECT_THROW(participant.receive(), CouplerLost);
  }
  EXPECT_LT(seconds_since(start), 1.0);
}

TEST(Environment, ProcessesAndZombiesAreToldApart) {
  Process child([] { return 0; });
  EXPECT_TRUE(process_is_alive(getpid()));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(process_is_alive(child.pid()));
  EXPECT_FALSE(process_is_alive(0));
}

TEST(Environment, ChildDiesWithItsParent) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  Process parent([&] {
    const pid_t child = fork();
    if (child == 0) {
      die_with_parent();
      const pid_t own = getpid();
      if (write(ends[1], &own, sizeof own) <= 0) _exit(1);
      pause();
    }
    pause();
    return 0;
  });
  pid_t grandchild = 0;
  ASSERT_EQ(read(ends[0], &grandchild, sizeof grandchild), static_cast<ssize_t>(sizeof grandchild));
  EXPECT_TRUE(process_is_alive(grandchild));
  parent.kill();
  parent.wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(process_is_alive(grandchild));
}

}  // namespace
}  // namespace polynya::exchange
