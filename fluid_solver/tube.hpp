#pragma once
#include "core/results/checkpoint_file.hpp"
#include "core/scene/scene.hpp"
#include "fluid_solver/fluid.hpp"
#include "fluid_solver/output.hpp"

namespace polynya::fluid {

/// Runs the scene's shock tube alone and writes RUN/series/tube.csv: position, density, velocity and pressure at the
/// end, beside the exact solution where both materials are stiffened or ideal gases. Returns the mean relative error of
/// the density (L1), or -1 without an exact solution.
double run_tube(const scene::Scene& scene, Fluid& fluid, Output& output, const results::Checkpoints& checkpoints = {});

}  // namespace polynya::fluid
