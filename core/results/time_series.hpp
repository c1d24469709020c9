#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/compute/state_archive.hpp"

namespace polynya::results {

/// Whether a run begins, or goes on from a checkpoint with the files that are there.
enum class Opening { fresh, continued };

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
  /// Continued: keeps what is there, to be cut to the length of the checkpoint (list_state); the header must be that of
  /// the columns.
  TimeSeries(std::string path, std::vector<Column> columns, Opening opening = Opening::fresh);
  ~TimeSeries();
  TimeSeries(TimeSeries&& other) noexcept;
  TimeSeries& operator=(TimeSeries&&) = delete;
  TimeSeries(const TimeSeries&) = delete;
  TimeSeries& operator=(const TimeSeries&) = delete;

  /// One value per column, in the order of the columns. Throws ResultsError on another number of values or a full disk.
  void append(std::span<const double> row);

  const std::vector<Column>& columns() const { return columns_; }

  /// The length of the file. The first row after loading replaces those that came later: until then all is as it was,
  /// in case another program refuses the checkpoint. Throws ResultsError if there are fewer.
  void list_state(compute::StateArchive& archive);

 private:
  void write_line();

  std::string path_;
  std::vector<Column> columns_;
  std::string line_;
  int descriptor_ = -1;
  std::int64_t length_ = 0;  ///< bytes written
  bool cut_ = false;         ///< before the next row: what is longer than that
};

}  // namespace polynya::results
