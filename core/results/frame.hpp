#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace polynya::results {

/// Values at the points or in the cells, [count][components] interleaved.
struct FieldArray {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

/// Types of cells, numbered as VTK numbers them.
enum class CellType : std::uint8_t { vertex = 1, triangle = 5, hexahedron = 12 };

/// An unstructured grid with fields, in the layout of the VTKHDF format.
struct UnstructuredFields {
  std::vector<double> points;              ///< [points][3], m
  std::vector<std::int64_t> connectivity;  ///< points of the cells, one cell after the other
  std::vector<std::int64_t> offsets{0};    ///< [cells + 1], where each cell starts in `connectivity`
  std::vector<std::uint8_t> types;         ///< [cells], CellType
  std::vector<FieldArray> point_fields;
  std::vector<FieldArray> cell_fields;
  std::vector<FieldArray> grid;   ///< optional 1-D data sets of the group /Grid, e.g. the grid lines x, y, z
  bool single_precision = false;  ///< store the fields (not the points) as 32-bit numbers

  /// Appends a cell of one type; `nodes` in the order of VTK.
  void add_cell(CellType type, std::span<const std::int64_t> nodes);
  std::size_t point_count() const { return points.size() / 3; }
  std::size_t cell_count() const { return types.size(); }
};

/// Writes one frame as VTKHDF UnstructuredGrid 1.0 (opened by ParaView 5.11 and by VTK 9.1's vtkHDFReader), compressed
/// by gzip 1 with shuffling; `time` in s is kept as field datum "TimeValue". The file is written aside, synchronised
/// and renamed. Throws ResultsError naming the file, also when the sizes of the fields do not fit the grid.
void write_frame(const std::string& path, const UnstructuredFields& fields, double time);

}  // namespace polynya::results
