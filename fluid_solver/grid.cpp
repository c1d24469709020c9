#include "fluid_solver/grid.hpp"

#include <stdexcept>
#include <string>

namespace polynya::fluid {
namespace {

std::vector<double> widths(const std::vector<double>& line, const char* axis) {
  if (line.size() < 2) throw std::invalid_argument(std::string("the grid needs at least two lines along ") + axis);
  const std::size_t cells = line.size() - 1;
  std::vector<double> width(cells + 3);
  for (std::size_t i = 0; i < cells; ++i) {
    width[i + 1] = line[i + 1] - line[i];
    if (!(width[i + 1] > 0))
      throw std::invalid_argument(std::string("the grid lines along ") + axis + " must increase");
  }
  width[0] = width[1];
  width[cells + 1] = width[cells + 2] = width[cells];
  return width;
}

}  // namespace

Grid::Grid(std::vector<double> x_lines, std::vector<double> y_lines, std::vector<double> z_lines)
    : x(std::move(x_lines)), y(std::move(y_lines)), z(std::move(z_lines)) {
  dx = widths(x, "x");
  dy = widths(y, "y");
  dz = widths(z, "z");
  nx = static_cast<int>(x.size()) - 1;
  ny = static_cast<int>(y.size()) - 1;
  nz = static_cast<int>(z.size()) - 1;
  sy = nx + 3;
  sz = sy * (ny + 3);
  size = static_cast<std::size_t>(sz) * (nz + 3);
  cell_volume.assign(size, 0.0);
  for (int k = 1; k <= nz; ++k) {
    for (int j = 1; j <= ny; ++j) {
      for (int i = 1; i <= nx; ++i) cell_volume[static_cast<std::size_t>(at(i, j, k))] = dx[i] * dy[j] * dz[k];
    }
  }
}

std::ptrdiff_t Grid::from_message(std::int64_t cell) const {
  const std::int64_t plane = static_cast<std::int64_t>(nx) * ny;
  if (cell < 0 || cell >= plane * nz)
    throw std::out_of_range("cell " + std::to_string(cell) + " is not in the fluid grid");
  const std::int64_t in_plane = cell % plane;
  return at(1 + static_cast<int>(in_plane % nx), 1 + static_cast<int>(in_plane / nx),
            1 + static_cast<int>(cell / plane));
}

std::int64_t Grid::to_message(std::ptrdiff_t cell) const {
  int i, j, k;
  position(cell, i, j, k);
  return (i - 1) + static_cast<std::int64_t>(nx) * ((j - 1) + static_cast<std::int64_t>(ny) * (k - 1));
}

std::ptrdiff_t Grid::face_from_message(int normal, std::int64_t face) const {
  const std::int64_t fx = nx + (normal == 0), fy = ny + (normal == 1), fz = nz + (normal == 2);
  if (face < 0 || face >= fx * fy * fz)
    throw std::out_of_range("face " + std::to_string(face) + " is not in the fluid grid");
  const std::int64_t in_plane = face % (fx * fy);
  return at(1 + static_cast<int>(in_plane % fx), 1 + static_cast<int>(in_plane / fx),
            1 + static_cast<int>(face / (fx * fy)));
}

}  // namespace polynya::fluid
