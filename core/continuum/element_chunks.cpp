#include "core/continuum/element_chunks.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "core/compute/pack.hpp"

namespace polynya::continuum {
namespace {

constexpr std::size_t w = compute::pack_width;

/// Some 8192 elements, whose nodes (numbered in 16 bits) fit a core's own cache; fewer in a small mesh, so that threads
/// find chunks to share.
std::size_t chunk_size(std::size_t packs) {
  constexpr std::size_t most = 8192 / w, least = 128 / w, wanted_chunks = 16;
  return std::clamp((packs + wanted_chunks - 1) / wanted_chunks, least, most);
}

void list_elements_of_nodes(const HexMesh& mesh, ElementChunks& chunks) {
  const std::size_t nodes = mesh.node_count();
  chunks.node_start.assign(nodes + 1, 0);
  for (std::int32_t n : mesh.elements) ++chunks.node_start[n + 1];
  for (std::size_t n = 0; n < nodes; ++n) chunks.node_start[n + 1] += chunks.node_start[n];
  chunks.node_elements.resize(mesh.elements.size());
  std::vector<std::int32_t> next(chunks.node_start.begin(), chunks.node_start.end() - 1);
  for (std::size_t k = 0; k < mesh.elements.size(); ++k)
    chunks.node_elements[next[mesh.elements[k]]++] = static_cast<std::int32_t>(k / 8);
}

/// The nodes of the elements [begin, end), ascending; those of other chunks as well behind the others.
void list_nodes_of_chunk(const HexMesh& mesh, std::size_t begin, std::size_t end, ElementChunks& chunks,
                         std::vector<std::int32_t>& number) {
  std::vector<std::int32_t> all(mesh.elements.begin() + static_cast<std::ptrdiff_t>(8 * begin),
                                mesh.elements.begin() + static_cast<std::ptrdiff_t>(8 * end));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const auto alone = [&](std::int32_t n) {  // elements of a node are in ascending order
    const auto first = static_cast<std::size_t>(chunks.node_elements[chunks.node_start[n]]);
    const auto last = static_cast<std::size_t>(chunks.node_elements[chunks.node_start[n + 1] - 1]);
    return first >= begin && last < end;
  };
  const auto middle = std::stable_partition(all.begin(), all.end(), alone);
  chunks.start.push_back(static_cast<std::int32_t>(chunks.nodes.size()));
  chunks.first_shared.push_back(static_cast<std::int32_t>(chunks.nodes.size() + (middle - all.begin())));
  chunks.first_share.push_back(chunks.shares);
  chunks.shares += static_cast<std::int32_t>(all.end() - middle);
  for (std::size_t k = 0; k < all.size(); ++k) number[all[k]] = static_cast<std::int32_t>(k);
  chunks.nodes.insert(chunks.nodes.end(), all.begin(), all.end());
}

void list_shares(std::size_t nodes, ElementChunks& chunks) {
  std::vector<std::int32_t> count(nodes, 0);
  const auto for_shares = [&](auto&& body) {
    for (std::size_t c = 0; c < chunks.chunk_count(); ++c)
      for (std::int32_t k = chunks.first_shared[c]; k < chunks.start[c + 1]; ++k)
        body(chunks.nodes[k], chunks.first_share[c] + k - chunks.first_shared[c]);
  };
  for_shares([&](std::int32_t n, std::int32_t) { ++count[n]; });
  chunks.share_start.assign(1, 0);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (count[n] == 0) continue;
    chunks.shared_nodes.push_back(static_cast<std::int32_t>(n));
    chunks.share_start.push_back(chunks.share_start.back() + count[n]);
    count[n] = chunks.share_start[chunks.share_start.size() - 2];  // from now on where its next share goes
  }
  chunks.share_of.resize(static_cast<std::size_t>(chunks.shares));
  for_shares([&](std::int32_t n, std::int32_t share) { chunks.share_of[count[n]++] = share; });
}

/// Cuts [begin, end) of `order` across its longest side into halves of whole chunks, until one is left.
void bisect(const std::vector<std::array<double, 3>>& centres, std::size_t chunk, std::span<std::int32_t> order) {
  const std::size_t chunks = (order.size() + chunk - 1) / chunk;
  if (chunks < 2) {
    std::sort(order.begin(), order.end());
    return;
  }
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::int32_t e : order)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], centres[e][i]);
      high[i] = std::max(high[i], centres[e][i]);
    }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  const std::size_t half = (chunks + 1) / 2 * chunk;
  std::nth_element(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
      [&](std::int32_t a, std::int32_t b) { return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b); });
  bisect(centres, chunk, order.first(half));
  bisect(centres, chunk, order.subspan(half));
}

std::vector<std::array<double, 3>> centres_of(const HexMesh& mesh) {
  std::vector<std::array<double, 3>> centres(mesh.element_count());
  for (std::size_t k = 0; k < mesh.elements.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) centres[k / 8][i] += 0.125 * mesh.nodes[3 * mesh.elements[k] + i];
  return centres;
}

}  // namespace

HexMesh in_blocks(const HexMesh& mesh, std::vector<std::int32_t>* element_from, std::vector<std::int32_t>* node_from) {
  std::vector<std::int32_t> order(mesh.element_count()), number(mesh.node_count(), -1), from;
  std::iota(order.begin(), order.end(), 0);
  bisect(centres_of(mesh), chunk_size(compute::padded(mesh.element_count()) / w) * w, order);
  const auto take = [&](std::int32_t node) {
    if (number[node] >= 0) return;
    number[node] = static_cast<std::int32_t>(from.size());
    from.push_back(node);
  };
  HexMesh blocks;
  for (std::int32_t e : order)
    for (std::size_t a = 0; a < 8; ++a) {
      take(mesh.elements[8 * e + a]);
      blocks.elements.push_back(number[mesh.elements[8 * e + a]]);
    }
  for (std::size_t n = 0; n < mesh.node_count(); ++n) take(static_cast<std::int32_t>(n));  // of no element: last
  for (std::int32_t n : from)
    blocks.nodes.insert(blocks.nodes.end(), mesh.nodes.begin() + 3 * n, mesh.nodes.begin() + 3 * n + 3);
  if (element_from) *element_from = std::move(order);
  if (node_from) *node_from = std::move(from);
  return blocks;
}

ElementChunks make_chunks(const HexMesh& mesh) {
  ElementChunks chunks;
  const std::size_t elements = mesh.element_count(), packs = compute::padded(elements) / w;
  chunks.packs_per_chunk = chunk_size(packs);
  list_elements_of_nodes(mesh, chunks);
  chunks.connectivity.resize(8 * w * packs);
  std::vector<std::int32_t> number(mesh.node_count());
  for (std::size_t pack = 0; pack < packs; pack += chunks.packs_per_chunk) {
    const std::size_t last = std::min(packs, pack + chunks.packs_per_chunk);
    list_nodes_of_chunk(mesh, pack * w, std::min(elements, last * w), chunks, number);
    for (std::size_t e = pack * w; e < last * w; ++e)
      for (std::size_t a = 0; a < 8; ++a)
        chunks.connectivity[(e / w * 8 + a) * w + e % w] =
            static_cast<std::uint16_t>(number[mesh.elements[8 * (e < elements ? e : pack * w) + a]]);
  }
  chunks.start.push_back(static_cast<std::int32_t>(chunks.nodes.size()));
  list_shares(mesh.node_count(), chunks);
  return chunks;
}

}  // namespace polynya::continuum
