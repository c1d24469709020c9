#pragma once
#include "core/results/checkpoint_file.hpp"
#include "fluid_solver/output.hpp"

namespace polynya::fluid {

/// Runs the scene's dam to its end and writes RUN/series/dam.csv: time, front along the floor, height at the wall, and
/// the three over the column's length, time in units of sqrt(length / 2 g).
void run_dam(const scene::Scene& scene, Fluid& fluid, Output& output, const results::Checkpoints& checkpoints = {});

}  // namespace polynya::fluid
