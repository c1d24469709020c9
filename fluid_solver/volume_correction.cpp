#include "fluid_solver/volume_correction.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::fluid {
namespace {

constexpr int layers = 2;              ///< of cells around those that hold walls
constexpr double least_weight = 0.05;  ///< of a closed face between two cells with fluid
constexpr double tolerance = 1e-9;     ///< of a cell's volume: with water's stiffness about two pascal
constexpr int most_iterations = 200;

struct Link {
  std::int32_t to = -1;
  double weight = 0;
};

class Network {
 public:
  /// Cells around the walls whose change of volume is not explained to the tolerance.
  Network(const Grid& grid, const CutGeometry& before, const CutGeometry& after, const std::vector<StepWall>& walls,
          double dt, std::vector<std::int32_t>& label)
      : grid_(grid), before_(before), after_(after), label_(label) {
    for (const StepWall& wall : walls)
      if (std::abs(unexplained_change(wall, before, after, dt)) > tolerance * grid.cell_volume[wall.cell]) add(wall.cell);
    std::size_t from = 0;
    for (int layer = 0; layer < layers; ++layer) {
      const std::size_t to = cells.size();
      for (; from < to; ++from) {
        for (int side = 0; side < 6; ++side) add(neighbour(cells[from], side));
      }
    }
    links.resize(cells.size());
    diagonal.assign(cells.size(), 0.0);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      for (int side = 0; side < 6; ++side) {
        const std::int32_t other = label_[neighbour(cells[c], side)];
        if (other < 0) continue;
        const double weight = face_weight(cells[c], side);
        links[c][side] = {other, weight};
        diagonal[c] += weight;
      }
    }
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
        for (const Link& link : links[part[at]]) {
          if (link.to < 0 || seen[link.to]) continue;
          seen[link.to] = 1;
          part.push_back(link.to);
        }
      }
      for (const std::int32_t c : part) source[c] -= sum / volume * mean_volume(cells[c]);
    }
  }

  /// Conjugate gradients for sum over faces of weight (x - x_neighbour) = source.
  std::vector<double> solve(const std::vector<double>& source, int& iterations) const {
    const std::size_t count = cells.size();
    std::vector<double> x(count, 0.0), r = source, z(count), d(count), q(count);
    const auto precondition = [&] {
      for (std::size_t c = 0; c < count; ++c) z[c] = diagonal[c] > 0 ? r[c] / diagonal[c] : 0.0;
    };
    const auto dot = [&](const std::vector<double>& a, const std::vector<double>& b) {
      double sum = 0;
      for (std::size_t c = 0; c < count; ++c) sum += a[c] * b[c];
      return sum;
    };
    precondition();
    d = z;
    double rho = dot(r, z);
    for (iterations = 0; iterations < most_iterations && rho > 0; ++iterations) {
      double worst = 0;
      for (std::size_t c = 0; c < count; ++c) worst = std::max(worst, std::abs(r[c]) / full_volume_[c]);
      if (worst < tolerance) break;
      for (std::size_t c = 0; c < count; ++c) {
        double sum = diagonal[c] * d[c];
        for (const Link& link : links[c]) {
          if (link.to >= 0) sum -= link.weight * d[link.to];
        }
        q[c] = sum;
      }
      const double step = rho / dot(d, q);
      for (std::size_t c = 0; c < count; ++c) {
        x[c] += step * d[c];
        r[c] -= step * q[c];
      }
      precondition();
      const double next = dot(r, z);
      for (std::size_t c = 0; c < count; ++c) d[c] = z[c] + next / rho * d[c];
      rho = next;
    }
    return x;
  }

  std::vector<std::ptrdiff_t> cells;
  std::vector<std::array<Link, 6>> links;  ///< x-, x+, y-, y+, z-, z+
  std::vector<double> diagonal;

 private:
  std::ptrdiff_t neighbour(std::ptrdiff_t c, int side) const {
    return side % 2 ? c + grid_.stride(side / 2) : c - grid_.stride(side / 2);
  }
  double mean_volume(std::ptrdiff_t c) const { return 0.5 * (before_.volume[c] + after_.volume[c]); }
  void add(std::ptrdiff_t c) {
    if (label_[c] >= 0 || !grid_.inside(c) || mean_volume(c) <= 0) return;
    label_[c] = static_cast<std::int32_t>(cells.size());
    cells.push_back(c);
    full_volume_.push_back(grid_.cell_volume[c]);
  }
  double face_weight(std::ptrdiff_t c, int side) const {
    const int axis = side / 2;
    const std::ptrdiff_t f = side % 2 ? c + grid_.stride(axis) : c;
    int index[3];
    grid_.position(f, index[0], index[1], index[2]);
    const double width[3] = {grid_.dx[index[0]], grid_.dy[index[1]], grid_.dz[index[2]]};
    const std::vector<double>& along = axis == 0 ? grid_.dx : axis == 1 ? grid_.dy : grid_.dz;
    const double area = width[(axis + 1) % 3] * width[(axis + 2) % 3];
    const double distance = 0.5 * (along[index[axis] - 1] + along[index[axis]]);
    return std::max(least_weight, 0.5 * (before_.open[axis][f] + after_.open[axis][f])) * area / distance;
  }

  const Grid& grid_;
  const CutGeometry &before_, &after_;
  std::vector<std::int32_t>& label_;
  std::vector<double> full_volume_;
};

}  // namespace

double unexplained_change(const StepWall& wall, const CutGeometry& before, const CutGeometry& after, double dt) {
  double change = after.volume[wall.cell] - before.volume[wall.cell];
  for (int body = 0; body < 2; ++body) {
    for (int axis = 0; axis < 3; ++axis) change -= dt * wall.area[body][axis] * wall.velocity[body][axis];
  }
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
      const Link& lower = network.links[c][2 * axis];
      if (lower.to < 0) continue;
      const double volume = lower.weight * (potential[lower.to] - potential[c]);
      if (volume == 0) continue;
      correction.faces.push_back({network.cells[c], axis, volume});
      correction.outflow[lower.to] += volume;
      correction.outflow[c] -= volume;
    }
  }
  return correction;
}

}  // namespace polynya::fluid
