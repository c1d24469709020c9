// New velocities of nodes: predicted pressure and weight (node_forces.hpp), and a viscosity against hourglass modes:
// the part of a full cell's eight corner velocities that no linear field can be. That viscosity scales with density
// times (0.002 c + 0.1 |u|): with density times c it would inflate the added mass.
#include <algorithm>

#include "fluid_solver/node_forces.hpp"
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// Forces on the corners of a row of cells, one component, along the four edges in x (number y + 2 z): on their lower
/// and on their upper ends, by cell.
struct EdgeForces {
  std::array<double*, 4> lower, upper;
};

/// With sums s and differences d along x, what no linear field can be is d less its mean over the four edges, and of s
/// what alternates in y and z.
void edge_forces(const double* u, const double* coefficient, Span cells, std::ptrdiff_t sy, std::ptrdiff_t sz,
                 const EdgeForces& out) {
  double *lower0 = out.lower[0], *lower1 = out.lower[1], *lower2 = out.lower[2], *lower3 = out.lower[3];
  double *upper0 = out.upper[0], *upper1 = out.upper[1], *upper2 = out.upper[2], *upper3 = out.upper[3];
#pragma omp simd
  for (int i = cells.first; i <= cells.last; ++i) {
    const double s0 = u[i] + u[i + 1], d0 = u[i] - u[i + 1];
    const double s1 = u[i + sy] + u[i + sy + 1], d1 = u[i + sy] - u[i + sy + 1];
    const double s2 = u[i + sz] + u[i + sz + 1], d2 = u[i + sz] - u[i + sz + 1];
    const double s3 = u[i + sy + sz] + u[i + sy + sz + 1], d3 = u[i + sy + sz] - u[i + sy + sz + 1];
    const double half = -0.5 * coefficient[i];
    const double twist = half * 0.25 * ((s0 - s1) - (s2 - s3)), mean = 0.25 * ((d0 + d1) + (d2 + d3));
    const double e0 = half * (d0 - mean), e1 = half * (d1 - mean), e2 = half * (d2 - mean), e3 = half * (d3 - mean);
    lower0[i] = twist + e0;
    upper0[i] = twist - e0;
    lower1[i] = e1 - twist;
    upper1[i] = -e1 - twist;
    lower2[i] = e2 - twist;
    upper2[i] = -e2 - twist;
    lower3[i] = twist + e3;
    upper3[i] = twist - e3;
  }
}

/// Energy that the hourglass viscosity has taken, kinetic energy of the new velocities, J, what nodes that are held
/// would have taken up, N s, and the nodes that hold next to nothing (thin_density).
struct Accelerated {
  double dissipated = 0, kinetic = 0;
  std::array<double, 3> held{};
  std::vector<std::ptrdiff_t> thin;

  void add(const Accelerated& other) {
    dissipated += other.dissipated;
    kinetic += other.kinetic;
    for (int d = 0; d < 3; ++d) held[d] += other.held[d];
    thin.insert(thin.end(), other.thin.begin(), other.thin.end());
  }
};

/// Mass of thin nodes in the open over the widths along x of the cells around them, kg/m.
double thin_mass_per_width(const Grid& grid, int j, int k) {
  return 0.125 * thin_density * (grid.dy[j - 1] + grid.dy[j]) * (grid.dz[k - 1] + grid.dz[k]);
}

/// Nodes of a row. With `some_held` those that are not `moving`, beside sleeping cells, stay at rest.
template <class Row, bool some_held>
Accelerated accelerate_row(Fluid& fluid, double dt, int j, int k, Span nodes, Span moving,
                           const std::array<double*, 3>& hourglass) {
  const NodeForces<Row> force(fluid, j, k);
  const std::ptrdiff_t row = fluid.grid.at(0, j, k);
  const double *m = row_mass(fluid, j, k), *my = row_mass(fluid, j - 1, k), *mz = row_mass(fluid, j, k - 1),
               *myz = row_mass(fluid, j - 1, k - 1);
  const double *u = fluid.velocity[0].data() + row, *v = fluid.velocity[1].data() + row,
               *w = fluid.velocity[2].data() + row;
  const double *hx = hourglass[0], *hy = hourglass[1], *hz = hourglass[2];
  double *un = fluid.next_velocity[0].data() + row, *vn = fluid.next_velocity[1].data() + row,
         *wn = fluid.next_velocity[2].data() + row, *mass = fluid.node_mass.data() + row;
  const double *dx = fluid.grid.dx.data(), thin = thin_mass_per_width(fluid.grid, j, k);
  double loss = 0, kinetic = 0, held_x = 0, held_y = 0, held_z = 0, least = 0;
#pragma omp simd reduction(+ : kinetic, loss, held_x, held_y, held_z) reduction(min : least)
  for (std::ptrdiff_t n = nodes.first; n <= nodes.last; ++n) {
    const double node =
        0.125 * (((m[n] + m[n - 1]) + (my[n] + my[n - 1])) + ((mz[n] + mz[n - 1]) + (myz[n] + myz[n - 1])));
    const double per_mass = node > 0 ? dt / (node > 0 ? node : 1.0) : 0.0, b = force.own.node(n);
    const double fx = b * force.x(n) + hx[n], fy = b * force.y(n) + hy[n], fz = b * force.z(n) + hz[n];
    double x_new = u[n] + per_mass * fx, y_new = v[n] + per_mass * fy, z_new = w[n] + per_mass * fz;
    if (some_held) {
      const bool moves = n >= moving.first && n <= moving.last;
      held_x += moves ? 0.0 : dt * fx;
      held_y += moves ? 0.0 : dt * fy;
      held_z += moves ? 0.0 : dt * fz;
      x_new = moves ? x_new : 0.0;
      y_new = moves ? y_new : 0.0;
      z_new = moves ? z_new : 0.0;
    }
    un[n] = x_new;
    vn[n] = y_new;
    wn[n] = z_new;
    mass[n] = node;
    least = std::min(least, node - thin * b * (dx[n - 1] + dx[n]));
    kinetic += 0.5 * node * (x_new * x_new + y_new * y_new + z_new * z_new);
    loss += -0.5 * (node > 0 ? dt : 0.0) * (hx[n] * (u[n] + x_new) + hy[n] * (v[n] + y_new) + hz[n] * (w[n] + z_new));
  }
  Accelerated done{loss, kinetic, {held_x, held_y, held_z}, {}};
  for (std::ptrdiff_t n = nodes.first; least < 0 && n <= nodes.last; ++n)
    if (mass[n] < thin * force.own.node(n) * (dx[n - 1] + dx[n])) done.thin.push_back(row + n);
  return done;
}

/// Layer by layer through a block of nodes. What a layer of cells does to the nodes above it is kept for them.
class March {
 public:
  March(Fluid& fluid, double dt, const Block& block)
      : fluid_(fluid),
        grid_(fluid.grid),
        dt_(dt),
        block_(block),
        width_(static_cast<std::size_t>(grid_.nx) + 3),
        rows_(static_cast<std::size_t>(block.last_j - block.first_j + 1)),
        storage_(scratch()) {
    storage_.assign(width_ * (17 + 3 * rows_), 0.0);  // ends of rows stay 0
  }

  Accelerated run() {
    Accelerated sum;
    if (block_.first_k > 1) layer(block_.first_k - 1, nullptr);
    for (int k = block_.first_k; k <= block_.last_k; ++k) layer(k, &sum);
    return sum;
  }

 private:
  static std::vector<double>& scratch() {
    thread_local std::vector<double> kept;
    return kept;
  }
  double* at(std::size_t place) { return storage_.data() + width_ * place; }
  double* force(int d) { return at(static_cast<std::size_t>(d)); }
  double* next(int d) { return at(static_cast<std::size_t>(3 + d)); }
  double* next_above(int d) { return at(static_cast<std::size_t>(6 + d)); }
  EdgeForces edges() {
    EdgeForces of;
    for (std::size_t e = 0; e < 4; ++e) {
      of.lower[e] = at(9 + e);
      of.upper[e] = at(13 + e);
    }
    return of;
  }
  double* above(int d, int j) {
    return at(17 + static_cast<std::size_t>(d) * rows_ + static_cast<std::size_t>(j - block_.first_j));
  }

  /// Forces of the row of cells (j, k) and of what is kept from the row and the layer before on the nodes of the row,
  /// if they are of this block; keeps what the next row and the layer above will feel.
  void gather(int d, int j, int k) {
    double *out = force(d), *next_row = next(d), *next_row_above = next_above(d);
    const EdgeForces on = edges();
    const std::ptrdiff_t row = grid_.at(0, j, k);
    if (j >= 1 && j <= grid_.ny && k <= grid_.nz) {
      const Span cells{std::max(block_.along.first - 1, 1), std::min(block_.along.last, grid_.nx)};
      edge_forces(fluid_.velocity[d].data() + row, fluid_.viscosity.data() + row, cells, grid_.sy, grid_.sz, on);
    } else {
      for (std::size_t e = 0; e < 4; ++e) {
        std::fill_n(on.lower[e], width_, 0.0);
        std::fill_n(on.upper[e], width_, 0.0);
      }
    }
    const double *l0 = on.lower[0], *u0 = on.upper[0], *l1 = on.lower[1], *u1 = on.upper[1];
    const double *l2 = on.lower[2], *u2 = on.upper[2], *l3 = on.lower[3], *u3 = on.upper[3];
    if (j >= block_.first_j) {
      double* kept = above(d, j);
#pragma omp simd
      for (int i = block_.along.first; i <= block_.along.last; ++i) {
        out[i] = kept[i] + ((l0[i] + u0[i - 1]) + next_row[i]);
        kept[i] = (l2[i] + u2[i - 1]) + next_row_above[i];
      }
    }
#pragma omp simd
    for (int i = block_.along.first; i <= block_.along.last; ++i) {
      next_row[i] = l1[i] + u1[i - 1];
      next_row_above[i] = l3[i] + u3[i - 1];
    }
  }

  Accelerated row(int j, int k) {
    const std::array<double*, 3> hourglass{force(0), force(1), force(2)};
    const Span nodes = block_.along, moving = awake_nodes(fluid_, j, k);
    const auto run = [&](auto accelerate) { return accelerate(fluid_, dt_, j, k, nodes, moving, hourglass); };
    if (untouched_around(fluid_, j, k))
      return moving == nodes ? run(accelerate_row<OpenRow, false>) : run(accelerate_row<OpenRow, true>);
    return moving == nodes ? run(accelerate_row<TouchedRow, false>) : run(accelerate_row<TouchedRow, true>);
  }

  void layer(int k, Accelerated* sum) {
    for (int d = 0; d < 3; ++d) gather(d, block_.first_j - 1, k);
    for (int j = block_.first_j; j <= block_.last_j; ++j) {
      for (int d = 0; d < 3; ++d) gather(d, j, k);
      if (sum) sum->add(row(j, k));
    }
  }

  Fluid& fluid_;
  const Grid& grid_;
  double dt_;
  Block block_;
  std::size_t width_, rows_;
  std::vector<double>& storage_;
};

}  // namespace

double accelerate_nodes(Fluid& fluid, double dt) {
  const std::vector<Block>& blocks = fluid.sleeping.touched_blocks;
  std::vector<Accelerated> of_blocks(blocks.size());
  for_blocks(blocks,
             [&](std::size_t number, const Block& block) { of_blocks[number] = March(fluid, dt, block).run(); });
  Accelerated sum;
  for (const Accelerated& block : of_blocks) sum.add(block);
  fluid.thin_nodes = std::move(sum.thin);
  Account& account = fluid.account;
  account.hourglass += sum.dissipated;
  for (int d = 0; d < 3; ++d) account.rest_impulse[d] += sum.held[d] + dt * fluid.sleeping.at_rest.force[d];
  return sum.kinetic;
}

}  // namespace polynya::fluid
