#pragma once
#include <string>

#include "core/results/frame_series.hpp"
#include "ice_solver/ice_body.hpp"

namespace polynya::ice {

/// The field frames of the ice: living elements as RUN/fields/ice_NNNN.vtkhdf, particles as
/// RUN/fields/particles_NNNN.vtkhdf.
class IceFrames {
 public:
  explicit IceFrames(const std::string& run_folder);
  void write(int number, const IceBody& ice);
  std::size_t count() const { return elements_.count(); }
  double last_time() const { return elements_.last_time(); }
  const std::string& folder() const { return folder_; }

  POLYNYA_STATE_WITHOUT((folder_), folder_, elements_, particles_)

 private:
  std::string folder_;  ///< RUN/fields
  results::FrameSeries elements_, particles_;
};

/// Living elements with stress, pressure, von_mises, damage, effective_strain, plastic_strain per cell and velocity,
/// displacement per point.
results::UnstructuredFields element_fields(const IceBody& ice);
/// Particles as vertices with damage, velocity, pressure, von_mises, density, smoothing_length.
results::UnstructuredFields particle_fields(const IceBody& ice);

}  // namespace polynya::ice
