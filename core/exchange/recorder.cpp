#include "core/exchange/recorder.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "core/exchange/record_file.hpp"
#include "core/exchange/record_region.hpp"

namespace polynya::exchange {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::size_t batch_bytes = 2 << 20;
constexpr double share_at_risk = 0.01;  ///< of a long run, that may lie in files not closed yet
/// Files grow with the record: what is in memory still when the run ends keeps it waiting, and many files are a burden.
constexpr std::size_t first_file_bytes = 16 << 20, files_of_a_record = 32;

struct Noted {
  std::string participant;
  RecordedMessage recorded;
};

std::size_t size_of(const Message& message) {
  std::size_t size = sizeof(Noted);
  for (const Array& array : message.arrays) size += array.bytes.size();
  return size;
}

/// Window and time that a conversation has reached: `loads` and `pressure` carry no time of their own.
struct Progress {
  std::int64_t window = -1;
  double time = 0;

  void take(const nlohmann::json& header) {
    for (const char* name : {"window", "span"})
      if (header.contains(name) && header[name].is_number_integer()) window = header[name].get<std::int64_t>();
    for (const char* name : {"time", "time1"})
      if (header.contains(name) && header[name].is_number()) time = header[name].get<double>();
  }
};

/// One participant's files. Belongs to the recorder's thread.
struct Conversation {
  RecordLabel label;
  std::optional<RecordRegion> region;
  Compression compression = Compression::none;
  RecordSegment segment;
  int files = 0;

  void write(const std::string& folder, Route route) {
    if (segment.header.empty()) return;
    write_segment(segment_path(folder, label.participant, files++), segment, label, compression, route);
    segment.clear();
  }

  void append(const std::string& folder, RecordedMessage&& recorded, Route route) {
    if (region) recorded.message = region->restrict(recorded.message);
    if (!segment.fits(recorded.message)) write(folder, route);
    segment.append(recorded, label.run);
  }
};

/// On Linux a thread has a niceness of its own: the solvers go first, the recorder takes what they leave.
void step_back() {
  pthread_setname_np(pthread_self(), "recorder");
  const auto thread = static_cast<id_t>(gettid());
  setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + 10);
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

struct Recorder::State {
  Options options;
  std::map<std::string, Progress> progress;           // of the run's thread
  std::int64_t window = -1;                           // likewise, of the run
  std::map<std::string, Conversation> conversations;  // of the recorder's thread
  std::deque<Noted> batch;                            // likewise, what it works at
  std::size_t taken_bytes = 0;                        // likewise
  Route route = Route::past_cache;                    // likewise
  Statistics statistics;

  std::mutex mutex;  // held for no longer than it takes to swap two queues: its holder has stepped back
  std::condition_variable arrived, room;
  std::deque<Noted> queue;
  std::atomic<std::size_t> queued_bytes = 0;  // in both queues
  std::atomic<bool> closing = false;
  std::exception_ptr error;
  Clock::time_point begun = Clock::now(), last_files = begun;
  std::thread thread;

  explicit State(Options given) : options(std::move(given)), thread([this] { work(); }) {}

  bool wanted(const std::string& participant, const Progress& now) const {
    const auto& chosen = options.participants;
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), participant) == chosen.end()) return false;
    // What is said before the first window describes surfaces and grid; later messages cannot be read without it.
    return now.window < 0 || options.selection.holds(window, now.time);
  }

  void put(Noted&& noted) {
    std::unique_lock lock(mutex);
    room.wait(lock, [&] { return queued_bytes < options.queue_bytes || error; });
    if (error) std::rethrow_exception(error);
    const std::size_t size = size_of(noted.recorded.message);
    queued_bytes += size;
    statistics.bytes += size;
    ++statistics.messages;
    queue.push_back(std::move(noted));
    if (full_batch()) arrived.notify_one();
  }

  /// Waking the thread for every message would cost the run more than copying it.
  bool full_batch() const { return queued_bytes >= std::min(batch_bytes, options.queue_bytes); }

  /// When the open files are due: their loss must not cost more than a little of the run.
  Clock::time_point due() const {
    const double passed = Seconds(last_files - begun).count();
    return last_files + std::chrono::duration_cast<Clock::duration>(
                            Seconds(std::max(options.segment_seconds, share_at_risk * passed)));
  }

  void work() {
    step_back();
    try {
      while (!closing) {
        {
          std::unique_lock lock(mutex);
          arrived.wait_until(lock, due(), [&] { return full_batch() || closing; });
          batch.swap(queue);
        }
        while (!batch.empty() && !closing) take(pop());
        if (!closing && Clock::now() >= due()) write_all();
      }
    } catch (...) {
      const std::scoped_lock lock(mutex);
      error = std::current_exception();
      room.notify_all();
    }
    statistics.busy_seconds = processor_seconds();
  }

  /// The oldest message of the batch.
  Noted pop() {
    Noted noted = std::move(batch.front());
    batch.pop_front();
    const std::size_t size = size_of(noted.recorded.message), before = queued_bytes.fetch_sub(size);
    // A disk that does not keep up must not hold the run while the kernel has memory to lend.
    route = closing || 2 * before > options.queue_bytes ? Route::through_cache : Route::past_cache;
    if (before >= options.queue_bytes) {
      const std::scoped_lock lock(mutex);
      room.notify_one();
    }
    return noted;
  }

  void take(Noted&& noted) {
    Conversation& conversation = conversations[noted.participant];
    if (conversation.label.participant.empty()) {
      conversation.label = {options.run, noted.participant, options.selection, options.region};
      conversation.compression = options.compression;
      if (options.region) conversation.region.emplace(*options.region);
    }
    taken_bytes += size_of(noted.recorded.message);
    conversation.append(options.folder, std::move(noted.recorded), route);
    if (conversation.segment.bytes >= file_bytes()) conversation.write(options.folder, route);
  }

  std::size_t file_bytes() const {
    return std::min(options.segment_bytes, std::max(first_file_bytes, taken_bytes / files_of_a_record));
  }

  void write_all() {
    for (auto& [name, conversation] : conversations) conversation.write(options.folder, route);
    last_files = Clock::now();
  }

  /// The rest is written by the caller, for whom the run waits: the thread has stepped back.
  void finish() {
    if (!thread.joinable()) return;
    {
      const std::scoped_lock lock(mutex);
      closing = true;
      arrived.notify_one();
    }
    thread.join();
    if (error) return;
    try {
      while (!batch.empty()) take(pop());
      for (batch.swap(queue); !batch.empty();) take(pop());
      route = Route::through_cache;
      write_all();
    } catch (...) {
      error = std::current_exception();
    }
  }
};

Recorder::Recorder(Options options) : state_(std::make_unique<State>(std::move(options))) {}

Recorder::~Recorder() {
  state_->finish();
}

void Recorder::note(const std::string& participant, Sender sender, const Message& message) {
  const auto start = Clock::now();
  Progress& now = state_->progress[participant];
  now.take(message.header);
  // The fluid counts spans; what it says belongs to the window in which it is said.
  if (message.header.contains("window")) state_->window = now.window;
  if (!state_->wanted(participant, now)) return;
  state_->put({participant, {sender, now.window, now.time, message}});
  state_->statistics.noting_seconds += Seconds(Clock::now() - start).count();
}

Recorder::Statistics Recorder::close() {
  const auto start = Clock::now();
  state_->finish();
  state_->statistics.closing_seconds = Seconds(Clock::now() - start).count();
  if (state_->error) std::rethrow_exception(state_->error);
  return state_->statistics;
}

}  // namespace polynya::exchange
