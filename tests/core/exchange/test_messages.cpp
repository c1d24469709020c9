#include <bit>
#include <cmath>
#include <limits>
#include <thread>

#include "core/exchange/hub.hpp"
#include "core/exchange/participant.hpp"
#include "core/exchange/wire.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

using nlohmann::json;

/// A header frame as a participant would send it, to be spoilt by the tests.
json good_header() {
  return json::parse(R"({"kind": "surface", "protocol": 1, "run": "r", "part": 1, "parts": 1, "window": 3,
    "arrays": [{"name": "positions", "type": "f8", "shape": [2, 3]}]})");
}

std::string complaint(const json& header) {
  Envelope envelope;
  return message_of<ProtocolError>([&] { decode_header(header.dump(), envelope); });
}

Message one_of_each() {
  Message message("surface");
  message.header["window"] = 7;
  message.header["stable_step"] = 0.1 + 0.2;
  message.header["note"] = "Eis über Wasser";
  const std::vector<double> reals{-0.0, 5e-324, std::numeric_limits<double>::quiet_NaN(), INFINITY, 1.0 / 3.0, -1e300};
  const std::vector<std::int64_t> longs{std::numeric_limits<std::int64_t>::min(), -1, (1LL << 53) + 1};
  const std::vector<std::int32_t> ints{std::numeric_limits<std::int32_t>::min(), 0, 7};
  const std::vector<std::uint8_t> bytes{0, 255, 128, 1, 2};
  message.add<double>("reals", {2, 3}, reals);
  message.add<std::int64_t>("longs", {3}, longs);
  message.add<std::int32_t>("ints", {3, 1}, ints);
  message.add<std::uint8_t>("bytes", {5}, bytes);
  message.add<double>("none", {0, 3}, std::span<const double>());
  message.add<std::int64_t>("scalar", {}, std::span(longs).first(1));
  return message;
}

TEST(Message, ArrivesBitForBit) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "r", {"solid"});
  const Message sent = one_of_each();
  std::jthread solid([&] {
    Participant participant({folder.endpoint(), "r", "solid", 10});
    participant.send(participant.receive("surface"));
    participant.receive("bye");
  });
  hub.await_participants(10);
  hub.send("solid", sent);
  const Message back = hub.receive("solid", "surface");
  hub.send("solid", Message("bye"));
  EXPECT_EQ(back.header, sent.header);
  ASSERT_EQ(back.arrays.size(), sent.arrays.size());
  for (std::size_t i = 0; i < sent.arrays.size(); ++i) {
    EXPECT_EQ(back.arrays[i].name, sent.arrays[i].name);
    EXPECT_EQ(back.arrays[i].type, sent.arrays[i].type);
    EXPECT_EQ(back.arrays[i].shape, sent.arrays[i].shape);
    EXPECT_EQ(back.arrays[i].bytes, sent.arrays[i].bytes);
  }
  EXPECT_EQ(std::bit_cast<std::uint64_t>(back.view<double>("reals")[0]), 0x8000000000000000u);
  EXPECT_EQ(back.view<std::int64_t>("longs")[2], 9007199254740993);
  EXPECT_TRUE(back.view<double>("none").empty());
}

TEST(Message, TakesTheMemoryOfAnArrayThatMovesIntoIt) {
  std::vector<double> values{1, 2, 3};
  const double* where = values.data();
  Message message("surface");
  message.add("x", {3}, std::move(values));
  EXPECT_EQ(message.view<double>("x").data(), where);
  EXPECT_EQ(message.view<double>("x")[2], 3.0);
}

TEST(Message, LargeArrayArrivesWhole) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "r", {"solid"});
  std::vector<std::int64_t> values(4'000'000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i * i);
  std::jthread solid([&] {
    Participant participant({folder.endpoint(), "r", "solid", 10});
    Message message("surface");
    message.add<std::int64_t>("values", {4'000'000}, values);
    participant.send(std::move(message));
    participant.receive("bye");
  });
  hub.await_participants(10);
  const Message message = hub.receive("solid");
  const auto received = message.view<std::int64_t>("values");
  EXPECT_TRUE(std::equal(received.begin(), received.end(), values.begin(), values.end()));
  hub.send("solid", Message("bye"));
}

TEST(Message, NamesMissingArraysAndWrongTypes) {
  const Message message = one_of_each();
  EXPECT_NE(message_of<ProtocolError>([&] { message.view<double>("velocities"); }).find("no array 'velocities'"),
            std::string::npos);
  EXPECT_NE(message_of<ProtocolError>([&] { message.view<double>("longs"); }).find("is of type i8, not f8"),
            std::string::npos);
}

TEST(Message, RefusesDataThatDoesNotFitItsShape) {
  Message message("surface");
  const std::vector<double> five(5);
  EXPECT_NE(message_of<ProtocolError>([&] {
              message.add<double>("x", {2, 3}, five);
            }).find("[2][3]"),
            std::string::npos);
  message.add<double>("x", {5}, five);
  EXPECT_THROW(message.add<double>("x", {5}, five), ProtocolError);
}

TEST(Message, ReservedFieldsCannotBeOverwritten) {
  Message message("surface");
  message.header["run"] = "another";
  EXPECT_THROW(encode_header(message, {1, "r"}), ProtocolError);
}

TEST(Header, ComesBackWithNamesThatJsonHasToEscape) {
  Message message("surface");
  message.header["note"] = "\"a\\b\"\n";
  message.add<double>("quote \" and \\ and \n", {1, 1, 1}, std::vector<double>{1.5});
  message.add<std::int64_t>("scalar", {}, std::vector<std::int64_t>{-3});
  Envelope envelope;
  const Message read = decode_header(encode_header(message, {2, "run \"7\""}), envelope);
  EXPECT_EQ(read.header, message.header);
  EXPECT_EQ(envelope.protocol, 2);
  EXPECT_EQ(envelope.run, "run \"7\"");
  ASSERT_EQ(read.arrays.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.arrays[i].name, message.arrays[i].name);
    EXPECT_EQ(read.arrays[i].type, message.arrays[i].type);
    EXPECT_EQ(read.arrays[i].shape, message.arrays[i].shape);
  }
}

TEST(Header, GoodOneIsReadAndStrippedOfTheEnvelope) {
  Envelope envelope;
  const Message message = decode_header(good_header().dump(), envelope);
  EXPECT_EQ(message.header, json::parse(R"({"kind": "surface", "window": 3})"));
  EXPECT_EQ(envelope.protocol, 1);
  EXPECT_EQ(envelope.run, "r");
}

TEST(Header, EveryDefectIsNamed) {
  const auto spoilt = [](const char* pointer, json value) {
    json header = good_header();
    header[json::json_pointer(pointer)] = std::move(value);
    return complaint(header);
  };
  EXPECT_NE(spoilt("/kind", 3).find("'kind'"), std::string::npos);
  EXPECT_NE(spoilt("/protocol", "one").find("'protocol'"), std::string::npos);
  EXPECT_NE(spoilt("/run", nullptr).find("'run'"), std::string::npos);
  EXPECT_NE(spoilt("/parts", 2).find("part 1 of 2"), std::string::npos);
  EXPECT_NE(spoilt("/arrays", "none").find("'arrays'"), std::string::npos);
  EXPECT_NE(spoilt("/arrays/0/type", "f4").find("unknown type 'f4'"), std::string::npos);
  EXPECT_NE(spoilt("/arrays/0/shape", json::array({-1, 3})).find("negative extent"), std::string::npos);
  EXPECT_NE(spoilt("/arrays/0/shape", json::array({1LL << 40, 1LL << 40})).find("too large"), std::string::npos);
  EXPECT_NE(spoilt("/arrays/0/shape", json::array({1.5})).find("list of integers"), std::string::npos);
  EXPECT_NE(spoilt("/arrays/1", good_header()["arrays"][0]).find("two arrays 'positions'"), std::string::npos);
  EXPECT_NE(complaint(json::array()).find("not a JSON object"), std::string::npos);
}

TEST(Header, FrameOfAnotherSizeThanAnnouncedIsRejected) {
  Array array{"positions", "f8", {2, 3}, {}};
  const Bytes frame(std::vector<std::byte>(47));
  EXPECT_NE(message_of<ProtocolError>([&] { fill(array, frame, "surface"); }).find("47 bytes"), std::string::npos);
}

}  // namespace
}  // namespace polynya::exchange
