#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/exchange/message.hpp"

namespace polynya::exchange {

/// Keeps of one participant's messages (docs/protocol.md, sections 4 and 5) the vertices, triangles, cells and faces
/// inside a box: to look at, not to replay. Indices stay those of the whole message; of a surface the array
/// `region.vertices` says which of its vertices were kept. What has no place (accounts, grid lines, arrays of unknown
/// names) stays whole.
class RecordRegion {
 public:
  /// m; lowest x, y, z, then highest. Everything on the border is inside.
  explicit RecordRegion(std::array<double, 6> box) : box_(box) {}

  /// The part of the participant's next message that lies inside, whoever sent it.
  Message restrict(const Message& message);

 private:
  using Mask = std::vector<bool>;

  bool inside(const std::array<double, 3>& point) const;
  void note_vertices(const Message& message);
  void note_cells(const Message& message);
  std::array<double, 3> place(std::int64_t index, int face_axis) const;
  Array runs_inside(const Message& message, const std::string& name, int face_axis) const;
  const Mask* mask_for(const std::string& array) const;

  std::array<double, 6> box_;
  std::array<std::vector<double>, 3> lines_;  ///< m, of the fluid's grid as `ready` told it
  double shift_ = 0;                          ///< m, of its planes across z since then
  Mask vertices_, triangles_, loads_, cells_, walls_, walls_before_;
  std::array<Mask, 3> faces_;
};

}  // namespace polynya::exchange
