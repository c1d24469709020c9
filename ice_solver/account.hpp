#pragma once
#include <string>
#include <vector>

#include "ice_solver/ice_body.hpp"

namespace polynya::ice {

/// The books of the ice at t(n), of the modelled part. Energies in J since the start; their balance is constant:
///   kinetic + internal + hourglass + viscous + conversion_heat + boundary_flux
///     - external_work - gravity_work - step_change
struct Account {
  double kinetic = 0;
  double internal =
      0;  ///< work of the stress in elements and particles, and what springs of the ice's own contact hold
  double hourglass = 0;
  double viscous =
      0;  ///< bulk viscosity of elements, artificial viscosity of particles, losses of the ice's own contact
  double conversion_heat =
      0;                     ///< motion within elements that became particles; all motion of those that became nothing
  double boundary_flux = 0;  ///< out through non-reflecting sides
  double external_work = 0;  ///< done by loads and by what holds prescribed nodes
  double support_work = 0;   ///< the part of external_work that supports do which move
  double set_load_work = 0;  ///< the part of external_work that prescribed loads on sets do
  double gravity_work = 0;
  double step_change = 0;                                ///< see continuum::EnergyAccount
  std::array<double, 3> momentum{}, boundary_impulse{};  ///< N s, at t(n+1/2)
  double gravity_impulse = 0;                            ///< N s, along z, at t(n+1/2)
  double mass = 0, broken_mass = 0;                      ///< kg
  double converted_elements = 0, particles = 0;

  double balance() const {
    return kinetic + internal + hourglass + viscous + conversion_heat + boundary_flux - external_work - gravity_work -
           step_change;
  }
};

Account account_of(const IceBody& ice);

/// The account as the coupler reads it.
const std::vector<std::string>& account_names();
std::vector<double> account_values(const Account& account);

}  // namespace polynya::ice
