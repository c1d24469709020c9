#include "coupler/thread_balance.hpp"

#include <algorithm>
#include <utility>

namespace polynya::coupler {
namespace {

constexpr std::size_t spans_per_sample = 15;  // whose median counts: frames and new lists of neighbours do not
constexpr long spans_to_settle = 3;           // after a change: threads start, caches warm up
constexpr long spans_of_rest = 1000;          // after all trials, until the next ones: what is slow has changed by then
constexpr double worthwhile = 0.97;           // of the time before: smaller gains are noise

}  // namespace

int first_threads(const std::string& name, int cores) {
  return name == "fluid" || name == "coupler" ? cores : std::max(1, cores / 2);
}

ThreadBalance::ThreadBalance(int cores, std::map<std::string, int> threads)
    : cores_(cores), threads_(std::move(threads)), skip_(spans_to_settle) {}

void ThreadBalance::plan_trials() {
  for (const auto& [name, count] : threads_) {
    if (count > 1) planned_.push_back({name, count / 2});
    if (count < cores_) planned_.push_back({name, std::min(cores_, 2 * count)});
  }
}

double ThreadBalance::median() {
  const auto middle = samples_.begin() + static_cast<std::ptrdiff_t>(samples_.size() / 2);
  std::nth_element(samples_.begin(), middle, samples_.end());
  const double value = *middle;
  samples_.clear();
  return value;
}

std::vector<std::string> ThreadBalance::begin_next_trial() {
  skip_ = spans_to_settle;
  if (planned_.empty()) {
    tried_.clear();
    skip_ = spans_of_rest;
    return {};
  }
  const Trial trial = planned_.back();
  planned_.pop_back();
  tried_ = trial.name;
  threads_before_ = std::exchange(threads_[tried_], trial.threads);
  return {tried_};
}

std::vector<std::string> ThreadBalance::note(double seconds_per_window) {
  if (cores_ < 2 || threads_.empty()) return {};
  if (skip_-- > 0) return {};
  skip_ = 0;
  samples_.push_back(seconds_per_window);
  if (samples_.size() < spans_per_sample) return {};
  const double time = median();
  if (tried_.empty()) {
    time_ = time;
    plan_trials();
    return begin_next_trial();
  }
  std::vector<std::string> changed;
  const std::string name = tried_;
  if (time < worthwhile * time_) {
    time_ = time;
    // The other direction is out; further the same way may be better still.
    std::erase_if(planned_, [&](const Trial& trial) { return trial.name == name; });
    const int further = threads_[name] > threads_before_ ? 2 * threads_[name] : threads_[name] / 2;
    if (further >= 1 && further <= cores_) planned_.push_back({name, further});
  } else {
    threads_[name] = threads_before_;
    changed.push_back(name);
  }
  for (const std::string& next : begin_next_trial())
    if (next != name || changed.empty()) changed.push_back(next);
  return changed;
}

}  // namespace polynya::coupler
