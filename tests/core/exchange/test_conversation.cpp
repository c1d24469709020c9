#include <sys/stat.h>

#include <thread>

#include "core/exchange/bench_window.hpp"
#include "core/exchange/hub.hpp"
#include "core/exchange/participant.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

Message numbered(const char* kind, int window) {
  Message message(kind);
  message.header["window"] = window;
  return message;
}

/// Sends 200 windows and expects each answer in turn.
void play_solid(const std::string& endpoint, const std::string& name) {
  Participant participant({endpoint, "r", name, 10});
  for (int window = 0; window < 200; ++window) {
    participant.send(numbered("surface", window));
    EXPECT_EQ(participant.receive("loads").header["window"], window);
  }
  participant.send(Message("finished"));
  participant.receive("bye");
}

TEST(Conversation, KeepsTheOrderOfEachParticipant) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "r", {"vehicle", "ice"});
  std::jthread vehicle([&] { play_solid(folder.endpoint(), "vehicle"); });
  std::jthread ice([&] { play_solid(folder.endpoint(), "ice"); });
  hub.await_participants(10);
  for (int window = 0; window < 200; ++window) {
    for (const char* name : {"ice", "vehicle"})
      EXPECT_EQ(hub.receive(name, "surface").header["window"], window) << name;
    for (const char* name : {"vehicle", "ice"}) hub.send(name, numbered("loads", window));
  }
  for (const char* name : {"vehicle", "ice"}) {
    hub.receive(name, "finished");
    hub.send(name, Message("bye"));
  }
}

TEST(Conversation, WorksOverTcpAndSurvivesTheFirstToLeave) {
  Hub hub("tcp://127.0.0.1:*", "r", {"vehicle", "ice"});
  std::jthread vehicle([&] { play_solid(hub.endpoint(), "vehicle"); });
  std::jthread ice([endpoint = hub.endpoint()] { play_solid(endpoint, "ice"); });
  hub.await_participants(10);
  for (const char* name : {"vehicle", "ice"}) {
    for (int window = 0; window < 200; ++window) {
      hub.receive(name, "surface");
      hub.send(name, numbered("loads", window));
    }
    hub.receive(name, "finished");
    hub.send(name, Message("bye"));
    if (vehicle.joinable()) vehicle.join();
  }
}

TEST(Conversation, ParticipantMayComeBeforeTheCoupler) {
  const SocketFolder folder;
  std::jthread solid([&] { Participant({folder.endpoint(), "r", "solid", 10}).receive("bye"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  Hub hub(folder.endpoint(), "r", {"solid"});
  hub.await_participants(5);
  hub.send("solid", Message("bye"));
}

TEST(Conversation, LastMessagesLeaveBeforeTheHubIsGoneAndNoFileStays) {
  const SocketFolder folder;
  std::string reason;
  std::jthread solid([&] {
    Participant participant({folder.endpoint(), "r", "solid", 10});
    try {
      participant.receive();
    } catch (const Stopped& stopped) {
      reason = stopped.reason;
    }
  });
  {
    Hub hub(folder.endpoint(), "r", {"solid"});
    hub.await_participants(10);
    EXPECT_FALSE(folder.empty());
    hub.stop_all("the ice broke the ledger");
  }
  EXPECT_TRUE(folder.empty());
  solid.join();
  EXPECT_EQ(reason, "the ice broke the ledger");
}

TEST(Conversation, UnexpectedKindNamesBothKindsAndTheSender) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "r", {"solid"});
  std::jthread solid([&] {
    Participant participant({folder.endpoint(), "r", "solid", 10});
    participant.send(Message("pressure"));
    participant.receive("bye");
  });
  hub.await_participants(10);
  EXPECT_EQ(message_of<ProtocolError>([&] { hub.receive("solid", "surface"); }),
            "from solid: expected a message 'surface', received 'pressure'");
  hub.send("solid", Message("bye"));
}

TEST(Conversation, WaitingIsMeasured) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "r", {"solid"});
  double waited = 0;
  std::jthread solid([&] {
    Participant participant({folder.endpoint(), "r", "solid", 10});
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    participant.send(Message("surface"));
    participant.receive("bye");
    waited = participant.waiting_seconds();
  });
  hub.await_participants(10);
  hub.receive("solid");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  hub.send("solid", Message("bye"));
  solid.join();
  EXPECT_NEAR(hub.waiting_seconds("solid"), 0.2, 0.1);
  EXPECT_NEAR(waited, 0.2, 0.1);
}

TEST(Endpoint, TooLongASocketPathIsNamedWithItsLength) {
  const std::string path = "/tmp/" + std::string(103, 'x');
  const auto text = message_of<EndpointError>([&] { Hub("ipc://" + path, "r", {"solid"}); });
  EXPECT_NE(text.find("108 characters, allowed are 1 to 107"), std::string::npos) << text;
  EXPECT_THROW(Hub("shm://x", "r", {"solid"}), EndpointError);
}

TEST(Endpoint, TakenAddressIsAnError) {
  const Hub hub("tcp://127.0.0.1:*", "r", {"solid"});
  EXPECT_THROW(Hub(hub.endpoint(), "r", {"solid"}), EndpointError);
}

TEST(Window, OfTwoThousandVerticesTakesWellBelowAMillisecond) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "instrumented code has no speed of its own";
#endif
  // The figure itself belongs to the benchmark; here only a collapse (spinning, lost wake-ups) would show.
  EXPECT_LT(window_microseconds(2000), 1000.0);
}

}  // namespace
}  // namespace polynya::exchange
