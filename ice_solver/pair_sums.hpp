#pragma once
#include <span>
#include <vector>

#include "ice_solver/neighbour_list.hpp"
#include "ice_solver/points.hpp"

namespace polynya::ice {

/// Artificial viscosity of Monaghan (1992): Pi = (-alpha c mu + beta mu^2)/rho for approaching pairs,
/// mu = h v.r / (r^2 + 0.01 h^2).
struct PairViscosity {
  double alpha = 0.1, beta = 2.0;
  double sound_speed = 0;  ///< m/s of the undamaged material
};

/// The sums over neighbours. Holds the interleaved records the kernels read.
///
/// An element beside a particle acts like the particle's mirror image: in the velocity gradient it counts twice, in the
/// force the particle's stress stands for both. So the force is the adjoint of the gradient, the work of every pair is
/// work of a particle's stress and no energy is lost or made in the bond; broken particles, whose stress is never
/// tensile, cannot be pulled by the ice beside them; and in a uniform state of stress all is in balance.
/// (With the element's own stress instead, the pair's stiffness is not symmetric: an elastic bar, half elements and
/// half particles, lost 30 % of its energy in the bond within two oscillations.)
class PairSums {
 public:
  /// Velocity gradient of every particle, L_ab = dv_a/dx_b = sum_j w_j m_j/rho_i (v_j - v_i)_a grad_b W_ij ([n][9], w =
  /// 2 for elements), and the largest speed at which a neighbour approaches it ([n], m/s).
  void velocity_gradients(const NeighbourList& list, const Points& particles, const Points& elements,
                          std::span<double> gradient, std::span<double> approach_speed);

  /// Forces on particles and elements, equal and opposite in every pair:
  /// F_i = m_i sum_j m_j (sigma_i/rho_i^2 + sigma_j/rho_j^2 - Pi_ij) grad_i W_ij.
  /// The part of Pi is given in viscous_force as well.
  void forces(const NeighbourList& list, Points& particles, Points& elements, const PairViscosity& viscosity);

 private:
  void load_records(const NeighbourList& list, const Points& particles, const Points& elements, bool with_stress);

  struct alignas(128) Record {  // two cache lines, so that no load straddles two
    double value[16];
  };
  std::vector<Record> records_;  // [points + 1], the last one empty
};

}  // namespace polynya::ice
