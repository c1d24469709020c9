// Momentum of nodes moves with the mass: the dual flux between two nodes is the mean of the face masses around the
// edge, so the mass of a node stays an eighth of its cells'. Limited slopes (van Leer 1977) away from walls, donor
// values near them.
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/row_geometry.hpp"
#include "fluid_solver/sweep.hpp"

namespace polynya::fluid {
namespace {

constexpr double whole = 0.5;  ///< node fraction from which the slope is trusted

/// Mass from node n to node n + s (axis stride s; t1, t2 the other strides).
inline double dual_flux(const double* face_mass, std::ptrdiff_t n, std::ptrdiff_t s, std::ptrdiff_t t1,
                        std::ptrdiff_t t2) {
  const auto through = [&](std::ptrdiff_t c) { return face_mass[c] + face_mass[c + s]; };
  return 0.125 * ((through(n) + through(n - t1)) + (through(n - t2) + through(n - t1 - t2)));
}

inline double limited(double a, double b) {
  const double product = a * b, sum = a + b;
  return product > 0 ? 2.0 * product / (product > 0 ? sum : 1.0) : 0.0;
}

/// A row of edges from nodes n to nodes n + s.
struct EdgeRow {
  const Fluid& fluid;
  std::ptrdiff_t row, s, t1, t2;
  int axis, j, k;
  bool at_lower_end, at_upper_end;  ///< the edge touches the outermost ghosts: no node beyond to take a slope from

  /// True if all nodes that the edges of this row look at are whole, but for ghosts at the ends of rows.
  bool open() const {
    const Grid& grid = fluid.grid;
    if (axis == 0) return untouched(fluid, j, k);
    const int place = axis == 1 ? j : k, last = axis == 1 ? grid.ny : grid.nz;
    if (place < 2 || place + 1 > last) return false;
    return axis == 1 ? untouched(fluid, j - 1, k) && untouched(fluid, j + 1, k)
                     : untouched(fluid, j, k - 1) && untouched(fluid, j, k + 1);
  }

  /// Momentum that the edges carry; with `kinetic` also the kinetic energy.
  template <bool kinetic>
  void momentum(int first, int last, double* __restrict mx, double* __restrict my, double* __restrict mz,
                double* __restrict ke) const {
    const double* face_mass = fluid.face_mass[axis].data() + row;
    const double* mass = fluid.node_mass.data() + row;
    const std::ptrdiff_t before = at_lower_end ? 0 : -s, beyond = at_upper_end ? s : 2 * s;
    const bool all_whole = open();
    const double* b = all_whole ? fluid.whole_nodes.data() + 1 : fluid.node_fraction.data() + row;
    const std::ptrdiff_t step = all_whole && axis > 0 ? 0 : 1;  // whole rows are all the same
    const std::ptrdiff_t b_before = step * before, b_other = step * s, b_beyond = step * beyond;
    const double *u = fluid.next_velocity[0].data() + row, *v = fluid.next_velocity[1].data() + row,
                 *w = fluid.next_velocity[2].data() + row;
#pragma omp simd
    for (std::ptrdiff_t n = first; n <= last; ++n) {
      const double flux = dual_flux(face_mass, n, s, t1, t2);
      const bool forward = flux >= 0;
      // Both sides are read whatever the direction, so that the loop needs no branch.
      const double near = std::min(b[n], b[n + b_other]), lower = std::min(near, b[n + b_before]),
                   upper = std::min(near, b[n + b_beyond]);
      const bool smooth = (forward ? lower : upper) >= whole;
      const double donor_mass = forward ? mass[n] : mass[n + s];
      const double courant = std::abs(flux) / (donor_mass > 0 ? donor_mass : 1.0);
      const double reach = smooth ? 0.5 * (1.0 - std::min(courant, 1.0)) : 0.0;
      const auto value = [&](const double* f) {
        const double own = f[n], other = f[n + s], middle = other - own, first = own - f[n + before],
                     last = f[n + beyond] - other;
        const double slope = reach * limited(middle, forward ? first : last);
        return forward ? own + slope : other - slope;
      };
      const double x = value(u), y = value(v), z = value(w);
      mx[n] = flux * x;
      my[n] = flux * y;
      mz[n] = flux * z;
      if (kinetic) ke[n] = 0.5 * flux * (x * x + y * y + z * z);
    }
  }
};

/// A node that gives away more than half its mass, beside solids or where there is next to no fluid: it gives at the
/// velocity of the mixture of what it has and gets.
struct PassingNode {
  std::ptrdiff_t node;
  std::array<double, 3> own, donor;
};

/// Mass that a node gives through its edges, kg.
double given_mass(const Fluid& fluid, std::ptrdiff_t n) {
  const Grid& grid = fluid.grid;
  double out = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::ptrdiff_t s = grid.stride(axis), t1 = grid.stride((axis + 1) % 3), t2 = grid.stride((axis + 2) % 3);
    out += std::max(0.0, dual_flux(fluid.face_mass[axis].data(), n, s, t1, t2)) +
           std::max(0.0, -dual_flux(fluid.face_mass[axis].data(), n - s, s, t1, t2));
  }
  return out;
}

std::vector<PassingNode> passing_nodes(const Fluid& fluid) {
  constexpr std::size_t together = 512;
  const std::array<const std::vector<std::ptrdiff_t>*, 3> lists{&fluid.before.nodes(), &fluid.after.nodes(),
                                                                &fluid.thin_nodes};
  const std::size_t first = lists[0]->size(), second = first + lists[1]->size(), count = second + lists[2]->size();
  std::vector<std::vector<PassingNode>> found((count + together - 1) / together);
  compute::for_chunks(count, together, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const std::ptrdiff_t n = c < first    ? (*lists[0])[c]
                               : c < second ? (*lists[1])[c - first]
                                            : (*lists[2])[c - second];
      // Inside solids nothing flows.
      if (fluid.before.node_fraction[n] == 0 && fluid.after.node_fraction[n] == 0) continue;
      const double out = given_mass(fluid, n);
      if (!(out > 0.5 * fluid.node_mass[n])) continue;
      const std::array<double, 3> own{fluid.next_velocity[0][n], fluid.next_velocity[1][n], fluid.next_velocity[2][n]};
      found[begin / together].push_back({n, own, own});
    }
  });
  std::vector<PassingNode> passing;
  for (const auto& some : found) passing.insert(passing.end(), some.begin(), some.end());
  // Most nodes are listed before and after; few pass.
  std::sort(passing.begin(), passing.end(), [](const PassingNode& a, const PassingNode& b) { return a.node < b.node; });
  const auto same = [](const PassingNode& a, const PassingNode& b) { return a.node == b.node; };
  passing.erase(std::unique(passing.begin(), passing.end(), same), passing.end());
  return passing;
}

void iterate_donors(Fluid& fluid, std::vector<PassingNode>& passing) {
  const Grid& grid = fluid.grid;
  for (int iteration = 0; iteration < 12; ++iteration) {
    for (PassingNode& p : passing) {
      double mass = std::max(0.0, fluid.node_mass[p.node]);
      std::array<double, 3> momentum{mass * p.own[0], mass * p.own[1], mass * p.own[2]};
      for (int axis = 0; axis < 3; ++axis) {
        const std::ptrdiff_t s = grid.stride(axis), t1 = grid.stride((axis + 1) % 3), t2 = grid.stride((axis + 2) % 3);
        for (const int direction : {-1, 1}) {
          const std::ptrdiff_t other = p.node + direction * s;
          const double in = -direction * dual_flux(fluid.face_mass[axis].data(), std::min(p.node, other), s, t1, t2);
          if (in <= 0) continue;
          mass += in;
          for (int d = 0; d < 3; ++d) momentum[d] += in * fluid.next_velocity[d][other];
        }
      }
      if (!(mass > 0)) continue;
      for (int d = 0; d < 3; ++d) fluid.next_velocity[d][p.node] = p.donor[d] = momentum[d] / mass;
    }
  }
}

/// True if a row of nodes touches a row of cells that may hold a gas.
bool touches_gas(const Fluid& fluid, int gases, int j, int k) {
  return gases != 0 && (gases & (materials_around(fluid, std::min(j, fluid.grid.ny), std::min(k, fluid.grid.nz)) |
                                 materials_around(fluid, std::max(j - 1, 1), std::max(k - 1, 1)))) != 0;
}

int gases_of(const Setup& setup) {
  return (is_gas(setup.law[0]) ? 1 : 0) | (is_gas(setup.law[1]) ? 2 : 0);
}

/// What a row of edges carries: momentum along x, y, z, and kinetic energy.
struct Carried {
  std::array<double*, 4> of{};
};

/// Rows of nodes in a block, in the order of its layers: what the edges towards higher y and z carry is kept for the
/// next row and the next layer.
class March {
 public:
  March(Fluid& fluid, int gases, const Block& block)
      : fluid_(fluid),
        grid_(fluid.grid),
        gases_(gases),
        block_(block),
        width_(static_cast<std::size_t>(grid_.nx) + 3),
        storage_(scratch()) {
    const std::size_t rows = static_cast<std::size_t>(block.last_j - block.first_j + 1);
    storage_.resize(4 * width_ * (rows + 4));
    for (std::size_t place = 0; place < rows + 4; ++place) carried_.push_back(at(place));
  }

  void run() {
    for (int j = block_.first_j; j <= block_.last_j; ++j) carry_z(j, block_.first_k - 1, below(j));
    for (int k = block_.first_k; k <= block_.last_k; ++k) {
      Carried &x = carried_[0], &y0 = carried_[1], &y1 = carried_[2], &z1 = carried_[3];
      carry_y(block_.first_j - 1, k, y0);
      for (int j = block_.first_j; j <= block_.last_j; ++j) {
        const std::ptrdiff_t row = grid_.at(0, j, k);
        carry({fluid_, row, 1, grid_.sy, grid_.sz, 0, j, k, false, false}, block_.along.first - 1, gas(j, k), x);
        carry_y(j, k, y1);
        carry_z(j, k, z1);
        update(row, gas(j, k), x, y0, y1, below(j), z1);
        std::swap(y0, y1);
        std::swap(below(j), z1);
      }
    }
  }

 private:
  /// Kept from step to step: allocating it anew costs as much as using it.
  static std::vector<double>& scratch() {
    thread_local std::vector<double> kept;
    return kept;
  }
  Carried at(std::size_t place) {
    double* start = storage_.data() + 4 * width_ * place;
    return {{start, start + width_, start + 2 * width_, start + 3 * width_}};
  }
  /// What comes through the edges from the layer below.
  Carried& below(int j) { return carried_[static_cast<std::size_t>(j - block_.first_j) + 4]; }
  bool gas(int j, int k) const {
    return touches_gas(fluid_, gases_, std::clamp(j, 1, grid_.ny + 1), std::clamp(k, 1, grid_.nz + 1));
  }

  void carry(const EdgeRow& edges, int first, bool kinetic, const Carried& out) {
    kinetic ? edges.momentum<true>(first, block_.along.last, out.of[0], out.of[1], out.of[2], out.of[3])
            : edges.momentum<false>(first, block_.along.last, out.of[0], out.of[1], out.of[2], out.of[3]);
  }
  void carry_y(int j, int k, const Carried& out) {
    carry({fluid_, grid_.at(0, j, k), grid_.sy, 1, grid_.sz, 1, j, k, j == 0, j == grid_.ny + 1}, block_.along.first,
          gas(j, k) || gas(j + 1, k), out);
  }
  void carry_z(int j, int k, const Carried& out) {
    carry({fluid_, grid_.at(0, j, k), grid_.sz, 1, grid_.sy, 2, j, k, k == 0, k == grid_.nz + 1}, block_.along.first,
          gas(j, k) || gas(j, k + 1), out);
  }

  void update(std::ptrdiff_t row, bool kinetic, const Carried& x, const Carried& y0, const Carried& y1,
              const Carried& z0, const Carried& z1) {
    const std::ptrdiff_t sy = grid_.sy, sz = grid_.sz;
    const double *m0 = fluid_.material[0].mass.data() + row, *m1 = fluid_.material[1].mass.data() + row;
    const double* old_mass = fluid_.node_mass.data() + row;
    double* __restrict new_mass = fluid_.viscosity.data() + row;  // free until the next step
#pragma omp simd
    for (std::ptrdiff_t n = block_.along.first; n <= block_.along.last; ++n) {
      const auto pair = [&](std::ptrdiff_t c) { return (m0[c] + m1[c]) + (m0[c - 1] + m1[c - 1]); };
      new_mass[n] = 0.125 * ((pair(n) + pair(n - sy)) + (pair(n - sz) + pair(n - sy - sz)));
    }
    const auto gained = [&](int d, int n) {
      return (x.of[d][n - 1] - x.of[d][n]) + (y0.of[d][n] - y1.of[d][n]) + (z0.of[d][n] - z1.of[d][n]);
    };
    const double *u = fluid_.next_velocity[0].data() + row, *v = fluid_.next_velocity[1].data() + row,
                 *w = fluid_.next_velocity[2].data() + row;
    double* __restrict un = fluid_.velocity[0].data() + row;
    double* __restrict vn = fluid_.velocity[1].data() + row;
    double* __restrict wn = fluid_.velocity[2].data() + row;
#pragma omp simd
    for (int n = block_.along.first; n <= block_.along.last; ++n) {
      const bool filled = new_mass[n] > 0;
      const double inverse = 1.0 / (filled ? new_mass[n] : 1.0);
      un[n] = filled ? inverse * (old_mass[n] * u[n] + gained(0, n)) : u[n];
      vn[n] = filled ? inverse * (old_mass[n] * v[n] + gained(1, n)) : v[n];
      wn[n] = filled ? inverse * (old_mass[n] * w[n] + gained(2, n)) : w[n];
    }
    if (!kinetic) return;
    double* __restrict loss = fluid_.kinetic_loss.data() + row;
    const auto square = [row](const std::array<std::vector<double>, 3>& u, std::ptrdiff_t n) {
      return u[0][row + n] * u[0][row + n] + u[1][row + n] * u[1][row + n] + u[2][row + n] * u[2][row + n];
    };
#pragma omp simd
    for (int n = block_.along.first; n <= block_.along.last; ++n) {
      const double lost =
          0.5 * (old_mass[n] * square(fluid_.next_velocity, n) - new_mass[n] * square(fluid_.velocity, n)) +
          gained(3, n);
      loss[n] =
          fluid_.node_fraction[row + n] >= 1.0 && new_mass[n] > 0 ? lost / (new_mass[n] > 0 ? new_mass[n] : 1.0) : 0.0;
    }
  }

  Fluid& fluid_;
  const Grid& grid_;
  int gases_;
  Block block_;
  std::size_t width_;
  std::vector<double>& storage_;
  std::vector<Carried> carried_;  ///< along x, y before, y after, z after, and by row from the layer below
};

/// Gives cells the kinetic energy that mixing of momentum has cost at their nodes, by mass, as far as they hold gas:
/// shocks need it. Water would answer a few joules with bars, so there the account keeps it. Returns what was given, J.
double heat_gas(Fluid& fluid, int gases) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  return row_sum(grid, 0, [&](int j, int k) {
    const Span cells = awake_cells(fluid, j, k);
    if (cells.empty()) return 0.0;
    const int heated = gases & materials_around(fluid, j, k);
    double given = 0;
    for (int m = 0; m < 2; ++m) {
      if (!(heated >> m & 1)) continue;
      const std::ptrdiff_t row = grid.at(0, j, k);
      const double *loss = fluid.kinetic_loss.data() + row, *mass = fluid.material[m].mass.data() + row;
      double* __restrict energy = fluid.material[m].energy.data() + row;
#pragma omp simd reduction(+ : given)
      for (std::ptrdiff_t i = cells.first; i <= cells.last; ++i) {
        const auto four = [loss, sy, sz](std::ptrdiff_t n) {
          return (loss[n] + loss[n + sy]) + (loss[n + sz] + loss[n + sy + sz]);
        };
        const double heat = 0.125 * mass[i] * (four(i) + four(i + 1));
        energy[i] += heat;
        given += heat;
      }
    }
    return given;
  });
}

/// What the remap has brought to nodes beside sleeping cells goes: they stay at rest. What mixing cost there before has
/// become heat (`kinetic_loss`); this is the motion that is left.
void hold_sleeping_nodes(Fluid& fluid) {
  if (fluid.sleeping.all_awake) return;
  const auto taken = row_sums<4>(fluid.grid, 1, [&](int j, int k) {
    const Span touched = touched_nodes(fluid, j, k), moving = awake_nodes(fluid, j, k);
    const std::ptrdiff_t row = fluid.grid.at(0, j, k);
    std::array<double, 4> sum{};
    for (int i = touched.first; touched != moving && i <= touched.last; ++i) {
      if (moving.holds(i)) continue;
      for (int d = 0; d < 3; ++d) {
        double& u = fluid.velocity[d][row + i];
        const double momentum = fluid.viscosity[row + i] * u;  // where the remap has left the new masses
        sum[d] += momentum;
        sum[3] += 0.5 * momentum * u;
        u = 0;
      }
    }
    return sum;
  });
  Account& account = fluid.account;
  for (int d = 0; d < 3; ++d) account.rest_impulse[d] += taken[d];
  account.put_to_rest += taken[3];
  account.remap_loss -= taken[3];  // which counts what the remap leaves to nodes that move
}

}  // namespace

void remap_momentum(Fluid& fluid) {
  std::vector<PassingNode> passing = passing_nodes(fluid);
  iterate_donors(fluid, passing);
  const int gases = gases_of(fluid.setup);
  for_blocks(fluid.sleeping.touched_blocks, [&](std::size_t, const Block& block) { March(fluid, gases, block).run(); });
  hold_sleeping_nodes(fluid);
  // The rows above took the donor velocity of passing nodes for their own.
  for (const PassingNode& p : passing) {
    const double mass = fluid.viscosity[p.node];
    if (!(mass > 0)) continue;
    for (int d = 0; d < 3; ++d) fluid.velocity[d][p.node] += fluid.node_mass[p.node] * (p.own[d] - p.donor[d]) / mass;
  }
  std::swap(fluid.node_mass, fluid.viscosity);
  if (gases) fluid.account.remap_loss -= heat_gas(fluid, gases);
}

}  // namespace polynya::fluid
