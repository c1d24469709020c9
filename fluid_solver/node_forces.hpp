#pragma once
#include <cstddef>

#include "fluid_solver/row_geometry.hpp"

namespace polynya::fluid {

/// What the predicted pressure and the weight of the cells around it do to each node of a row: the adjoint of the face
/// average, per free fraction of the node, N. Row: OpenRow, or TouchedRow where a solid touches one of the four rows of
/// cells around the nodes.
template <class Row>
struct NodeForces {
  Row own, below_y, below_z, below_yz;  ///< geometry of the rows of faces
  std::ptrdiff_t sy, sz;
  const double *p, *rho;
  double low, high;  ///< weight of half a layer below and above over density and area, m^2/s^2

  NodeForces(const Fluid& fluid, int j, int k)
      : own(fluid, j, k),
        below_y(fluid, j - 1, k),
        below_z(fluid, j, k - 1),
        below_yz(fluid, j - 1, k - 1),
        sy(fluid.grid.sy),
        sz(fluid.grid.sz),
        p(fluid.predicted_pressure.data() + fluid.grid.at(0, j, k)),
        rho(fluid.density.data() + fluid.grid.at(0, j, k)),
        low(0.5 * fluid.setup.gravity * fluid.grid.dz[k - 1]),
        high(0.5 * fluid.setup.gravity * fluid.grid.dz[k]) {}

  double x(std::ptrdiff_t n) const {
    const std::ptrdiff_t y = n - sy, z = n - sz, yz = n - sy - sz;
    return own.x(n) * (p[n - 1] - p[n]) + below_y.x(n) * (p[y - 1] - p[y]) + below_z.x(n) * (p[z - 1] - p[z]) +
           below_yz.x(n) * (p[yz - 1] - p[yz]);
  }
  double y(std::ptrdiff_t n) const {
    const std::ptrdiff_t z = n - sz;
    return own.y(n) * (p[n - sy] - p[n]) + own.y(n - 1) * (p[n - 1 - sy] - p[n - 1]) +
           below_z.y(n) * (p[z - sy] - p[z]) + below_z.y(n - 1) * (p[z - 1 - sy] - p[z - 1]);
  }
  double z(std::ptrdiff_t n) const {
    const std::ptrdiff_t y = n - sy;
    return own.z(n) * lift(n) + own.z(n - 1) * lift(n - 1) + below_y.z(n) * lift(y) + below_y.z(n - 1) * lift(y - 1);
  }

 private:
  /// Pressure that lifts a face, less the weight that it carries.
  double lift(std::ptrdiff_t f) const { return p[f - sz] - p[f] - (low * rho[f - sz] + high * rho[f]); }
};

/// True if no solid touches the four rows of cells around a row of nodes.
inline bool untouched_around(const Fluid& fluid, int j, int k) {
  return untouched(fluid, j, k) && untouched(fluid, j - 1, k) && untouched(fluid, j, k - 1) &&
         untouched(fluid, j - 1, k - 1);
}

}  // namespace polynya::fluid
