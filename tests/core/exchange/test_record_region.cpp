#include "core/exchange/errors.hpp"
#include "core/exchange/record_reader.hpp"
#include "core/exchange/record_region.hpp"
#include "core/exchange/recorder.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

using Integers = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

template <class T>
std::vector<T> values(const Message& message, const char* name) {
  const auto view = message.view<T>(name);
  return {view.begin(), view.end()};
}

/// Four vertices on the x axis at 0, 1, 2, 3 m and two triangles.
Message line_of_vertices() {
  Message message("ready");
  message.add<double>("positions", {4, 3}, Numbers{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0});
  message.add<std::int64_t>("surface.ids", {4}, Integers{10, 11, 12, 13});
  message.add<std::int32_t>("surface.triangles", {2, 3}, std::vector<std::int32_t>{0, 1, 2, 1, 2, 3});
  message.add<double>("account", {4}, Numbers{1, 2, 3, 4});
  return message;
}

TEST(RecordRegion, KeepsVerticesTrianglesAndLoadsInsideTheBox) {
  RecordRegion region({0.5, -1, -1, 3, 1, 1});
  const Message part = region.restrict(line_of_vertices());
  EXPECT_EQ(values<std::int64_t>(part, "surface.ids"), (Integers{11, 12, 13}));
  EXPECT_EQ(values<std::int64_t>(part, "region.vertices"), (Integers{1, 2, 3}));
  EXPECT_EQ(values<std::int32_t>(part, "surface.triangles"), (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_EQ(values<double>(part, "account"), (Numbers{1, 2, 3, 4}));

  Message loads("loads");
  loads.add<std::int64_t>("load.vertices", {2}, Integers{3, 0});
  loads.add<double>("load.forces", {2, 3}, Numbers{1, 2, 3, 4, 5, 6});
  const Message kept = region.restrict(loads);
  EXPECT_EQ(values<std::int64_t>(kept, "load.vertices"), (Integers{3}));
  EXPECT_EQ(values<double>(kept, "load.forces"), (Numbers{1, 2, 3}));
}

Message overlap(const Integers& cells) {
  Message message("span");
  message.add<std::int64_t>("cell", {static_cast<std::int64_t>(cells.size())}, cells);
  message.add<std::int64_t>("wall", {static_cast<std::int64_t>(cells.size())}, cells);
  message.add<std::int64_t>("cell.full", {1, 2}, Integers{3, 4});
  message.add<std::int64_t>("face_z.full", {1, 2}, Integers{1, 6});
  message.add<std::int64_t>("face_x", {3}, Integers{0, 1, 5});
  message.add<double>("face_x.solid", {3}, Numbers{0.1, 0.2, 0.3});
  message.add<std::int64_t>("face_z", {2}, Integers{0, 8});
  message.add<double>("face_z.solid", {2}, Numbers{0.4, 0.5});
  return message;
}

TEST(RecordRegion, KeepsCellsFacesAndTheirPressuresInsideTheBox) {
  RecordRegion region({0, 0, 0, 1.1, 2, 1});  // of a grid of 2 x 2 x 2 cells of 1 m
  Message ready("ready");
  for (const char* line : {"grid.x", "grid.y", "grid.z"}) ready.add<double>(line, {3}, Numbers{0, 1, 2});
  region.restrict(ready);
  // Cells 0, 1, 2, 7 have their centres at x = 0.5, 1.5, 0.5, 1.5 m and z = 0.5, 0.5, 0.5, 1.5 m.
  const Message span = region.restrict(overlap({0, 1, 2, 7}));
  EXPECT_EQ(values<std::int64_t>(span, "cell"), (Integers{0, 2}));
  // x-faces 0, 1, 5 lie at x = 0, 1, 2 m; z-faces 0 and 8 at z = 0 and 2 m.
  EXPECT_EQ(values<std::int64_t>(span, "face_x"), (Integers{0, 1}));
  EXPECT_EQ(values<double>(span, "face_x.solid"), (Numbers{0.1, 0.2}));
  EXPECT_EQ(values<double>(span, "face_z.solid"), (Numbers{0.4}));
  // Of cells 3 to 6 none lies at x = 0.5 m and z = 0.5 m; of z-faces 1 to 6 every other one at x = 0.5 m, none above 1
  // m.
  EXPECT_TRUE(values<std::int64_t>(span, "cell.full").empty());
  EXPECT_EQ(values<std::int64_t>(span, "face_z.full"), (Integers{2, 1, 4, 1, 6, 1}));

  region.restrict(overlap({1, 2}));
  Message pressure("pressure");
  pressure.add<double>("pressure.values", {2}, Numbers{1, 2});
  pressure.add<double>("pressure.previous_values", {4}, Numbers{3, 4, 5, 6});
  const Message kept = region.restrict(pressure);
  EXPECT_EQ(values<double>(kept, "pressure.values"), (Numbers{2}));
  EXPECT_EQ(values<double>(kept, "pressure.previous_values"), (Numbers{3, 5}));
}

TEST(RecordRegion, FollowsAGridThatMoves) {
  RecordRegion region({0, 0, 0, 2, 2, 1});  // of a grid of 2 x 2 x 2 cells of 1 m
  Message ready("ready");
  for (const char* line : {"grid.x", "grid.y", "grid.z"}) ready.add<double>(line, {3}, Numbers{0, 1, 2});
  ready.header["grid_shift"] = 0.0;
  region.restrict(ready);
  EXPECT_EQ(values<std::int64_t>(region.restrict(overlap({0, 4, 5, 7})), "cell"), (Integers{0}));
  Message span = overlap({0, 4, 5, 7});
  span.header["grid_shift"] = -1.2;  // the upper layer of cells has come to z = 0.3 m
  EXPECT_EQ(values<std::int64_t>(region.restrict(span), "cell"), (Integers{4, 5, 7}));
}

TEST(RecordRegion, ARecordOfARegionIsRefusedForReplay) {
  const SocketFolder folder;
  Recorder::Options options;
  options.folder = folder.path / "record";
  options.region = {0, 0, 0, 1, 1, 1};
  Recorder recorder(options);
  recorder.note("ice", Sender::participant, line_of_vertices());
  recorder.close();
  EXPECT_EQ(RecordReader(options.folder, "ice").next()->message.array("positions").shape, (Integers{2, 3}));
  const std::string refusal = message_of<RecordError>([&] { check_replayable(options.folder, "ice"); });
  EXPECT_NE(refusal.find("record.region"), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace polynya::exchange
