#pragma once
#include <array>

namespace polynya::fluid {

/// A plane through the unit cube: the first material fills {x in [0,1]^3 : normal . x <= offset}.
struct InterfacePlane {
  std::array<double, 3> normal{};  ///< any length but 0, any signs
  double offset = 0;
};

/// Part of the unit cube below the plane. (Compare Scardovelli & Zaleski 2000, J. Comput. Phys. 164:228.)
double fraction_below(const InterfacePlane& plane);

/// Offset at which the plane with this normal cuts off this fraction of the unit cube, 0 <= fraction <= 1.
double offset_for(const std::array<double, 3>& normal, double fraction);

/// The part below the plane of the slab of thickness `part` at the lower or upper face of the unit cube along an axis,
/// relative to the slab; 0 < part <= 1.
double fraction_of_slab(const InterfacePlane& plane, int axis, bool upper, double part);

/// Normal from the fractions of the first material in a cell and its 26 neighbours (by i + 3 j + 9 k), out of that
/// material, in units of the cell's widths (w_x n_x, ...): the mixed scheme of Aulisa et al. 2007, J. Comput. Phys.
/// 225:2301. `width` are those of the three cells along each axis. Zero where the fractions have no gradient.
std::array<double, 3> interface_normal(const std::array<double, 27>& fraction,
                                       const std::array<std::array<double, 3>, 3>& width);

}  // namespace polynya::fluid
