#include "core/exchange/bench_window.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "core/exchange/hub.hpp"
#include "core/exchange/participant.hpp"

namespace polynya::exchange {
namespace {

constexpr int warm_up = 50;
constexpr int windows = 2000;

struct SocketFolder {
  std::string path;
  SocketFolder() {
    char name[] = "/tmp/polynya-bench-XXXXXX";
    if (mkdtemp(name) == nullptr) throw EndpointError("cannot make a folder under /tmp for a local socket");
    path = name;
  }
  ~SocketFolder() { rmdir(path.c_str()); }
  std::string endpoint() const { return "ipc://" + path + "/socket"; }
};

void unpack(const Message& message, std::string_view name, std::vector<double>& into) {
  const std::span<const double> values = message.view<double>(name);
  std::copy(values.begin(), values.end(), into.begin());
}

/// Answers every `surface` by `loads` until the last window.
void answer(Hub& hub, std::size_t vertices) {
  std::vector<double> forces(3 * vertices, 1.0);
  const auto count = static_cast<std::int64_t>(vertices);
  hub.await_participants(10);
  for (int window = 0; window < warm_up + windows; ++window) {
    unpack(hub.receive("solid", "surface"), "positions", forces);
    Message loads("loads");
    loads.header["window"] = window;
    loads.header["next_step"] = 1e-7;
    loads.add<double>("load.forces", {count, 3}, forces);
    hub.send("solid", std::move(loads));
  }
}

}  // namespace

double window_microseconds(std::size_t vertices) {
  const SocketFolder folder;
  Hub hub(folder.endpoint(), "bench", {"solid"});
  std::jthread coupler([&] { answer(hub, vertices); });
  Participant participant({folder.endpoint(), "bench", "solid", 10});

  std::vector<double> positions(3 * vertices, 0.5);
  std::vector<double> microseconds;
  for (int window = 0; window < warm_up + windows; ++window) {
    const auto start = std::chrono::steady_clock::now();
    Message surface("surface");
    surface.header["window"] = window;
    surface.header["stable_step"] = 1e-7;
    surface.add<double>("positions", {static_cast<std::int64_t>(vertices), 3}, positions);
    participant.send(std::move(surface));
    unpack(participant.receive("loads"), "load.forces", positions);
    const std::chrono::duration<double, std::micro> passed = std::chrono::steady_clock::now() - start;
    if (window >= warm_up) microseconds.push_back(passed.count());
  }
  const auto middle = microseconds.begin() + windows / 2;
  std::nth_element(microseconds.begin(), middle, microseconds.end());
  return *middle;
}

}  // namespace polynya::exchange
