#include "core/exchange/replay_options.hpp"

namespace polynya::exchange {

void add_replay_options(CLI::App& app, Replay& replay) {
  auto* record =
      app.add_option("--replay", replay.record, "record of a coupled run (RUN/record) in place of the coupler");
  record->excludes(app.get_option("--connect"));
  app.add_option("--from", replay.from, "s; compare and write field frames from here on")
      ->needs(record)
      ->check(CLI::NonNegativeNumber);
  app.add_option("--until", replay.until, "s; end with the window that reaches this time")
      ->needs(record)
      ->check(CLI::NonNegativeNumber);
  app.add_option("--tolerance", replay.tolerance, "largest difference, relative to an array's largest value; 0: no bit")
      ->needs(record)
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--keep-going", replay.keep_going, "go on past differences and tell the largest at the end")
      ->needs(record);
}

}  // namespace polynya::exchange
