#pragma once
#include <string>

#include "geometry/hull/triangle_soup.hpp"

namespace polynya::geometry {

/// Reads STL (text or binary), OBJ or PLY (text or binary), told apart by the ending of the name. Faces with more than
/// three corners become fans of triangles. Coordinates are those of the file; equal points of an STL file are one.
/// GeometryError names the file, the place in it and what is wrong.
TriangleSoup read_surface(const std::string& path);

}  // namespace polynya::geometry
