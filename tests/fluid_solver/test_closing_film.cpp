// Films of water that bodies squeeze out, down to four cells.
#include <gtest/gtest.h>

#include "tests/fluid_solver/closing_film.hpp"

using namespace polynya::fluid::test;

TEST(ClosingFilm, StripFeelsTheForceOfItsJetsDownToFourCells) {
  for (const Squeeze& one : close_strip(80, 10, 12, 4)) {
    EXPECT_NEAR(one.mean, 1, 0.1) << one.gap;
    EXPECT_NEAR(one.least, 1, 0.15) << one.gap;
    EXPECT_NEAR(one.most, 1, 0.15) << one.gap;
  }
}

// A disc 40 cells in radius: above six cells the film is too thick for the formula, which knows nothing of the water around it.
TEST(ClosingFilm, DiscFeelsTheForceOfItsJetsDownToFourCells) {
  for (const Squeeze& one : close_disc(40, 20, 6, 4)) {
    EXPECT_NEAR(one.mean, 1, 0.1) << one.gap;
    EXPECT_NEAR(one.least, 1, 0.15) << one.gap;
    EXPECT_NEAR(one.most, 1, 0.15) << one.gap;
  }
}
