#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/continuum/explicit_solid.hpp"
#include "core/continuum/surface.hpp"

/// Loads that the scene puts on named sets of the ice's mesh.
namespace polynya::ice {

/// A row of numbers over time: linear between its entries, the last one lasts.
struct LoadCurve {
  std::vector<double> times;  ///< s, rising, the first 0
  std::vector<double> rows;   ///< [times][components]
};

/// A pressure (Pa, one component) pushes the faces whose four nodes are in the set, along their present normals, as
/// long as their elements live. A force (N, three components) is shared by the set: as a uniform traction over such
/// faces as they were at the start, or, where it has none, in equal parts by its nodes; a node without mass left loses
/// its part.
struct SetLoad {
  enum class Kind { pressure, force };
  Kind kind = Kind::pressure;
  std::string name;  ///< of the set
  std::vector<std::int32_t> nodes;
  LoadCurve curve;
};

/// The loads of a body, ready to be asked for their forces.
class SetLoads {
 public:
  SetLoads() = default;
  /// Throws std::invalid_argument naming the set in which a pressure finds no face on the surface.
  SetLoads(const continuum::ExplicitSolid& solid, const continuum::FaceNeighbours& neighbours,
           std::span<const SetLoad> loads);

  bool empty() const { return pressures_.empty() && forces_.empty(); }

  /// Forces at the body's time, [nodes][3], N: those that work equivalent to the loads gives (shape functions of the
  /// bilinear face, two by two points). Empty without loads.
  std::span<const double> at(const continuum::ExplicitSolid& solid);

 private:
  struct Pressure {
    LoadCurve curve;
    std::vector<std::int32_t> faces;  ///< 6 x element + local face
  };
  struct Force {
    LoadCurve curve;
    std::vector<std::int32_t> nodes;
    std::vector<double> shares;  ///< [nodes], their sum is 1
  };

  static Force shared(const continuum::ExplicitSolid& solid, const SetLoad& load, std::span<const std::int32_t> faces);

  std::vector<Pressure> pressures_;
  std::vector<Force> forces_;
  std::vector<double> force_;  ///< [nodes][3]
};

}  // namespace polynya::ice
