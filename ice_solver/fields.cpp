#include "ice_solver/fields.hpp"

#include <array>
#include <cmath>

namespace polynya::ice {
namespace {

using results::FieldArray;

double pressure_of(const std::array<double, 6>& s) {
  return -(s[0] + s[1] + s[2]) / 3;
}

double von_mises_of(const std::array<double, 6>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

FieldArray scalar(const char* name) {
  return {name, 1, {}};
}
FieldArray vector(const char* name) {
  return {name, 3, {}};
}

void append(FieldArray& to, const double* values) {
  to.values.insert(to.values.end(), values, values + to.components);
}

}  // namespace

results::UnstructuredFields element_fields(const IceBody& ice) {
  const auto& solid = ice.solid;
  results::UnstructuredFields fields;
  fields.single_precision = true;
  std::vector<std::int64_t> point_of(solid.node_count(), -1);
  FieldArray velocity = vector("velocity"), displacement = vector("displacement");
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    if (solid.living_elements[n] == 0) continue;
    point_of[n] = static_cast<std::int64_t>(fields.points.size() / 3);
    for (std::size_t c = 0; c < 3; ++c) {
      fields.points.push_back(solid.positions[3 * n + c]);
      displacement.values.push_back(solid.positions[3 * n + c] - solid.mesh.nodes[3 * n + c]);
    }
    append(velocity, &solid.velocities[3 * n]);
  }
  FieldArray stress{"stress", 6, {}};
  FieldArray pressure = scalar("pressure"), von_mises = scalar("von_mises"), damage = scalar("damage"),
             strain = scalar("effective_strain"), plastic = scalar("plastic_strain");
  for (std::size_t e = 0; e < solid.element_count(); ++e) {
    if (solid.element.alive[e] == 0) continue;
    std::array<std::int64_t, 8> nodes;
    for (std::size_t a = 0; a < 8; ++a) nodes[a] = point_of[static_cast<std::size_t>(solid.mesh.elements[8 * e + a])];
    fields.add_cell(results::CellType::hexahedron, nodes);
    std::array<double, 6> s;
    for (std::size_t c = 0; c < 6; ++c) s[c] = solid.element.stress[c][e];
    append(stress, s.data());
    pressure.values.push_back(pressure_of(s));
    von_mises.values.push_back(von_mises_of(s));
    damage.values.push_back(solid.element.damage[e]);
    strain.values.push_back(continuum::effective_strain(solid, e));
    plastic.values.push_back(solid.element.plastic_strain[e]);
  }
  fields.point_fields = {std::move(velocity), std::move(displacement)};
  fields.cell_fields = {std::move(stress), std::move(pressure), std::move(von_mises),
                        std::move(damage), std::move(strain),   std::move(plastic)};
  return fields;
}

results::UnstructuredFields particle_fields(const IceBody& ice) {
  const Particles& p = ice.particles;
  results::UnstructuredFields fields;
  fields.single_precision = true;
  fields.points = p.points.position;
  FieldArray velocity{"velocity", 3, p.points.velocity};
  FieldArray pressure = scalar("pressure"), von_mises = scalar("von_mises");
  for (std::size_t i = 0; i < p.count(); ++i) {
    const std::int64_t point = static_cast<std::int64_t>(i);
    fields.add_cell(results::CellType::vertex, std::span(&point, 1));
    std::array<double, 6> s;
    std::copy_n(&p.points.stress[6 * i], 6, s.begin());
    pressure.values.push_back(pressure_of(s));
    von_mises.values.push_back(von_mises_of(s));
  }
  fields.point_fields = {std::move(velocity),
                         std::move(pressure),
                         std::move(von_mises),
                         {"damage", 1, p.damage},
                         {"density", 1, p.points.density},
                         {"smoothing_length", 1, p.points.smoothing_length}};
  return fields;
}

IceFrames::IceFrames(const std::string& run_folder)
    : folder_(run_folder + "/fields"), elements_(run_folder, "ice"), particles_(run_folder, "particles") {}

void IceFrames::write(int number, const IceBody& ice) {
  elements_.write(number, element_fields(ice), ice.solid.time);
  particles_.write(number, particle_fields(ice), ice.solid.time);
}

}  // namespace polynya::ice
