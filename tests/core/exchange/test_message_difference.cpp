#include <cmath>
#include <limits>

#include "core/exchange/message_difference.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Message with(const std::vector<double>& positions, std::int32_t corner = 5) {
  Message message("surface");
  message.header["stable_step"] = 1e-7;
  message.add<double>("positions", {static_cast<std::int64_t>(positions.size() / 2), 2}, positions);
  message.add<std::int32_t>("triangles", {1}, std::vector<std::int32_t>{corner});
  return message;
}

TEST(MessageDifference, EqualBitsAreEqualEvenWhenTheyAreNoNumber) {
  const double none = std::nan("");
  EXPECT_TRUE(compare(with({none, -0.0}), with({none, -0.0})).first.empty());
}

TEST(MessageDifference, OneBitIsNamedWithItsPlaceAndBothValues) {
  const MessageDifference difference = compare(with({1, 2, 3, std::nextafter(4, 5)}), with({1, 2, 3, 4}));
  EXPECT_EQ(difference.first, "array 'positions', value [1][1] is 4.000000000000001, on record is 4");
  EXPECT_DOUBLE_EQ(difference.size, std::numeric_limits<double>::epsilon());
  EXPECT_FALSE(compare(with({0.0, 1}), with({-0.0, 1})).first.empty());
}

TEST(MessageDifference, LargestIsRelativeToTheLargestValueOfTheRecordedArray) {
  const MessageDifference difference = compare(with({1.1, 2, 97, 4}), with({1, 2, 100, 4}));
  EXPECT_EQ(difference.first.substr(0, 30), "array 'positions', value [0][0");
  EXPECT_EQ(difference.largest.substr(0, 30), "array 'positions', value [1][0");
  EXPECT_NEAR(difference.size, 0.03, 1e-15);
}

TEST(MessageDifference, WhatIsNoFloatingPointNumberOrHasAnotherSizeDiffersBeyondAnyTolerance) {
  EXPECT_EQ(compare(with({1, 2}, 6), with({1, 2}, 5)).size, infinite);
  EXPECT_EQ(compare(with({1, 2}), with({1, 2, 3, 4})).size, infinite);
  EXPECT_EQ(compare(with({std::nan(""), 2}), with({1, 2})).size, infinite);
  Message more = with({1, 2});
  more.header["note"] = "new";
  EXPECT_EQ(compare(more, with({1, 2})).size, infinite);
  EXPECT_EQ(compare(with({1, 2}), more).first, "field 'note' is missing, on record is \"new\"");
}

TEST(MessageDifference, FieldsOfTheHeaderAreComparedRelativeToTheRecordedNumber) {
  Message other = with({1, 2});
  other.header["stable_step"] = 1.01e-7;
  EXPECT_NEAR(compare(other, with({1, 2})).size, 0.01, 1e-12);
  Message nested = with({1, 2}), changed = with({1, 2});
  nested.header["account"] = {{"kinetic", 2.0}, {"internal", 1.0}};
  changed.header["account"] = {{"kinetic", 2.5}, {"internal", 1.0}};
  EXPECT_EQ(compare(changed, nested).first, "field 'account/kinetic' is 2.5, on record is 2.0");
  EXPECT_DOUBLE_EQ(compare(changed, nested).size, 0.25);
  nested.header["kind"] = changed.header["kind"] = "finished";  // the last words
  EXPECT_FALSE(compare(changed, nested).first.empty());
  EXPECT_EQ(compare(changed, nested).size, 0);
}

}  // namespace
}  // namespace polynya::exchange
