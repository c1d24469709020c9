#pragma once
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

namespace polynya::exchange {

/// A private folder for a socket, gone at the end of the test.
struct SocketFolder {
  std::filesystem::path path;
  SocketFolder() {
    char name[] = "/tmp/polynya-test-XXXXXX";
    path = mkdtemp(name);
  }
  ~SocketFolder() { std::filesystem::remove_all(path); }
  std::string endpoint() const { return "ipc://" + (path / "socket").string(); }
  bool empty() const { return std::filesystem::is_empty(path); }
};

/// A process of its own that runs a function and leaves with its result as the exit code (99 after an exception).
/// Fork it before the test makes a Hub or a Participant: their threads do not survive a fork.
class Process {
 public:
  explicit Process(const std::function<int()>& work) : pid_(fork()) {
    if (pid_ != 0) return;
    alarm(60);
    int code = 99;
    try {
      code = work();
    } catch (...) {
    }
    _exit(code);
  }
  ~Process() {
    if (pid_ > 0) {
      kill();
      wait();
    }
  }
  Process(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void kill() { ::kill(pid_, SIGKILL); }
  void pause() { ::kill(pid_, SIGSTOP); }
  /// The exit code, -1 after a signal.
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_;
};

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The text of the exception of type Error that an action throws; fails the test when it throws none.
template <class Error, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no exception of the expected type";
  return {};
}

}  // namespace polynya::exchange
