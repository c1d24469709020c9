// Two boxes that overlap, touch or hold one another.
#include "union_boxes.hpp"

using namespace union_boxes;

TEST(UnionOfBoxes, IsExactInEveryCellAndFaceAnywhere) {
  std::mt19937 random(3);
  double worst = 0;
  std::int64_t united = 0, exactly = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Bounds a = random_box(random, false), b = random_box(random, false);
    const CutCells cut = cut_of(a.shape(1 + trial % 4), b.shape(1 + trial % 3));
    worst = std::max(worst, largest_error(cut, a, b));
    expect_closed(cut);
    united += cut.united_cells;
    exactly += cut.united_exactly;
  }
  std::printf("%ld cells united, %ld exactly; largest error %.1e\n", long(united), long(exactly), worst);
  EXPECT_GT(united, 1000);
  EXPECT_LT(worst, 1e-11);
}

TEST(UnionOfBoxes, IsExactWherePlanesEdgesAndCornersCoincide) {
  expect_degenerate_pairs(5, 300);
}

TEST(UnionOfBoxes, HoldsWherePlanesCoincideToRounding) {
  expect_turned_pairs(11, 150);
}

TEST(UnionOfBoxes, FacesThatLieOnEachOtherAreNotWetted) {
  for (const double plane : {0.0, 0.1}) {  // of the grid, and amid cells
    const Bounds lower{{-0.4, -0.3, -0.5}, {0.45, 0.35, plane}}, upper{{-0.2, -0.15, plane}, {0.3, 0.2, 0.6}};
    const CutCells cut = cut_of(lower.shape(3), upper.shape(2));
    EXPECT_LT(largest_error(cut, lower, upper), 1e-11);
    expect_closed(cut);
    const auto surface = [](const Bounds& b) { return 2 * (measure(b, 0) + measure(b, 1) + measure(b, 2)); };
    const double contact = 0.5 * 0.35;
    EXPECT_NEAR(wetted(cut), surface(lower) + surface(upper) - 2 * contact, 1e-11);
  }
}

TEST(UnionOfBoxes, OneInsideTheOtherIsNotSeen) {
  const Bounds outer{{-0.6, -0.55, -0.62}, {0.6, 0.6, 0.5}}, inner{{-0.2, -0.3, -0.1}, {0.3, 0.2, 0.3}};
  for (const bool swapped : {false, true}) {
    const Shape a = outer.shape(2), b = inner.shape(2);
    const CutCells cut = swapped ? cut_of(b, a) : cut_of(a, b);
    CutCells alone;
    Cutter(grid).cut(std::array{a.surface()}, alone);
    EXPECT_NEAR(total_volume(cut), measure(outer), 1e-12);
    EXPECT_NEAR(wetted(cut), wetted(alone), 1e-11);
    ASSERT_EQ(cut.cell, alone.cell);
    EXPECT_EQ(cut.walled, alone.walled);
    for (const WallPiece& piece : cut.pieces) EXPECT_EQ(piece.body, swapped ? 1 : 0);
    expect_closed(cut);
  }
}

TEST(UnionOfBoxes, ExactNumbersThroughoutGiveTheSame) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 12; ++trial) {
    const Bounds a = random_box(random, trial % 2 == 0), b = random_box(random, trial % 2 == 0);
    const Shape first = a.shape(2), second = b.shape(1);
    const CutCells packed = cut_of(first, second), exact = cut_of(first, second, true);
    EXPECT_LT(largest_error(exact, a, b), 1e-11);
    ASSERT_EQ(packed.cell, exact.cell);
    for (std::size_t e = 0; e < packed.cell.size(); ++e)
      EXPECT_NEAR(packed.solid_volume[e], exact.solid_volume[e], 1e-12 * h * h * h);
    for (std::size_t w = 0; w < packed.wall_area.size(); ++w)
      EXPECT_NEAR(packed.wall_area[w], exact.wall_area[w], 1e-12 * h * h);
    expect_closed(exact);
  }
}

TEST(UnionOfBoxes, OfThreeInOnePlaceIsNotClaimed) {
  const Shape a = Bounds{{-0.4, -0.4, -0.4}, {0.2, 0.3, 0.1}}.shape(2),
              b = Bounds{{-0.1, -0.3, -0.2}, {0.6, 0.4, 0.5}}.shape(2),
              c = Bounds{{-0.3, -0.2, -0.3}, {0.4, 0.1, 0.6}}.shape(2);
  Cutter cutter(grid);
  cutter.set_exact_union(add_below_exactly);
  CutCells cut;
  cutter.cut(std::array{a.surface(), b.surface(), c.surface()}, cut);
  EXPECT_GT(cut.doubted_unions, 0);
}
