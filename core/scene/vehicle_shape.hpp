#pragma once
#include "core/scene/scene.hpp"

namespace polynya::scene {

/// Radius of the vehicle (m) at a distance behind the nose (m). Ogive: tangent ogive, an arc that meets the cylinder
/// smoothly; ellipsoid and hemisphere: quarter ellipse. Of a hull from a file: half of its largest extent across.
double hull_radius(const Vehicle& vehicle, double distance_from_nose);

/// How far (m) the vehicle at its start reaches above its nose, and below it: its angle lifts the edge of a blunt head.
double highest_above_nose(const Vehicle& vehicle);
double lowest_below_nose(const Vehicle& vehicle);

/// Thickest wall (m) that leaves a cavity: 0.9 of the radius and of the sharpest curvature of the head's outline.
double thickest_wall(const Vehicle& vehicle);

/// Volume (m^3) inside the outer hull.
double hull_volume(const Vehicle& vehicle);

/// Volume (m^3) of material between the hull and a cavity whose radius is smaller by the wall everywhere and that stops
/// one wall before the tail. An estimate: the mesh of the vehicle decides.
double shell_volume(const Vehicle& vehicle, double wall);

/// Wall (m) that gives the vehicle's mass at this density; 0 if even a solid vehicle is lighter.
double wall_from_mass(const Vehicle& vehicle, double density);

}  // namespace polynya::scene
