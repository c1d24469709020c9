#include "core/results/time_series.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "core/results/error.hpp"
#include "temporary_folder.hpp"

using namespace polynya::results;

TEST(TimeSeries, HeaderCarriesUnitsAndNumbersReadBackExactly) {
  const TemporaryFolder folder;
  const std::array row{1.0 / 3.0, -2.5e-300, 40.0};
  {
    TimeSeries series(folder / "series/vehicle.csv", {{"time", "s"}, {"speed", "m/s"}, {"damage", ""}});
    series.append(row);
  }
  const std::string text = read_text(folder / "series/vehicle.csv");
  const std::string header = "time [s],speed [m/s],damage [-]\n";
  ASSERT_EQ(text.substr(0, header.size()), header);
  const char* at = text.c_str() + header.size();
  for (double value : row) {
    char* next = nullptr;
    EXPECT_EQ(std::strtod(at, &next), value);
    at = next + 1;
  }
}

TEST(TimeSeries, RefusesARowOfTheWrongLength) {
  const TemporaryFolder folder;
  TimeSeries series(folder / "a.csv", {{"time", "s"}, {"speed", "m/s"}});
  EXPECT_THROW(series.append(std::array{1.0}), ResultsError);
}

TEST(TimeSeries, NamesTheFileItCannotCreate) {
  try {
    TimeSeries series("/proc/polynya/a.csv", {{"time", "s"}});
    FAIL();
  } catch (const ResultsError& error) {
    EXPECT_NE(std::string(error.what()).find("/proc/polynya"), std::string::npos);
  }
}

TEST(TimeSeries, EveryAppendedRowSurvivesSigkill) {
  const TemporaryFolder folder;
  const std::string path = folder / "killed.csv";
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    TimeSeries series(path, {{"time", "s"}, {"speed", "m/s"}});
    for (int i = 0; i < 1000; ++i) series.append(std::array{1e-6 * i, 40.0 - std::sin(i)});
    if (::write(ready[1], "x", 1) != 1) std::_Exit(1);
    for (;;) ::pause();
  }
  char byte;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));

  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    double time = -1, speed = -1;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf", &time, &speed), 2);
    EXPECT_EQ(time, 1e-6 * rows);
    EXPECT_EQ(speed, 40.0 - std::sin(rows));
  }
  EXPECT_EQ(rows, 1000);
}
