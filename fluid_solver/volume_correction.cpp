#include "fluid_solver/volume_correction.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_solver/coarse_network.hpp"

namespace polynya::fluid {
namespace {

constexpr int layers = 2;              ///< of cells around those that hold walls
constexpr double least_weight = 0.05;  ///< of a closed face between two cells with fluid
constexpr double tolerance = 1e-11;    ///< of a cell's volume: with water's stiffness a fiftieth of a pascal
/// What is left over is compression of the cells. Some dozens suffice.
constexpr int most_iterations = 1000;

class Network {
 public:
  /// Cells around the walls whose change of volume is not explained to the tolerance.
  Network(const Grid& grid, const CutGeometry& before, const CutGeometry& after, const std::vector<StepWall>& walls,
          double dt, std::vector<std::int32_t>& label)
      : grid_(grid), before_(before), after_(after), label_(label) {
    for (const StepWall& wall : walls)
      if (std::abs(unexplained_change(wall, before, after, dt)) > tolerance * grid.cell_volume[wall.cell])
        add(wall.cell);
    std::size_t from = 0;
    for (int layer = 0; layer < layers; ++layer) {
      const std::size_t to = cells.size();
      for (; from < to; ++from) {
        for (int side = 0; side < 6; ++side) add(neighbour(cells[from], side));
      }
    }
    link();
  }
  ~Network() {
    for (const std::ptrdiff_t c : cells) label_[c] = -1;
  }
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// Takes the mean out of every connected part, weighted with volume: only differences can be moved about.
  void balance(std::vector<double>& source) const {
    std::vector<char> seen(cells.size(), 0);
    std::vector<std::int32_t> part;
    for (std::size_t start = 0; start < cells.size(); ++start) {
      if (seen[start]) continue;
      part.assign(1, static_cast<std::int32_t>(start));
      seen[start] = 1;
      double sum = 0, volume = 0;
      for (std::size_t at = 0; at < part.size(); ++at) {
        sum += source[part[at]];
        volume += mean_volume(cells[part[at]]);
        for (int side = 0; side < 6; ++side) {
          const std::int32_t other = links.neighbours[side][part[at]];
          if (seen[other]) continue;  // where there is no neighbour the cell itself stands
          seen[other] = 1;
          part.push_back(other);
        }
      }
      for (const std::int32_t c : part) source[c] -= sum / volume * mean_volume(cells[c]);
    }
  }

  /// Conjugate gradients for sum over faces of weight (x - x_neighbour) = source, on two levels: cells by the diagonal,
  /// lumps of them at once.
  std::vector<double> solve(const std::vector<double>& source, int& iterations) const {
    const std::size_t count = cells.size();
    std::vector<double> x(count, 0.0), residual = source, direction(count, 0.0), image(count), changed(count);
    CoarseNetwork coarse(links);
    double before = 0;
    iterations = 0;
    for (; iterations < most_iterations && worst_of(residual) >= tolerance; ++iterations) {
      const double product = precondition(residual, coarse, changed);
      if (!(product > 0)) break;
      const double turn = before > 0 ? product / before : 0.0;
      before = product;
      const double* z = changed.data();
      double* d = direction.data();
#pragma omp simd
      for (std::size_t c = 0; c < count; ++c) d[c] = z[c] + turn * d[c];
      const double step = product / apply(direction, image);
      double *to = x.data(), *left = residual.data();
      const double* q = image.data();
#pragma omp simd
      for (std::size_t c = 0; c < count; ++c) {
        to[c] += step * d[c];
        left[c] -= step * q[c];
      }
    }
    return x;
  }

  std::vector<std::ptrdiff_t> cells;
  CellNetwork links;  ///< sides in the order x-, x+, y-, y+, z-, z+
  std::vector<double> diagonal;

 private:
  /// The largest residual of a cell, of its volume.
  double worst_of(const std::vector<double>& residual) const {
    const double *r = residual.data(), *full = full_volume_.data();
    double worst = 0;
#pragma omp simd reduction(max : worst)
    for (std::size_t c = 0; c < cells.size(); ++c) worst = std::max(worst, std::abs(r[c]) / full[c]);
    return worst;
  }
  /// Returns the product of the residual and what is made of it.
  double precondition(const std::vector<double>& residual, CoarseNetwork& coarse, std::vector<double>& changed) const {
    const double *r = residual.data(), *own = diagonal.data();
    double* z = changed.data();
#pragma omp simd
    for (std::size_t c = 0; c < cells.size(); ++c) z[c] = own[c] > 0 ? r[c] / (own[c] > 0 ? own[c] : 1.0) : 0.0;
    coarse.add_correction(residual, changed);
    double product = 0;
#pragma omp simd reduction(+ : product)
    for (std::size_t c = 0; c < cells.size(); ++c) product += r[c] * z[c];
    return product;
  }
  /// Sum over faces of weight (d - d_neighbour); returns its product with d.
  double apply(const std::vector<double>& direction, std::vector<double>& image) const {
    const double *d = direction.data(), *own = diagonal.data();
    const auto& t = links.neighbours;
    const auto& w = links.weights;
    const auto [t0, t1, t2, t3, t4, t5] =
        std::array{t[0].data(), t[1].data(), t[2].data(), t[3].data(), t[4].data(), t[5].data()};
    const auto [w0, w1, w2, w3, w4, w5] =
        std::array{w[0].data(), w[1].data(), w[2].data(), w[3].data(), w[4].data(), w[5].data()};
    double* q = image.data();
    double product = 0;
#pragma omp simd reduction(+ : product)
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const double around = (w0[c] * d[t0[c]] + w1[c] * d[t1[c]]) + (w2[c] * d[t2[c]] + w3[c] * d[t3[c]]) +
                            (w4[c] * d[t4[c]] + w5[c] * d[t5[c]]);
      q[c] = own[c] * d[c] - around;
      product += d[c] * q[c];
    }
    return product;
  }

  void link() {
    const std::size_t count = cells.size();
    for (int side = 0; side < 6; ++side) {
      links.neighbours[side].resize(count);
      links.weights[side].assign(count, 0.0);
    }
    diagonal.assign(count, 0.0);
    for (std::size_t c = 0; c < count; ++c) {
      for (int side = 0; side < 6; ++side) {
        const std::int32_t other = label_[neighbour(cells[c], side)];
        links.neighbours[side][c] = other < 0 ? static_cast<std::int32_t>(c) : other;
      }
      // A face belongs to the cell above it; the cell below takes it over.
      std::array<int, 3> index;
      grid_.position(cells[c], index[0], index[1], index[2]);
      for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t lower = links.neighbours[2 * axis][c];
        if (lower == static_cast<std::int32_t>(c)) continue;
        links.weights[2 * axis][c] = links.weights[2 * axis + 1][lower] = face_weight(cells[c], index, axis);
      }
    }
    for (int side = 0; side < 6; ++side) {
      for (std::size_t c = 0; c < count; ++c) diagonal[c] += links.weights[side][c];
    }
  }

  std::ptrdiff_t neighbour(std::ptrdiff_t c, int side) const {
    return side % 2 ? c + grid_.stride(side / 2) : c - grid_.stride(side / 2);
  }
  double mean_volume(std::ptrdiff_t c) const {
    return 0.5 * (before_.volume[c] + after_.volume[c]);
  }
  void add(std::ptrdiff_t c) {
    if (label_[c] >= 0 || !grid_.inside(c) || mean_volume(c) <= 0) return;
    label_[c] = static_cast<std::int32_t>(cells.size());
    cells.push_back(c);
    full_volume_.push_back(grid_.cell_volume[c]);
  }
  /// Of the lower face of a cell across an axis.
  double face_weight(std::ptrdiff_t face, const std::array<int, 3>& index, int axis) const {
    const std::array<double, 3> width{grid_.dx[index[0]], grid_.dy[index[1]], grid_.dz[index[2]]};
    const std::vector<double>& along = axis == 0 ? grid_.dx : axis == 1 ? grid_.dy : grid_.dz;
    const double area = width[(axis + 1) % 3] * width[(axis + 2) % 3];
    const double distance = 0.5 * (along[index[axis] - 1] + along[index[axis]]);
    return std::max(least_weight, 0.5 * (before_.open[axis][face] + after_.open[axis][face])) * area / distance;
  }

  const Grid& grid_;
  const CutGeometry &before_, &after_;
  std::vector<std::int32_t>& label_;
  std::vector<double> full_volume_;
};

}  // namespace

double unexplained_change(const StepWall& wall, const CutGeometry& before, const CutGeometry& after, double dt) {
  double change = after.volume[wall.cell] - before.volume[wall.cell] - wall.by_planes;
  for (const double sweep : wall.sweep) change -= dt * sweep;
  return change;
}

VolumeCorrection correct_volumes(const Grid& grid, const CutGeometry& before, const CutGeometry& after,
                                 const std::vector<StepWall>& walls, double dt, std::vector<std::int32_t>& label) {
  VolumeCorrection correction;
  if (walls.empty()) return correction;
  const Network network(grid, before, after, walls, dt, label);
  std::vector<double> source(network.cells.size(), 0.0);
  for (const StepWall& wall : walls) {
    if (label[wall.cell] >= 0) source[label[wall.cell]] = -unexplained_change(wall, before, after, dt);
  }
  network.balance(source);
  const std::vector<double> potential = network.solve(source, correction.iterations);
  correction.cells = network.cells;
  correction.outflow.assign(network.cells.size(), 0.0);
  for (std::size_t c = 0; c < network.cells.size(); ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t lower = network.links.neighbours[2 * axis][c];
      const double volume = network.links.weights[2 * axis][c] * (potential[lower] - potential[c]);
      if (volume == 0) continue;
      correction.faces.push_back({network.cells[c], axis, volume});
      correction.outflow[lower] += volume;
      correction.outflow[c] -= volume;
    }
  }
  return correction;
}

}  // namespace polynya::fluid
