#include <thread>

#include "core/exchange/hub.hpp"
#include "core/exchange/participant.hpp"
#include "core/exchange/transport.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

std::string refusal_of(const std::string& endpoint, const std::string& run, const std::string& name) {
  return message_of<Refused>([&] { Participant({endpoint, run, name, 10}); });
}

/// A hub with one participant, "ice", that answers every `loads` by a `surface` until `bye`.
struct RunningPair {
  SocketFolder folder;
  Hub hub{folder.endpoint(), "r", {"ice"}};
  std::jthread ice{[this] {
    Participant participant({folder.endpoint(), "r", "ice", 10});
    while (participant.receive().kind() != "bye") participant.send(Message("surface"));
  }};
  RunningPair() { hub.await_participants(10); }
  ~RunningPair() { hub.send("ice", Message("bye")); }
};

TEST(Refusal, StrangersAndOtherRunsAreRefusedWithAReason) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "r", {"ice"});
  std::string missing;
  std::jthread coupler([&] { missing = message_of<ParticipantMissing>([&] { hub.await_participants(1.0); }); });
  EXPECT_EQ(refusal_of(folder.endpoint(), "r", "isce"),
            "the coupler refused: no participant 'isce' is expected; expected are ice");
  EXPECT_EQ(refusal_of(folder.endpoint(), "other", "ice"), "the coupler refused: this is run 'r', not 'other'");
  coupler.join();
  EXPECT_NE(missing.find("ice did not join run 'r'"), std::string::npos) << missing;
  EXPECT_NE(missing.find("last refusal: this is run 'r', not 'other'"), std::string::npos) << missing;
}

TEST(Refusal, AnotherProtocolVersionIsRefused) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "r", {"ice"});
  std::jthread coupler([&] { EXPECT_THROW(hub.await_participants(1.0), ParticipantMissing); });
  Transport stranger(Transport::Side::participant, folder.endpoint());
  Message hello("hello");
  hello.header["name"] = "ice";
  stranger.send({}, std::move(hello), {1, "r"});
  const auto answer = stranger.next(std::chrono::seconds(5));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->message.kind(), "refuse");
  EXPECT_EQ(answer->message.header["reason"], "this coupler speaks protocol 2, not 1");
}

TEST(Refusal, SecondOfTheSameNameIsRefusedWhileTheFirstGoesOn) {
  RunningPair pair;
  std::string reason;
  std::jthread second([&] { reason = refusal_of(pair.folder.endpoint(), "r", "ice"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  for (int window = 0; window < 3; ++window) {
    pair.hub.send("ice", Message("loads"));
    EXPECT_EQ(pair.hub.receive("ice").kind(), "surface");
  }
  second.join();
  EXPECT_EQ(reason, "the coupler refused: a participant 'ice' has already joined this run");
  pair.hub.send("ice", Message("loads"));
  EXPECT_EQ(pair.hub.receive("ice").kind(), "surface");
}

TEST(Refusal, NoiseOfAStrangerDoesNotDisturbTheRun) {
  RunningPair pair;
  Transport stranger(Transport::Side::participant, pair.folder.endpoint());
  stranger.send({}, Message("surface"), {protocol_version, "r"});
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  for (int window = 0; window < 3; ++window) {
    pair.hub.send("ice", Message("loads"));
    EXPECT_EQ(pair.hub.receive("ice").kind(), "surface");
  }
  const auto answer = stranger.next(std::chrono::seconds(5));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->message.header["reason"], "the first message must be 'hello', not 'surface'");
}

TEST(Missing, ParticipantThatNeverComesIsNamed) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "r", {"vehicle", "ice", "fluid"});
  std::jthread vehicle([&] { EXPECT_THROW(Participant({folder.endpoint(), "r", "vehicle", 10}).receive(), Stopped); });
  try {
    hub.await_participants(0.5);
    ADD_FAILURE() << "nobody was missed";
  } catch (const ParticipantMissing& error) {
    EXPECT_EQ(error.names, (std::vector<std::string>{"fluid", "ice"}));
  }
  hub.stop_all("ice and fluid did not come");
}

TEST(Missing, CouplerThatNeverComesIsReportedAfterTheTimeout) {
  const SocketFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const auto text = message_of<CouplerLost>([&] { Participant({folder.endpoint(), "r", "ice", 0.3}); });
  EXPECT_NE(text.find("no coupler answered at ipc://"), std::string::npos) << text;
  EXPECT_LT(seconds_since(start), 2.0);
}

}  // namespace
}  // namespace polynya::exchange
