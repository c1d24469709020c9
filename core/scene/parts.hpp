#pragma once
#include "core/scene/resolve.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/values.hpp"

/// The parts of a scene, each filled in from the file's values and checked as far as it stands alone. Internal to the
/// library.
namespace polynya::scene {

Vehicle read_vehicle(const Values& values);
/// Fills in the hull of a file and its box (needs the scene's folder for its path); vehicle without a file: nothing.
void read_hull_file(const Values& values, Vehicle& vehicle);
/// Metres per unit of a file of a surface; refuses "none".
double file_unit(const Values& values, const std::string& key);
/// The smallest symmetry that the start of the vehicle allows: quarter unless it lies or moves askew.
Symmetry natural_symmetry(const Values& values);
/// Point masses; refuses what the symmetry or a deformable vehicle does not allow. Needs place and effects.
void check_start(const Values& values, const Scene& scene);
/// Checks the hull against its material; needs the card.
void check_hull(const Values& values, const Vehicle& vehicle, const MaterialCard& card);
/// mesh: facts of the ice's mesh file (JSON), where the scene names one.
Ice read_ice(const Values& values, const std::string& mesh);
/// Fills in the mesh of a file and its box; ice without a file: nothing.
void read_ice_mesh(const Values& values, const std::string& facts, Ice& ice);
/// All of it but the planes of symmetry.
WantedMesh read_wanted_mesh(const Values& values);
Tube read_tube(const Values& values);
/// Fills scene.fluid with the tank and its column.
void read_dam(const Values& values, Scene& scene);
/// Fills in the fluid's bodies with what they pass through; needs the end of the run.
void read_bodies(const Values& values, Scene& scene);
/// Half width of the fluid about the axis that bodies pass through, with room about them, and the largest extent of a
/// body, m.
double reach_of_bodies(const Scene& scene);
double largest_body(const Scene& scene);
/// The smallest symmetry that all bodies allow: quarter unless one lies, is turned or moves askew.
Symmetry symmetry_of_bodies(const Values& values);
/// Refuses bodies outside the fluid, across planes of symmetry they have not, or that meet. Needs the fluid's extent.
void check_bodies(const Values& values, const Scene& scene);
/// z of the nose and checks against ice and water.
void place_vehicle(const Values& values, Scene& scene);
/// Latest end, frame interval.
void read_run(const Values& values, Scene& scene);
void read_resolution(const Values& values, Scene& scene);
/// Extent of the fluid; needs the vehicle's place and the end of the run.
void read_fluid(const Values& values, Scene& scene);
/// How the fluid's grid moves; needs vehicle, ice, symmetry and fluid.
void read_grid_motion(const Values& values, Scene& scene);
/// What is recorded; needs the participants.
void read_record(const Values& values, Scene& scene);
/// z of the undisturbed free surface: floating draught of the ice, or as given; 0 without water.
double waterline(const Values& values, const Scene& scene);

}  // namespace polynya::scene
