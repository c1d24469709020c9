#pragma once
#include <atomic>
#include <limits>

#include "core/compute/parallel.hpp"
#include "core/continuum/hexahedron_kernel.hpp"

namespace polynya::continuum {

/// Throws BadElement for the first living element whose volume or stress is bad.
[[noreturn]] void report_bad_element(const ExplicitSolid& solid, std::size_t first_pack);

/// Sums element forces to the nodes, in the order of the elements.
void gather_forces(ExplicitSolid& solid);

/// The loop over elements for one law; T: the number that the kernel works in.
template <class T, class LawType>
void advance_all_elements(ExplicitSolid& solid, const LawType& law, double dt) {
  constexpr std::size_t packs_per_chunk = 128;
  const std::size_t packs = solid.idle.size();
  std::atomic<std::size_t> first_bad{std::numeric_limits<std::size_t>::max()};
  compute::for_chunks(packs, packs_per_chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pack = begin; pack < end; ++pack) {
      if (solid.idle[pack]) continue;
      bool good = true;
      for (std::size_t lane = 0; lane < compute::pack_width; lane += width_of<T>)
        good = advance_elements<LawType, T>(solid, law, {pack, lane}, dt) && good;
      if (!good) {
        std::size_t known = first_bad;
        while (pack < known && !first_bad.compare_exchange_weak(known, pack)) {
        }
      }
      const double* alive = &solid.element.alive[pack * compute::pack_width];
      bool dead = true;
      for (std::size_t lane = 0; lane < compute::pack_width; ++lane) dead = dead && alive[lane] == 0;
      solid.idle[pack] = dead;
    }
  });
  if (first_bad < packs) report_bad_element(solid, first_bad);
}

}  // namespace polynya::continuum
