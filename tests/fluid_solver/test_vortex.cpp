// The deforming vortex at the resolution of published comparisons. Labelled long.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/fluid_solver/transport.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

/// Fractions of the first material as 32-bit floats, x fastest, for docs/pictures/draw_vortex.py.
void write_fractions(const Fluid& fluid, const std::string& name) {
  std::ofstream file(std::filesystem::path(testing::TempDir()) / name, std::ios::binary);
  const Grid& grid = fluid.grid;
  for (int k = 1; k <= grid.nz; ++k) {
    for (int j = 1; j <= grid.ny; ++j) {
      for (int i = 1; i <= grid.nx; ++i) {
        const std::ptrdiff_t c = grid.at(i, j, k);
        const float part = static_cast<float>(fluid.material[water].volume[c] / fluid.after.volume[c]);
        file.write(reinterpret_cast<const char*>(&part), sizeof part);
      }
    }
  }
}

}  // namespace

TEST(Vortex, SphereOf64CellsComesBackAsPublishedPlanesBringIt) {
  bool deformed = false;
  const VortexResult result = run_vortex(64, [&](const Fluid& fluid, double time) {
    if (time >= 1.5 && !deformed) {
      write_fractions(fluid, "vortex_deformed.f32");
      deformed = true;
    }
    if (time > 3.0 - 1e-9) write_fractions(fluid, "vortex_returned.f32");
  });
  RecordProperty("shape_error", std::to_string(result.shape_error));
  std::printf("shape error %.3e, volume %.1e, bounds %.1e\n", result.shape_error, result.volume_error,
              result.bound_error);
  EXPECT_LT(result.volume_error, 1e-12);
  EXPECT_LT(result.bound_error, 1e-12);
  EXPECT_LT(result.shape_error, 3.0e-3);
}
