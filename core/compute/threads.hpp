#pragma once
#include <omp.h>

namespace polynya::compute {

/// Threads that parallel loops use from now on.
inline int threads() {
  return omp_get_max_threads();
}

/// Takes this many threads from now on; anything below 1 changes nothing. Results do not depend on it.
inline void use_threads(int count) {
  if (count > 0) omp_set_num_threads(count);
}

}  // namespace polynya::compute
