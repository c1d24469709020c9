#pragma once
#include <span>
#include <string>
#include <vector>

namespace polynya::results {

/// A column of a time series; the unit is written behind the name: "speed [m/s]". An empty unit means a plain number:
/// "[-]".
struct Column {
  std::string name;
  std::string unit;
};

/// A CSV file that grows by rows: one header line, then shortest decimal numbers that read back to the same bits. Every
/// row is one write to the file as soon as it is appended, so the file is readable after SIGKILL.
class TimeSeries {
 public:
  /// Creates (or empties) the file and writes the header line; creates the folder. Throws ResultsError.
  TimeSeries(std::string path, std::vector<Column> columns);
  ~TimeSeries();
  TimeSeries(TimeSeries&& other) noexcept;
  TimeSeries& operator=(TimeSeries&&) = delete;
  TimeSeries(const TimeSeries&) = delete;
  TimeSeries& operator=(const TimeSeries&) = delete;

  /// One value per column, in the order of the columns. Throws ResultsError on another number of values or a full disk.
  void append(std::span<const double> row);

  const std::vector<Column>& columns() const { return columns_; }

 private:
  void write_line();

  std::string path_;
  std::vector<Column> columns_;
  std::string line_;
  int descriptor_ = -1;
};

}  // namespace polynya::results
