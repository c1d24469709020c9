#pragma once
#include <limits>
#include <vector>

#include "core/scene/scene.hpp"

namespace polynya::scene {

/// Coordinates of the nodes of a line of cells from lo to hi (both hit exactly, ascending). Cells of about `cell`, all
/// equal, between fine_lo and fine_hi (both hit exactly); outside, cells grow geometrically away from the fine part,
/// neighbours differing by at most the factor `growth`, no cell larger than `largest`. An outside part too short for
/// such a sequence joins the fine part, whose end is then no node.
/// Throws std::invalid_argument unless lo <= fine_lo < fine_hi <= hi, cell > 0 and growth >= 1.
std::vector<double> graded_line(double lo, double hi, double fine_lo, double fine_hi, double cell, double growth,
                                double largest = std::numeric_limits<double>::infinity());

/// Appends equal cells of about `cell` from line.back() to `to`; an empty line starts at `from`.
void append_equal_cells(std::vector<double>& line, double from, double to, double cell);

struct GridLines {
  std::vector<double> x, y, z;  ///< m, ascending node coordinates
  std::size_t cells() const { return (x.size() - 1) * (y.size() - 1) * (z.size() - 1); }
  std::size_t nodes() const { return x.size() * y.size() * z.size(); }
};

/// Grid lines of the fluid domain: fine about the axis and from the vehicle's tail to the top, with nodes at both faces
/// of the ice. A quarter starts at x = 0 and y = 0. A tube: uniform along x, one cell across. A dam: uniform
/// in x and z, one cell thick. Throws
/// std::invalid_argument if the scene has no fluid.
GridLines fluid_grid_lines(const Scene& scene);

/// Grid lines of the ice plate: fine about the axis, equal layers through the thickness. A beam in bending: nearly
/// equal elements with nodes at the rollers. Throws std::invalid_argument if the scene has no ice.
GridLines ice_grid_lines(const Scene& scene);

}  // namespace polynya::scene
