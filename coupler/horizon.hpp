#pragma once
#include "coupler/solid_side.hpp"

namespace polynya::coupler {

/// Time (s) in which two solids surely do not touch, from the positions and velocities of their surfaces alone; 0 when
/// their bounding boxes meet, infinite when they part for good.
///
/// Along an axis on which the boxes are apart by g they close at no more than u, the largest speeds of any vertex of
/// either towards the other, and no faster than u + a t later on. They touch in no less than the time that solves
/// u t + a t^2 / 2 = g. Half of g is used: an elastic wave that arrives at a free surface doubles the surface's speed.
/// `acceleration`: m/s^2, bound for the relative motion by what acts on the bodies from outside (gravity).
double time_apart(const SolidSide& one, const SolidSide& other, double acceleration);

}  // namespace polynya::coupler
