#include "core/scene/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "core/scene/graded_line.hpp"
#include "core/scene/vehicle_shape.hpp"

namespace polynya::scene {
namespace {

using std::numbers::pi;
constexpr double never = std::numeric_limits<double>::infinity();

double modelled_fraction(Symmetry symmetry) {
  return symmetry == Symmetry::full ? 1 : symmetry == Symmetry::half ? 0.5 : 0.25;
}

double wall_of(const Scene& scene) {
  const auto& v = *scene.vehicle;
  if (v.interior == "solid") return 0.5 * v.diameter;
  return v.wall_thickness > 0 ? v.wall_thickness : wall_from_mass(v, scene.material(v.material).value("density"));
}

/// Smallest distance between neighbouring lines.
double smallest(const std::vector<double>& line) {
  double size = never;
  for (std::size_t i = 1; i < line.size(); ++i) size = std::min(size, line[i] - line[i - 1]);
  return size;
}

/// The hull's elements: square of size vehicle_element on the surface; one layer of a wall, or filled through.
void add_vehicle(const Scene& scene, Estimate& e) {
  const auto& v = *scene.vehicle;
  if (v.surface) return;
  const double size = scene.resolution.vehicle_element, fraction = modelled_fraction(scene.symmetry);
  const double around = std::max(8.0, pi * v.diameter / size);
  const double through = v.interior == "solid" ? std::max(2.0, 0.25 * v.diameter / size) : 1;
  e.vehicle_elements = static_cast<std::size_t>(std::ceil(v.length / size * around * through * fraction));
  e.nodes += static_cast<std::size_t>(e.vehicle_elements * (1 + 1 / through));
  if (v.deformable) {
    const double across = v.interior == "solid" ? size : std::min(size, wall_of(scene));
    e.vehicle_step = scene.run.step_factor * across / sound_speed(scene.material(v.material));
  }
}

void add_ice(const Scene& scene, Estimate& e) {
  if (const auto& mesh = scene.ice->mesh) {
    e.ice_elements = static_cast<std::size_t>(mesh->elements);
    e.nodes += static_cast<std::size_t>(mesh->nodes);
    e.ice_step = scene.run.step_factor * mesh->thinnest / sound_speed(scene.material(scene.ice->material));
    return;
  }
  const GridLines lines = ice_grid_lines(scene);
  e.ice_elements = lines.cells();
  e.nodes += lines.nodes();
  const double size = std::min({smallest(lines.x), smallest(lines.y), smallest(lines.z)});
  e.ice_step = scene.run.step_factor * size / sound_speed(scene.material(scene.ice->material));
}

void add_fluid(const Scene& scene, Estimate& e) {
  const GridLines lines = fluid_grid_lines(scene);
  e.cells = lines.cells();
  const double cell = 0.5 * scene.run.fluid_step_factor * scene.resolution.cell;
  if (const auto& tube = scene.fluid->tube) {
    double fastest = 0;
    for (const TubeState* side : {&tube->left, &tube->right}) {
      auto card = scene.material(side->material);
      card.values["density"] = side->density;
      fastest = std::max(fastest, sound_speed(card, side->pressure) + std::abs(side->velocity));
    }
    e.fluid_span = cell / fastest;
    return;
  }
  if (scene.fluid->dam) {
    const auto& f = *scene.fluid;
    e.fluid_span = cell / std::max(sound_speed(scene.material(f.water)),
                                   sound_speed(scene.material(f.air), f.atmospheric_pressure));
    return;
  }
  e.fluid_span = cell / sound_speed(scene.material(scene.fluid->water));
}

/// Triangles of the surfaces that the coupler cuts: the hull and both faces of the ice.
double triangles(const Scene& scene, const Estimate& e) {
  double count = 0;
  if (scene.vehicle) {
    const double size = scene.resolution.vehicle_element;
    count +=
        2 * pi * scene.vehicle->diameter * scene.vehicle->length / (size * size) * modelled_fraction(scene.symmetry);
  }
  if (scene.ice && scene.ice->mesh) {
    count += 2 * static_cast<double>(scene.ice->mesh->boundary_faces);
  } else if (scene.ice) {
    const auto layers = static_cast<double>(ice_grid_lines(scene).z.size() - 1);
    count += 4 * static_cast<double>(e.ice_elements) / layers;
  }
  return count;
}

void add_steps(const Scene& scene, Estimate& e) {
  double window = never;
  for (const double step : {e.ice_step, e.vehicle_step})
    if (step > 0) window = std::min(window, step);
  const double end = scene.run.end_time;
  if (e.fluid_span > 0) {
    // A span is a whole number of windows, at least one.
    window = e.fluid_span / std::ceil(std::max(e.fluid_span / window, 1e-9));
    e.fluid_steps = std::ceil(end / e.fluid_span);
  }
  e.windows = std::ceil(end / window);
  e.frames = std::floor(end / scene.run.frame_interval + 1e-9) + 1;
}

void add_costs(const Scene& scene, const CostModel& c, Estimate& e) {
  const auto cells = static_cast<double>(e.cells);
  const auto elements = static_cast<double>(e.ice_elements + e.vehicle_elements);
  const auto processes = static_cast<double>(scene.participants.size());
  const bool coupled = processes > 1;
  const double cut = coupled && scene.fluid ? e.fluid_steps * triangles(scene, e) * c.cut_triangle : 0;
  const double work = e.fluid_steps * cells * c.fluid_cell_step + e.windows * elements * c.hexahedron_step + cut;
  e.wall_time = work / e.available.cores + (coupled ? e.windows * c.window : 0);
  e.memory =
      cells * c.fluid_cell_memory + elements * c.hexahedron_memory + (processes + (coupled ? 1 : 0)) * c.process_memory;
  e.disk = e.frames * (cells * c.fluid_cell_frame + elements * c.hexahedron_frame) + e.windows * c.window_rows;
  if (scene.checkpoint.interval > 0 || scene.checkpoint.wall_interval > 0)
    e.disk += c.checkpoints_kept * (cells * c.fluid_cell_checkpoint + elements * c.hexahedron_checkpoint);
}

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g GB", bytes * 1e-9);
  return text;
}

void judge(const CostModel& c, Estimate& e) {
  const bool memory = e.memory <= c.usable * e.available.memory, disk = e.disk <= c.usable * e.available.disk;
  e.fits = memory && disk;
  if (e.fits)
    e.reason = "memory and disk suffice";
  else if (!memory)
    e.reason = "needs " + gigabytes(e.memory) + " of memory, available " + gigabytes(e.available.memory);
  else
    e.reason = "needs " + gigabytes(e.disk) + " of disk, available " + gigabytes(e.available.disk);
}

/// The limit of this process's control group, if one is set.
double memory_limit() {
  std::ifstream file("/sys/fs/cgroup/memory.max");
  double bytes = never;
  return file >> bytes ? bytes : never;
}

}  // namespace

double sound_speed(const MaterialCard& card, double pressure) {
  const double density = card.value("density");
  if (card.law == "elastic" || card.law == "j2_plastic") {
    const double e = card.value("youngs_modulus"), nu = card.value("poisson_ratio");
    return std::sqrt(e * (1 - nu) / (density * (1 + nu) * (1 - 2 * nu)));
  }
  if (card.law == "johnson_holmquist_2")
    return std::sqrt((card.value("bulk_modulus") + 4.0 / 3.0 * card.value("shear_modulus")) / density);
  if (card.law == "mie_grueneisen") return card.value("sound_speed");
  if (card.law == "linear_polynomial" && card.value("c1") == 0)
    return std::sqrt((1 + card.value("c4")) * pressure / density);
  if (card.law == "linear_polynomial") return std::sqrt(card.value("c1") / density);
  if (card.law == "tait") return std::sqrt(card.value("exponent") * card.value("stiffness") / density);
  const double stiffening = card.law == "stiffened_gas" ? card.value("stiffening_pressure") : 0;
  return std::sqrt(card.value("ratio_of_specific_heats") * (pressure + stiffening) / density);
}

Machine machine(const std::filesystem::path& folder) {
  Machine m;
  m.cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;)
    if (word == "MemAvailable:") file >> m.memory, m.memory *= 1024;
  m.memory = std::min(m.memory, memory_limit());
  auto place = std::filesystem::absolute(folder);
  while (!std::filesystem::exists(place) && place.has_relative_path()) place = place.parent_path();
  m.disk = static_cast<double>(std::filesystem::space(place).available);
  return m;
}

Estimate estimate(const Scene& scene, const Machine& machine, const CostModel& costs) {
  Estimate e;
  e.available = machine;
  if (scene.vehicle) add_vehicle(scene, e);
  if (scene.ice) add_ice(scene, e);
  if (scene.fluid) add_fluid(scene, e);
  add_steps(scene, e);
  add_costs(scene, costs, e);
  judge(costs, e);
  return e;
}

nlohmann::json to_json(const Estimate& e) {
  return {{"note", "estimates, good to about a factor of two; times until end_time"},
          {"cells", e.cells},
          {"elements", e.ice_elements + e.vehicle_elements},
          {"ice_elements", e.ice_elements},
          {"vehicle_elements", e.vehicle_elements},
          {"nodes", e.nodes},
          {"ice_step", e.ice_step},
          {"vehicle_step", e.vehicle_step},
          {"fluid_span", e.fluid_span},
          {"windows", e.windows},
          {"fluid_steps", e.fluid_steps},
          {"frames", e.frames},
          {"wall_time", e.wall_time},
          {"memory", e.memory},
          {"disk", e.disk},
          {"available_memory", e.available.memory},
          {"available_disk", e.available.disk},
          {"cores", e.available.cores},
          {"fits", e.fits},
          {"reason", e.reason}};
}

}  // namespace polynya::scene
