// Where the grid lines of a scene's fluid and ice run.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/scene/graded_line.hpp"
#include "core/scene/vehicle_shape.hpp"

namespace polynya::scene {
namespace {

constexpr int cells_below_tail = 4;

/// The half line from the axis outward.
std::vector<double> half_line(double half_width, double fine, double cell, double growth, double largest) {
  return graded_line(0, half_width, 0, std::min(fine, half_width), cell, growth, largest);
}

std::vector<double> mirrored(const std::vector<double>& half) {
  std::vector<double> line;
  for (std::size_t i = half.size(); i-- > 1;) line.push_back(-half[i]);
  line.insert(line.end(), half.begin(), half.end());
  return line;
}

/// The lateral lines: the half from the axis where a symmetry plane cuts, both halves elsewhere.
void place(GridLines& lines, Symmetry symmetry, const std::vector<double>& half_x, const std::vector<double>& half_y) {
  lines.x = symmetry == Symmetry::quarter ? half_x : mirrored(half_x);
  lines.y = symmetry == Symmetry::full ? mirrored(half_y) : half_y;
}

GridLines tube_lines(const Scene& scene) {
  const double cell = scene.resolution.cell;
  GridLines lines;
  append_equal_cells(lines.x, 0, scene.fluid->tube->diaphragm, cell);
  append_equal_cells(lines.x, 0, scene.fluid->tube->length, cell);
  lines.y = lines.z = {0, cell};
  return lines;
}

GridLines dam_lines(const Scene& scene) {
  const double cell = scene.resolution.cell;
  GridLines lines;
  append_equal_cells(lines.x, 0, scene.fluid->dam->length, cell);
  append_equal_cells(lines.x, 0, scene.fluid->length, cell);
  append_equal_cells(lines.z, 0, scene.fluid->dam->height, cell);
  append_equal_cells(lines.z, 0, scene.fluid->top, cell);
  lines.y = {0, cell};
  return lines;
}

/// Vertical lines about bodies: fine where they pass and half of the largest around, growing away from there. A node at
/// the waterline where that lies in the fine part.
std::vector<double> line_about_bodies(const Scene& scene) {
  const auto& fluid = *scene.fluid;
  const double cell = scene.resolution.cell, anchor = fluid.waterline;
  double low = fluid.top, high = fluid.bottom;
  for (const auto& [name, body] : *fluid.bodies) {
    low = std::min(low, body.low[2] - 0.5 * body.size);
    high = std::max(high, body.high[2] + 0.5 * body.size);
  }
  low = std::max(fluid.bottom, anchor + std::floor((low - anchor) / cell + 1e-9) * cell);
  high = std::min(fluid.top, anchor + std::ceil((high - anchor) / cell - 1e-9) * cell);
  return graded_line(fluid.bottom, fluid.top, low, high, cell, scene.resolution.growth);
}

/// Vertical lines: growing below the fine part, then equal cells in pieces that end at both faces of the ice.
std::vector<double> vertical_line(const Scene& scene) {
  const auto& fluid = *scene.fluid;
  const double cell = scene.resolution.cell;
  const double anchor = scene.ice ? scene.ice->lower_face : fluid.waterline;
  double fine_bottom = fluid.bottom;
  if (scene.vehicle) {
    const double tail = scene.vehicle->nose_position - lowest_below_nose(*scene.vehicle);
    const double below = std::ceil((anchor - tail) / cell - 1e-9) + cells_below_tail;
    fine_bottom = std::max(fluid.bottom, anchor - below * cell);
  }
  std::vector<double> line;  // the ice may be the floor
  if (fluid.bottom < anchor)
    line = graded_line(fluid.bottom, anchor, fine_bottom, anchor, cell, scene.resolution.growth);
  if (scene.ice) append_equal_cells(line, anchor, anchor + scene.ice->thickness, cell);
  append_equal_cells(line, anchor, fluid.top, cell);
  return line;
}

std::vector<double> beam_half_line(const Ice& ice, double element) {
  std::vector<double> line;
  append_equal_cells(line, 0, 0.5 * ice.bending->load_span, element);
  append_equal_cells(line, 0, 0.5 * ice.bending->support_span, element);
  append_equal_cells(line, 0, 0.5 * ice.length, element);
  return line;
}

}  // namespace

GridLines fluid_grid_lines(const Scene& scene) {
  if (!scene.fluid) throw std::invalid_argument("fluid_grid_lines: the scene has no fluid");
  if (scene.fluid->tube) return tube_lines(scene);
  if (scene.fluid->dam) return dam_lines(scene);
  const auto& r = scene.resolution;
  const double no_limit = std::numeric_limits<double>::infinity();
  GridLines lines;
  place(lines, scene.symmetry, half_line(0.5 * scene.fluid->length, r.fine_radius, r.cell, r.growth, no_limit),
        half_line(0.5 * scene.fluid->width, r.fine_radius, r.cell, r.growth, no_limit));
  lines.z = scene.fluid->bodies ? line_about_bodies(scene) : vertical_line(scene);
  return lines;
}

GridLines ice_grid_lines(const Scene& scene) {
  if (!scene.ice) throw std::invalid_argument("ice_grid_lines: the scene has no ice");
  const auto& ice = *scene.ice;
  const auto& r = scene.resolution;
  GridLines lines;
  if (ice.bending) {
    std::vector<double> half_y;
    append_equal_cells(half_y, 0, 0.5 * ice.width, r.ice_element);
    place(lines, scene.symmetry, beam_half_line(ice, r.ice_element), half_y);
  } else {
    const double largest = r.largest_ice_element;
    place(lines, scene.symmetry, half_line(0.5 * ice.length, r.ice_fine_radius, r.ice_element, r.growth, largest),
          half_line(0.5 * ice.width, r.ice_fine_radius, r.ice_element, r.growth, largest));
  }
  append_equal_cells(lines.z, ice.lower_face, ice.lower_face + ice.thickness, r.ice_element);
  return lines;
}

}  // namespace polynya::scene
