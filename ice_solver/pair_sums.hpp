#pragma once
#include <span>
#include <vector>

#include "ice_solver/neighbour_list.hpp"
#include "ice_solver/points.hpp"

namespace polynya::ice {

/// Artificial viscosity of Monaghan (1992): Pi = (-alpha c mu + beta mu^2)/rho for approaching pairs,
/// mu = h v.r / (r^2 + 0.01 h^2).
struct PairViscosity {
  double alpha = 1.0, beta = 2.0;
  double sound_speed = 0;  ///< m/s of the undamaged material
};

/// Powers and extremes that the sums find on the way.
struct PairBalance {
  double viscous_power = 0;  ///< W, heat made by the artificial viscosity of all pairs
  double bond_power = 0;     ///< W, work done on the pairs by the stress of elements (no energy of a state behind it)
};

/// The sums over neighbours. Holds the interleaved records the kernels read.
class PairSums {
 public:
  /// Velocity gradient of every particle, L_ab = dv_a/dx_b = sum_j m_j/rho_i (v_j - v_i)_a grad_b W_ij ([n][9]), and
  /// the largest speed at which a neighbour approaches it ([n], m/s).
  void velocity_gradients(const NeighbourList& list, const Points& particles, const Points& elements,
                          std::span<double> gradient, std::span<double> approach_speed);

  /// Forces on particles and elements, equal and opposite in every pair:
  /// F_i = m_i sum_j m_j (sigma_i/rho_i^2 + sigma_j/rho_j^2 - Pi_ij) grad_i W_ij.
  /// Where an element would pull on a particle, the element's part is scaled by the particle's cohesion.
  PairBalance forces(const NeighbourList& list, Points& particles, Points& elements, const PairViscosity& viscosity);

 private:
  void load_records(const NeighbourList& list, const Points& particles, const Points& elements, bool with_stress);

  struct alignas(128) Record {  // two cache lines, so that no load straddles two
    double value[16];
  };
  std::vector<Record> records_;  // [points + 1], the last one empty
};

}  // namespace polynya::ice
