#include "core/contact/contact_law.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/contact/edge_contact.hpp"
#include "core/contact/point_contact.hpp"

namespace polynya::contact {
namespace {

template <class Visit>
void for_each_vertex(const Touch& touch, Visit&& visit) {
  for (std::size_t k = 0; k < 2; ++k)
    if (touch.pushed_weights[k] != 0) visit(!touch.swapped, touch.pushed[k], touch.pushed_weights[k]);
  for (std::size_t k = 0; k < 3; ++k)
    if (touch.opposed_weights[k] != 0) visit(touch.swapped, touch.opposed[k], -touch.opposed_weights[k]);
}

Vector3 tangential(const Vector3& v, const Vector3& normal) {
  return v - (dot(v, normal) / dot(normal, normal)) * normal;
}

double held_energy(const PairState& state, double stiffness, double depth) {
  return 0.5 * stiffness * (depth * depth + state.elastic_slip * state.elastic_slip);
}

}  // namespace

Vector3 relative_velocity(const Body& primary, const Body& secondary, const Touch& touch) {
  Vector3 v{};
  for_each_vertex(touch, [&](bool of_secondary, std::int32_t vertex, double weight) {
    v = v + weight * row((of_secondary ? secondary : primary).velocities, static_cast<std::size_t>(vertex));
  });
  return v;
}

ContactSprings::ContactSprings(const ContactLaw& law) : law_(law) {
  if (!(law.damping >= 0 && law.damping <= 1) || !(law.stiffness_factor > 0))
    throw std::invalid_argument("contact: damping must be 0 to 1 and the stiffness factor above 0");
  // The damping's largest eigenvalue times dt: 2 zeta / sqrt(factor) x 2 factor; an explicit step bears 2.
  if (4 * law.damping * std::sqrt(law.stiffness_factor) > 2)
    throw std::invalid_argument("contact: damping x sqrt(stiffness factor) must not exceed 0.5, it is " +
                                std::to_string(law.damping * std::sqrt(law.stiffness_factor)));
}

void ContactSprings::topology_changed(std::vector<LostForce> lost) {
  lost_ = std::move(lost);
}

void ContactSprings::limit_stiffness(const Body& primary, const Body& secondary, double dt,
                                     std::vector<Touch>& touches) {
  load_primary_.assign(primary.rigid ? 1 : primary.vertex_count(), 0.0);
  load_secondary_.assign(secondary.rigid ? 1 : secondary.vertex_count(), 0.0);
  const auto body = [&](bool of_secondary) -> const Body& { return of_secondary ? secondary : primary; };
  // Of a vertex the sum of stiffness x weight over its mass, of a rigid body that over all of its vertices.
  const auto load = [&](bool of_secondary, std::int32_t v) -> double& {
    return (of_secondary ? load_secondary_ : load_primary_)[body(of_secondary).rigid ? 0 : static_cast<std::size_t>(v)];
  };
  const auto yielding = [&](bool of_secondary, std::int32_t v, double w) {
    return std::abs(w) / body(of_secondary).masses[static_cast<std::size_t>(v)];
  };
  const double rate = law_.stiffness_factor / (dt * dt);
  for (Touch& touch : touches) {
    double compliance = 0;
    for_each_vertex(touch, [&](bool s, std::int32_t v, double w) {
      compliance += (body(s).rigid ? 1.0 : std::abs(w)) * yielding(s, v, w);
    });
    touch.stiffness = touch.share * rate / compliance;
    if (!touch.state->born) touch.stiffness = std::min(touch.stiffness, touch.state->stiffness);
    for_each_vertex(touch,
                    [&](bool s, std::int32_t v, double w) { load(s, v) += touch.stiffness * yielding(s, v, w); });
  }
  for (Touch& touch : touches) {
    double scale = 1;
    for_each_vertex(touch, [&](bool s, std::int32_t v, double) {
      if (const double sum = load(s, v); sum > rate) scale = std::min(scale, rate / sum);
    });
    touch.stiffness *= scale;
  }
}

Vector3 ContactSprings::friction(const Vector3& motion, double normal_force, Touch& touch,
                                 ContactForces& forces) const {
  PairState& state = *touch.state;
  // A spring that turns with the force keeps its length: nothing slid.
  Vector3 slip = tangential(touch.slip, touch.push);
  if (const double length = norm(slip); length > 0)
    slip = (state.elastic_slip / length) * slip;
  else
    forces.released_energy += 0.5 * touch.stiffness * state.elastic_slip * state.elastic_slip;
  slip = slip + tangential(motion, touch.push);
  const double most = law_.friction * normal_force, k = touch.stiffness, stretch = norm(slip);
  double slid = 0;
  if (k * stretch > most) {
    slip = (most / (k * stretch)) * slip;
    slid = stretch - most / k;
  }
  for (std::size_t d = 0; d < 3; ++d) state.slip[d] = dot(slip, touch.frame[d]);
  state.elastic_slip = stretch - slid;
  const double force = k * state.elastic_slip;
  forces.friction_loss += 0.5 * (state.friction_force + force) * slid;
  state.friction_force = force;
  return -k * slip;
}

void ContactSprings::push(const Body& primary, const Body& secondary, double dt, Touch& touch, ContactForces& forces) {
  PairState& state = *touch.state;
  if (state.born) {
    if (state.accepted)
      state.offset = std::clamp(touch.depth - state.inherited_force / touch.stiffness, 0.0, touch.depth);
    if (state.inherited_force > 0)
      forces.released_energy -= held_energy(state, touch.stiffness, touch.depth - state.offset);
    state.stiffness = touch.stiffness;
  }
  state.offset = std::min(state.offset, touch.depth);
  const double compressed = touch.depth - state.offset;
  forces.released_energy +=
      held_energy(state, state.stiffness, compressed) - held_energy(state, touch.stiffness, compressed);
  state.stiffness = touch.stiffness;

  const bool born = state.born;
  const Vector3 velocity = relative_velocity(primary, secondary, touch);
  touch.approach = -dot(touch.push, velocity);
  const double spring = touch.stiffness * compressed;
  if (state.born) forces.released_energy += 0.5 * spring * std::max(0.0, dt * touch.approach - compressed);
  state.born = false;
  touch.damping_force = 0;
  if (compressed > 0 && law_.damping > 0) {
    const double coefficient = 2 * law_.damping * touch.stiffness * dt / std::sqrt(law_.stiffness_factor);
    touch.damping_force = std::max(-spring, coefficient * touch.approach);
  }
  const double along = spring + touch.damping_force;
  state.normal_force = along * norm(touch.push);
  Vector3 force = along * touch.push;
  // Before it was born the pair did not slide.
  if (law_.friction > 0) force = force + friction((born ? 0.0 : dt) * velocity, state.normal_force, touch, forces);

  for_each_vertex(touch, [&](bool of_secondary, std::int32_t v, double weight) {
    add_to_row(of_secondary ? forces.secondary : forces.primary, static_cast<std::size_t>(v), weight * force);
  });
  forces.damping_loss += 0.5 * dt * touch.damping_force * touch.approach;
  state.compressed = compressed;
  const Body& pushed = touch.swapped ? primary : secondary;
  state.place = touch.pushed_weights[0] * row(pushed.positions, static_cast<std::size_t>(touch.pushed[0])) +
                touch.pushed_weights[1] * row(pushed.positions, static_cast<std::size_t>(touch.pushed[1]));
  state.held_energy = held_energy(state, touch.stiffness, compressed);
  forces.stored_energy += state.held_energy;
  forces.deepest = std::max(forces.deepest, compressed);
  if (along > 0) ++forces.active;
}

void ContactSprings::apply(const Body& primary, const Body& secondary, double dt, std::vector<Touch>& touches,
                           ContactForces& forces) {
  forces.primary.assign(primary.positions.size(), 0.0);
  forces.secondary.assign(secondary.positions.size(), 0.0);
  forces.stored_energy = forces.friction_loss = forces.released_energy = forces.deepest = 0;
  forces.active = 0;
  forces.damping_loss = settled_damping_;
  settled_damping_ = 0;
  limit_stiffness(primary, secondary, dt, touches);
  if (lost_) inherit(primary, secondary, *std::exchange(lost_, std::nullopt), touches);
  for (Touch& touch : touches) push(primary, secondary, dt, touch, forces);
}

void ContactSprings::settle(const Body& primary, const Body& secondary, double dt, std::span<const Touch> touches) {
  for (const Touch& touch : touches)
    if (touch.damping_force != 0)
      settled_damping_ -=
          0.5 * dt * touch.damping_force * dot(touch.push, relative_velocity(primary, secondary, touch));
}

void ContactSprings::settle_as_before(double dt, std::span<const Touch> touches) {
  for (const Touch& touch : touches) settled_damping_ += 0.5 * dt * touch.damping_force * touch.approach;
}

}  // namespace polynya::contact
