#pragma once
#include "core/results/checkpoint_file.hpp"
#include "fluid_solver/output.hpp"
#include "fluid_solver/prescribed_bodies.hpp"

namespace polynya::fluid {

/// Runs a fluid around bodies whose motion the scene prescribes to its end and writes RUN/series/bodies.csv: time and,
/// by body, force on it and moment about its reference point (both mean since the row before), place and velocity of
/// that point.
void run_bodies(const scene::Scene& scene, Fluid& fluid, PrescribedBodies& bodies, Output& output,
                const results::Checkpoints& checkpoints = {});

}  // namespace polynya::fluid
