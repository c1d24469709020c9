#include "core/contact/inheritance.hpp"

#include <algorithm>
#include <limits>

namespace polynya::contact {
namespace {

constexpr double reach_in_radii = 4;    // the corner of a cube is 1.7 from its middle
constexpr double reach_of_share = 1.5;  // a node's force goes to the particles of all elements around it, not to one

struct Heir {
  Vector3 place{};
  double radius = 0;
  PairState* state = nullptr;
};

std::vector<Heir> heirs_of(const Body& primary, const Body& secondary, std::span<const Touch> touches) {
  std::vector<Heir> heirs;
  for (const Touch& touch : touches) {
    const Body& body = touch.swapped ? primary : secondary;
    const auto point = static_cast<std::size_t>(touch.pushed[0]);
    if (touch.kind == Touch::Kind::point && touch.state->born && touch.state->accepted && body.radii[point] > 0)
      heirs.push_back({row(body.positions, point), body.radii[point], touch.state});
  }
  return heirs;
}

void hand_over(const LostForce& lost, std::span<const Heir> heirs) {
  const auto away = [&](const Heir& heir) {
    const double distance = norm(heir.place - lost.place);
    return distance <= reach_in_radii * heir.radius ? distance : std::numeric_limits<double>::infinity();
  };
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (const Heir& heir : heirs) least = std::min(least, away(heir));
  const double reach = std::max(reach_of_share * least, std::numeric_limits<double>::min());
  const auto weight = [&](const Heir& heir) {
    const double distance = away(heir);
    return distance < reach ? reach - distance : 0.0;
  };
  for (const Heir& heir : heirs) sum += weight(heir);
  for (const Heir& heir : heirs)
    if (const double share = weight(heir); share > 0) heir.state->inherited_force += lost.force * (share / sum);
}

}  // namespace

void inherit(const Body& primary, const Body& secondary, std::vector<LostForce> lost, std::span<const Touch> touches) {
  const std::vector<Heir> heirs = heirs_of(primary, secondary, touches);
  if (heirs.empty()) return;
  for (const Touch& touch : touches) {
    const PairState& state = *touch.state;
    const double force = (state.stiffness - touch.stiffness) * (touch.depth - state.offset);
    if (!state.born && force > 0) lost.push_back({state.place, force});
  }
  for (const LostForce& each : lost) hand_over(each, heirs);
}

}  // namespace polynya::contact
