#include "core/results/time_series.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <utility>

#include "core/results/durable_file.hpp"
#include "core/results/error.hpp"

namespace polynya::results {

TimeSeries::TimeSeries(std::string path, std::vector<Column> columns, Opening opening)
    : path_(std::move(path)), columns_(std::move(columns)) {
  if (columns_.empty()) throw ResultsError("the time series " + path_ + " has no columns");
  create_folder_of(path_);
  const int mode = opening == Opening::fresh ? O_WRONLY | O_CREAT | O_TRUNC : O_RDWR;
  descriptor_ = ::open(path_.c_str(), mode | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw_file_error(path_, errno);
  for (const Column& column : columns_) {
    if (!line_.empty()) line_ += ',';
    line_ += column.name + " [" + (column.unit.empty() ? "-" : column.unit) + "]";
  }
  if (opening == Opening::fresh) {
    write_line();
    return;
  }
  std::string found(line_.size() + 1, ' ');
  if (::pread(descriptor_, found.data(), found.size(), 0) != static_cast<ssize_t>(found.size()) ||
      found != line_ + '\n')
    throw ResultsError("the time series " + path_ + " has other columns than this program writes");
}

void TimeSeries::list_state(compute::StateArchive& archive) {
  archive.item("length", length_);
  if (!archive.loading()) return;
  const off_t there = ::lseek(descriptor_, 0, SEEK_END);
  if (there < length_)
    throw ResultsError("the time series " + path_ + " has " + std::to_string(there) + " bytes, " +
                       std::to_string(length_) + " when the checkpoint was taken");
  cut_ = true;
}

TimeSeries::TimeSeries(TimeSeries&& other) noexcept
    : path_(std::move(other.path_)),
      columns_(std::move(other.columns_)),
      line_(std::move(other.line_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      length_(other.length_),
      cut_(other.cut_) {}

TimeSeries::~TimeSeries() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void TimeSeries::append(std::span<const double> row) {
  if (row.size() != columns_.size())
    throw ResultsError("the time series " + path_ + " has " + std::to_string(columns_.size()) + " columns, a row of " +
                       std::to_string(row.size()) + " values was appended");
  line_.clear();
  char digits[32];
  for (double value : row) {
    if (!line_.empty()) line_ += ',';
    line_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  write_line();
}

void TimeSeries::write_line() {
  if (cut_ && (::ftruncate(descriptor_, length_) != 0 || ::lseek(descriptor_, length_, SEEK_SET) < 0))
    throw_file_error(path_, errno);
  cut_ = false;
  line_ += '\n';
  std::size_t done = 0;
  while (done < line_.size()) {
    const ssize_t written = ::write(descriptor_, line_.data() + done, line_.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw_file_error(path_, errno);
    done += static_cast<std::size_t>(written);
  }
  length_ += static_cast<std::int64_t>(line_.size());
}

}  // namespace polynya::results
