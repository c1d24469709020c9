#pragma once
#include <array>
#include <vector>

/// Rows that a sweep of the remap works on.
namespace polynya::fluid {

/// Contents of a row of cells per present volume. `plain` is 1 where a material fills the cell and slopes are meant.
/// Rows that are not `general` hold one material and nothing else: their other arrays are those of all such rows.
struct CellRow {
  std::vector<double> storage;
  double* inverse = nullptr;  ///< of the present volume
  std::array<double*, 2> mass{}, energy{}, fraction{}, plain{};
  std::array<const double*, 2> seen_mass{}, seen_energy{}, seen_fraction{}, seen_plain{};
  bool general = false;
  int materials = 0;

  explicit CellRow(std::size_t width) : storage(9 * (width + 4), 0.0) {
    double* next = storage.data() + 2;  // a row may be read two cells before its first
    for (double** array :
         {&inverse, &mass[0], &mass[1], &energy[0], &energy[1], &fraction[0], &fraction[1], &plain[0], &plain[1]}) {
      *array = next;
      next += width + 4;
    }
  }
  CellRow(CellRow&&) = default;  // the pointers go along with the storage, a copy's would not
};

/// What crosses a row of faces.
struct FaceRow {
  std::vector<double> storage;
  double* swept = nullptr;  ///< volume, m^3
  std::array<double*, 2> mass{}, energy{}, volume{};

  explicit FaceRow(std::size_t width) : storage(7 * width, 0.0) {
    double* next = storage.data();
    for (double** array : {&swept, &mass[0], &mass[1], &energy[0], &energy[1], &volume[0], &volume[1]}) {
      *array = next;
      next += width;
    }
  }
  FaceRow(FaceRow&&) = default;
};

}  // namespace polynya::fluid
