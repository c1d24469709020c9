// The resolved scene as JSON: one function per part and direction, keys as in the structures.
#include <fstream>
#include <stdexcept>

#include "core/scene/scene.hpp"

namespace polynya::scene {
namespace {

using nlohmann::json;

/// Visits every member of a part with its key; used for both directions so that they cannot disagree.
template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Run>
void members(Part& p, Visit&& visit) {
  visit("end", p.end), visit("end_time", p.end_time), visit("frame_interval", p.frame_interval);
  visit("step_factor", p.step_factor), visit("fluid_step_factor", p.fluid_step_factor);
  visit("filter_frequency", p.filter_frequency), visit("join_timeout", p.join_timeout);
  visit("gravity", p.gravity), visit("seed", p.seed);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Resolution>
void members(Part& p, Visit&& visit) {
  visit("cell", p.cell), visit("ice_element", p.ice_element), visit("vehicle_element", p.vehicle_element);
  visit("fine_radius", p.fine_radius), visit("ice_fine_radius", p.ice_fine_radius), visit("growth", p.growth);
  visit("largest_ice_element", p.largest_ice_element);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, HullFile>
void members(Part& p, Visit&& visit) {
  visit("file", p.file), visit("unit", p.unit), visit("nose", p.nose), visit("repair", p.repair);
  visit("wrap_alpha", p.wrap_alpha), visit("wrap_offset", p.wrap_offset), visit("volume", p.volume);
  visit("note", p.note);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Vehicle>
void members(Part& p, Visit&& visit) {
  visit("head", p.head), visit("head_length", p.head_length), visit("diameter", p.diameter);
  visit("length", p.length), visit("interior", p.interior), visit("wall_thickness", p.wall_thickness);
  visit("mass", p.mass), visit("material", p.material), visit("speed", p.speed);
  visit("nose_position", p.nose_position), visit("deformable", p.deformable);
  visit("angle", p.angle), visit("offset_x", p.offset_x), visit("offset_y", p.offset_y);
  visit("spin", p.spin), visit("pitch_rate", p.pitch_rate);
  visit("ballast", p.ballast), visit("surface", p.surface);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Bending>
void members(Part& p, Visit&& visit) {
  visit("support_span", p.support_span), visit("load_span", p.load_span), visit("speed", p.speed);
  visit("ramp_time", p.ramp_time);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Ball>
void members(Part& p, Visit&& visit) {
  visit("diameter", p.diameter), visit("speed", p.speed);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Curve>
void members(Part& p, Visit&& visit) {
  visit("times", p.times), visit("rows", p.rows);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, IceMesh>
void members(Part& p, Visit&& visit) {
  visit("file", p.file), visit("unit", p.unit), visit("pieces", p.pieces), visit("velocity", p.velocity), visit("low", p.low);
  visit("high", p.high), visit("elements", p.elements), visit("nodes", p.nodes);
  visit("boundary_faces", p.boundary_faces), visit("volume", p.volume), visit("thinnest", p.thinnest);
  visit("supports", p.supports), visit("pressures", p.pressures), visit("forces", p.forces);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Ice>
void members(Part& p, Visit&& visit) {
  visit("length", p.length), visit("width", p.width), visit("thickness", p.thickness);
  visit("lower_face", p.lower_face), visit("material", p.material), visit("critical_strain", p.critical_strain);
  visit("flaws", p.flaws);
  visit("sides", p.sides), visit("damping", p.damping), visit("held_rim", p.held_rim);
  visit("sleeping_threshold", p.sleeping_threshold);
  visit("start", p.start), visit("equilibrium", p.equilibrium), visit("particles", p.particles),
      visit("integration", p.integration);
  visit("bending", p.bending), visit("ball", p.ball), visit("mesh", p.mesh);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, TubeState>
void members(Part& p, Visit&& visit) {
  visit("material", p.material), visit("density", p.density), visit("velocity", p.velocity);
  visit("pressure", p.pressure);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Tube>
void members(Part& p, Visit&& visit) {
  visit("length", p.length), visit("diaphragm", p.diaphragm), visit("left", p.left), visit("right", p.right);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Dam>
void members(Part& p, Visit&& visit) {
  visit("length", p.length), visit("height", p.height);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, AxisMotion>
void members(Part& p, Visit&& visit) {
  visit("lower_speed", p.lower_speed), visit("upper_speed", p.upper_speed), visit("times", p.times);
  visit("lower_displacement", p.lower_displacement), visit("upper_displacement", p.upper_displacement);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, GridMotion>
void members(Part& p, Visit&& visit) {
  visit("x", p.x), visit("y", p.y), visit("z", p.z);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Body>
void members(Part& p, Visit&& visit) {
  visit("shape", p.shape), visit("diameter", p.diameter), visit("length", p.length), visit("width", p.width);
  visit("height", p.height), visit("file", p.file), visit("unit", p.unit), visit("position", p.position);
  visit("angles", p.angles), visit("times", p.times), visit("velocity", p.velocity);
  visit("rotation_axis", p.rotation_axis), visit("rotation_times", p.rotation_times);
  visit("rotation_rate", p.rotation_rate), visit("low", p.low), visit("high", p.high), visit("size", p.size);
  visit("volume", p.volume);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Fluid>
void members(Part& p, Visit&& visit) {
  visit("length", p.length), visit("width", p.width), visit("bottom", p.bottom), visit("top", p.top);
  visit("waterline", p.waterline), visit("water", p.water), visit("air", p.air);
  visit("atmospheric_pressure", p.atmospheric_pressure), visit("vapour_pressure", p.vapour_pressure);
  visit("start", p.start), visit("outer_boundary", p.outer_boundary);
  visit("shock_viscosity", p.shock_viscosity), visit("sweeps", p.sweeps), visit("grid_motion", p.grid_motion);
  visit("grid_follows", p.grid_follows);
  visit("sleeping_threshold", p.sleeping_threshold), visit("dam", p.dam), visit("tube", p.tube);
  visit("bodies", p.bodies);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Contact>
void members(Part& p, Visit&& visit) {
  visit("friction", p.friction), visit("stiffness_factor", p.stiffness_factor);
  visit("damping", p.damping), visit("two_way", p.two_way), visit("edges", p.edges);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, OverlapCut>
void members(Part& p, Visit&& visit) {
  visit("method", p.method);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Checkpoint>
void members(Part& p, Visit&& visit) {
  visit("interval", p.interval), visit("wall_interval", p.wall_interval);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Record>
void members(Part& p, Visit&& visit) {
  visit("participants", p.participants), visit("times", p.times), visit("windows", p.windows);
  visit("compression", p.compression);
  visit("x_min", p.x_min), visit("x_max", p.x_max), visit("y_min", p.y_min), visit("y_max", p.y_max);
  visit("z_min", p.z_min), visit("z_max", p.z_max);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, MaterialCard>
void members(Part& p, Visit&& visit) {
  visit("law", p.law), visit("values", p.values), visit("origin", p.origin);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Effect>
void members(Part& p, Visit&& visit) {
  visit("requested", p.requested), visit("active", p.active), visit("reason", p.reason);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, ParticipantCommand>
void members(Part& p, Visit&& visit) {
  visit("command", p.command), visit("launch", p.launch), visit("threads", p.threads);
}

template <class Part, class Visit>
requires std::is_same_v<std::remove_const_t<Part>, Scene>
void members(Part& p, Visit&& visit) {
  visit("title", p.title), visit("name", p.name), visit("level", p.level), visit("symmetry", p.symmetry);
  visit("run", p.run), visit("resolution", p.resolution), visit("vehicle", p.vehicle), visit("ice", p.ice);
  visit("fluid", p.fluid), visit("contact", p.contact), visit("overlap", p.overlap);
  visit("checkpoint", p.checkpoint);
  visit("record", p.record);
  visit("materials", p.materials), visit("effects", p.effects), visit("participants", p.participants);
}

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

constexpr const char* symmetry_names[] = {"full", "half", "quarter"};

template <class T>
struct Codec {  // a part: an object with a key per member
  static json write(const T& part) {
    json object = json::object();
    members(part, [&](const char* key, const auto& member) {
      using Member = std::remove_cvref_t<decltype(member)>;
      json value = Codec<Member>::write(member);
      if (!value.is_null()) object[key] = std::move(value);
    });
    return object;
  }
  static void read(const json& source, const std::string& path, T& part) {
    if (!source.is_object()) throw std::runtime_error(path + ": an object is needed");
    members(part, [&](const char* key, auto& member) {
      using Member = std::remove_cvref_t<decltype(member)>;
      const std::string place = path.empty() ? key : path + "." + key;
      Codec<Member>::read(source.contains(key) ? source.at(key) : json(), place, member);
    });
  }
};

template <Plain T>
struct Codec<T> {
  static json write(const T& value) { return value; }
  static void read(const json& source, const std::string& path, T& value) {
    const bool fits = std::is_same_v<T, std::string> ? source.is_string()
                      : std::is_same_v<T, bool>      ? source.is_boolean()
                                                     : source.is_number();
    if (!fits)
      throw std::runtime_error(path + (source.is_null() ? ": missing" : ": wrong type, found " + source.dump()));
    value = source.get<T>();
  }
};

template <>
struct Codec<Symmetry> {
  static json write(Symmetry value) { return symmetry_names[static_cast<int>(value)]; }
  static void read(const json& source, const std::string& path, Symmetry& value) {
    for (int i = 0; i < 3; ++i)
      if (source == symmetry_names[i]) return void(value = static_cast<Symmetry>(i));
    throw std::runtime_error(path + ": must be full, half or quarter, found " + source.dump());
  }
};

template <class T>
struct Codec<std::optional<T>> {
  static json write(const std::optional<T>& value) { return value ? Codec<T>::write(*value) : json(); }
  static void read(const json& source, const std::string& path, std::optional<T>& value) {
    value.reset();
    if (!source.is_null()) Codec<T>::read(source, path, value.emplace());
  }
};

template <Plain T>
struct Codec<std::vector<T>> {
  static json write(const std::vector<T>& values) { return values; }
  static void read(const json& source, const std::string& path, std::vector<T>& values) {
    if (!source.is_array()) throw std::runtime_error(path + ": an array is needed");
    values.clear();
    for (const json& value : source) Codec<T>::read(value, path, values.emplace_back());
  }
};

template <class T>
struct Codec<std::map<std::string, T>> {
  static json write(const std::map<std::string, T>& values) {
    json object = json::object();
    for (const auto& [key, value] : values) object[key] = Codec<T>::write(value);
    return object;
  }
  static void read(const json& source, const std::string& path, std::map<std::string, T>& values) {
    if (!source.is_object()) throw std::runtime_error(path + ": an object is needed");
    values.clear();
    for (const auto& [key, value] : source.items()) Codec<T>::read(value, path + "." + key, values[key]);
  }
};

}  // namespace

json to_json(const Scene& scene) {
  return Codec<Scene>::write(scene);
}

Scene from_json(const json& resolved) {
  Scene scene;
  Codec<Scene>::read(resolved, "", scene);
  for (auto& [name, card] : scene.materials) card.name = name;
  return scene;
}

Scene load_resolved_scene(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  json resolved;
  try {
    resolved = json::parse(file);
  } catch (const json::exception& error) {
    throw std::runtime_error(path + ": not a JSON document: " + error.what());
  }
  try {
    return from_json(resolved);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

bool Scene::effect(const std::string& name) const {
  return effects.at(name).active;
}

const MaterialCard& Scene::material(const std::string& name) const {
  return materials.at(name);
}

double MaterialCard::value(const std::string& key) const {
  const auto found = values.find(key);
  if (found == values.end()) throw std::runtime_error("material " + name + " (" + law + "): no value " + key);
  return found->second;
}

}  // namespace polynya::scene
