#pragma once
#include "core/exchange/message.hpp"
#include "fluid_solver/grid.hpp"
#include "fluid_solver/overlap.hpp"

namespace polynya::fluid {

/// The overlap arrays of a `begin` or `span` message (docs/protocol.md, section 5), runs written out. Throws
/// ProtocolError when one is missing or of another shape, sizes disagree, or numbers of cells or faces do not ascend,
/// come twice or leave the grid.
Overlap read_overlap(const exchange::Message& message, const Grid& grid);

}  // namespace polynya::fluid
