#include "coupler/thread_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace polynya;

namespace {

/// Feeds the balance with windows of a machine that is known; returns after so many spans.
void run(coupler::ThreadBalance& balance, int spans,
         const std::function<double(const coupler::ThreadBalance&)>& window) {
  for (int span = 0; span < spans; ++span) {
    const double disturbed = span % 7 == 0 ? 5.0 : 1.0;  // a frame is written
    balance.note(disturbed * window(balance) * (1 + 0.01 * std::sin(3.1 * span)));
  }
}

}  // namespace

TEST(ThreadBalance, GivesMoreThreadsToWhoGainsAndTakesThemFromWhoLoses) {
  coupler::ThreadBalance balance(8, {{"fluid", 8}, {"ice", 1}, {"structure", 4}});
  // The fluid is small and loses by every thread beyond two; the ice gains up to four; the structure does not matter.
  const auto window = [](const coupler::ThreadBalance& b) {
    const double fluid = b.threads("fluid"), ice = b.threads("ice");
    return 4 / std::min(fluid, 2.0) + 0.3 * fluid + 8 / std::min(ice, 4.0) + 0.1 * ice;
  };
  run(balance, 2500, window);
  EXPECT_EQ(balance.threads("fluid"), 2);
  EXPECT_EQ(balance.threads("ice"), 4);
  EXPECT_EQ(balance.threads("structure"), 4);
}

TEST(ThreadBalance, FollowsARunWhoseWorkMoves) {
  coupler::ThreadBalance balance(2, {{"fluid", 2}, {"ice", 1}});
  run(balance, 1500, [](const coupler::ThreadBalance& b) { return b.threads("ice") == 1 ? 1.0 : 1.2; });
  EXPECT_EQ(balance.threads("ice"), 1);
  run(balance, 1500, [](const coupler::ThreadBalance& b) { return b.threads("ice") == 1 ? 1.2 : 1.0; });
  EXPECT_EQ(balance.threads("ice"), 2);
}

TEST(ThreadBalance, KeepsWithinTheCoresAndLeavesASingleCoreAlone) {
  coupler::ThreadBalance one(1, {{"fluid", 1}, {"ice", 1}}), three(3, {{"fluid", 3}, {"ice", 1}});
  for (int span = 0; span < 5000; ++span) {
    EXPECT_TRUE(one.note(1.0 / (1 + span)).empty());
    for (const std::string& name : three.note(1.0 / (1 + span))) {
      EXPECT_GE(three.threads(name), 1);
      EXPECT_LE(three.threads(name), 3);
    }
  }
}
