#pragma once
#include "fluid_solver/fluid.hpp"

/// A column of water at one end of a tank, let go at once.
namespace polynya::fluid {

/// Water of hydrostatic pressure in x < length, z < height, air of the setup's atmospheric pressure elsewhere, all at
/// rest. Lengths in m, from the tank's lower corner.
void fill_column(Fluid& fluid, double length, double height);

/// How far water reaches along the floor, m: the extent of the lowest layer up to the first cell less than half full,
/// with that cell's part, at the first row of cells along y.
double front_of(const Fluid& fluid);

/// Height of the water at the wall it leant on, m: the extent of the first column of cells likewise.
double height_at_wall(const Fluid& fluid);

}  // namespace polynya::fluid
