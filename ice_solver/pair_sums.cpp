#include "ice_solver/pair_sums.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "core/compute/pack.hpp"
#include "core/compute/parallel.hpp"
#include "ice_solver/record_columns.hpp"
#include "ice_solver/smoothing_kernel.hpp"

namespace polynya::ice {
namespace {

using compute::Pack;
using compute::pack_width;

// Columns of a record: motion first, then what forces need. `role` is 1 for an element, 0 for a particle.
enum Motion : std::size_t { px, py, pz, vx, vy, vz, mass, length };
enum Strength : std::size_t { sxx, syy, szz, sxy, syz, szx, density, role };
constexpr std::size_t strength = 8;  // where the second half begins
constexpr std::size_t stride = RecordColumns::stride;

/// A pair's separation and mean smoothing length. The distance is kept from zero so that nothing is
/// divided by it.
struct Separation {
  Pack x, y, z, squared, distance, smoothing_length;
  Separation(const double* self, const Pack* other)
      : x(self[px] - other[px]), y(self[py] - other[py]), z(self[pz] - other[pz]) {
    squared = max(x * x + y * y + z * z, Pack(1e-200));
    distance = sqrt(squared);
    smoothing_length = 0.5 * (self[length] + other[length]);
  }
};

/// kernel_gradient_over_distance with 1/(h r) given.
Pack kernel_gradient(const Separation& r, const Pack& inverse_product) {
  const Pack q = r.squared * inverse_product, inverse_length = r.distance * inverse_product;
  const Pack outer = max(2.0 - q, Pack(0.0)), inner = max(1.0 - q, Pack(0.0));
  return (-0.75 / std::numbers::pi) * (outer * outer - 4.0 * inner * inner) *
         (inverse_length * inverse_length * inverse_length * inverse_product);
}

struct Vector {
  Pack x, y, z;
};

/// (sigma / rho^2) . separation; s: six columns, of one point or of a pack of points.
template <class Number>
Vector traction(const Number* s, const Separation& r) {
  return {s[sxx] * r.x + s[sxy] * r.y + s[szx] * r.z, s[sxy] * r.x + s[syy] * r.y + s[syz] * r.z,
          s[szx] * r.x + s[syz] * r.y + s[szz] * r.z};
}

struct ForceSum {
  Pack x{0.0}, y{0.0}, z{0.0}, viscous_x{0.0}, viscous_y{0.0}, viscous_z{0.0};
};

/// Adds the force of one pack of neighbours on `self`. Which side is an element is known per row or per lane.
template <bool self_is_element>
void add_pair_forces(const double* self, const double* records, const std::int32_t* neighbour,
                     const PairViscosity& viscosity, ForceSum& sum) {
  const RecordColumns motion(records, neighbour, 0), state(records, neighbour, strength);
  const Pack *other = motion.column, *other_state = state.column;
  const Separation r(self, other);
  const Pack smoothed = r.squared + 0.01 * r.smoothing_length * r.smoothing_length;
  const Pack mean_density = 0.5 * (self[strength + density] + other_state[density]);
  const Pack product = r.smoothing_length * r.distance, viscous_product = smoothed * mean_density;
  const Pack inverse = 1.0 / (product * viscous_product);  // one division for all
  const Pack weight = self[mass] * other[mass] * kernel_gradient(r, inverse * viscous_product);

  // Where an element takes part, the particle's stress stands for both sides.
  Vector own = traction(self + strength, r), theirs = traction(other_state, r);
  if constexpr (self_is_element) {
    own = theirs;
  } else {
    const auto element = other_state[role] != 0.0;
    where(element, theirs.x) = own.x;
    where(element, theirs.y) = own.y;
    where(element, theirs.z) = own.z;
  }

  const Pack dvx = self[vx] - other[vx], dvy = self[vy] - other[vy], dvz = self[vz] - other[vz];
  const Pack approach = dvx * r.x + dvy * r.y + dvz * r.z;
  const Pack inverse_viscous = inverse * product;
  const Pack mu = min(Pack(0.0), r.smoothing_length * approach * (inverse_viscous * mean_density));
  const Pack pressure =
      mu * (viscosity.beta * mu - viscosity.alpha * viscosity.sound_speed) * (inverse_viscous * smoothed);
  const Pack push = weight * pressure;
  sum.x += weight * (own.x + theirs.x);
  sum.y += weight * (own.y + theirs.y);
  sum.z += weight * (own.z + theirs.z);
  sum.viscous_x -= push * r.x;
  sum.viscous_y -= push * r.y;
  sum.viscous_z -= push * r.z;
}

}  // namespace

void PairSums::load_records(const NeighbourList& list, const Points& particles, const Points& elements,
                            bool with_stress) {
  const auto points = list.points();
  records_.resize(points.size() + 1);
  double* empty = records_[points.size()].value;
  std::fill(empty, empty + stride, 0.0);
  empty[px] = empty[py] = empty[pz] = 1e9;
  empty[length] = empty[strength + density] = 1.0;
  compute::for_chunks(points.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const PointSource& source = points[p];
      const Points& set = source.element ? elements : particles;
      const auto i = static_cast<std::size_t>(source.index);
      const MirrorSigns sign(source.mirror);
      double* record = records_[p].value;
      record[px] = sign.x * set.position[3 * i];
      record[py] = sign.y * set.position[3 * i + 1];
      record[pz] = set.position[3 * i + 2];
      record[vx] = sign.x * set.velocity[3 * i];
      record[vy] = sign.y * set.velocity[3 * i + 1];
      record[vz] = set.velocity[3 * i + 2];
      record[mass] = set.mass[i];
      record[length] = set.smoothing_length[i];
      if (!with_stress) {
        // Seen from a particle an element counts twice: see PairSums.
        if (source.element) record[mass] *= 2;
        continue;
      }
      const double* stress = &set.stress[6 * i];
      const double scale = 1 / (set.density[i] * set.density[i]);
      double* state = record + strength;
      state[sxx] = scale * stress[0];
      state[syy] = scale * stress[1];
      state[szz] = scale * stress[2];
      state[sxy] = sign.x * sign.y * scale * stress[3];
      state[syz] = sign.y * scale * stress[4];
      state[szx] = sign.x * scale * stress[5];
      state[density] = set.density[i];
      state[role] = source.element ? 1.0 : 0.0;
    }
  });
}

void PairSums::velocity_gradients(const NeighbourList& list, const Points& particles, const Points& elements,
                                  std::span<double> gradient, std::span<double> approach_speed) {
  load_records(list, particles, elements, false);
  const auto rows = list.rows();
  compute::for_chunks(rows.size(), NeighbourList::chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const PointSource& source = list.points()[static_cast<std::size_t>(rows[row].point)];
      if (source.element) continue;
      const double* self = records_[static_cast<std::size_t>(rows[row].point)].value;
      const std::int32_t* neighbour = list.row_begin(row);
      Pack xx(0.0), xy(0.0), xz(0.0), yx(0.0), yy(0.0), yz(0.0), zx(0.0), zy(0.0), zz(0.0), fastest(0.0);
      for (std::int32_t k = 0; k < rows[row].length; k += static_cast<std::int32_t>(pack_width)) {
        const RecordColumns columns(records_[0].value, neighbour + k, 0);
        const Pack* other = columns.column;
        const Separation r(self, other);
        const Pack inverse = 1.0 / (r.smoothing_length * r.distance);
        const Pack weight = other[mass] * kernel_gradient(r, inverse);
        const Pack dx = other[vx] - self[vx], dy = other[vy] - self[vy], dz = other[vz] - self[vz];
        const Pack gx = weight * r.x, gy = weight * r.y, gz = weight * r.z;
        xx += dx * gx, xy += dx * gy, xz += dx * gz;
        yx += dy * gx, yy += dy * gy, yz += dy * gz;
        zx += dz * gx, zy += dz * gy, zz += dz * gz;
        Pack speed = (dx * r.x + dy * r.y + dz * r.z) * (inverse * r.smoothing_length);
        where(weight == Pack(0.0), speed) = 0.0;  // out of reach
        fastest = max(fastest, speed);
      }
      const auto i = static_cast<std::size_t>(source.index);
      const double volume = 1 / particles.density[i];
      const Pack* sums[9] = {&xx, &xy, &xz, &yx, &yy, &yz, &zx, &zy, &zz};
      for (std::size_t k = 0; k < 9; ++k) gradient[9 * i + k] = volume * reduce(*sums[k]);
      approach_speed[i] = hmax(fastest);
    }
  });
}

void PairSums::forces(const NeighbourList& list, Points& particles, Points& elements, const PairViscosity& viscosity) {
  load_records(list, particles, elements, true);
  const auto rows = list.rows();
  compute::for_chunks(rows.size(), NeighbourList::chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const PointSource& source = list.points()[static_cast<std::size_t>(rows[row].point)];
      const double* self = records_[static_cast<std::size_t>(rows[row].point)].value;
      const std::int32_t* neighbour = list.row_begin(row);
      const std::int32_t* const row_end = neighbour + rows[row].length;
      ForceSum sum;
      for (; neighbour < row_end; neighbour += pack_width) {
        if (source.element) {
          add_pair_forces<true>(self, records_[0].value, neighbour, viscosity, sum);
        } else {
          add_pair_forces<false>(self, records_[0].value, neighbour, viscosity, sum);
        }
      }
      Points& set = source.element ? elements : particles;
      const std::size_t i = 3 * static_cast<std::size_t>(source.index);
      const Pack* const sums[] = {&sum.viscous_x, &sum.viscous_y, &sum.viscous_z, &sum.x, &sum.y, &sum.z};
      for (std::size_t c = 0; c < 3; ++c) {
        set.viscous_force[i + c] = reduce(*sums[c]);
        set.force[i + c] = reduce(*sums[3 + c]) + set.viscous_force[i + c];
      }
    }
  });
}

}  // namespace polynya::ice
