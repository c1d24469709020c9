#include "core/contact/penalty_contact.hpp"

#include <algorithm>
#include <utility>

namespace polynya::contact {
namespace {

constexpr double spare = 2;  // margin over the fastest motion of a step, when that exceeds the depth limit

double skin_of(const ContactLaw& law) {
  return law.skin > 0 ? law.skin : law.depth_limit;
}

/// Length that a tenth of the edges fall below, m.
double short_edge(const Body& body) {
  std::vector<double> lengths;
  for (std::size_t t = 0; t < body.triangle_count(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      lengths.push_back(norm(row(body.positions, static_cast<std::size_t>(body.triangles[3 * t + e])) -
                             row(body.positions, static_cast<std::size_t>(body.triangles[3 * t + (e + 1) % 3]))));
  if (lengths.empty()) return 0;
  const auto tenth = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 10);
  std::nth_element(lengths.begin(), tenth, lengths.end());
  return *tenth;
}

double largest_radius(const Body& body) {
  double largest = 0;
  for (const double r : body.radii) largest = std::max(largest, r);
  return largest;
}

}  // namespace

void PenaltyContact::list_state(compute::StateArchive& archive) {
  list_members(archive);
  for (Touch& touch : touches_) touch.state = nullptr;  // only looked at within an evaluation
}

void SelfContact::list_state(compute::StateArchive& archive) {
  list_members(archive);
  for (Touch& touch : touches_) touch.state = nullptr;
}

bool is_finer(const Body& primary, const Body& secondary) {
  return secondary.triangle_count() > 0 && short_edge(primary) < 0.99 * short_edge(secondary);
}

PenaltyContact::PenaltyContact(const ContactLaw& law)
    : law_(law),
      margin_(law.depth_limit),
      secondary_points_({law.depth_limit, law.mirror, false}),
      primary_points_({law.depth_limit, law.mirror, true}),
      springs_(law) {}

void PenaltyContact::set_topology(const Body& primary, const Body& secondary) {
  springs_.settle_as_before(last_step_, touches_);
  touches_.clear();
  if (!std::ranges::equal(primary.triangles, primary_triangles_)) {
    first_ = make_surface_topology(primary.triangles, primary.positions, law_.mirror);
    primary_triangles_.assign(primary.triangles.begin(), primary.triangles.end());
  }
  std::vector<LostForce> lost;
  secondary_points_.set_topology(secondary, primary, lost);
  if (law_.two_way || law_.edges)
    second_ = make_surface_topology(secondary.triangles, secondary.positions, law_.mirror);
  if (law_.two_way) primary_points_.set_topology(primary, secondary, lost);
  if (law_.edges) edges_.set_topology(primary, secondary, first_, second_, lost);
  springs_.topology_changed(std::move(lost));
  outdated_ = true;
}

void PenaltyContact::search(const Body& primary, const Body& secondary) {
  margin_ = std::max(law_.depth_limit, spare * watch_.step_motion());
  const double skin = skin_of(law_), reach = margin_ + skin;
  secondary_points_.search(secondary, primary, first_, {}, reach);
  if (law_.two_way) primary_points_.search(primary, secondary, second_, {}, reach);
  if (law_.edges) edges_.search(primary, secondary, first_, second_, reach);
  watch_.restart(primary, secondary, margin_ + std::max(largest_radius(primary), largest_radius(secondary)), skin);
  outdated_ = false;
  ++searches_;
}

const ContactForces& PenaltyContact::evaluate(const Body& primary, const Body& secondary, double dt) {
  springs_.settle(primary, secondary, dt, touches_);
  if (outdated_) {
    watch_.restart(primary, secondary, margin_, skin_of(law_));
    watch_.outdated(primary, secondary, dt, margin_);  // for the motion of this step
  }
  if (outdated_ || watch_.outdated(primary, secondary, dt, margin_)) search(primary, secondary);
  touches_.clear();
  const double share = law_.two_way ? 0.5 : 1.0;
  secondary_points_.find(secondary, primary, first_, {}, dt, share, touches_);
  if (law_.two_way) primary_points_.find(primary, secondary, second_, {}, dt, share, touches_);
  if (law_.edges) edges_.find(primary, secondary, first_, second_, dt, touches_);
  springs_.apply(primary, secondary, dt, touches_, forces_);
  forces_.released_energy +=
      secondary_points_.take_dropped_energy() + primary_points_.take_dropped_energy() + edges_.take_dropped_energy();
  last_step_ = dt;
  return forces_;
}

SelfContact::SelfContact(const ContactLaw& law)
    : law_(law), margin_(law.depth_limit), points_({law.depth_limit, law.mirror, false}), springs_(law) {}

void SelfContact::set_topology(const Body& body) {
  springs_.settle_as_before(last_step_, touches_);
  touches_.clear();
  topology_ = make_surface_topology(body.triangles, body.positions, law_.mirror);
  std::vector<LostForce> lost;
  points_.set_topology(body, body, lost);
  springs_.topology_changed(std::move(lost));
  outdated_ = true;
}

const ContactForces& SelfContact::evaluate(const Body& body, const Exclusion& exclusion, double dt) {
  springs_.settle(body, body, dt, touches_);
  if (outdated_) {
    watch_.restart(body, body, margin_, skin_of(law_));
    watch_.outdated(body, body, dt, margin_);
  }
  if (outdated_ || watch_.outdated(body, body, dt, margin_)) {
    margin_ = std::max(law_.depth_limit, spare * watch_.step_motion());
    points_.search(body, body, topology_, exclusion, margin_ + skin_of(law_));
    watch_.restart(body, body, margin_ + largest_radius(body), skin_of(law_));
    outdated_ = false;
  }
  touches_.clear();
  points_.find(body, body, topology_, exclusion, dt, 0.5, touches_);  // nodes are looked at on both sides of a gap
  springs_.apply(body, body, dt, touches_, forces_);
  forces_.released_energy += points_.take_dropped_energy();
  for (std::size_t k = 0; k < forces_.secondary.size(); ++k) forces_.secondary[k] += forces_.primary[k];
  forces_.primary.clear();
  last_step_ = dt;
  return forces_;
}

}  // namespace polynya::contact
