#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace polynya::compute {

/// Runs body(begin, end) over [0, count) in chunks of fixed size. Chunks, not threads, own results, so that
/// what is computed does not depend on the number of threads.
template <class Body>
void for_chunks(std::size_t count, std::size_t chunk, Body&& body) {
  const std::ptrdiff_t chunks = static_cast<std::ptrdiff_t>((count + chunk - 1) / chunk);
#pragma omp parallel for schedule(static) if (chunks > 1)
  for (std::ptrdiff_t c = 0; c < chunks; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * chunk;
    body(begin, std::min(count, begin + chunk));
  }
}

/// The same for chunks that may take very different times: a thread takes the next chunk when it is done with one.
template <class Body>
void for_uneven_chunks(std::size_t count, std::size_t chunk, Body&& body) {
  const std::ptrdiff_t chunks = static_cast<std::ptrdiff_t>((count + chunk - 1) / chunk);
#pragma omp parallel for schedule(dynamic) if (chunks > 1)
  for (std::ptrdiff_t c = 0; c < chunks; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * chunk;
    body(begin, std::min(count, begin + chunk));
  }
}

/// Sum of term(i) over [0, count): partial sums per chunk, added in the order of the chunks.
template <class Term>
double ordered_sum(std::size_t count, std::size_t chunk, Term&& term) {
  const std::size_t chunks = (count + chunk - 1) / chunk;
  std::vector<double> partial(chunks, 0.0);
  for_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += term(i);
    partial[begin / chunk] = sum;
  });
  double total = 0.0;
  for (double p : partial) total += p;
  return total;
}

/// Smallest value(i) over [0, count), or `otherwise` if count is 0. The result does not depend on threads.
template <class Value>
double ordered_minimum(std::size_t count, std::size_t chunk, double otherwise, Value&& value) {
  const std::size_t chunks = (count + chunk - 1) / chunk;
  std::vector<double> partial(chunks, otherwise);
  for_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    double least = otherwise;
    for (std::size_t i = begin; i < end; ++i) least = std::min(least, value(i));
    partial[begin / chunk] = least;
  });
  double least = otherwise;
  for (double p : partial) least = std::min(least, p);
  return least;
}

}  // namespace polynya::compute
