// The deforming vortex at the resolution of published comparisons. Labelled long.
#include <gtest/gtest.h>

#include "tests/fluid_solver/transport.hpp"

using namespace polynya::fluid::test;

TEST(Vortex, SphereOf64CellsComesBackAsPublishedPlanesBringIt) {
  const VortexResult result = run_vortex(64);
  RecordProperty("shape_error", std::to_string(result.shape_error));
  std::printf("shape error %.3e, volume %.1e, bounds %.1e\n", result.shape_error, result.volume_error,
              result.bound_error);
  EXPECT_LT(result.volume_error, 1e-12);
  EXPECT_LT(result.bound_error, 1e-12);
  EXPECT_LT(result.shape_error, 3.0e-3);
}
