#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <thread>

#include "core/exchange/errors.hpp"
#include "core/exchange/record_reader.hpp"
#include "core/exchange/recorder.hpp"
#include "core/results/error.hpp"
#include "tests/core/exchange/support.hpp"

namespace polynya::exchange {
namespace {

Recorder::Options options_in(const SocketFolder& folder) {
  Recorder::Options options;
  options.folder = (folder.path / "record").string();
  options.run = "r";
  return options;
}

std::vector<RecordedMessage> read_all(const std::string& folder, const std::string& participant) {
  std::vector<RecordedMessage> all;
  RecordReader reader(folder, participant);
  while (std::optional<RecordedMessage> recorded = reader.next()) all.push_back(std::move(*recorded));
  return all;
}

void expect_equal(const Message& read, const Message& written) {
  EXPECT_EQ(read.header, written.header);
  ASSERT_EQ(read.arrays.size(), written.arrays.size());
  for (std::size_t i = 0; i < read.arrays.size(); ++i) {
    EXPECT_EQ(read.arrays[i].name, written.arrays[i].name);
    EXPECT_EQ(read.arrays[i].type, written.arrays[i].type);
    EXPECT_EQ(read.arrays[i].shape, written.arrays[i].shape);
    EXPECT_EQ(read.arrays[i].bytes, written.arrays[i].bytes) << written.arrays[i].name;
  }
}

Message surface(std::int64_t window, double time, std::size_t vertices = 1000) {
  Message message("surface");
  message.header["window"] = window;
  message.header["time"] = time;
  std::vector<double> positions(3 * vertices);
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = std::sin(static_cast<double>(i) + time);
  message.add<double>("positions", {static_cast<std::int64_t>(vertices), 3}, positions);
  return message;
}

Message loads(std::int64_t window) {
  Message message("loads");
  message.header["window"] = window;
  return message;
}

/// Every type, every rank, extents of 0, numbers that a decimal text would not keep, names that a path would not.
std::vector<Message> odd_messages() {
  Message all("odd/kind");
  all.header["step"] = 0.1 + 0.2;
  all.header["words"] = {"ü", "\"", nullptr};
  const std::vector<double> numbers{-0.0, std::numeric_limits<double>::quiet_NaN(), 5e-324, 1e308, 1.0 / 3, -1.0};
  all.add<double>("f8/of %", {2, 3}, numbers);
  all.add<std::int64_t>("i8", {3}, std::vector<std::int64_t>{-1, 0, std::numeric_limits<std::int64_t>::max()});
  all.add<std::int32_t>(".", {1, 1, 2}, std::vector<std::int32_t>{7, -7});
  all.add<std::uint8_t>("", {4}, std::vector<std::uint8_t>{0, 1, 254, 255});
  all.add<double>("scalar", {}, std::vector<double>{42.5});
  all.add<double>("no rows", {0, 3}, std::vector<double>{});
  all.add<double>("no columns", {2, 0}, std::vector<double>{});
  Message fewer("odd/kind");
  fewer.add<double>("no rows", {1, 3}, std::vector<double>{1, 2, 3});
  fewer.add<double>("f8/of %", {0, 3}, std::vector<double>{});
  Message changed("odd/kind");  // another type and other extents under the same names
  changed.add<std::int32_t>("i8", {1}, std::vector<std::int32_t>{3});
  changed.add<double>("scalar", {1}, std::vector<double>{1});
  return {all, fewer, changed, Message("empty"), all};
}

void expect_messages_come_back(Compression compression) {
  const SocketFolder folder;
  const std::vector<Message> written = odd_messages();
  Recorder::Options options = options_in(folder);
  options.compression = compression;
  Recorder recorder(options);
  for (std::size_t i = 0; i < written.size(); ++i)
    recorder.note("ice", i % 2 == 0 ? Sender::participant : Sender::coupler, written[i]);
  EXPECT_EQ(recorder.close().messages, written.size());
  const std::vector<RecordedMessage> read = read_all(folder.path / "record", "ice");
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    expect_equal(read[i].message, written[i]);
    EXPECT_EQ(read[i].sender, i % 2 == 0 ? Sender::participant : Sender::coupler);
  }
}

TEST(Recorder, MessagesComeBackBitForBitInOrder) {
  expect_messages_come_back(Compression::none);
}

TEST(Recorder, CompressedMessagesComeBackBitForBitInOrder) {
  expect_messages_come_back(Compression::deflate);
}

/// Adds up the bytes of the files.
void expect_large_arrays_come_back(Compression compression, std::uintmax_t& bytes) {
  const SocketFolder folder;
  Recorder::Options options = options_in(folder);
  options.compression = compression;
  options.segment_bytes = 3 << 20;
  std::vector<Message> written;
  for (int window = 0; window < 6; ++window) {
    written.push_back(surface(window, 1e-6 * window, 60000));  // 1.4 MB of noise
    std::vector<std::int64_t> ids(200000);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(i) + window;
    written.back().add<std::int64_t>("ids", {200000}, ids);
  }
  Recorder recorder(options);
  for (const Message& message : written) recorder.note("ice", Sender::participant, message);
  recorder.close();
  const std::vector<RecordedMessage> read = read_all(options.folder, "ice");
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) expect_equal(read[i].message, written[i]);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(options.folder)) {
    ++files;
    bytes += entry.file_size();
  }
  EXPECT_EQ(files, 3u);
}

TEST(Recorder, LargeArraysComeBackFromManyFiles) {
  std::uintmax_t bytes = 0;
  expect_large_arrays_come_back(Compression::none, bytes);
  EXPECT_GT(bytes, 6u * (60000 * 24 + 200000 * 8));
}

TEST(Recorder, CompressionStoresOrderedNumbersInLessThanATenthOfTheirRoom) {
  std::uintmax_t plain = 0, compressed = 0;
  expect_large_arrays_come_back(Compression::none, plain);
  expect_large_arrays_come_back(Compression::deflate, compressed);
  EXPECT_LT(compressed, plain - 9 * 6 * 200000 * 8 / 10);  // the identifiers; positions are noise
}

TEST(Recorder, LoadsCarryTheTimeOfTheSurfaceTheyAnswer) {
  const SocketFolder folder;
  Recorder recorder(options_in(folder));
  recorder.note("ice", Sender::participant, Message("ready"));
  recorder.note("ice", Sender::participant, surface(0, 1e-6));
  recorder.note("structure", Sender::participant, surface(0, 9e-6));
  recorder.note("ice", Sender::coupler, loads(0));
  recorder.close();
  const std::vector<RecordedMessage> read = read_all(folder.path / "record", "ice");
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[0].window, -1);
  EXPECT_EQ(read[2].window, 0);
  EXPECT_EQ(read[2].time, 1e-6);
}

TEST(Recorder, KeepsTheChosenParticipantsAndTimes) {
  const SocketFolder folder;
  Recorder::Options options = options_in(folder);
  options.participants = {"ice"};
  options.selection.times = {3e-6, 5e-6, 7e-6, 7.5e-6};
  Recorder recorder(options);
  for (const char* name : {"ice", "structure"}) {
    recorder.note(name, Sender::participant, Message("ready"));
    for (int window = 0; window < 10; ++window) {
      recorder.note(name, Sender::participant, surface(window, window * 1e-6));
      recorder.note(name, Sender::coupler, loads(window));
    }
  }
  recorder.close();
  EXPECT_EQ(recorded_participants(options.folder), std::vector<std::string>{"ice"});
  std::vector<std::int64_t> windows;
  for (const RecordedMessage& recorded : read_all(options.folder, "ice")) windows.push_back(recorded.window);
  EXPECT_EQ(windows, (std::vector<std::int64_t>{-1, 3, 3, 4, 4, 5, 5, 7, 7}));
  EXPECT_NE(message_of<RecordError>([&] {
              check_replayable(options.folder, "ice");
            }).find("begins at t = 3e-06 s; a replay needs"),
            std::string::npos);
  EXPECT_NE(message_of<RecordError>([&] { check_replayable(options.folder, "structure"); }).find("recorded are ice"),
            std::string::npos);
}

TEST(Recorder, KeepsTheChosenWindowsAndTheSpansThatEndInThem) {
  const SocketFolder folder;
  Recorder::Options options = options_in(folder);
  options.selection.windows = {2, 3, 7, 7, 9};
  Recorder recorder(options);
  recorder.note("ice", Sender::participant, Message("ready"));
  recorder.note("fluid", Sender::participant, Message("ready"));
  for (int window = 0; window < 12; ++window) {
    recorder.note("ice", Sender::participant, surface(window, window * 1e-6));
    if (window % 2 == 1) {  // a span of two windows
      Message span("span");
      span.header["span"] = window / 2;
      span.header["time1"] = window * 1e-6;
      recorder.note("fluid", Sender::coupler, span);
    }
    recorder.note("ice", Sender::coupler, loads(window));
  }
  recorder.close();
  const auto windows = [&](const char* name) {
    std::vector<std::int64_t> all;
    for (const RecordedMessage& recorded : read_all(options.folder, name)) all.push_back(recorded.window);
    return all;
  };
  EXPECT_EQ(windows("ice"), (std::vector<std::int64_t>{-1, 2, 2, 3, 3, 7, 7, 9, 9, 10, 10, 11, 11}));
  EXPECT_EQ(windows("fluid"), (std::vector<std::int64_t>{-1, 1, 3, 4, 5}));
  EXPECT_EQ(RecordReader(options.folder, "ice").label().selection.windows, options.selection.windows);
}

TEST(Recorder, WhatAKilledProcessHadWrittenIsWholeUpToTheLastFile) {
  const SocketFolder folder;
  Recorder::Options options = options_in(folder);
  options.segment_seconds = 0.05;
  Process writer([&] {
    Recorder recorder(options);
    for (int window = 0;; ++window) {
      recorder.note("ice", Sender::participant, surface(window, window * 1e-6));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return 0;
  });
  while (!std::filesystem::exists(options.folder + "/ice-00004.h5"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  writer.kill();
  EXPECT_EQ(writer.wait(), -1);
  const std::vector<RecordedMessage> read = read_all(options.folder, "ice");
  EXPECT_GT(read.size(), 20u);
  for (std::size_t i = 0; i < read.size(); ++i)
    expect_equal(read[i].message, surface(static_cast<int>(i), static_cast<double>(i) * 1e-6));
}

TEST(Recorder, FilesAppearWhileNobodySpeaks) {
  const SocketFolder folder;
  Recorder::Options options = options_in(folder);
  options.segment_seconds = 0.02;
  Recorder recorder(options);
  recorder.note("ice", Sender::participant, surface(0, 0));
  const auto start = std::chrono::steady_clock::now();
  while (!std::filesystem::exists(options.folder + "/ice-00000.h5") && seconds_since(start) < 10)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(std::filesystem::exists(options.folder + "/ice-00000.h5"));
}

TEST(Recorder, AQueueThatIsFullMakesTheRunWaitAndLosesNothing) {
  const SocketFolder folder;
  Recorder::Options options = options_in(folder);
  options.queue_bytes = 1;
  Recorder recorder(options);
  for (int window = 0; window < 200; ++window) recorder.note("ice", Sender::participant, surface(window, window));
  recorder.close();
  EXPECT_EQ(read_all(options.folder, "ice").size(), 200u);
}

TEST(Recorder, AFolderThatCannotBeWrittenIsNamed) {
  const SocketFolder folder;
  Recorder::Options options = options_in(folder);
  std::ofstream(options.folder) << "a file in the way";
  Recorder recorder(options);
  recorder.note("ice", Sender::participant, surface(0, 0));
  EXPECT_NE(message_of<results::ResultsError>([&] { recorder.close(); }).find(options.folder), std::string::npos);
}

TEST(Recorder, AnArrayThatRepeatsIsStoredOnceAndComesBackEachTime) {
  const SocketFolder folder;
  const Recorder::Options options = options_in(folder);
  const std::vector<double> steady(100000, 0.1);
  std::vector<Message> written;
  for (int window = 0; window < 9; ++window) {
    written.push_back(loads(window));
    std::vector<double> values = steady;
    values.back() += window / 3;  // changes twice
    written.back().add<double>("load.forces", {100000}, values);
  }
  Recorder recorder(options);
  for (const Message& message : written) recorder.note("ice", Sender::coupler, message);
  recorder.close();
  const std::vector<RecordedMessage> read = read_all(options.folder, "ice");
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) expect_equal(read[i].message, written[i]);
  const auto bytes = std::filesystem::file_size(options.folder + "/ice-00000.h5");
  EXPECT_GE(bytes, 3u * 800000);
  EXPECT_LT(bytes, 3.2 * 800000);
}

TEST(Recorder, ADiskThatTakesNoMoreIsNamedAndWhatIsWholeStaysReadable) {
  const SocketFolder folder;
  Recorder::Options options = options_in(folder);
  options.segment_bytes = 1 << 20;
  options.queue_bytes = 1 << 20;
  // Files may not grow beyond 2 MB: writing fails as on a full disk.
  Process writer([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{2 << 20, 2 << 20};
    setrlimit(RLIMIT_FSIZE, &limit);
    Recorder recorder(options);
    for (int window = 0; window < 3; ++window)
      recorder.note("ice", Sender::participant, surface(window, window, 20000));  // 0.5 MB each
    const std::string error = message_of<results::ResultsError>([&] {
      for (int window = 3; window < 1000; ++window)
        recorder.note("ice", Sender::participant, surface(window, window, 200000));  // 4.8 MB each
    });
    return error.find(options.folder) != std::string::npos ? 0 : 1;
  });
  EXPECT_EQ(writer.wait(), 0);
  const std::vector<RecordedMessage> read = read_all(options.folder, "ice");
  ASSERT_GE(read.size(), 2u);
  for (std::size_t i = 0; i < read.size(); ++i)
    expect_equal(read[i].message, surface(static_cast<int>(i), static_cast<double>(i), 20000));
}

TEST(Recorder, AMissingAndADamagedRecordAreNamed) {
  const SocketFolder folder;
  const std::string record = folder.path / "record";
  EXPECT_NE(message_of<RecordError>([&] { RecordReader(record, "ice"); }).find("there is no record"),
            std::string::npos);
  std::filesystem::create_directory(record);
  std::ofstream(record + "/ice-00000.h5") << "not HDF5";
  EXPECT_NE(message_of<RecordError>([&] { RecordReader(record, "ice"); }).find("ice-00000.h5"), std::string::npos);
}

}  // namespace
}  // namespace polynya::exchange
