#pragma once
#include <array>

#include "fluid_solver/equation_of_state.hpp"

namespace polynya::fluid {

/// Two materials that share a volume.
struct Mixture {
  std::array<double, 2> mass{}, energy{}, volume{};
};

/// Pressure and stiffness at one point. `bulk_modulus` is 0 where the pressure rests on its lower bound.
struct PointState {
  double pressure = 0, bulk_modulus = 0, sound_speed = 0;
};

/// One material: pressure not below `floor`.
PointState point_state(const EquationOfState& law, double floor, double mass, double energy, double volume);

/// Lets the two materials exchange volume until their pressures agree. What the one gives of its energy the other
/// takes: mass, volume and total energy are conserved to rounding. Of two gases the one that expands keeps its entropy,
/// and what is dissipated heats the one that is compressed, as a shock does; else the energy that goes with the volume
/// is that of the softer material's initial pressure.
PointState equilibrate(const std::array<EquationOfState, 2>& law, const std::array<double, 2>& floor, Mixture& mixture);

/// The state of a volume with one or two materials: dormant traces are set aside, the rest comes to equilibrium. The
/// volumes are made to fill `volume`.
PointState settle(const std::array<EquationOfState, 2>& law, const std::array<double, 2>& floor, double volume,
                  Mixture& mixture);

/// How the two materials share a change of the common volume: by their compliances, so that their pressures stay
/// together; by their fractions when the change is large or neither resists.
std::array<double, 2> volume_shares(const std::array<EquationOfState, 2>& law, const std::array<double, 2>& floor,
                                    const Mixture& mixture, double change);

/// Below this fraction of the volume a material is carried along but takes no part in the pressure.
inline constexpr double dormant_fraction = 1e-9;

/// Fluid thinner than this is a void: traces left by rounding, whose energy per mass tells nothing. Vapour fills it:
/// its pressure is the lower bound of water's. kg/m^3
inline constexpr double void_density = 1e-6;

/// Around fluid thinner than this, an eightieth of air at the atmosphere's pressure, dense fluid may pass through a node
/// in a step that holds next to nothing itself. kg/m^3
inline constexpr double thin_density = 0.015;

}  // namespace polynya::fluid
