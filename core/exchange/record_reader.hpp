#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/exchange/record_segment.hpp"

namespace polynya::exchange {

/// Names of the participants that a record holds, in the order of the alphabet; empty if there is no record.
std::vector<std::string> recorded_participants(const std::string& folder);

/// The messages of one participant's record, one after the other; one file is in memory at a time.
class RecordReader {
 public:
  /// Opens the first file. Throws RecordError when the record or this participant's part is missing or damaged.
  RecordReader(std::string folder, std::string participant);

  const RecordLabel& label() const { return label_; }
  /// The next message without taking it; null at the end.
  const RecordedMessage* look();
  /// The next message; nothing at the end.
  std::optional<RecordedMessage> next();

 private:
  bool open_next();

  std::string folder_, participant_;
  RecordLabel label_;
  std::deque<RecordedMessage> messages_;
  int files_ = 0;
};

/// Throws RecordError, one sentence, unless this participant can be replayed from the record: all of it is there from
/// the first message on, and no region was cut out.
void check_replayable(const std::string& folder, const std::string& participant);

}  // namespace polynya::exchange
