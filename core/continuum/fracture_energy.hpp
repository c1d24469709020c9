#pragma once
#include "core/continuum/johnson_holmquist_2.hpp"

/// Crack band after Bazant & Oh 1983: a crack localises in one layer of elements, so the energy that its area takes is
/// the law's energy per volume times the size of the element. The plastic strain to fracture in tension is scaled until
/// that product is the fracture energy of the material, whatever the size.
namespace polynya::continuum {

/// Work per volume (J/m^3) that a point takes up under slow uniaxial tensile stress until a tenth of its strength is
/// left. Near full damage the pressure reaches its cut-off, where the law stretches without shear and without damage:
/// a tail of a few percent of the strength that is not counted.
double tensile_work_to_fracture(const JohnsonHolmquist2& law);

/// The law with the tension_ductility that makes a layer of elements of this size (m) take law.fracture_energy. Throws
/// std::invalid_argument naming the largest size possible, where even a brittle element, by the elastic energy it holds
/// at its strength, would take more.
JohnsonHolmquist2 regularised(JohnsonHolmquist2 law, double size);

}  // namespace polynya::continuum
