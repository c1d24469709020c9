#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cut_cells.hpp"

namespace polynya::geometry {

/// Spreads the volume of particles over the cells. Internal to the room; see Cutter::deposit_debris.
class DebrisDeposit {
 public:
  void deposit(const GridLines& grid, const std::array<LineLocator, 3>& lines, std::span<const double> positions,
               std::span<const double> volumes, double least_free, CutCells& out);

 private:
  struct Share {
    std::int64_t cell;
    double volume;
  };
  void spread(const GridLines& grid, const std::array<LineLocator, 3>& lines, std::span<const double> positions,
              std::span<const double> volumes);
  void merge_shares();
  double capacity(const GridLines& grid, const CutCells& cut, std::int64_t cell, double least_free) const;
  /// Limits every cell to its room and offers the excess to face neighbours; returns what is still without a place.
  double push_excess(const GridLines& grid, const CutCells& cut, double least_free);
  double limit(const GridLines& grid, const CutCells& cut, double least_free);
  void insert_entries(CutCells& out);

  std::vector<Share> shares_;
  std::vector<std::int64_t> moved_;  ///< per entry, its row after insertion
  std::vector<std::size_t> place_;   ///< per share, its row
};

}  // namespace polynya::geometry
