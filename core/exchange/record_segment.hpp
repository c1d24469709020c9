#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/exchange/growing_bytes.hpp"
#include "core/exchange/message.hpp"
#include "core/exchange/record_selection.hpp"

namespace polynya::exchange {

/// Of the arrays of a record's file; readers need not know. deflate: HDF5's own filters shuffle and deflate, level 1.
enum class Compression { none, deflate };

enum class Sender : std::uint8_t { participant = 0, coupler = 1 };

/// A message, who sent it, and when in the run: the window (of a fluid: the span) and the time (s) that the
/// conversation had reached. window is -1 for messages that have none.
struct RecordedMessage {
  Sender sender = Sender::participant;
  std::int64_t window = -1;
  double time = 0;
  Message message;
};

/// What every file of a record says about itself.
struct RecordLabel {
  std::string run, participant;
  RecordSelection selection;                    ///< what was to be recorded
  std::optional<std::array<double, 6>> region;  ///< m, lowest x, y, z, then highest: only this box was stored
};

/// A message of the segment, the first row that it has in a series, and one behind its last.
struct RowsOfMessage {
  std::int64_t message = 0, first = 0, last = 0;
};

/// All arrays of one name in one kind of message, one behind the other along their first extent. One that is the same
/// as the one before it shares its rows.
struct ArraySeries {
  std::string type;
  std::vector<std::int64_t> trailing;  ///< extents after the first
  bool scalar = false;                 ///< shape [] each
  std::vector<RowsOfMessage> rows;     ///< one for each message that carries it
  std::int64_t count = 0;              ///< of all rows
  GrowingBytes values;

  std::size_t row_bytes() const;
};

/// A part of a conversation as it lies in one file. Header frames are kept as they travel (docs/protocol.md), with the
/// arrays' names, types and shapes.
struct RecordSegment {
  std::vector<std::string> header;
  std::vector<std::uint8_t> sender;
  std::vector<std::int64_t> window;
  std::vector<double> time;
  std::map<std::pair<std::string, std::string>, ArraySeries> series;  ///< by kind and name
  std::size_t bytes = 0;

  /// False if an array changes its type or an extent other than the first: such a message needs a new segment.
  bool fits(const Message& message) const;
  /// Copies the message's arrays: their memory is wanted again at once by the next message.
  void append(const RecordedMessage& recorded, const std::string& run);
  /// Forgets the messages and keeps the memory of their arrays for others.
  void clear();
  /// The messages again, bit for bit; the segment is empty after it. Throws ProtocolError when header and arrays
  /// disagree.
  std::vector<RecordedMessage> take_messages();
};

}  // namespace polynya::exchange
