#include "core/exchange/replay.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <sstream>
#include <utility>

#include "core/exchange/channel.hpp"
#include "core/exchange/errors.hpp"
#include "core/exchange/message_difference.hpp"
#include "core/exchange/record_reader.hpp"

extern "C" __attribute__((noinline)) void polynya_replay_reached(double time) {
  asm volatile("" : : "x"(time) : "memory");  // or the compiler would drop the call
}

namespace polynya::exchange {
namespace {

std::string seconds(double time) {
  std::ostringstream text;
  text.precision(6);
  text << time << " s";
  return text.str();
}

std::string place(const RecordedMessage& recorded) {
  const std::string where = recorded.window < 0 ? "before window 0"
                            : recorded.message.kind() == "pressure" || recorded.message.kind() == "span"
                                ? "span " + std::to_string(recorded.window)
                                : "window " + std::to_string(recorded.window);
  return where + ", t = " + seconds(recorded.time) + ": '" + recorded.message.kind() + "'";
}

class ReplayChannel : public Channel {
 public:
  ReplayChannel(const Replay& replay, const std::string& participant)
      : replay_(replay), reader_(replay.record, participant), name_(participant) {}

  void send(Message&& message, const Envelope& envelope) override {
    envelope_ = envelope;
    if (message.kind() == "hello") return inbox_.push_back({Sender::coupler, -1, 0, Message("welcome")});
    if (message.kind() == "failed") return;
    const std::optional<RecordedMessage> recorded = next_of_participant();
    if (!recorded) return;  // the record ends here: the next message of the coupler is missed, not this one
    note_time(*recorded);
    if (recorded->time < replay_.from) return;
    check(message, *recorded);
  }

  std::optional<Delivery> next(std::chrono::milliseconds) override {
    RecordedMessage recorded = next_of_coupler();
    note_time(recorded);
    if (recorded.message.kind() == "bye") end("the end of the run");
    auto& header = recorded.message.header;
    if (recorded.time < replay_.from && header.contains("frame")) header["frame"] = -1;
    header.erase("threads");  // the best number among others, not alone
    Delivery delivery;
    delivery.message = std::move(recorded.message);
    delivery.envelope = envelope_;
    return delivery;
  }

  bool closed() override { return false; }
  std::chrono::steady_clock::time_point woke() const override { return {}; }
  void abandon_queued() override {}

 private:
  /// What the participant said next; what the coupler said before that waits in the inbox.
  std::optional<RecordedMessage> next_of_participant() {
    while (look() != nullptr) {
      RecordedMessage recorded = take();
      if (recorded.sender == Sender::participant) return recorded;
      inbox_.push_back(std::move(recorded));
    }
    return std::nullopt;
  }

  /// The next message; none where the record ends or leaves windows out.
  const RecordedMessage* look() {
    const RecordedMessage* next = reader_.look();
    gap_ = next != nullptr && next->window > window_ + 1;
    return gap_ ? nullptr : next;
  }

  RecordedMessage take() {
    RecordedMessage recorded = *reader_.next();
    window_ = std::max(window_, recorded.window);
    return recorded;
  }

  RecordedMessage next_of_coupler() {
    if (inbox_.empty()) {
      const RecordedMessage* recorded = look();
      if (recorded == nullptr) end(gap_ ? "where the record leaves windows out" : "where the record ends");
      if (recorded->sender == Sender::participant)
        throw ReplayDifference(place(*recorded) + " is on record, but " + name_ + " waits for the coupler instead");
      inbox_.push_back(take());
    }
    RecordedMessage recorded = std::move(inbox_.front());
    inbox_.pop_front();
    return recorded;
  }

  void note_time(const RecordedMessage& recorded) {
    if (time_ >= replay_.until && recorded.time > time_) end("as far as it was to go");
    time_ = recorded.time;
    if (reached_ || recorded.time < replay_.from || recorded.message.kind() == "welcome") return;
    reached_ = true;
    polynya_replay_reached(recorded.time);
  }

  void check(const Message& message, const RecordedMessage& recorded) {
    ++compared_;
    if (message.kind() != recorded.message.kind())
      throw ReplayDifference(place(recorded) + " is on record, but " + name_ + " sends '" + message.kind() + "'");
    const MessageDifference difference = compare(message, recorded.message);
    if (difference.first.empty()) return;
    ++differing_;
    if (first_.empty()) first_ = place(recorded) + ", " + difference.first;
    if (largest_.empty() || difference.size > size_) {
      size_ = difference.size;
      largest_ = place(recorded) + ", " + difference.largest;
    }
    const bool allowed = replay_.tolerance > 0 && difference.size <= replay_.tolerance;
    if (!allowed) too_large_ = true;
    if (!allowed && !replay_.keep_going)
      throw ReplayDifference(place(recorded) + ", " + (replay_.tolerance > 0 ? difference.largest : difference.first));
  }

  [[noreturn]] void end(const std::string& where) {
    std::string verdict = "replay of " + name_ + " to t = " + seconds(time_) + ", " + where + ": ";
    if (reached_ && replay_.from > 0) verdict += "from t = " + seconds(replay_.from) + " on, ";
    if (compared_ == 0) throw ReplayDifference(verdict + "nothing was sent from t = " + seconds(replay_.from) + " on");
    if (differing_ == 0) throw ReplayEnded(verdict + std::to_string(compared_) + " messages, all equal bit for bit");
    std::ostringstream size;
    size << size_;
    verdict += std::to_string(differing_) + " of " + std::to_string(compared_) + " messages differ, at most by " +
               size.str() + " of the array's largest value; first: " + first_ + "; largest: " + largest_;
    if (too_large_) throw ReplayDifference(verdict);
    throw ReplayEnded(verdict);
  }

  Replay replay_;
  RecordReader reader_;
  std::string name_;
  Envelope envelope_;
  std::deque<RecordedMessage> inbox_;
  std::int64_t window_ = -1;  // reached
  bool gap_ = false;
  double time_ = 0;
  bool reached_ = false, too_large_ = false;
  std::size_t compared_ = 0, differing_ = 0;
  double size_ = 0;
  std::string first_, largest_;
};

}  // namespace

std::unique_ptr<Channel> open_replay(const Replay& replay, const std::string& participant) {
  check_replayable(replay.record, participant);
  return std::make_unique<ReplayChannel>(replay, participant);
}

}  // namespace polynya::exchange
