#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// The resolved scene: every quantity in SI, every default filled in, every choice made. Written by `resolve_scene`
/// as RUN/scene.json and read by every executable.
namespace polynya::scene {

enum class Symmetry { full, half, quarter };  ///< half: y >= 0 is modelled; quarter: x >= 0 and y >= 0.

/// A named physical effect, the user's wish and what was decided.
struct Effect {
  std::string requested;  ///< "auto", "on" or "off"
  bool active = false;
  std::string reason;  ///< why it is on or off, a whole sentence
};

/// A constitutive law or equation of state with its constants (SI) and where each came from.
struct MaterialCard {
  std::string name;  ///< "ice.paper"
  std::string law;   ///< "elastic", "j2_plastic", "johnson_holmquist_2", "mie_grueneisen", "linear_polynomial",
                     ///< "ideal_gas", "stiffened_gas", "tait"; docs/scene.md lists the values of each
  std::map<std::string, double> values;       ///< "density", "shear_modulus", ... SI
  std::map<std::string, std::string> origin;  ///< per value: "literature: ...", "calibrated: ...", "assumed: ..."

  /// A value by name. std::runtime_error naming card and value if it is absent (unlimited values are absent).
  double value(const std::string& key) const;
  bool has(const std::string& key) const { return values.contains(key); }
};

struct Run {
  std::string end;            ///< "ice_passed", "exited" or "time"
  double end_time = 0;        ///< s, latest end
  double frame_interval = 0;  ///< s, between field frames
  double step_factor = 0;     ///< fraction of the stable step that the solids use
  double fluid_step_factor = 0;
  double filter_frequency = 0;  ///< Hz, low-pass of the reported deceleration
  double gravity = 0;           ///< m/s^2, along -z
  double join_timeout = 0;      ///< s, longest wait for all participants of a coupled run
  long seed = 0;
};

struct Resolution {
  double cell = 0;                 ///< m, fluid cell in the fine region
  double ice_element = 0;          ///< m, ice element in the fine region
  double vehicle_element = 0;      ///< m, along the vehicle
  double fine_radius = 0;          ///< m, half width of the fluid's fine region about the axis
  double ice_fine_radius = 0;      ///< m, half width of the ice's fine region about the axis
  double growth = 0;               ///< ratio of neighbouring cells outside
  double largest_ice_element = 0;  ///< m, limit of the growth in the ice
};

/// The hull of a rigid vehicle from a file; geometry/hull/import_hull.hpp says what happens to it.
struct HullFile {
  std::string file;                        ///< full path
  double unit = 0;                         ///< m per unit of the file
  std::string nose;                        ///< direction of the nose in the file: "x", "-x", "y", "-y", "z" or "-z"
  std::string repair;                      ///< "none", "safe" or "wrap"
  double wrap_alpha = 0, wrap_offset = 0;  ///< m; 0: from the size
  double volume = 0;                       ///< m^3, of the material
  std::string note;                        ///< what was found and done, whole sentences
};

struct Vehicle {
  std::string head;                                  ///< "ogive", "hemisphere", "ellipsoid"; "imported": of `surface`
  double head_length = 0, diameter = 0, length = 0;  ///< m
  std::string interior;                              ///< "solid" or "hollow"
  double wall_thickness = 0;  ///< m; 0: from mass (hollow). Never both 0 when hollow, never both given.
  double mass = 0;            ///< kg of the full vehicle; 0: from the material's density (solid) or the wall (hollow).
                              ///< A solid vehicle with a mass gets the density mass / volume.
  std::string material;       ///< key into Scene::materials
  double speed = 0;           ///< m/s, along its axis, nose first
  double nose_position = 0;   ///< m, z of the nose at the start
  double angle = 0;           ///< rad, of the axis from the vertical towards +x
  double offset_x = 0, offset_y = 0;  ///< m, of the nose at the start
  double spin = 0;                    ///< rad/s, about the axis, right-handed about the direction of the nose
  double pitch_rate = 0;              ///< rad/s, about +y: of the nose towards +x
  std::vector<double> ballast;        ///< [n][4]: kg, and m from the nose of the upright vehicle; of a rigid one
  std::optional<HullFile> surface;    ///< then length and diameter are those of its box
  bool deformable = true;
};

/// Prescribed bending of an ice beam between rollers (four-point: two supports below, two loads above).
struct Bending {
  double support_span = 0, load_span = 0;  ///< m
  double speed = 0;                        ///< m/s of the loading rollers, downward
  double ramp_time = 0;                    ///< s to reach it
};

/// A ball of ice that falls on a rigid, smooth plate at z = lower_face.
struct Ball {
  double diameter = 0;  ///< m
  double speed = 0;     ///< m/s, downward
};

/// Hexahedra from a file. The launcher reads it into RUN/ice_mesh.h5 (core/results/mesh_file.hpp); the facts are its.
/// A row of numbers over time, SI: linear between its entries, the last one lasts.
struct Curve {
  std::vector<double> times;  ///< s, rising, the first 0
  std::vector<double> rows;   ///< [times][components]
};

struct IceMesh {
  std::string file;               ///< full path
  std::string unit;               ///< of its coordinates: "m", "mm", ...
  long pieces = 1;                ///< without a common face that it may fall into
  std::vector<double> low, high;  ///< [3] m, corners of its box
  long elements = 0, nodes = 0, boundary_faces = 0;
  double volume = 0;                            ///< m^3, of the modelled part
  double thinnest = 0;                          ///< m, smallest volume over largest face of an element
  double velocity = 0;                          ///< m/s, of all of it at the start, along z; held components keep it
  std::map<std::string, std::string> supports;  ///< by the name of a set: "x", "xyz", ... or "non_reflecting"
  std::map<std::string, Curve> pressures;       ///< Pa, by the name of a set: on its faces
  std::map<std::string, Curve> forces;          ///< N (x, y, z), by the name of a set: on the modelled part of it
};

struct Ice {
  double length = 0, width = 0, thickness = 0;  ///< m, of the full plate (x, y, z)
  double lower_face = 0;                        ///< m, z of the lower face
  std::string material;
  double critical_strain = 0;
  double flaws = 0;               ///< largest damage that elements start with, drawn evenly from 0 by run.seed
  std::string sides;              ///< "non_reflecting", "free", "clamped" or "clamped_ends"
  double damping = 0;             ///< 1/s, force over mass and velocity; 0: none
  double held_rim = 0;            ///< m, width of a rim of the upper face whose nodes are held; 0: none
  std::string start;              ///< "equilibrium" with the loads it starts under, or "unloaded"
  std::string equilibrium;        ///< how it is found: "auto", "newton" or "relaxation"
  std::string particles;          ///< what a converted element becomes: "element_centre", "free_masses" or "none"
  std::string integration;        ///< points per element: "one_point" or "full" (2 x 2 x 2)
  double sleeping_threshold = 0;  ///< relative disturbance below which elements sleep; 0: none does
  std::optional<Bending> bending;
  std::optional<Ball> ball;
  std::optional<IceMesh> mesh;  ///< then the sizes are those of its box, mirrored at x = 0 and y = 0
};

/// One side of a shock tube along x.
struct TubeState {
  std::string material;
  double density = 0, velocity = 0, pressure = 0;
};
struct Tube {
  double length = 0, diaphragm = 0;  ///< m
  TubeState left, right;
};

/// A column of water at x = 0 in a tank, one cell thick along y, that is let go at once.
struct Dam {
  double length = 0, height = 0;  ///< m, of the column; the tank's are those of the fluid
};

/// How the two ends of the fluid's grid move along one axis; planes between keep their share of the way. Displacement:
/// speed times time plus a table.
struct AxisMotion {
  double lower_speed = 0, upper_speed = 0;                            ///< m/s
  std::vector<double> times, lower_displacement, upper_displacement;  ///< s and m; empty or of one length, from 0 and 0
};

struct GridMotion {
  AxisMotion x, y, z;
};

/// A rigid body in the fluid whose motion is prescribed (core/scene/body_motion.hpp).
struct Body {
  std::string shape;                                       ///< "sphere", "cylinder", "box", "wedge" or "file"
  double diameter = 0, length = 0, width = 0, height = 0;  ///< m, those of the shape; else 0
  std::string file;                                        ///< full path
  double unit = 0;                                         ///< m per unit of the file
  std::vector<double> position;                            ///< [3] m, of the reference point at the start
  std::vector<double> angles;                              ///< [3] rad, turned about x, then y, then z
  std::vector<double> times, velocity;  ///< s from 0 on, and [times][3] m/s: linear between, held after the last
  std::string rotation_axis;            ///< "x", "y" or "z", through the reference point
  std::vector<double> rotation_times, rotation_rate;  ///< s and rad/s, likewise
  std::vector<double> low, high;                      ///< [3] m, corners of the box that it passes through
  double size = 0;                                    ///< m, its largest extent at the start
  double volume = 0;                                  ///< m^3
};

struct Fluid {
  double length = 0, width = 0;     ///< m, lateral extent of the full domain (x, y)
  double bottom = 0, top = 0;       ///< m, z
  double waterline = 0;             ///< m, z of the undisturbed free surface
  std::string water, air;           ///< keys into Scene::materials
  double atmospheric_pressure = 0;  ///< Pa
  double vapour_pressure = 0;       ///< Pa, absolute; lower bound of the pressure of water
  std::string start;                ///< "potential_flow" or "impulsive"
  std::string outer_boundary;       ///< "non_reflecting" or "wall"
  std::string shock_viscosity;      ///< "limited" or "reference"
  std::string sweeps;               ///< "alternating" or "all_orders"
  std::optional<GridMotion> grid_motion;
  std::string grid_follows;       ///< "none" or "vehicle": whose mean speed along z the grid takes
  double sleeping_threshold = 0;  ///< relative disturbance below which cells sleep; 0: none does
  std::optional<Dam> dam;         ///< then the fluid is a tank with walls, x from 0 to length, z from 0 to top
  std::optional<std::map<std::string, Body>> bodies;  ///< by name; absent: none
  std::optional<Tube> tube;  ///< then the fluid is a one-dimensional tube and nothing else above holds
};

struct Contact {
  double friction = 0;           ///< Coulomb coefficient
  double stiffness_factor = 0;   ///< of the bound m / dt_window^2
  double damping = 0;            ///< fraction of critical
  std::string two_way = "auto";  ///< "auto", "on" or "off": the vehicle's vertices against the ice's surface as well
  std::string edges = "auto";    ///< "auto", "on" or "off": edges against edges
};

/// How solids cut the fluid's grid.
struct OverlapCut {
  std::string method = "packed";  ///< "packed": doubles, what is uncertain exactly; "exact": exact numbers throughout
};

/// Checkpoints, whichever comes first; 0: never.
struct Checkpoint {
  double interval = 0;       ///< s of simulated time
  double wall_interval = 0;  ///< s of wall time
};

/// The interface on record (core/exchange/recorder.hpp); only what differs from "all of it" is there.
struct Record {
  std::string participants;  ///< names between commas; empty: all
  /// Intervals: [from, to, from, to, ...], s and numbers; the last one open where its end is missing; empty: all.
  std::vector<double> times;
  std::vector<std::int64_t> windows;
  std::string compression = "none";  ///< "none" or "deflate"
  /// m; sides of the box that vertices, cells and faces must lie in.
  std::optional<double> x_min, x_max, y_min, y_max, z_min, z_max;

  bool has_region() const { return x_min || x_max || y_min || y_max || z_min || z_max; }
};

struct ParticipantCommand {
  std::string command;  ///< empty: the project's own executable
  std::string launch;   ///< put in front of the command
  int threads = 0;      ///< for all of the run; 0: what the coupler finds best
};

struct Scene {
  std::string title, name, level;
  Symmetry symmetry = Symmetry::full;
  Run run;
  Resolution resolution;
  std::optional<Vehicle> vehicle;
  std::optional<Ice> ice;
  std::optional<Fluid> fluid;
  Contact contact;
  OverlapCut overlap;
  Checkpoint checkpoint;
  std::optional<Record> record;  ///< absent: nothing is recorded
  std::map<std::string, MaterialCard> materials;
  std::map<std::string, Effect> effects;  ///< "fluid", "conversion", "friction", ...: all of docs/scene.md, always
  std::map<std::string, ParticipantCommand> participants;  ///< those this scene needs of "structure", "ice", "fluid"

  bool effect(const std::string& name) const;  ///< active? std::out_of_range if there is no such effect
  const MaterialCard& material(const std::string& name) const;  ///< std::out_of_range if there is no such card
};

/// Reads RUN/scene.json. Throws std::runtime_error naming the file and the key at fault.
Scene load_resolved_scene(const std::string& path);
/// std::runtime_error naming the key that is missing or of the wrong type.
Scene from_json(const nlohmann::json& resolved);
nlohmann::json to_json(const Scene& scene);

}  // namespace polynya::scene
