#pragma once
#include <string>

#include "core/results/mesh_file.hpp"
#include "core/scene/scene.hpp"
#include "ice_solver/ice_body.hpp"

namespace polynya::ice {

/// Gives the options the mesh of a scene with `ice.mesh` and its supports, from `file` (RUN/ice_mesh.h5); returns what
/// the file holds. Throws std::runtime_error naming the file and what is missing in it.
results::MeshFile use_imported_mesh(IceOptions& options, const scene::IceMesh& mesh, const std::string& file);

/// The element that sets the step of the ice at its start: its number in the user's file, its place and its step, and
/// what the median element would allow.
std::string element_that_sets_the_step(const IceBody& ice, const results::MeshFile& file);

}  // namespace polynya::ice
