#pragma once
#include "core/scene/scene.hpp"

namespace polynya::structure {

/// The default vehicle (5 g, hollow aluminium, ogive head) with nothing around it.
inline scene::Scene vehicle_scene() {
  scene::Scene scene;
  scene.symmetry = scene::Symmetry::quarter;
  scene.run.end_time = 1e-3;
  scene.run.step_factor = 0.9;
  scene.resolution.vehicle_element = 2e-3;
  scene::Vehicle vehicle;
  vehicle.head = "ogive";
  vehicle.head_length = 0.01;
  vehicle.diameter = 0.01;
  vehicle.length = 0.1;
  vehicle.interior = "hollow";
  vehicle.mass = 0.005;
  vehicle.material = "aluminium";
  vehicle.speed = 40;
  vehicle.nose_position = -0.004;
  scene.vehicle = vehicle;
  scene::MaterialCard card;
  card.name = "aluminium";
  card.law = "elastic";
  card.values = {{"density", 2700}, {"youngs_modulus", 68.9e9}, {"poisson_ratio", 0.33}};
  scene.materials["aluminium"] = card;
  return scene;
}

inline scene::Scene solid_scene() {
  scene::Scene scene = vehicle_scene();
  scene.vehicle->interior = "solid";
  scene.vehicle->mass = 0;
  return scene;
}

}  // namespace polynya::structure
