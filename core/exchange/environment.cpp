#include "core/exchange/environment.hpp"

#include <signal.h>
#include <sys/prctl.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>

namespace polynya::exchange {

void die_with_parent() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
}

bool process_is_alive(long pid) {
  if (pid <= 0 || (kill(static_cast<pid_t>(pid), 0) != 0 && errno != EPERM)) return false;
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  const std::string stat{std::istreambuf_iterator<char>(file), {}};
  // "pid (command) state ...": the command may contain anything, so the state stands behind the last parenthesis.
  const std::size_t end = stat.rfind(')');
  if (end == std::string::npos || end + 2 >= stat.size()) return false;
  const char state = stat[end + 2];
  return state != 'Z' && state != 'X';
}

}  // namespace polynya::exchange
