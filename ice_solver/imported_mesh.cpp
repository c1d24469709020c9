#include "ice_solver/imported_mesh.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace polynya::ice {

namespace {

const std::vector<std::int32_t>& set_of(const results::MeshFile& found, const std::string& file,
                                        const std::string& name, const std::string& table) {
  const auto set = found.sets.find(name);
  if (set == found.sets.end()) throw std::runtime_error(file + ": lacks the set '" + name + "' of " + table);
  return set->second;
}

}  // namespace

results::MeshFile use_imported_mesh(IceOptions& options, const scene::IceMesh& mesh, const std::string& file) {
  results::MeshFile found = results::read_mesh_file(file);
  for (const auto& [name, held] : mesh.supports) {
    Support support{.nodes = set_of(found, file, name, "ice.supports"),
                    .components = 0,
                    .non_reflecting = held == "non_reflecting"};
    if (!support.non_reflecting)
      for (const char axis : held) support.components |= static_cast<std::uint8_t>(1 << (axis - 'x'));
    options.supports.push_back(std::move(support));
  }
  for (const auto& [name, curve] : mesh.pressures)
    options.loads.push_back(
        {SetLoad::Kind::pressure, name, set_of(found, file, name, "ice.pressures"), {curve.times, curve.rows}});
  for (const auto& [name, curve] : mesh.forces)
    options.loads.push_back(
        {SetLoad::Kind::force, name, set_of(found, file, name, "ice.forces"), {curve.times, curve.rows}});
  options.velocity = mesh.velocity;
  options.mesh = continuum::HexMesh{found.nodes, found.elements};
  return found;
}

std::string element_that_sets_the_step(const IceBody& ice, const results::MeshFile& file) {
  std::vector<double> steps = ice.first_step;
  const auto e = static_cast<std::size_t>(std::min_element(steps.begin(), steps.end()) - steps.begin());
  const double least = steps[e];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const auto at = continuum::element_centre(ice.solid, e);
  char text[256];
  std::snprintf(text, sizeof text,
                "element %lld of the mesh at (%.6g, %.6g, %.6g) mm sets the step, %.3e s; the median element allows "
                "%.3e s",
                static_cast<long long>(file.element_numbers[e]), 1e3 * at[0], 1e3 * at[1], 1e3 * at[2], least, *middle);
  return text;
}

}  // namespace polynya::ice
