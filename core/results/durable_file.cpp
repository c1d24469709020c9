#include "core/results/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/results/error.hpp"

namespace polynya::results {
namespace {

std::string folder_of(const std::string& path) {
  const std::filesystem::path parent = std::filesystem::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

void synchronise(const std::string& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags);
  if (descriptor < 0) throw_file_error(path, errno);
  const int failed = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (failed != 0) throw_file_error(path, failed);
}

}  // namespace

void throw_file_error(const std::string& path, int error_number) {
  throw ResultsError("cannot write " + path + ": " + std::strerror(error_number));
}

std::string aside(const std::string& path) {
  return path + ".tmp";
}

void create_folder_of(const std::string& path) {
  std::error_code failed;
  std::filesystem::create_directories(folder_of(path), failed);
  if (failed) throw ResultsError("cannot create the folder " + folder_of(path) + ": " + failed.message());
}

void commit_file(const std::string& path) {
  const std::string prepared = aside(path);
  synchronise(prepared, O_RDONLY);
  if (std::rename(prepared.c_str(), path.c_str()) != 0) throw_file_error(path, errno);
  synchronise(folder_of(path), O_RDONLY | O_DIRECTORY);
}

void replace_text(const std::string& path, std::string_view text) {
  create_folder_of(path);
  const std::string prepared = aside(path);
  std::FILE* file = std::fopen(prepared.c_str(), "wb");
  if (file == nullptr) throw_file_error(prepared, errno);
  const bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int failed = errno;
  if (std::fclose(file) != 0 || !whole) throw_file_error(prepared, whole ? errno : failed);
  commit_file(path);
}

}  // namespace polynya::results
