#include "core/results/frame.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/results/error.hpp"
#include "core/results/frame_series.hpp"
#include "temporary_folder.hpp"

using namespace polynya::results;
using nlohmann::json;

namespace {

/// A row of hexahedra along x with a loose vertex above each.
UnstructuredFields row_of_hexahedra(std::int64_t count) {
  UnstructuredFields fields;
  for (std::int64_t i = 0; i <= count; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        fields.points.insert(fields.points.end(), {0.1 * static_cast<double>(i), 1.0 * j, 1.0 * k});
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t a = 4 * i, b = 4 * (i + 1);
    fields.add_cell(CellType::hexahedron, std::array{a, b, b + 2, a + 2, a + 1, b + 1, b + 3, a + 3});
  }
  for (std::int64_t i = 0; i < count; ++i) {
    fields.points.insert(fields.points.end(), {0.1 * static_cast<double>(i), 0.0, 7.0});
    fields.add_cell(CellType::vertex, std::array{4 * (count + 1) + i});
  }
  FieldArray velocity{"velocity", 3, {}}, pressure{"pressure", 1, {}};
  for (std::size_t i = 0; i < 3 * fields.point_count(); ++i)
    velocity.values.push_back(std::sin(static_cast<double>(i)));
  for (std::size_t i = 0; i < fields.cell_count(); ++i) pressure.values.push_back(1.0 / static_cast<double>(i + 3));
  fields.point_fields = {velocity};
  fields.cell_fields = {pressure};
  return fields;
}

json open_with_vtk(const std::string& path) {
  const std::string command =
      "/usr/bin/python3 " POLYNYA_SOURCE_DIR "/tests/core/results/open_frame.py " + path + " > " + path + ".txt";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return json::parse(read_text(path + ".txt"));
}

}  // namespace

TEST(Frame, IsReadBackByVtkBitForBit) {
  const TemporaryFolder folder;
  for (std::int64_t count : {1, 300}) {  // stored plainly and compressed
    const UnstructuredFields fields = row_of_hexahedra(count);
    write_frame(folder / "frame.vtkhdf", fields, 1.25e-3);
    EXPECT_FALSE(std::filesystem::exists(folder / "frame.vtkhdf.tmp"));
    const json read = open_with_vtk(folder / "frame.vtkhdf");
    EXPECT_EQ(read["class"], "vtkUnstructuredGrid");
    std::vector<double> points, velocity;
    for (const json& row : read["points"]) points.insert(points.end(), row.begin(), row.end());
    for (const json& row : read["point_fields"]["velocity"]) velocity.insert(velocity.end(), row.begin(), row.end());
    EXPECT_EQ(points, fields.points);
    EXPECT_EQ(velocity, fields.point_fields[0].values);
    EXPECT_EQ(read["cell_fields"]["pressure"].get<std::vector<double>>(), fields.cell_fields[0].values);
    EXPECT_EQ(read["types"].get<std::vector<std::uint8_t>>(), fields.types);
    std::vector<std::int64_t> connectivity;
    for (const json& cell : read["cells"]) connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    EXPECT_EQ(connectivity, fields.connectivity);
    EXPECT_EQ(read["field_data"]["TimeValue"].get<std::vector<double>>(), std::vector{1.25e-3});
  }
}

TEST(Frame, SinglePrecisionKeepsSevenDigits) {
  const TemporaryFolder folder;
  UnstructuredFields fields = row_of_hexahedra(100);
  fields.single_precision = true;
  fields.grid = {{"x", 1, {0.0, 0.1, 0.25}}};
  write_frame(folder / "frame.vtkhdf", fields, 0.0);
  const json read = open_with_vtk(folder / "frame.vtkhdf");
  for (std::size_t i = 0; i < fields.cell_count(); ++i)
    EXPECT_NEAR(read["cell_fields"]["pressure"][i], fields.cell_fields[0].values[i], 1e-7);
}

TEST(Frame, RefusesFieldsOfTheWrongSizeByName) {
  const TemporaryFolder folder;
  UnstructuredFields fields = row_of_hexahedra(2);
  fields.cell_fields[0].values.pop_back();
  try {
    write_frame(folder / "frame.vtkhdf", fields, 0.0);
    FAIL();
  } catch (const ResultsError& error) {
    EXPECT_NE(std::string(error.what()).find("pressure"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "frame.vtkhdf"));
}

TEST(FrameSeries, IndexNamesEveryFrameThatIsThere) {
  const TemporaryFolder folder;
  FrameSeries series(folder.path(), "ice");
  const UnstructuredFields fields = row_of_hexahedra(2);
  for (int number = 0; number < 3; ++number) {
    series.write(number, fields, 0.5 * number);
    const json index = json::parse(read_text(folder / "fields/ice.json"));
    ASSERT_EQ(index["frames"].size(), static_cast<std::size_t>(number + 1));
    EXPECT_EQ(index["frames"][static_cast<std::size_t>(number)]["time"], 0.5 * number);
    for (const json& frame : index["frames"])
      EXPECT_TRUE(std::filesystem::exists(folder / ("fields/" + frame["file"].get<std::string>())));
  }
}
