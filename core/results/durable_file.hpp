#pragma once
#include <string>
#include <string_view>

namespace polynya::results {

/// Name under which `path` is prepared before it is renamed.
std::string aside(const std::string& path);

/// Makes a finished file at aside(path) appear at `path`: fsync, rename, fsync of the folder. A reader sees the old
/// file or the whole new one. Throws ResultsError.
void commit_file(const std::string& path);

/// Replaces `path` by `text` through aside() and commit_file(). Creates the folder. Throws ResultsError.
void replace_text(const std::string& path, std::string_view text);

/// Creates the folder that will hold `path`. Throws ResultsError.
void create_folder_of(const std::string& path);

/// "cannot write PATH: reason of errno".
[[noreturn]] void throw_file_error(const std::string& path, int error_number);

}  // namespace polynya::results
