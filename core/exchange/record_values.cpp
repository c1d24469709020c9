#include "core/exchange/record_values.hpp"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>

#include "core/results/durable_file.hpp"

namespace polynya::exchange {
namespace {

constexpr std::size_t most_parts = 1024;  // of one call: Linux takes no more

/// A descriptor that closes.
struct File {
  int descriptor;
  explicit File(const std::string& path) : descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
    if (descriptor < 0) results::throw_file_error(path, errno);
  }
  ~File() { ::close(descriptor); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
};

/// Takes what was written off the front of the parts.
void take_off(std::vector<iovec>& parts, std::size_t written) {
  std::size_t done = 0;
  while (done < parts.size() && written >= parts[done].iov_len) written -= parts[done++].iov_len;
  parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(done));
  if (written == 0) return;
  parts.front().iov_base = static_cast<std::byte*>(parts.front().iov_base) + written;
  parts.front().iov_len -= written;
}

/// Writes the parts one behind the other; returns where the last one ends.
std::uint64_t write_parts(const File& file, const std::string& path, std::uint64_t offset, std::vector<iovec>& parts) {
  while (!parts.empty()) {
    const ssize_t written =
        ::pwritev(file.descriptor, parts.data(), static_cast<int>(parts.size()), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) results::throw_file_error(path, errno);
    offset += static_cast<std::uint64_t>(written);
    take_off(parts, static_cast<std::size_t>(written));
  }
  return offset;
}

}  // namespace

void write_placed_values(const std::string& path, const std::vector<PlacedValues>& series) {
  if (series.empty()) return;
  const File file(path);
  std::vector<iovec> parts;
  for (const PlacedValues& placed : series) {
    std::uint64_t offset = placed.offset;
    for (const Bytes& bytes : *placed.values) {
      if (bytes.empty()) continue;
      parts.push_back({const_cast<std::byte*>(bytes.data()), bytes.size()});
      if (parts.size() == most_parts) offset = write_parts(file, path, offset, parts);
    }
    write_parts(file, path, offset, parts);
  }
}

}  // namespace polynya::exchange
