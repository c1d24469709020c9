#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace polynya::results {

/// Hexahedra as the launcher writes them from a mesh file, checked and renumbered for locality (HDF5): data sets
/// `nodes` [n][3], `elements` [e][8], `element_numbers` [e] and the group `sets` with one list of nodes per name.
struct MeshFile {
  std::vector<double> nodes;                              ///< [n][3], m
  std::vector<std::int32_t> elements;                     ///< [e][8], node indices in the order of VTK
  std::vector<std::int64_t> element_numbers;              ///< [e], in the file that the user made
  std::map<std::string, std::vector<std::int32_t>> sets;  ///< node indices
};

/// Throws std::runtime_error naming the file, and the data set that is missing or does not fit the others.
MeshFile read_mesh_file(const std::string& path);

}  // namespace polynya::results
