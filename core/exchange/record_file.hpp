#pragma once
#include <string>

#include "core/exchange/record_segment.hpp"
#include "core/exchange/record_values.hpp"

namespace polynya::exchange {

/// "RECORD/ice-00000.h5".
std::string segment_path(const std::string& folder, const std::string& participant, int number);

/// Writes one file of a record (layout: docs/debugging.md), aside and renamed: a reader sees all of it or nothing.
/// Throws results::ResultsError naming the file.
void write_segment(const std::string& path, const RecordSegment& segment, const RecordLabel& label,
                   Compression compression, Route route);

/// Reads it back. Throws RecordError naming the file when it is missing, damaged or of another version.
RecordSegment read_segment(const std::string& path, RecordLabel& label);

}  // namespace polynya::exchange
