#pragma once
#include "geometry/hull/triangle_soup.hpp"

/// Closed surfaces of simple bodies with outward triangles, lengths in m. Mirrored by the planes x = 0 and y = 0; round
/// ones hold the volume of the round body: the corners lie slightly outside of it, the triangles' middles inside.
namespace polynya::geometry {

/// About the origin; sides of triangles of about `edge`.
TriangleSoup sphere_surface(double diameter, double edge);

/// About the origin, axis along z; the round side has flat strips about `edge` wide.
TriangleSoup cylinder_surface(double diameter, double height, double edge);

/// About the origin, sides along x, y, z.
TriangleSoup box_surface(double length, double width, double height);

/// A prism with its sharp edge down, along y through the origin; its flat top is at z = height and `length` wide along
/// x.
TriangleSoup wedge_surface(double length, double width, double height);

/// Whether two closed surfaces have a point in common, or one lies inside the other. Exact.
bool bodies_meet(const TriangleSoup& a, const TriangleSoup& b);

}  // namespace polynya::geometry
