#include "ice_solver/account.hpp"

#include <numeric>

namespace polynya::ice {
namespace {

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

Account account_of(const IceBody& ice) {
  const continuum::EnergyAccount elements = continuum::energies(ice.solid);
  const IceBooks& books = ice.books;
  Account account;
  account.kinetic = elements.kinetic - books.removed_since_step + books.particle_kinetic;
  account.internal = elements.internal + sum_of(ice.particles.stress_work) + ice.own_contact.stored;
  account.hourglass = elements.hourglass;
  account.viscous = elements.viscous + books.particle_heat.total + ice.own_contact.dissipated;
  account.conversion_heat = books.conversion_heat + books.lost_kinetic;
  account.boundary_flux = elements.boundary_flux;
  account.gravity_work = books.node_gravity_work.total + books.particle_gravity_work.total;
  account.external_work = elements.external_work - books.node_pair_work.total - books.node_gravity_work.total +
                          books.particle_load_work.total + books.prescribed_work;
  account.support_work = elements.support_work;
  account.set_load_work = books.set_load_work.total;
  account.step_change = elements.step_change + books.particle_step_change.total;
  account.momentum = books.momentum;
  account.boundary_impulse = books.boundary_impulse;
  account.gravity_impulse = books.gravity_impulse;
  account.mass = sum_of(ice.solid.masses) + sum_of(ice.particles.points.mass);
  account.broken_mass = books.broken_mass;
  account.converted_elements = static_cast<double>(books.converted.strained + books.converted.collapsed);
  account.particles = static_cast<double>(ice.particles.count());
  return account;
}

const std::vector<std::string>& account_names() {
  static const std::vector<std::string> names{"kinetic",
                                              "internal",
                                              "hourglass",
                                              "viscous",
                                              "conversion_heat",
                                              "boundary_flux",
                                              "external_work",
                                              "support_work",
                                              "set_load_work",
                                              "gravity_work",
                                              "step_change",
                                              "momentum_x",
                                              "momentum_y",
                                              "momentum_z",
                                              "boundary_impulse_x",
                                              "boundary_impulse_y",
                                              "boundary_impulse_z",
                                              "gravity_impulse_z",
                                              "mass",
                                              "broken_mass",
                                              "converted_elements",
                                              "particles"};
  return names;
}

std::vector<double> account_values(const Account& a) {
  return {a.kinetic,
          a.internal,
          a.hourglass,
          a.viscous,
          a.conversion_heat,
          a.boundary_flux,
          a.external_work,
          a.support_work,
          a.set_load_work,
          a.gravity_work,
          a.step_change,
          a.momentum[0],
          a.momentum[1],
          a.momentum[2],
          a.boundary_impulse[0],
          a.boundary_impulse[1],
          a.boundary_impulse[2],
          a.gravity_impulse,
          a.mass,
          a.broken_mass,
          a.converted_elements,
          a.particles};
}

}  // namespace polynya::ice
