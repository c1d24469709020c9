#pragma once
#include "coupler/run_state.hpp"

/// How long windows and spans are, and on how many threads.
namespace polynya::coupler {

/// Takes over the stable steps that the participants reported last.
void refresh_limits(Run& run);
void plan_next_span(Run& run);
/// Bounds the span by the lag of the fluid's loads on the lightest wall there is.
void bound_lag(Run& run, const geometry::CutCells& cells);

/// Length of the next window (s): `step`, or until something can act between the solids again, if that is much longer.
double next_length(Run& run, double step, bool span_ends);

/// The cores to share are those that this process was given. Processes whose threads the scene fixes keep them.
void begin_balance(Run& run, const std::vector<std::string>& names);
/// Tells the balance how long the windows of the span that ended took, and passes on what it wants to try.
void balance_threads(Run& run);

}  // namespace polynya::coupler
