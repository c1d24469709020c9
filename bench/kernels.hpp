#pragma once
#include <functional>
#include <string>
#include <vector>

namespace polynya::bench {

/// One measured figure.
struct Figure {
  std::string name;  ///< "ice.hexahedron_jh2_ns"
  double value = 0;  ///< in the unit that ends the name
};

/// Shortest processor time of this thread in `repetitions` calls, s: other load on the machine counts little. A first
/// call, not counted, warms caches and pages.
double shortest_time(int repetitions, const std::function<void()>& call);

/// Processor time of this thread in one call, s.
double time_of(const std::function<void()>& call);

/// Shortest wall time of a call with one thread over that with two, taken in turns; a gain only on cores that are free.
double speedup_of_two_threads(int repetitions, const std::function<void()>& call);

// One function per file; each runs on one thread, and says so where it also tries two.
std::vector<Figure> machine_triad();
std::vector<Figure> hexahedron_elastic();
std::vector<Figure> hexahedron_jh2();
std::vector<Figure> hexahedron_scaling();
std::vector<Figure> particle();
std::vector<Figure> clip();
std::vector<Figure> contact_evaluate();
std::vector<Figure> window();
std::vector<Figure> fluid_step();
std::vector<Figure> fluid_sleeping();
std::vector<Figure> solid_sleeping();

}  // namespace polynya::bench
