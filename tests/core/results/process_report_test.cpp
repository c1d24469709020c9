#include "core/results/process_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "temporary_folder.hpp"

using polynya::results::ProcessReport;

TEST(ProcessReport, AccountsForTimeAndMemoryOfThisProcess) {
  const TemporaryFolder folder;
  ProcessReport report;
  std::vector<double> numbers(10'000'000);  // 80 MB, all touched
  double sum = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) sum += numbers[i] = static_cast<double>(i);
  ASSERT_GT(sum, 0.0);
  report.waits["coupler"] = {{1, 1.5}, {2, 2.25}};
  report.set_headings({{"remap", 1.5}, {"messages", 1}}, {{"remap", 2.5}});
  report.counts["steps"] = 12;
  report.write(folder.path(), "fluid");
  const auto read = nlohmann::json::parse(read_text(folder / "logs/fluid.json"));
  EXPECT_GT(read["wall_time"], 0.0);
  EXPECT_LT(read["wall_time"], 60.0);
  EXPECT_GT(read["cpu_time"], 0.0);
  EXPECT_GT(read["peak_memory"], 80e6);
  EXPECT_LT(read["peak_memory"], 10e9);
  EXPECT_EQ(read["waiting_time"], 0.75);
  EXPECT_EQ(read["seconds"]["messages"], 0.25);  // the rest was waiting
  EXPECT_EQ(read["cpu_seconds"]["remap"], 2.5);
  EXPECT_EQ(read["seconds"]["remap"], 1.5);
  EXPECT_EQ(read["counts"]["steps"], 12);
}
