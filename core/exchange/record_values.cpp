#include "core/exchange/record_values.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <optional>

#include "core/results/durable_file.hpp"

namespace polynya::exchange {
namespace {

/// A descriptor that closes.
struct File {
  int descriptor;
  explicit File(const std::string& path, int flags = 0)
      : descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags)) {
    if (descriptor < 0 && flags == 0) results::throw_file_error(path, errno);
  }
  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
};

/// Writes until all is written, or an error that is returned; `placed` becomes what is left.
int write(const File& file, PlacedValues& placed) {
  while (!placed.values.empty()) {
    const ssize_t written =
        ::pwrite(file.descriptor, placed.values.data(), placed.values.size(), static_cast<off_t>(placed.offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : ENOSPC;
    placed.offset += static_cast<std::uint64_t>(written);
    placed.values = placed.values.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Writes the whole blocks past the cache; `placed` becomes what is left.
void write_blocks(const File& file, const std::string& path, PlacedValues& placed) {
  if (file.descriptor < 0 || placed.values.size() < least_past_cache || placed.offset % disk_block != 0) return;
  const std::size_t whole = placed.values.size() / disk_block * disk_block;
  PlacedValues blocks{placed.offset, placed.values.first(whole)};
  const int error = write(file, blocks);
  // EINVAL: the file system wants other blocks. It gets the rest through its cache.
  if (error != 0 && error != EINVAL) results::throw_file_error(path, error);
  const std::size_t done = whole - blocks.values.size();
  placed = {placed.offset + done, placed.values.subspan(done)};
}

}  // namespace

void write_placed_values(const std::string& path, const std::vector<PlacedValues>& series, Route route) {
  if (series.empty()) return;
  const File cached(path);
  std::optional<File> direct;
  if (route == Route::past_cache) direct.emplace(path, O_DIRECT);
  for (PlacedValues placed : series) {
    if (direct) write_blocks(*direct, path, placed);
    if (const int error = write(cached, placed)) results::throw_file_error(path, error);
  }
}

}  // namespace polynya::exchange
