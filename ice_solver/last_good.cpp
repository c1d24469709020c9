#include "ice_solver/last_good.hpp"

#include <sstream>
#include <stdexcept>

#include "core/continuum/bad_element.hpp"

namespace polynya::ice {
namespace {

constexpr long interval = 20;  // steps

}  // namespace

void LastGood::keep(const IceBody& ice) {
  time_ = ice.solid.time;
  positions_ = ice.solid.positions;
  velocities_ = ice.solid.velocities;
  living_elements_ = ice.solid.living_elements;
  element_ = ice.solid.element;
  particles_ = ice.particles;
}

void LastGood::put_back(IceBody& ice) const {
  ice.solid.time = time_;
  ice.solid.positions = positions_;
  ice.solid.velocities = velocities_;
  ice.solid.living_elements = living_elements_;
  ice.solid.element = element_;
  ice.particles = particles_;
}

void LastGood::internal_forces(IceBody& ice, double dt, IceFrames& frames) {
  try {
    ice::internal_forces(ice, dt);
  } catch (const continuum::BadElement& bad) {
    std::ostringstream text;
    text << bad.what();
    if (time_ >= 0) {
      put_back(ice);
      if (frames.last_time() < time_) frames.write(static_cast<int>(frames.count()), ice);
      text << "; the last good state kept, of time " << time_ << " s, is the last frame in " << frames.folder();
    }
    throw std::runtime_error(text.str());
  }
  if (++steps_ % interval == 0) keep(ice);
}

}  // namespace polynya::ice
