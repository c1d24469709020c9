// The start: a body that moves from the first instant would send out a pressure of rho c V. Instead the water starts
// with the velocity an impulse would have given it, were it incompressible: u = u0 - grad(impulse) / rho in the
// discrete sense, with the impulse chosen so that no group of water cells changes its volume while the walls move. The
// impulse is 0 in air and outside non-reflecting boundaries. The pressure that belongs to this flow about a steadily
// moving body is Bernoulli's, rho (U.u - u^2/2), added to what is there.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

using Field = std::vector<double>;
constexpr int most_iterations = 20000;
/// A member of a group that is at least so full keeps its own impulse: the step's prediction also holds the members of
/// a group to the walls' motion one by one, and a start that ignores it would begin with a jolt.
constexpr double own_fill = 1e-4;
constexpr double tolerance = 2e-5;  ///< of the norm of the walls' rates of volume, or of what has to be cleared

class Projection {
 public:
  explicit Projection(Fluid& fluid) : f_(fluid), unknown_(fluid.grid.size, 0.0), kick_(fluid.next_velocity) {
    find_unknowns();
    find_diagonal();
  }

  /// Conjugate gradients on cells and groups; returns the number of iterations.
  int run() {
    const std::size_t size = f_.grid.size;
    Field residual(size, 0.0), impulse(size, 0.0), direction(size, 0.0), image(size, 0.0);
    initial_rates(residual);
    auto [rho, square] = norms(residual);
    // A body at rest in a stream has walls that sweep nothing: there what the stream brings is the measure.
    const double goal = tolerance * tolerance * std::max(wall_rates(), square);
    double turn = 0;
    int iteration = 0;
    for (; iteration < most_iterations && rho > 0 && square > goal; ++iteration) {
      turn_towards(residual, turn, direction);
      const double step = rho / apply(direction, image);
      double *to = impulse.data(), *left = residual.data();
      const double *d = direction.data(), *q = image.data();
      for_all([=](std::size_t c) {
        to[c] += step * d[c];
        left[c] -= step * q[c];
      });
      const double before = rho;
      std::tie(rho, square) = norms(residual);
      turn = rho / before;
    }
    if (iteration == most_iterations)
      throw FluidError("the flow that the run starts with was not found in " + std::to_string(iteration) +
                       " iterations");
    give_kick(impulse);
    for (int d = 0; d < 3; ++d) {
      for (std::size_t n = 0; n < size; ++n) f_.velocity[d][n] += kick_[d][n];
    }
    return iteration;
  }

 private:
  /// 1 for cells of water (or in a group of water); groups carry their sum and their unknown in every member.
  void find_unknowns() {
    const Grid& grid = f_.grid;
    for_rows(grid, 0, [&](int j, int k) {
      for (std::ptrdiff_t c = grid.at(1, j, k), end = c + grid.nx; c < end; ++c) {
        unknown_[c] = f_.density[c] > 0 && f_.material[air].volume[c] <= 1e-9 * f_.after.volume[c] ? 1.0 : 0.0;
      }
    });
    for (std::size_t g = 0; g < f_.groups.count(); ++g) {
      const GroupState& state = f_.group_states[g];
      const bool wet = state.volume > 0 && state.content.volume[air] <= 1e-9 * state.volume;
      for (std::size_t m = f_.groups.first[g]; m < f_.groups.first[g + 1]; ++m) {
        // Emptier members are copies of the root: sums over unknowns count them once.
        unknown_[f_.groups.members[m].cell] = wet && (m == f_.groups.first[g] || !follows_root(m)) ? 1.0 : 0.0;
      }
    }
  }

  bool follows_root(std::size_t member) const {
    const std::ptrdiff_t c = f_.groups.members[member].cell;
    return f_.after.volume[c] < own_fill * f_.grid.cell_volume[c];
  }

  void find_diagonal() {
    const Grid& grid = f_.grid;
    Field diagonal(grid.size, 0.0);
    const Field &b = f_.node_fraction, &m = f_.node_mass;
    for_rows(grid, 0, [&](int j, int k) {
      for (std::ptrdiff_t c = grid.at(1, j, k), end = c + grid.nx; c < end; ++c) {
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const std::ptrdiff_t n = c + (corner & 1) + (corner & 2 ? grid.sy : 0) + (corner & 4 ? grid.sz : 0);
          if (!(m[n] > 0)) continue;
          for (int axis = 0; axis < 3; ++axis) {
            const double a = f_.face_coefficient[axis][corner >> axis & 1 ? c + grid.stride(axis) : c];
            sum += b[n] * b[n] / m[n] * a * a;
          }
        }
        diagonal[c] = sum;
      }
    });
    gather_groups(diagonal);
    inverse_.assign(grid.size, 0.0);
    for (std::size_t c = 0; c < inverse_.size(); ++c)
      inverse_[c] = unknown_[c] > 0 && diagonal[c] > 0 ? 1.0 / diagonal[c] : 0.0;
  }

  /// Moves the sum over each group to its root.
  void gather_groups(Field& field) const {
    for (std::size_t g = 0; g < f_.groups.count(); ++g) {
      const std::ptrdiff_t root = f_.groups.members[f_.groups.first[g]].cell;
      for (std::size_t m = f_.groups.first[g] + 1; m < f_.groups.first[g + 1]; ++m) {
        if (!follows_root(m)) continue;
        field[root] += field[f_.groups.members[m].cell];
        field[f_.groups.members[m].cell] = 0;
      }
    }
  }
  void copy_to_members(Field& field) const {
    for (std::size_t g = 0; g < f_.groups.count(); ++g) {
      const double value = field[f_.groups.members[f_.groups.first[g]].cell];
      for (std::size_t m = f_.groups.first[g] + 1; m < f_.groups.first[g + 1]; ++m) {
        if (follows_root(m)) field[f_.groups.members[m].cell] = value;
      }
    }
  }

  void sum_rates(Field& out, double sign) const {
    const Grid& grid = f_.grid;
    const double *qx = f_.face_rate[0].data(), *qy = f_.face_rate[1].data(), *qz = f_.face_rate[2].data();
    const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
    for_rows(grid, 0, [&, qx, qy, qz, sy, sz](int j, int k) {
      double* to = out.data();
      const std::ptrdiff_t begin = grid.at(1, j, k), end = begin + grid.nx;
#pragma omp simd
      for (std::ptrdiff_t c = begin; c < end; ++c)
        to[c] = sign * (qx[c + 1] - qx[c] + qy[c + sy] - qy[c] + qz[c + sz] - qz[c]);
    });
  }

  void initial_rates(Field& out) {
    face_rates(f_, f_.velocity, f_.face_rate);
    sum_rates(out, 1.0);
    for (const WallPiece& wall : f_.after.walls) {
      out[wall.cell] += wall.sweep[0] + wall.sweep[1];
    }
    gather_groups(out);
    for (std::size_t c = 0; c < out.size(); ++c) out[c] *= unknown_[c];
  }

  /// Sum of squares of the rates of volume of the walls' motion: what residuals are compared with.
  double wall_rates() const {
    double sum = 0;
    for (const WallPiece& wall : f_.after.walls) {
      const double rate = wall.sweep[0] + wall.sweep[1];
      sum += rate * rate;
    }
    return sum;
  }

  /// What the impulses on both sides of the four faces around a node push it, across the axis of stride s.
  static double push(const double* a, const double* p, std::ptrdiff_t n, std::ptrdiff_t s, std::ptrdiff_t t1,
                     std::ptrdiff_t t2) {
    return (a[n] * (p[n - s] - p[n]) + a[n - t1] * (p[n - t1 - s] - p[n - t1])) +
           (a[n - t2] * (p[n - t2 - s] - p[n - t2]) + a[n - t1 - t2] * (p[n - t1 - t2 - s] - p[n - t1 - t2]));
  }

  /// Velocity that an impulse per area in the cells gives to the nodes.
  void give_kick(Field& impulse) {
    const Grid& grid = f_.grid;
    copy_to_members(impulse);
    const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
    const double *p = impulse.data(), *mass = f_.node_mass.data(), *fraction = f_.node_fraction.data();
    const double *ax = f_.face_coefficient[0].data(), *ay = f_.face_coefficient[1].data(),
                 *az = f_.face_coefficient[2].data();
    double *u = kick_[0].data(), *v = kick_[1].data(), *w = kick_[2].data();
    for_rows(grid, 1, [=](int j, int k) {
      const std::ptrdiff_t begin = grid.at(1, j, k), end = begin + grid.nx + 1;
#pragma omp simd
      for (std::ptrdiff_t n = begin; n < end; ++n) {
        const double m = mass[n], free = fraction[n], scale = m > 0 ? free / (m > 0 ? m : 1.0) : 0.0;
        u[n] = scale * push(ax, p, n, 1, sy, sz);
        v[n] = scale * push(ay, p, n, sy, 1, sz);
        w[n] = scale * push(az, p, n, sz, 1, sy);
      }
    });
  }

  /// Returns the product of the direction and its image.
  double apply(Field& direction, Field& image) {
    give_kick(direction);
    face_rates(f_, kick_, f_.face_rate);
    sum_rates(image, -1.0);
    gather_groups(image);
    const double* unknown = unknown_.data();
    double *d = direction.data(), *q = image.data();
    return sums<1>([=](std::size_t begin, std::size_t end) {
      double sum = 0;
#pragma omp simd reduction(+ : sum)
      for (std::size_t c = begin; c < end; ++c) {
        q[c] *= unknown[c];
        d[c] *= unknown[c];  // members were copies
        sum += d[c] * q[c];
      }
      return std::array<double, 1>{sum};
    })[0];
  }

  void turn_towards(const Field& residual, double turn, Field& direction) const {
    const double *r = residual.data(), *inverse = inverse_.data();
    double* d = direction.data();
    for_all([=](std::size_t c) { d[c] = r[c] * inverse[c] + turn * d[c]; });
  }

  /// Square of the residual in the norm of the preconditioner, and plain.
  std::tuple<double, double> norms(const Field& residual) const {
    const double *r = residual.data(), *inverse = inverse_.data();
    const auto sum = sums<2>([=](std::size_t begin, std::size_t end) {
      double scaled = 0, plain = 0;
#pragma omp simd reduction(+ : scaled, plain)
      for (std::size_t c = begin; c < end; ++c) {
        scaled += r[c] * r[c] * inverse[c];
        plain += r[c] * r[c];
      }
      return std::array<double, 2>{scaled, plain};
    });
    return {sum[0], sum[1]};
  }

  static constexpr std::size_t chunk = 1 << 14;

  template <class Body>
  void for_all(Body&& body) const {
    compute::for_chunks(f_.grid.size, chunk, [&](std::size_t begin, std::size_t end) {
#pragma omp simd
      for (std::size_t c = begin; c < end; ++c) body(c);
    });
  }

  /// Sums of what term(begin, end) returns for chunks of the grid, added in their order.
  template <std::size_t count, class Term>
  std::array<double, count> sums(Term&& term) const {
    std::vector<std::array<double, count>> partial((f_.grid.size + chunk - 1) / chunk);
    compute::for_chunks(f_.grid.size, chunk,
                        [&](std::size_t begin, std::size_t end) { partial[begin / chunk] = term(begin, end); });
    std::array<double, count> total{};
    for (const auto& own : partial) {
      for (std::size_t s = 0; s < count; ++s) total[s] += own[s];
    }
    return total;
  }

  Fluid& f_;
  Field unknown_, inverse_;  ///< inverse: of the diagonal, 0 where there is no unknown
  std::array<Field, 3>& kick_;
};

/// Mean velocity and position of the vehicle's wall, weighted with its area. A plane of symmetry has the centre in it.
struct BodyMotion {
  std::array<double, 3> velocity{}, centre{};
  bool found = false;
};
BodyMotion body_motion(const Fluid& fluid) {
  BodyMotion body;
  double weight = 0;
  for (const WallPiece& wall : fluid.after.walls) {
    const auto& s = wall.area[0];
    const double area = std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    int i, j, k;
    fluid.grid.position(wall.cell, i, j, k);
    const std::array<double, 3> place{fluid.grid.centre_x(i), fluid.grid.centre_y(j), fluid.grid.centre_z(k)};
    weight += area;
    for (int d = 0; d < 3; ++d) {
      body.velocity[d] += area * wall.velocity[0][d];
      body.centre[d] += area * place[d];
    }
  }
  body.found = weight > 0;
  for (int d = 0; d < 3 && body.found; ++d) {
    body.velocity[d] /= weight;
    body.centre[d] /= weight;
  }
  if (fluid.setup.boundary[0] == Boundary::wall) body.centre[0] = fluid.grid.x.front();
  if (fluid.setup.boundary[2] == Boundary::wall) body.centre[1] = fluid.grid.y.front();
  return body;
}

void add_bernoulli_pressure(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  const std::array<double, 3> body = body_motion(fluid).velocity;
  Field raise(grid.size, 0.0);
  const auto raise_of = [&](std::ptrdiff_t c) {
    double weight = 0;
    std::array<double, 3> u{};
    for (int corner = 0; corner < 8; ++corner) {
      const std::ptrdiff_t n = c + (corner & 1) + (corner & 2 ? grid.sy : 0) + (corner & 4 ? grid.sz : 0);
      weight += fluid.node_fraction[n];
      for (int d = 0; d < 3; ++d)
        u[d] += fluid.node_fraction[n] * (fluid.velocity[d][n] - fluid.setup.ambient_velocity[d]);
    }
    double value = 0;
    for (int d = 0; d < 3; ++d) {
      const double mean = weight > 0 ? u[d] / weight : 0.0;
      value += (body[d] - fluid.setup.ambient_velocity[d]) * mean - 0.5 * mean * mean;
    }
    return fluid.density[c] * value;
  };
  for_rows(grid, 0, [&](int j, int k) {
    for (std::ptrdiff_t c = grid.at(1, j, k), end = c + grid.nx; c < end; ++c) {
      if (fluid.density[c] > 0 && fluid.material[air].mass[c] == 0) raise[c] = raise_of(c);
    }
  });
  for (std::size_t g = 0; g < fluid.groups.count(); ++g) {
    double sum = 0, volume = 0;
    for (std::size_t m = fluid.groups.first[g]; m < fluid.groups.first[g + 1]; ++m) {
      const std::ptrdiff_t c = fluid.groups.members[m].cell;
      sum += raise[c] * fluid.after.volume[c];
      volume += fluid.after.volume[c];
    }
    for (std::size_t m = fluid.groups.first[g]; m < fluid.groups.first[g + 1]; ++m) {
      raise[fluid.groups.members[m].cell] = volume > 0 ? sum / volume : 0.0;
    }
  }
  for_rows(grid, 0, [&](int j, int k) {
    for (std::ptrdiff_t c = grid.at(1, j, k), end = c + grid.nx; c < end; ++c) {
      if (raise[c] == 0 || fluid.density[c] <= 0 || fluid.material[air].mass[c] > 0) continue;
      const double mass = fluid.material[water].mass[c], volume = fluid.after.volume[c];
      if (!(mass > 0)) continue;
      const double e = fluid.material[water].energy[c] / mass;
      const double pressure = std::max(fluid.pressure[c] + raise[c], fluid.setup.pressure_floor[water]);
      const double density = density_at(fluid.setup.law[water], pressure, e, fluid.density[c]);
      fluid.material[water].mass[c] = density * volume;
      fluid.material[water].energy[c] = e * density * volume;
    }
  });
}

int project(Fluid& fluid) {
  // Closed faces hand no impulse to nodes in their plane, so these can be set beforehand.
  fix_covered_nodes(fluid, 1.0);
  const int iterations = Projection(fluid).run();
  fix_covered_nodes(fluid, 1.0);
  if (const BodyMotion body = body_motion(fluid); body.found) start_far_field(fluid, body.centre);
  fluid.account = {};
  return iterations;
}

}  // namespace

int start_potential_flow(Fluid& fluid) {
  // Sound crosses about four of the finest cells in this time.
  fluid.start_damping = {1.5, 8.0 * stable_step(fluid)};
  const int iterations = project(fluid);
  add_bernoulli_pressure(fluid);
  finish_filling(fluid);
  return iterations;
}

int adapt_potential_flow(Fluid& fluid, const Overlap& now, const Overlap& soon, double waterline) {
  const Account first = fluid.account;
  auto velocity = fluid.velocity;
  fill_hydrostatic(fluid, soon, waterline);
  fluid.velocity = std::move(velocity);
  const int iterations = project(fluid);
  velocity = fluid.velocity;
  fill_hydrostatic(fluid, now, waterline);
  fluid.velocity = std::move(velocity);
  add_bernoulli_pressure(fluid);
  finish_filling(fluid);
  // Who has read the account already finds the same sums: the change counts as given from outside.
  Account& account = fluid.account;
  account.node_fix = first.energy_sum() - account.energy_sum();
  for (int d = 0; d < 3; ++d) account.boundary_impulse[d] = first.momentum[d] - account.momentum[d];
  for (int m = 0; m < 2; ++m) account.boundary_mass[m] = first.mass[m] - account.mass[m];
  return iterations;
}

}  // namespace polynya::fluid
