#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace polynya::fluid {

/// A network of cells: neighbours by side (the cell itself where there is none) and weights of the faces between them
/// (0 where there is none).
struct CellNetwork {
  std::array<std::vector<std::int32_t>, 6> neighbours;
  std::array<std::vector<double>, 6> weights;
  std::size_t size() const { return neighbours[0].size(); }
};

/// Lumps of cells that hang together most: what moves volume along the whole of a wall at once, where an exchange
/// between neighbours takes an iteration per cell. Lumps grow by pairs, each cell (then lump) with the neighbour behind
/// its heaviest face: so they follow the strong links of graded grids (Notay 2010, Electron. Trans. Numer. Anal.
/// 37:123). Added to the inverse of the diagonal, the exact solution for the lumps makes a preconditioner whose number
/// of iterations hangs on the size of a lump rather than of the network (Nicolaides 1987, SIAM J. Numer. Anal. 24:355).
class CoarseNetwork {
 public:
  explicit CoarseNetwork(const CellNetwork& network);
  ~CoarseNetwork();
  CoarseNetwork(const CoarseNetwork&) = delete;
  CoarseNetwork& operator=(const CoarseNetwork&) = delete;

  /// Solves for the sums of `residual` over the lumps and adds the solution to every cell of `out`.
  void add_correction(const std::vector<double>& residual, std::vector<double>& out);
  /// By cell: the number of its lump.
  const std::vector<std::int32_t>& lump() const { return lump_; }

 private:
  struct Factors;
  std::vector<std::int32_t> lump_;
  std::unique_ptr<Factors> factors_;
};

}  // namespace polynya::fluid
