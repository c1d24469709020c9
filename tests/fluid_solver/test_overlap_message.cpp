// What the fluid reads of an overlap that travels in runs (docs/protocol.md, section 5).
#include <gtest/gtest.h>

#include "core/exchange/errors.hpp"
#include "fluid_solver/overlap_message.hpp"

using namespace polynya;
using namespace polynya::fluid;

namespace {

using Integers = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

/// 4 x 2 x 1 cells of 1 x 1 x 0.5 m.
Grid grid() {
  return {{0, 1, 2, 3, 4}, {0, 1, 2}, {0, 0.5}};
}

/// Cells 1 and 6 are cut, 6 has wall; cells 2 to 5 are solid.
exchange::Message overlap(const Integers& runs = {2, 4}, const Integers& wall = {6}, const Integers& cells = {1, 6},
                          const Integers& faces = {0, 5}) {
  exchange::Message message("span");
  const auto rows = [](const auto& values) { return static_cast<std::int64_t>(values.size()); };
  message.add<std::int64_t>("cell", {2}, cells);
  message.add<double>("solid_volume", {2}, Numbers{0.1, 0.2});
  message.add<double>("debris_volume", {2}, Numbers{0.01, 0.0});
  message.add<std::int64_t>("cell.full", {rows(runs) / 2, 2}, runs);
  message.add<std::int64_t>("wall", {rows(wall)}, wall);
  message.add<double>("wall_area", {rows(wall), 2, 3}, Numbers(6 * wall.size(), 0.5));
  message.add<double>("wall_velocity", {rows(wall), 2, 3}, Numbers(6 * wall.size(), 7.0));
  message.add<double>("wall_size", {rows(wall)}, Numbers(wall.size(), 3.0));
  for (const std::string name : {"face_x", "face_y", "face_z"}) {
    message.add<std::int64_t>(name, {2}, faces);
    message.add<double>(name + ".solid", {2}, Numbers{0.3, 0.4});
    message.add<std::int64_t>(name + ".full", {2, 2}, Integers{1, 2, 6, 1});
  }
  return message;
}

std::string error_of(const exchange::Message& message) {
  try {
    read_overlap(message, grid());
  } catch (const exchange::ProtocolError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(FluidOverlapMessage, RunsBecomeWhollySolidCellsInAscendingOrder) {
  const Overlap read = read_overlap(overlap(), grid());
  EXPECT_EQ(read.cell, (Integers{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read.solid_volume, (Numbers{0.1, 0.5, 0.5, 0.5, 0.5, 0.2}));
  EXPECT_EQ(read.debris_volume, (Numbers{0.01, 0, 0, 0, 0, 0}));
}

TEST(FluidOverlapMessage, OnlyTheCellsNamedHaveWall) {
  const Overlap read = read_overlap(overlap(), grid());
  EXPECT_EQ(read.walled, (Integers{6}));
  ASSERT_EQ(read.wall_area.size(), 36U);
  for (std::size_t at = 0; at < 36; ++at) {
    EXPECT_EQ(read.wall_area[at], at < 30 ? 0.0 : 0.5);
    EXPECT_EQ(read.wall_velocity[at], at < 30 ? 0.0 : 7.0);
  }
  EXPECT_EQ(read.wall_size, (Numbers{0, 0, 0, 0, 0, 3}));
}

TEST(FluidOverlapMessage, WallsThatDoNotSayWhatTheySweepMoveAsOnePiece) {
  exchange::Message message = overlap();
  EXPECT_TRUE(read_overlap(message, grid()).wall_sweep.empty());
  message.add<double>("wall_sweep", {1, 2}, Numbers{0.3, -0.1});
  EXPECT_EQ(read_overlap(message, grid()).wall_sweep, (Numbers{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.3, -0.1}));
  exchange::Message longer = overlap();
  longer.add<double>("wall_sweep", {3, 1}, Numbers{0.3, -0.1, 0.0});
  EXPECT_THROW(read_overlap(longer, grid()), exchange::ProtocolError);
}

TEST(FluidOverlapMessage, WallsThatDoNotSayTheirSizeHaveTheLengthsOfTheirAreas) {
  exchange::Message message = overlap();
  std::erase_if(message.arrays, [](const exchange::Array& array) { return array.name == "wall_size"; });
  EXPECT_TRUE(read_overlap(message, grid()).wall_size.empty());
  message.add<double>("wall_size", {2}, Numbers{3.0, 3.0});
  EXPECT_THROW(read_overlap(message, grid()), exchange::ProtocolError);
}

TEST(FluidOverlapMessage, RunsOfFacesAreClosed) {
  const Overlap read = read_overlap(overlap(), grid());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(read.face[axis], (Integers{0, 1, 2, 5, 6}));
    EXPECT_EQ(read.face_solid[axis], (Numbers{0.3, 1, 1, 0.4, 1}));
  }
}

TEST(FluidOverlapMessage, RunsBeyondTheGridOrIntoEachOtherAreRefused) {
  for (const Integers& runs : {Integers{2, 7}, Integers{-1, 2}, Integers{2, -1}, Integers{2, 2, 3, 1}})
    EXPECT_THROW(read_overlap(overlap(runs), grid()), exchange::ProtocolError);
}

TEST(FluidOverlapMessage, WallsInCellsThatAreNotListedAreRefused) {
  for (const Integers& wall : {Integers{7}, Integers{0}, Integers{6, 1}})
    EXPECT_THROW(read_overlap(overlap({2, 4}, wall), grid()), exchange::ProtocolError);
}

TEST(FluidOverlapMessage, CellsAndFacesOutOfOrderTwiceOrBeyondTheGridAreRefused) {
  EXPECT_EQ(error_of(overlap({2, 4}, {6}, {6, 1})),
            "message 'span': number 1 in 'cell' follows 6; numbers ascend, each once, from 0 to 7");
  EXPECT_EQ(error_of(overlap({2, 4}, {6}, {6, 6})),
            "message 'span': number 6 in 'cell' follows 6; numbers ascend, each once, from 0 to 7");
  EXPECT_EQ(error_of(overlap({2, 4}, {6}, {6, 8})),
            "message 'span': number 8 in 'cell' follows 6; numbers ascend, each once, from 0 to 7");
  EXPECT_EQ(error_of(overlap({2, 4}, {6}, {-1, 6})),
            "message 'span': number -1 in 'cell' follows -1; numbers ascend, each once, from 0 to 7");
  EXPECT_EQ(error_of(overlap({2, 4}, {6}, {1, 6}, {5, 0})),
            "message 'span': number 0 in 'face_x' follows 5; numbers ascend, each once, from 0 to 9");
  EXPECT_EQ(error_of(overlap({2, 4}, {6, 6})),
            "message 'span': cell 6 of 'wall' is not in 'cell', or not in ascending order");
}

TEST(FluidOverlapMessage, WhatIsCutAndFullAtOnceIsRefused) {
  EXPECT_EQ(error_of(overlap({2, 5})),
            "message 'span': number 6 is both in 'cell' and in a run of 'cell.full'; what is "
            "wholly solid is named in runs only");
  EXPECT_EQ(error_of(overlap({2, 4}, {6}, {1, 6}, {1, 5})),
            "message 'span': number 1 is both in 'face_x' and in a run of 'face_x.full'; what is wholly solid is named "
            "in runs only");
}

TEST(FluidOverlapMessage, RunsOfAnotherShapeAreRefused) {
  exchange::Message message = overlap();
  for (exchange::Array& array : message.arrays)
    if (array.name == "cell.full") array.shape = {2};
  EXPECT_EQ(error_of(message),
            "message 'span': array 'cell.full' has the shape [2], expected [r][2]: first and how many of each run");
  for (exchange::Array& array : message.arrays)
    if (array.name == "cell.full") array.shape = {2, 1};
  EXPECT_NE(error_of(message).find("has the shape [2][1], expected [r][2]"), std::string::npos);
}
