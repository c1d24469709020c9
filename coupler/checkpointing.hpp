#pragma once
#include "coupler/run_state.hpp"

/// Checkpoints of a coupled run. At the end of a span, after the loads of its last window, every participant writes its
/// file and then takes the next step; so whoever has sent its next message has written. When all have, the coupler
/// makes the checkpoint valid.
namespace polynya::coupler {

/// Says once, in the log, who cannot write checkpoints; then there are none.
void begin_checkpoints(Run& run);

/// At the end of a span: names the folder if a checkpoint is due now.
void choose_checkpoint(Run& run);

/// The window is complete and all loads are out: writes the coupler's own file.
void write_checkpoint(Run& run);

/// All solids, or the fluid, have answered since.
void solids_have_answered(Run& run);
void fluid_has_answered(Run& run);

/// Takes the state of the checkpoint, after all are `ready` with theirs. Throws CheckpointError where the times differ.
void load_checkpoint(Run& run);

}  // namespace polynya::coupler
