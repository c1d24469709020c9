#include "ice_solver/account.hpp"
#include "ice_solver/run.hpp"
#include "ice_solver/scene_options.hpp"

namespace polynya::ice {

nlohmann::json last_words(const IceRun& run) {
  const Account a = account_of(run.ice);
  const double factor = multiplicity(run.scene);
  const auto& converted = run.ice.books.converted;
  return {{"broken_ice_mass", factor * a.broken_mass},
          {"converted_elements", a.converted_elements},
          {"converted_by_strain", converted.strained},
          {"converted_by_collapse", converted.collapsed},
          {"particles", a.particles},
          {"density_bounded", run.ice.particles.steps_at_bound},
          {"elements", run.ice.solid.element_count()},
          {"nodes", run.ice.solid.node_count()},
          {"steps", run.steps},
          {"smallest_step", run.smallest_step},
          {"list_builds", run.ice.list.builds()},
          {"awake_fraction", run.ice.solid.sleeping.share_awake()},
          {"sleeping_threshold", run.ice.solid.sleeping.threshold},
          {"multiplicity", factor},
          {"energies",
           {{"kinetic", factor * a.kinetic},
            {"internal", factor * a.internal},
            {"hourglass", factor * a.hourglass},
            {"viscous", factor * a.viscous},
            {"conversion_heat", factor * a.conversion_heat},
            {"boundary_flux", factor * a.boundary_flux},
            {"external_work", factor * a.external_work},
            {"gravity_work", factor * a.gravity_work},
            {"balance", factor * a.balance()}}}};
}

}  // namespace polynya::ice
