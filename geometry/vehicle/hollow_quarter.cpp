#include <algorithm>
#include <cmath>

#include "geometry/vehicle/layered_hull.hpp"
#include "geometry/vehicle/quarter_mesh.hpp"

namespace polynya::geometry {
namespace {

/// `amount` at the edge (distance 0), fading linearly to zero within `reach`: spreads a mitre over a few elements.
double fading(double amount, double distance, double reach) {
  return amount * std::max(0.0, 1 - distance / reach);
}

/// The node of the cavity's surface that faces a node of the hull.
class InnerNode {
 public:
  InnerNode(const InnerOutline& cavity, const HullNet& net, double size)
      : cavity_(cavity),
        shoulder_begin_(net.ring_node(0, net.division.head_rows)),
        base_begin_(net.ring_node(0, net.division.rows())),
        size_(size) {}

  std::array<double, 3> operator()(std::int32_t index, const HullNode& node) const {
    const Meridian& outer = cavity_.outer();
    const double t = cavity_.thickness();
    const double reach = std::min(4 * t + size_, 0.9 * outer.radius());
    double radius = node.radius, depth = node.depth;
    if (index < shoulder_begin_) {
      const double first = cavity_.first_arc();
      const double shift = fading(first, node.arc, std::min(outer.head_arc(), 4 * first + size_));
      const MeridianPoint p = cavity_.head_point(node.arc + shift);
      radius = node.arc == 0 ? 0.0 : p.radius;
      depth = p.depth;
    } else if (index < base_begin_) {
      radius = cavity_.radius();
      const double above_base = outer.length() - node.depth;
      depth = node.depth - fading(t, above_base, std::min(reach, outer.length() - outer.head_length()));
    } else {
      radius = node.radius - fading(t, outer.radius() - node.radius, reach);
      depth = cavity_.base_depth();
    }
    return {radius * node.cosine, radius * node.sine, depth};
  }

 private:
  const InnerOutline& cavity_;
  std::int32_t shoulder_begin_, base_begin_;
  double size_;
};

}  // namespace

QuarterMesh make_hollow_quarter(const Meridian& outline, double wall_thickness, double size, int layers) {
  const InnerOutline cavity(outline, wall_thickness);
  const HullNet net = make_hull_net(outline, divide_hull(outline, size), true);
  const InnerNode inner(cavity, net, size);
  std::vector<std::array<double, 3>> inner_nodes(net.nodes.size());
  for (std::size_t i = 0; i < net.nodes.size(); ++i) inner_nodes[i] = inner(static_cast<std::int32_t>(i), net.nodes[i]);
  return layer_hull(net, inner_nodes, layers);
}

}  // namespace polynya::geometry
