#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/compute/parallel.hpp"
#include "core/compute/state_archive.hpp"

namespace polynya::fluid {

/// A structured graded grid. One padded index space serves cells, faces and nodes, so that every kernel runs over flat
/// rows with constant strides: cell (i,j,k), 1 <= i <= nx, has its lower x-, y- and z-face and its lower corner node at
/// the same index. Indices 0 and n+1 (cells) are ghosts; nodes run from 1 to n+1 with ghosts 0 and n+2.
struct Grid {
  int nx = 0, ny = 0, nz = 0;
  std::vector<double> x, y, z;      ///< node coordinates, n+1 each, m
  std::vector<double> dx, dy, dz;   ///< widths by padded index (n+3; ghosts repeat their neighbour)
  std::ptrdiff_t sy = 0, sz = 0;    ///< strides of j and k
  std::size_t size = 0;             ///< entries of every array
  std::vector<double> cell_volume;  ///< by padded index, m^3; 0 for what is no cell of the grid

  POLYNYA_STATE(nx, ny, nz, x, y, z, dx, dy, dz, sy, sz, size, cell_volume)

  /// Throws std::invalid_argument if a line has fewer than two nodes or does not increase.
  Grid(std::vector<double> x_lines, std::vector<double> y_lines, std::vector<double> z_lines);

  std::ptrdiff_t at(int i, int j, int k) const { return i + sy * j + sz * k; }
  /// Padded index of a cell of the messages (i + nx*(j + ny*k), counted from 0).
  std::ptrdiff_t from_message(std::int64_t cell) const;
  std::int64_t to_message(std::ptrdiff_t cell) const;
  /// Padded index of a face of the messages (normal 0, 1, 2; one more face than cells along its normal).
  std::ptrdiff_t face_from_message(int normal, std::int64_t face) const;
  void position(std::ptrdiff_t index, int& i, int& j, int& k) const {
    k = static_cast<int>(index / sz);
    j = static_cast<int>((index % sz) / sy);
    i = static_cast<int>(index % sy);
  }
  double centre_x(int i) const { return 0.5 * (x[i - 1] + x[i]); }
  double centre_y(int j) const { return 0.5 * (y[j - 1] + y[j]); }
  double centre_z(int k) const { return 0.5 * (z[k - 1] + z[k]); }
  /// Faces of one normal in the messages.
  std::int64_t face_count(int normal) const {
    return static_cast<std::int64_t>(nx + (normal == 0)) * (ny + (normal == 1)) * (nz + (normal == 2));
  }
  std::size_t cells() const { return static_cast<std::size_t>(nx) * ny * nz; }
  std::ptrdiff_t stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? sy : sz; }
  bool inside(std::ptrdiff_t cell) const { return cell_volume[static_cast<std::size_t>(cell)] > 0; }
};

/// Runs body(j, k) for rows 1..ny+extra, 1..nz+extra, in fixed chunks shared among the threads.
template <class Body>
void for_rows(const Grid& grid, int extra, Body&& body) {
  const std::size_t rows_y = static_cast<std::size_t>(grid.ny + extra),
                    rows_z = static_cast<std::size_t>(grid.nz + extra);
  compute::for_uneven_chunks(rows_y * rows_z, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      body(1 + static_cast<int>(row % rows_y), 1 + static_cast<int>(row / rows_y));
    }
  });
}

/// How many planes of this many entries a thread should take at once: threads are not worth waking for less.
inline std::size_t planes_per_chunk(std::ptrdiff_t entries) {
  return 1 + static_cast<std::size_t>(2048 / (entries + 1));
}

/// Several sums over rows at once: term(j, k) returns an array. Added in the order of the rows whatever the number of
/// threads.
template <std::size_t count, class Term>
std::array<double, count> row_sums(const Grid& grid, int extra, Term&& term) {
  const std::size_t rows_y = static_cast<std::size_t>(grid.ny + extra),
                    rows = rows_y * static_cast<std::size_t>(grid.nz + extra);
  constexpr std::size_t chunk = 16;
  std::vector<std::array<double, count>> partial((rows + chunk - 1) / chunk);
  compute::for_uneven_chunks(rows, chunk, [&](std::size_t begin, std::size_t end) {
    std::array<double, count> sum{};
    for (std::size_t row = begin; row < end; ++row) {
      const std::array<double, count> own =
          term(1 + static_cast<int>(row % rows_y), 1 + static_cast<int>(row / rows_y));
      for (std::size_t s = 0; s < count; ++s) sum[s] += own[s];
    }
    partial[begin / chunk] = sum;
  });
  std::array<double, count> total{};
  for (const auto& own : partial) {
    for (std::size_t s = 0; s < count; ++s) total[s] += own[s];
  }
  return total;
}

/// Sum over rows of term(j, k), added in the order of the rows whatever the number of threads.
template <class Term>
double row_sum(const Grid& grid, int extra, Term&& term) {
  return row_sums<1>(grid, extra, [&](int j, int k) { return std::array<double, 1>{term(j, k)}; })[0];
}

}  // namespace polynya::fluid
