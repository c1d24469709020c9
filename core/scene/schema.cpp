#include "core/scene/schema.hpp"

#include <sstream>

#include "core/scene/effects.hpp"

namespace polynya::scene {
namespace {

namespace dim = dimension;
constexpr double infinity = std::numeric_limits<double>::infinity();

KeyRule number(std::string path, Dimension d, std::string fallback, std::string meaning, double lower = -infinity,
               double upper = infinity) {
  return {.path = std::move(path),
          .kind = Kind::quantity,
          .dimension = d,
          .fallback = std::move(fallback),
          .meaning = std::move(meaning),
          .lower = lower,
          .upper = upper,
          .lower_open = false,
          .choices = {}};
}

/// A number above zero.
KeyRule positive(std::string path, Dimension d, std::string fallback, std::string meaning, double upper = infinity) {
  auto rule = number(std::move(path), d, std::move(fallback), std::move(meaning), 0, upper);
  rule.lower_open = true;
  return rule;
}

KeyRule choice(std::string path, std::vector<std::string> choices, std::string fallback, std::string meaning) {
  KeyRule rule;
  rule.path = std::move(path), rule.kind = Kind::choice, rule.fallback = std::move(fallback);
  rule.meaning = std::move(meaning), rule.choices = std::move(choices);
  return rule;
}

KeyRule text(std::string path, std::string fallback, std::string meaning) {
  KeyRule rule;
  rule.path = std::move(path), rule.kind = Kind::text, rule.fallback = std::move(fallback);
  rule.meaning = std::move(meaning);
  return rule;
}

KeyRule integer(std::string path, std::string fallback, std::string meaning, double lower) {
  auto rule = number(std::move(path), dim::none, std::move(fallback), std::move(meaning), lower);
  rule.kind = Kind::integer;
  return rule;
}

std::vector<KeyRule> general_rules() {
  return {
      text("title", "the case's name", "one line about the scene"),
      choice("symmetry", {"auto", "full", "half", "quarter"}, "auto",
             "modelled part: half is y >= 0, quarter x >= 0 and y >= 0; auto: quarter (a tube or a dam: full; with a "
             "vehicle or bodies as far as they and their motion allow)"),
      choice("run.end", {"auto", "ice_passed", "exited", "time"}, "auto",
             "what ends the run before `end_time`: nose past the ice, tail above the ice (without ice: above the "
             "waterline); "
             "auto: ice_passed with vehicle and ice, exited with a vehicle in water, else time"),
      positive("run.end_time", dim::time, "auto",
               "latest end; auto: 1.5 (gap + head + 2.6 thickness) / speed, or 1.5 times the way out of the water"),
      positive("run.frame_interval", dim::time, "auto", "between field frames; auto: a thirtieth of `end_time`"),
      positive("run.step_factor", dim::none, "0.9", "fraction of the stable step that the solids use", 1),
      positive("run.fluid_step_factor", dim::none, "1",
               "fraction of the fluid's stable step (half a cell per sound and flow speed) that it uses", 1),
      positive("run.filter_frequency", dim::frequency, "20 kHz", "low-pass filter of the reported deceleration"),
      positive("run.join_timeout", dim::time, "60 s", "longest wait for all participants to join a coupled run"),
      number("run.gravity", dim::acceleration, "9.81 m/s^2", "along -z", 0),
      integer("run.seed", "1", "of every random choice", 0),
      positive("resolution.cell", dim::length, "2 mm", "fluid cell in the fine region"),
      positive("resolution.ice_element", dim::length, "auto", "ice element in the fine region; auto: `cell`"),
      positive("resolution.vehicle_element", dim::length, "auto",
               "along the vehicle; auto: the smaller of `cell` and a tenth of the diameter"),
      positive("resolution.fine_radius", dim::length, "auto",
               "half width of the fluid's fine region about the axis; auto: 2 diameters; with bodies as far as they "
               "reach and half of the largest"),
      positive("resolution.ice_fine_radius", dim::length, "auto",
               "half width of the ice's fine region about the axis; auto: 3 diameters"),
      number("resolution.growth", dim::none, "1.15", "largest ratio of neighbouring cells outside", 1, 2),
      positive("resolution.largest_ice_element", dim::length, "10 mm", "limit of the growth in the ice"),
  };
}

std::vector<KeyRule> solid_rules() {
  return {
      choice("vehicle.head", {"ogive", "hemisphere", "ellipsoid"}, "ogive",
             "profile of the head, a body of revolution"),
      positive("vehicle.head_length", dim::length, "auto", "auto: the diameter (a hemisphere: half of it)"),
      positive("vehicle.diameter", dim::length, "10 mm", "of the cylinder"),
      positive("vehicle.length", dim::length, "100 mm", "head included"),
      choice("vehicle.interior", {"hollow", "solid"}, "hollow", "a hollow hull is closed and dry"),
      number("vehicle.wall_thickness", dim::length, "0", "of a hollow hull; 0: from `mass`", 0),
      number("vehicle.mass", dim::mass, "0",
             "of the full vehicle; 0: from the material's density. A solid vehicle with a mass gets another density",
             0),
      text("vehicle.material", "aluminium", "card, law elastic or j2_plastic"),
      number("vehicle.speed", dim::speed, "40 m/s", "along its axis, nose first, at the start", 0, 1000),
      number("vehicle.nose_position", dim::length, "auto",
             "z of the nose at the start; auto: 4 mm below the ice, or below the waterline without ice"),
      number("vehicle.angle", dim::none, "0", "of the axis from the vertical towards +x, e.g. \"20 deg\"; not quarter",
             -1.3, 1.3),
      number("vehicle.offset_x", dim::length, "0", "of the nose from the z axis; not quarter"),
      number("vehicle.offset_y", dim::length, "0", "likewise; full only"),
      number("vehicle.spin", dim::frequency, "0",
             "about its axis, right-handed, e.g. \"100 rad/s\"; full only, rigid only"),
      number("vehicle.pitch_rate", dim::frequency, "0", "of the nose towards +x; not quarter, rigid only"),
      text("vehicle.ballast", "none",
           "point masses of a rigid vehicle, from the nose of the upright one: \"1 g at 0, 0, -30 mm; ...\""),
      text("vehicle.surface_file", "none",
           "hull of a rigid vehicle: STL, OBJ or PLY file, relative to the scene; full only; instead of head, "
           "head_length, diameter, length, interior and wall_thickness"),
      choice("vehicle.file_unit", {"none", "m", "cm", "mm", "um", "in", "ft"}, "none",
             "unit of its coordinates; must be given with surface_file"),
      choice("vehicle.file_nose", {"x", "-x", "y", "-y", "z", "-z"}, "z", "direction of the nose in the file"),
      choice("vehicle.repair", {"none", "safe", "wrap"}, "safe",
             "of the file's surface; safe: double points and triangles, orientation; wrap: if that is not enough, a "
             "closed surface around it"),
      number("vehicle.wrap_alpha", dim::length, "auto",
             "gaps of the file's surface up to twice as wide are wrapped over; auto: a fiftieth of its diagonal", 0),
      number("vehicle.wrap_offset", dim::length, "auto", "of the wrap; auto: a thirtieth of wrap_alpha", 0),
      positive("ice.length", dim::length, "200 mm", "along x, of the full plate"),
      positive("ice.width", dim::length, "200 mm", "along y, of the full plate"),
      positive("ice.thickness", dim::length, "10 mm", "along z"),
      number("ice.lower_face", dim::length, "0", "z of the lower face"),
      text("ice.mesh", "none",
           "hexahedra from a file of Gmsh (.msh) or Abaqus (.inp), relative to the scene, instead of length, width, "
           "thickness and lower_face; it lies where its coordinates say"),
      choice("ice.mesh_unit", {"none", "m", "cm", "mm", "um", "in", "ft"}, "none",
             "unit of its coordinates; must be given with mesh"),
      integer("ice.mesh_pieces", "1", "parts without a common face that the mesh may fall into", 1),
      number("ice.velocity", dim::speed, "0",
             "of a mesh at the start, along z; components that a support holds keep it: supports move", -1000, 1000),
      text("ice.supports.NAME", "none",
           "what holds the nodes of NAME, a set of nodes or elements or a physical group of the mesh: components "
           "such as \"z\" or \"xyz\"; or \"non_reflecting\": waves leave through its faces"),
      text("ice.pressures.NAME", "none",
           "on the faces of the set NAME, inward: \"20 kPa\", or over time \"0 at 0; 20 kPa at 1 ms\""),
      text("ice.forces.NAME", "none",
           "on the set NAME as a whole, spread over its faces, or without faces over its nodes: \"0, 0, -10 N\", or over "
           "time \"0, 0, 0 at 0; 0, 0, -10 N at 1 ms\""),
      text("ice.material", "ice.paper", "card, law johnson_holmquist_2, j2_plastic or elastic"),
      positive("ice.critical_strain", dim::none, "0.35", "effective strain at which an element becomes a particle"),
      number("ice.flaws", dim::none, "0",
             "largest damage that elements start with, drawn evenly from 0 to it by run.seed; law johnson_holmquist_2 only", 0,
             0.5),
      choice(
          "ice.sides", {"auto", "non_reflecting", "free", "clamped", "clamped_ends"}, "auto",
          "lateral faces; clamped_ends: held at the ends along x, sliding in the faces across y (plane strain); auto: "
          "non_reflecting, free for a beam or a mesh from a file, where it means faces in the sides of its box"),
      number("ice.damping", dim::frequency, "0",
             "of all motion of a plate that is to come to rest: force over mass and velocity; not beside a vehicle", 0),
      number("ice.held_rim", dim::length, "0",
             "width of a rim along the sides of the upper face (away from the vehicle) that is held; 0: none", 0),
      choice(
          "ice.start", {"auto", "equilibrium", "unloaded"}, "auto",
          "stress at the start: in equilibrium with water and weight, or none; auto: equilibrium for ice that floats "
          "on water at rest"),
      choice(
          "ice.equilibrium", {"auto", "newton", "relaxation"}, "auto",
          "how that start is found: Newton's method, to rounding; dynamic relaxation, to 1e-6 of the largest load on "
          "a node; auto: Newton's up to 3,000 nodes, relaxation above and where Newton's finds none"),
      choice("ice.particles", {"element_centre", "free_masses", "none"}, "element_centre",
             "what a failed element becomes: an SPH particle at its centre; a mass there that meets the vehicle only; "
             "nothing, its mass and motion leave"),
      choice(
          "ice.integration", {"one_point", "full"}, "one_point",
          "points of an element at which the law is asked: its centre, with forces against hourglass modes; or 2 x 2 x "
          "2 without such forces, slower, for comparison"),
      positive(
          "ice.sleeping_threshold", dim::none, "1e-7",
          "disturbance below which chunks of elements that nothing has moved yet sleep: the speed over wave speed that "
          "unbalanced forces would give a node in 1,000 steps",
          1e-3),
      positive("ice.ball.diameter", dim::length, "required",
               "of a ball of ice that falls on a rigid, smooth plate at `lower_face`, instead of a plate of ice"),
      positive("ice.ball.speed", dim::speed, "required", "of the ball, downward", 1000),
      positive("ice.bending.support_span", dim::length, "required", "between the two lower rollers"),
      positive("ice.bending.load_span", dim::length, "required", "between the two upper rollers"),
      positive("ice.bending.speed", dim::speed, "required", "of the upper rollers, downward"),
      number("ice.bending.ramp_time", dim::time, "0", "to reach that speed", 0),
      number("contact.friction", dim::none, "0.1", "Coulomb coefficient", 0, 2),
      positive("contact.stiffness_factor", dim::none, "0.1", "contact stiffness as a fraction of mass / window^2", 1),
      number("contact.damping", dim::none, "0", "fraction of critical damping of contacts", 0, 0.5),
      choice("contact.two_way", {"auto", "on", "off"}, "auto",
             "the vehicle's vertices against the ice's faces as well; auto: where the vehicle's mesh is finer"),
      choice("contact.edges", {"auto", "on", "off"}, "auto",
             "crossing edges of vehicle and ice against each other; auto: on"),
      choice(
          "overlap.method", {"packed", "exact"}, "packed",
          "how solids cut the fluid's grid: in doubles, exactly where their rounding matters; or exactly throughout"),
  };
}

std::vector<KeyRule> fluid_rules() {
  std::vector<KeyRule> rules{
      text("water.material", "water", "card"),
      number(
          "water.depth", dim::length, "120 mm",
          "below the ice's lower face, or the waterline without ice; deepened to hold the vehicle; 0: the ice is the "
          "floor of the water, dry below",
          0),
      number("water.surface", dim::length, "auto",
             "z of the undisturbed waterline; auto: draught of the floating ice, 0 without ice"),
      text("air.material", "air", "card"),
      positive("air.height", dim::length, "30 mm",
               "above the ice's upper face or the waterline; raised to hold the vehicle until the end"),
      number("air.pressure", dim::pressure, "101325 Pa", "atmospheric pressure", 0),
      positive("fluid.length", dim::length, "auto",
               "along x, of the full domain; auto: the ice's, 20 diameters without ice, 10 times the largest body"),
      positive("fluid.width", dim::length, "auto", "along y, likewise"),
      choice("fluid.start", {"potential_flow", "impulsive"}, "potential_flow",
             "state of the water around the moving vehicle"),
      choice("fluid.outer_boundary", {"non_reflecting", "wall"}, "non_reflecting",
             "sides, bottom and top of the domain"),
      choice("fluid.shock_viscosity", {"limited", "reference"}, "limited",
             "away from solids: the linear part (0.2) only in compression that is not smooth, or (0.06) in all "
             "compression; 1.5 quadratic in both; beside solids always the latter"),
      choice("fluid.sweeps", {"alternating", "all_orders"}, "alternating",
             "orders of the axes in the remap: in turns, or in every step the mean of all six, which is the same for "
             "all axes and dearer"),
      choice("fluid.grid_follows", {"none", "vehicle"}, "none",
             "whether the grid goes along z with the mean speed of the vehicle's wall; with [vehicle] in water without "
             "[ice], ends along z open"),
      positive("fluid.sleeping_threshold", dim::none, "1e-7",
               "disturbance below which bricks of 8 x 8 x 8 cells sleep: speed over sound speed, change of pressure in "
               "half a step over the bulk modulus",
               1e-3),
      positive("dam.length", dim::length, "required",
               "of the column of water along x; a scene with [dam] has [water], [air] and no solid"),
      positive("dam.height", dim::length, "required", "of the column"),
      positive("dam.tank_length", dim::length, "required", "of the tank that it stands at one end of"),
      positive("dam.tank_height", dim::length, "auto", "of the tank; auto: 1.25 times the column's"),
      positive("tube.length", dim::length, "required", "along x; a scene with [tube] holds nothing but the tube"),
      positive("tube.diaphragm", dim::length, "auto", "x of the diaphragm; auto: the middle"),
  };
  for (const std::string side : {"left", "right"}) {
    const std::string path = "tube." + side + ".";
    rules.push_back(text(path + "material", "required", "card of a fluid law"));
    rules.push_back(positive(path + "density", dim::density, "required", ""));
    rules.push_back(number(path + "velocity", dim::speed, "0", "along x"));
    rules.push_back(number(path + "pressure", dim::pressure, "required", "absolute"));
  }
  for (const std::string axis : {"x", "y", "z"}) {
    const std::string path = "fluid.grid_motion." + axis + ".";
    rules.push_back(number(path + "speed", dim::speed, "0", "of all planes across " + axis + " of the fluid's grid"));
    for (const std::string end : {"lower", "upper"})
      rules.push_back(number(path + end + "_speed", dim::speed, "auto",
                             "of the " + end + " end along " + axis +
                                 "; planes between the ends keep their share of the way; auto: `speed`"));
    rules.push_back(text(path + "times", "none", "of the two next, e.g. \"0, 1 ms, 3 ms\", from 0 on"));
    for (const std::string end : {"lower", "upper"})
      rules.push_back(text(path + end + "_displacement", "none",
                           "of the " + end +
                               " end at these times, on top of its speed, e.g. \"0, 4 mm, 4 mm\"; linear "
                               "between, held after the last"));
  }
  return rules;
}

std::vector<KeyRule> body_rules() {
  const std::string body = "body.NAME.";
  return {
      choice(
          body + "shape", {"sphere", "cylinder", "box", "wedge", "file"}, "required",
          "of a rigid body whose motion is prescribed, NAME any word; [water] and [air] with such bodies and no other "
          "solid run alone"),
      positive(body + "diameter", dim::length, "auto", "of a sphere or cylinder, which need it"),
      positive(body + "length", dim::length, "auto", "along x, of a box or of the top of a wedge"),
      positive(body + "width", dim::length, "auto", "along y, of a box or a wedge, whose edge is as long"),
      positive(body + "height", dim::length, "auto",
               "along z, of a cylinder (its axis), a box or a wedge (edge down, flat top)"),
      text(body + "file", "none", "closed surface: STL, OBJ or PLY file, relative to the scene"),
      choice(body + "file_unit", {"none", "m", "cm", "mm", "um", "in", "ft"}, "none",
             "unit of its coordinates; must be given with file"),
      text(body + "position", "required",
           "of the reference point at the start, \"0, 0, -30 mm\": the centre; of a wedge the middle of its edge, of a "
           "file its origin"),
      text(body + "angles", "0, 0, 0", "turned about x, then y, then z through that point, e.g. \"0, 20 deg, 0\""),
      text(
          body + "velocity", "0, 0, 0",
          "of that point, constant or over time: \"0, 0, 0 at 0; 0, 0, 1 m/s at 1 ms\"; linear between, held after the "
          "last"),
      text(body + "rotation_rate", "0",
           "about `rotation_axis`, likewise: \"100 rad/s\" or \"0 at 0; 100 rad/s at 1 ms\""),
      choice(body + "rotation_axis", {"x", "y", "z"}, "z", "through that point, right-handed"),
  };
}

std::vector<KeyRule> record_rules() {
  std::vector<KeyRule> rules{
      number("checkpoint.interval", dim::time, "0",
             "simulated time between checkpoints, RUN/checkpoints (docs/coupling.md); 0: none by simulated time", 0),
      number("checkpoint.wall_interval", dim::time, "30 min",
             "wall time between checkpoints; 0: none by wall time. The last two are kept", 0),
      choice("record.interface", {"true", "false"}, "false",
             "write down every message between coupler and solvers, RUN/record (docs/debugging.md)"),
      text("record.participants", "all", "whose messages, e.g. \"ice\" or \"structure, ice\""),
      text("record.times", "all",
           "intervals on record, e.g. \"0 to 20 us, 0.1 ms to end\"; a replay goes as far as the first one, which must "
           "begin at 0"),
      text("record.windows", "all", "the same by the numbers of windows, e.g. \"0 to 100, 250, 300 to end\""),
      choice("record.compression", {"none", "deflate"}, "none",
             "of the files: deflate takes less room and more processor time (docs/debugging.md)"),
  };
  for (const std::string side : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"})
    rules.push_back(number("record.region." + side, dim::length, "auto",
                           "side of the box that vertices, cells and faces on record lie in, to look at, not to "
                           "replay; auto: everything"));
  return rules;
}

std::vector<KeyRule> all_rules() {
  auto rules = general_rules();
  for (auto& part : {solid_rules(), fluid_rules(), body_rules(), record_rules()})
    rules.insert(rules.end(), part.begin(), part.end());
  for (const auto& name : effect_names())
    rules.push_back(choice("effects." + name, {"auto", "on", "off"}, "auto", "see the effects below"));
  for (const std::string name : {"structure", "ice", "fluid"}) {
    rules.push_back(text("participants." + name + ".command", "", "program to start instead of the project's own"));
    rules.push_back(text("participants." + name + ".launch", "", "put in front of the command, e.g. \"srun -n 64\""));
    rules.push_back(
        integer("participants." + name + ".threads", "0", "for all of the run; 0: the coupler shares the cores", 0));
  }
  return rules;
}

std::string limit(double value, const Dimension& d) {
  std::ostringstream stream;
  stream << value;
  if (value != 0 && d != dim::none) stream << ' ' << unit_name(d);
  return stream.str();
}

}  // namespace

const std::vector<KeyRule>& schema() {
  static const std::vector<KeyRule> rules = all_rules();
  return rules;
}

std::string general_path(const std::string& path) {
  for (const std::string named : {"body.", "ice.supports.", "ice.pressures.", "ice.forces."}) {
    if (!path.starts_with(named) || path.size() == named.size()) continue;
    const auto dot = path.find('.', named.size());
    return named + "NAME" + (dot == std::string::npos ? "" : path.substr(dot));
  }
  return path;
}

const KeyRule* find_rule(const std::string& path) {
  const std::string general = general_path(path);
  for (const KeyRule& rule : schema())
    if (rule.path == general) return &rule;
  return nullptr;
}

std::string allowed(const KeyRule& rule) {
  if (rule.kind == Kind::text) return "a text";
  if (rule.kind == Kind::choice) {
    std::string list;
    for (const auto& choice : rule.choices) list += (list.empty() ? "" : ", ") + choice;
    return (rule.choices.size() > 1 ? "one of " : "") + list;
  }
  std::string result = rule.kind == Kind::integer ? "a whole number" : describe(rule.dimension);
  if (rule.lower > -infinity)
    result += (rule.lower_open ? ", above " : ", at least ") + limit(rule.lower, rule.dimension);
  if (rule.upper < infinity) result += ", at most " + limit(rule.upper, rule.dimension);
  return result;
}

std::string schema_as_markdown() {
  std::string table = "| key | allowed | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const KeyRule& rule : schema())
    table += "| `" + rule.path + "` | " + allowed(rule) + " | " + rule.fallback + " | " + rule.meaning + " |\n";
  return table;
}

}  // namespace polynya::scene
