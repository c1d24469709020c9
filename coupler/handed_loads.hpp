#pragma once
#include "coupler/ledger.hpp"
#include "coupler/solid_side.hpp"

/// How the fluid's loads reach the solids. The fluid answers to a span after it, the solids need loads within it: they
/// get what the fluid expects, plus its impedance times how otherwise the walls move than it assumes, and little by
/// little what had to be corrected afterwards. Where the impedance is the derivative of the fluid's answer, or more,
/// walls of any mass are stable, and the span may be longer than their periods (tests/coupler/handed_loads_test.cpp).
/// The idea is that of the added-mass partitioned schemes (Banks, Henshaw & Schwendeman 2014), with the discrete
/// response of one step of the fluid in the place of the impedance rho c.
namespace polynya::coupler {

/// Share of the outstanding impulse that a span hands on beside what is expected of it.
inline constexpr double corrected_share = 0.3;

struct SpanStart {
  double span = 0;         ///< s, length of the span that begins
  double last_span = 0;    ///< s, length of the one for which the impedance holds
  double window = 0;       ///< s, over which a force is held
  double last_window = 0;  ///< s, the one before it: loads act from the middle of a window to the middle of the next,
                           ///< so half of it is given and not handed on, by right
  bool expects = false;  ///< a forecast of this span is there; without it, what is outstanding is handed on evenly
};

/// What the loads F - Z (v - seen) of the span start from: `span_force` and impedances. A force that is held over a
/// window would overshoot where Z exceeds 2 mass / window; with v in the middle of the window, as the change of the
/// force since the last window moves it, it never does: with k = Z window / (2 mass) the load is
/// (F - Z (v - seen) + k last) / (1 + k). Where nothing moves that is F, whatever Z. What F lacks by it otherwise comes
/// back as outstanding.
void begin_span_loads(SolidSide& side, const SpanStart& start);

/// Sets the fluid's forces of the coming window and takes their impulse from what is outstanding. Returns its sum, N s.
Impulse hand_on_fluid_loads(SolidSide& side, double acting_time);

}  // namespace polynya::coupler
