#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/continuum/hex_mesh.hpp"

namespace polynya::continuum {

/// Elements are worked through in chunks: packs that follow one another in the mesh. A chunk copies the motion of its
/// nodes into the nearest cache and sums the forces of its elements there. A node of one chunk alone gets its force
/// from there at once; a node of several chunks has a share in each, and these are added in the order of the chunks. So
/// forces have the same bits for any number of threads. Everything follows from the mesh alone.
struct ElementChunks {
  std::size_t packs_per_chunk = 0;
  std::vector<std::uint16_t> connectivity;  ///< [pack][8][W], index into the chunk's nodes; padding lanes repeat the
                                            ///< first element of the chunk
  std::vector<std::int32_t> nodes;          ///< chunk by chunk: first the nodes it has alone, then those it shares
  std::vector<std::int32_t> start;          ///< [chunk + 1], into nodes
  std::vector<std::int32_t> first_shared;   ///< [chunk], into nodes
  std::vector<std::int32_t> first_share;    ///< [chunk], number of the share of its first shared node
  std::int32_t shares = 0;                  ///< of all chunks
  std::vector<std::int32_t> shared_nodes;   ///< of the mesh, ascending
  std::vector<std::int32_t> share_start;    ///< [shared node + 1], into share_of
  std::vector<std::int32_t> share_of;       ///< shares of every shared node, in the order of the chunks
  std::vector<std::int32_t> node_start;     ///< [mesh node + 1], into node_elements
  std::vector<std::int32_t> node_elements;  ///< elements around every node of the mesh, ascending

  std::size_t chunk_count() const { return first_shared.size(); }
};

ElementChunks make_chunks(const HexMesh& mesh);

/// The mesh with its elements in blocks of neighbours and its nodes in the order in which the elements meet them:
/// chunks then share few nodes. Elements keep their shape and the order of their nodes. `element_from` and `node_from`
/// (optional) tell what each had been.
HexMesh in_blocks(const HexMesh& mesh, std::vector<std::int32_t>* element_from = nullptr,
                  std::vector<std::int32_t>* node_from = nullptr);

}  // namespace polynya::continuum
