#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace polynya::exchange {

/// A message or a header that does not follow docs/protocol.md.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An endpoint that cannot be used: unknown transport, socket path too long, address taken.
class EndpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The coupler did not accept this participant. reason is the coupler's sentence.
class Refused : public std::runtime_error {
 public:
  explicit Refused(std::string why) : std::runtime_error("the coupler refused: " + why), reason(std::move(why)) {}
  std::string reason;
};

/// The coupler asked for an early end: write what you have, exit with 1.
class Stopped : public std::runtime_error {
 public:
  explicit Stopped(std::string why) : std::runtime_error("stopped by the coupler: " + why), reason(std::move(why)) {}
  std::string reason;
};

/// The coupler cannot be reached, ended or was killed.
class CouplerLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A record that is missing, damaged, or not fit for a replay.
class RecordError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// In a replay: this participant said something else than what is on record.
class ReplayDifference : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// In a replay: all that was to be replayed has been. The text is the verdict; exit with 0.
class ReplayEnded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A participant left before its end: killed, crashed, disconnected, or gave up with a reason of its own.
class ParticipantLost : public std::runtime_error {
 public:
  ParticipantLost(std::string who, const std::string& how)
      : std::runtime_error(who + ": " + how), name(std::move(who)) {}
  std::string name;
};

/// Expected participants that did not come in time.
class ParticipantMissing : public std::runtime_error {
 public:
  ParticipantMissing(std::vector<std::string> who, const std::string& sentence)
      : std::runtime_error(sentence), names(std::move(who)) {}
  std::vector<std::string> names;
};

}  // namespace polynya::exchange
