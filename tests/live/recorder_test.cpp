// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a recording that is cut anywhere gives back every message of its whole chunks. Folders never hold more than
// their room, and the oldest goes first. Names are never used twice, whatever the clock says. A disk that takes nothing
// and a folder that vanishes make a pause. The pause says so, costs neither descriptors nor files, and ends by itself.
// Each result is counted as recorded or as not. Black boxes of earlier starts stay and can be computed again.
// Does not prove: that the disk keeps what fdatasync promised. Tools of others and kill -9: recorder_peer.py.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <random>
#include <set>

#include "apps/live/edges.hpp"
#include "apps/live/live_runtime.hpp"
#include "apps/live/recorder/bounded_folder.hpp"
#include "apps/live/recorder/json_schema.hpp"
#include "apps/live/recorder/mcap_writer.hpp"
#include "io/bags/open_bag.hpp"
#include "io/box/box_replay.hpp"
#include "live/frame_catcher.hpp"
#include "support/said_by.hpp"
#include "tools/test_files.hpp"

namespace pose_wall::tools::live {
namespace {

namespace fs = std::filesystem;
using pose_wall::test::becomes_true;
using pose_wall::test::fact;
using test::TempFolder;
using test::text_of;

class NoHealth final : public HealthBoard {
 public:
  std::vector<PartHealth> all() const override { return {{"runtime", Grade::kGood, "measures", {}}}; }
};

std::size_t open_descriptors() {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
}

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::uint64_t bytes_in(const std::string& folder) {
  std::uint64_t sum = 0;
  for (const auto& entry : fs::directory_iterator(folder)) sum += entry.file_size();
  return sum;
}

// What can be read of a file, with its topic; `is_whole` where nothing was complained of.
struct Readable {
  std::vector<std::pair<std::string, std::string>> messages;
  bool is_whole = true;
};

Readable read_mcap(const fs::path& file) {
  Readable read;
  try {
    const auto bag = open_bag(file, BagKind::kMcap);
    while (const auto message = bag->next()) {
      read.messages.emplace_back(bag->topics()[message->topic].name,
                                 std::string(reinterpret_cast<const char*>(message->data.data), message->data.size));
    }
  } catch (const std::exception&) {
    read.is_whole = false;
  }
  return read;
}

const std::vector<McapChannel> kChannels = {{"/a", "json", "A", "jsonschema", "{}"},
                                            {"/b", "json", "B", "jsonschema", "{}"}};

TEST(McapWriter, WhatIsCutAnywhereGivesBackItsWholeChunks) {
  const TempFolder folder;
  std::vector<std::pair<std::string, std::string>> written;
  std::vector<std::pair<std::uint64_t, std::size_t>> chunk_ends;  // bytes of the file, messages by then
  std::mt19937 random(5);
  {
    McapWriter writer(folder.file("whole.mcap"), kChannels);
    for (int chunk = 0; chunk < 6; ++chunk) {
      for (int i = 0; i < 4; ++i) {
        const std::string message(random() % 90, static_cast<char>('a' + i));
        writer.add(static_cast<std::uint16_t>(i % 2), 1000 - random() % 100, message);
        written.emplace_back(i % 2 == 0 ? "/a" : "/b", message);
      }
      writer.flush();
      chunk_ends.emplace_back(writer.bytes(), written.size());
      EXPECT_EQ(fs::file_size(folder.file("whole.mcap")), writer.bytes());
    }
    const std::uint64_t told = writer.finished_bytes();
    writer.finish();
    EXPECT_EQ(writer.bytes(), told);
    EXPECT_EQ(fs::file_size(folder.file("whole.mcap")), told);
  }
  const std::string bytes = text_of(folder.file("whole.mcap"));
  const Readable whole = read_mcap(folder.file("whole.mcap"));
  EXPECT_TRUE(whole.is_whole);
  EXPECT_EQ(whole.messages, written);

  for (std::size_t length = 0; length < bytes.size(); ++length) {
    std::size_t at_least = 0;
    for (const auto& [end, messages] : chunk_ends) at_least = length >= end ? messages : at_least;
    const Readable cut = read_mcap(folder.write("cut.mcap", bytes.substr(0, length)));
    EXPECT_FALSE(cut.is_whole) << length;
    ASSERT_GE(cut.messages.size(), at_least) << length;
    ASSERT_LE(cut.messages.size(), written.size());
    EXPECT_TRUE(std::equal(cut.messages.begin(), cut.messages.end(), written.begin())) << length;
  }
}

TEST(McapWriter, FinishedBytesAreTrueBeforeAndAfterAChunk) {
  const TempFolder folder;
  McapWriter writer(folder.file("a.mcap"), kChannels);
  writer.add(0, 1, "first");
  writer.flush();
  writer.add(1, 2, "second");
  const std::uint64_t told = writer.finished_bytes();
  writer.finish();
  EXPECT_EQ(writer.bytes(), told);
}

template <typename Number>
Number number_in(const std::string& bytes, std::uint64_t at) {
  std::uint64_t number = 0;
  for (std::size_t i = sizeof(Number); i-- > 0;) number = number << 8U | static_cast<unsigned char>(bytes.at(at + i));
  return static_cast<Number>(number);
}

// As a reader does that jumps: footer, chunk index, message index, message. Each message is reached once.
std::vector<std::pair<std::uint64_t, std::uint16_t>> reached_by_index(const std::string& file) {
  // The format of MCAP: a record has its kind and its length first, a footer 20 bytes, a chunk 40 before its content.
  constexpr std::uint64_t kHead = 9, kFooter = kHead + 20, kMagic = 8, kChunkContent = kHead + 40;
  std::vector<std::pair<std::uint64_t, std::uint16_t>> reached;  // time and channel
  const std::uint64_t footer = file.size() - kMagic - kFooter;
  for (auto at = number_in<std::uint64_t>(file, footer + kHead); at < footer;
       at += kHead + number_in<std::uint64_t>(file, at + 1)) {
    if (file[at] != 0x08) continue;
    const auto chunk = number_in<std::uint64_t>(file, at + kHead + 16);
    const auto chunk_bytes = number_in<std::uint64_t>(file, at + kHead + 24);
    const auto offsets_bytes = number_in<std::uint32_t>(file, at + kHead + 32);
    std::uint64_t index_bytes = 0;
    for (std::uint64_t entry = at + kHead + 36; entry < at + kHead + 36 + offsets_bytes; entry += 10) {
      const auto index = number_in<std::uint64_t>(file, entry + 2);
      EXPECT_EQ(file.at(index), 0x07);
      EXPECT_EQ(index, chunk + chunk_bytes + index_bytes) << "the indexes follow their chunk";
      index_bytes += kHead + number_in<std::uint64_t>(file, index + 1);
      EXPECT_EQ(number_in<std::uint16_t>(file, index + kHead), number_in<std::uint16_t>(file, entry));
      const auto entries_bytes = number_in<std::uint32_t>(file, index + kHead + 2);
      for (std::uint64_t i = 0; i < entries_bytes; i += 16) {
        const std::uint64_t message = chunk + kChunkContent + number_in<std::uint64_t>(file, index + kHead + 6 + i + 8);
        EXPECT_EQ(file.at(message), 0x05);
        EXPECT_EQ(number_in<std::uint16_t>(file, message + kHead), number_in<std::uint16_t>(file, entry));
        const auto time_ns = number_in<std::uint64_t>(file, message + kHead + 6);
        EXPECT_EQ(time_ns, number_in<std::uint64_t>(file, index + kHead + 6 + i));
        reached.emplace_back(time_ns, number_in<std::uint16_t>(file, entry));
      }
    }
    EXPECT_EQ(number_in<std::uint64_t>(file, at + kHead + 36 + offsets_bytes), index_bytes);
  }
  return reached;
}

// Readers of JavaScript, as Foxglove has them, take a chunk without an index for one without messages.
TEST(McapWriter, EveryMessageIsReachedByTheIndexOfItsChunk) {
  const TempFolder folder;
  McapWriter writer(folder.file("a.mcap"), kChannels);
  std::vector<std::pair<std::uint64_t, std::uint16_t>> written;
  for (std::uint64_t i = 0; i < 9; ++i) {
    const auto channel = static_cast<std::uint16_t>(i < 3 || i % 2 == 0 ? 0 : 1);
    writer.add(channel, 100 + i, std::string(i, 'm'));
    written.emplace_back(100 + i, channel);
    if (i % 3 == 2) writer.flush();
  }
  writer.finish();
  std::vector<std::pair<std::uint64_t, std::uint16_t>> reached = reached_by_index(text_of(folder.file("a.mcap")));
  std::sort(reached.begin(), reached.end());
  EXPECT_EQ(reached, written);
}

TEST(McapWriter, NeverWritesOverAFile) {
  const TempFolder folder;
  const std::string file = folder.write("a.mcap", "an incident");
  EXPECT_THROW(McapWriter(file, kChannels), std::system_error);
  EXPECT_EQ(text_of(file), "an incident");
}

TEST(BoundedFolder, TheOldestGoesFirstAndOthersFilesStay) {
  const TempFolder folder;
  folder.write("000003_20200101T000000Z.mcap", std::string(100, 'x'));
  folder.write("000002_20990101T000000Z.mcap", std::string(100, 'x'));  // written while the clock was wrong
  folder.write("notes.txt", std::string(5000, 'x'));
  folder.write("road.mcap", std::string(5000, 'x'));
  BoundedFolder bounded(folder.path(), ".mcap", 250);
  EXPECT_EQ(bounded.bytes(), 200U);
  const fs::path next = bounded.next(100);
  EXPECT_EQ(next.filename().string().substr(0, 7), "000004_") << "numbers go on, whatever the clock says";
  EXPECT_FALSE(fs::exists(folder.file("000002_20990101T000000Z.mcap"))) << "the oldest by number";
  EXPECT_TRUE(fs::exists(folder.file("000003_20200101T000000Z.mcap")));
  EXPECT_TRUE(fs::exists(folder.file("notes.txt")));
  EXPECT_TRUE(fs::exists(folder.file("road.mcap")));
  EXPECT_FALSE(bounded.make_room(200, folder.file("000003_20200101T000000Z.mcap"))) << "the one in work is kept";
  EXPECT_TRUE(fs::exists(folder.file("000003_20200101T000000Z.mcap")));
  EXPECT_TRUE(bounded.make_room(150));
  EXPECT_THROW(bounded.next(251), std::runtime_error);
}

// Results of a recorder in a folder, with clouds of `points` points where asked.
class RecorderTest : public ::testing::Test {
 protected:
  // x, y, z as floats and four bytes beside them: 65,536 points are a megabyte.
  static constexpr std::uint32_t kPointBytes = 16;

  void open(const std::string& room_mb, bool clouds = true) {
    recorder_ = make_recorder(load_config("", {"recording=" + recordings(), "recording_mb=" + room_mb,
                                               std::string("recording_clouds=") + (clouds ? "1" : "0")}),
                              health_);
  }
  std::string recordings() const { return folder_.file("recordings"); }

  static std::shared_ptr<const LiveFrame> cloud(std::uint32_t points) {
    auto frame = std::make_shared<LiveFrame>();
    PointLayout layout;
    layout.count = points;
    layout.point_step = kPointBytes;
    layout.fields = {
        {"x", {0, POSE_WALL_FIELD_FLOAT32}}, {"y", {4, POSE_WALL_FIELD_FLOAT32}}, {"z", {8, POSE_WALL_FIELD_FLOAT32}}};
    frame->frame = describe_frame(Bytes(std::size_t{points} * kPointBytes), layout);
    frame->frame_id = "lidar";
    return frame;
  }

  void take(std::uint32_t points = 0) {
    LiveResult result;
    result.publication.index = ++taken_;
    result.publication.cause = POSE_WALL_RUNTIME_FRAME;
    if (points > 0) result.frame = cloud(points);
    recorder_->take(result);
  }
  std::uint64_t count(const std::string& name) const { return std::stoull(fact(recorder_->health(), name)); }
  bool pauses() const { return recorder_->health().summary.rfind("pauses: ", 0) == 0; }

  TempFolder folder_;
  NoHealth health_;
  std::unique_ptr<Sink> recorder_;
  std::uint64_t taken_ = 0;
};

TEST_F(RecorderTest, TheFolderNeverHoldsMoreThanItsRoom) {
  // A quarter of what is recorded, so that files go.
  constexpr std::uint64_t kRoom = 20'000'000;
  open("20");
  recorder_->start();
  std::set<std::string> seen;
  for (int i = 0; i < 80; ++i) {
    take(65536);  // a megabyte
    ASSERT_LE(bytes_in(recordings()), kRoom);
    for (const auto& entry : fs::directory_iterator(recordings())) seen.insert(entry.path().filename().string());
  }
  recorder_->stop();
  EXPECT_LE(bytes_in(recordings()), kRoom);
  EXPECT_EQ(count("results recorded"), 80U);
  EXPECT_EQ(count("results not recorded"), 0U);
  EXPECT_GT(seen.size(), files_in(recordings())) << "the oldest went";
  std::size_t clouds = 0, results = 0;
  for (const auto& entry : fs::directory_iterator(recordings())) {
    const Readable read = read_mcap(entry.path());
    EXPECT_TRUE(read.is_whole) << entry.path();
    for (const auto& [topic, message] : read.messages) {
      if (topic == "/pose_wall/result") ++results;
      if (topic.rfind("/pose_wall/", 0) == 0) continue;
      ++clouds;
      EXPECT_GT(message.size(), 65536U * kPointBytes);
    }
  }
  EXPECT_EQ(clouds, results);
  EXPECT_GT(clouds, 10U);
}

// A file is one chunk of four clouds, 4.2 MB. Beside four of them an eighth of the room fits, by which the fifth was
// begun, but not the three clouds that it holds at the stop: only room that is made before each write helps.
TEST_F(RecorderTest, WhatIsWrittenAtTheStopKeepsToTheRoom) {
  open("19.5");
  recorder_->start();
  for (int i = 0; i < 19; ++i) take(65536);
  recorder_->stop();
  EXPECT_LE(bytes_in(recordings()), 19'500'000U);
  EXPECT_EQ(count("results recorded"), 19U);
}

TEST_F(RecorderTest, ASecondThatDoesNotFitIsNamed) {
  open("1");
  recorder_->start();
  for (int i = 0; i < 5; ++i) take(65536);
  EXPECT_TRUE(pauses());
  EXPECT_NE(recorder_->health().summary.find("recording_mb allows 1000000 for all"), std::string::npos)
      << recorder_->health().summary;
  recorder_->stop();
  EXPECT_EQ(count("results recorded") + count("results not recorded"), taken_);
  EXPECT_LE(bytes_in(recordings()), 1'000'000U);
}

// Writes beyond so many bytes of a file fail, as on a disk that is full.
class WritesFail {
 public:
  explicit WritesFail(rlim_t beyond) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    rlimit low = limit_;
    low.rlim_cur = beyond;
    setrlimit(RLIMIT_FSIZE, &low);
  }
  WritesFail(const WritesFail&) = delete;
  WritesFail& operator=(const WritesFail&) = delete;
  ~WritesFail() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }

 private:
  rlimit limit_{};
  void (*before_)(int);
};

TEST_F(RecorderTest, ADiskThatTakesNothingMakesAPauseThatEnds) {
  open("100");
  recorder_->start();
  for (int i = 0; i < 4; ++i) take(65536);
  ASSERT_EQ(count("results recorded"), 4U) << "four megabytes are a chunk";
  const std::size_t descriptors = open_descriptors();
  {
    const WritesFail full(4'300'000);  // of the second chunk, a part
    for (int i = 0; i < 8; ++i) take(65536);
    EXPECT_TRUE(pauses());
    EXPECT_EQ(recorder_->health().grade, Grade::kBad);
    EXPECT_EQ(count("results not recorded"), 8U) << "those of the chunk that was lost, too";
  }
  EXPECT_EQ(open_descriptors(), descriptors - 1) << "the file is closed";
  const Readable before = read_mcap(fs::directory_iterator(recordings())->path());
  EXPECT_EQ(std::count_if(before.messages.begin(), before.messages.end(),
                          [](const auto& message) { return message.first == "/pose_wall/result"; }),
            4);
  EXPECT_TRUE(becomes_true([&] {
    take(65536);
    return !pauses();
  }));
  for (int i = 0; i < 4; ++i) take(65536);
  recorder_->stop();
  EXPECT_EQ(count("results recorded") + count("results not recorded"), taken_);
  EXPECT_GE(count("results recorded"), 8U);
}

TEST(McapWriter, OneThatCannotWriteItsHeadLeavesNoFileAndNoDescriptor) {
  const TempFolder folder;
  const std::size_t descriptors = open_descriptors();
  {
    const WritesFail full(10);
    for (int i = 0; i < 20; ++i) EXPECT_THROW(McapWriter(folder.file("a.mcap"), kChannels), std::system_error);
  }
  EXPECT_EQ(open_descriptors(), descriptors);
  EXPECT_EQ(files_in(folder.path()), 0U);
}

TEST(McapWriter, OneWithoutAChunkLeavesNoFile) {
  const TempFolder folder;
  { McapWriter writer(folder.file("a.mcap"), kChannels); }
  EXPECT_EQ(files_in(folder.path()), 0U);
}

TEST_F(RecorderTest, AFolderThatVanishesIsNoticedAndMadeAgain) {
  open("100");
  recorder_->start();
  for (int i = 0; i < 4; ++i) take(65536);
  fs::remove_all(recordings());
  for (int i = 0; i < 4; ++i) take(65536);
  EXPECT_TRUE(pauses()) << "bytes that nobody can find are not recorded";
  EXPECT_EQ(count("results not recorded"), 4U);
  EXPECT_TRUE(becomes_true([&] {
    take(65536);
    return !pauses();
  }));
  recorder_->stop();
  EXPECT_EQ(files_in(recordings()), 1U);
}

TEST_F(RecorderTest, AFolderThatCannotBeIsRefusedAtTheStart) {
  folder_.write("recordings", "a file in its place");
  open("100");
  const std::string said = test::said_by<std::runtime_error>([&] { recorder_->start(); });
  EXPECT_NE(said.find(recordings()), std::string::npos) << said;
}

TEST_F(RecorderTest, WithoutCloudsThereAreNone) {
  open("10", false);
  recorder_->start();
  take(1000);
  recorder_->stop();
  const Readable read = read_mcap(fs::directory_iterator(recordings())->path());
  std::vector<std::string> topics;
  for (const auto& [topic, message] : read.messages) {
    topics.push_back(topic);
    if (topic == "/pose_wall/health") {
      EXPECT_NE(message.find("measures"), std::string::npos);
    }
  }
  EXPECT_EQ(topics, (std::vector<std::string>{"/pose_wall/result", "/pose_wall/transforms", "/pose_wall/scene",
                                              "/pose_wall/health", "/pose_wall/log"}));
}

class BlackBoxTest : public ::testing::Test {
 protected:
  LoadedConfig settings(const std::string& room_mb) const {
    return load_config("", {"black_box=" + folder_.file("boxes"), "black_box_mb=" + room_mb});
  }
  TempFolder folder_;
};

TEST_F(BlackBoxTest, EarlierStartsStayWithinTheRoom) {
  const LoadedConfig loaded = settings("1");
  std::set<std::string> seen;
  for (int start = 0; start < 12; ++start) {
    const BlackBox box = open_black_box(loaded);
    ASSERT_NE(box.write, nullptr);
    EXPECT_EQ(box.bytes % 64, 0U);
    const std::string full(box.bytes, static_cast<char>('a' + start));
    ASSERT_EQ(box.write(box.user, 0, full.data(), full.size()), 0);
    EXPECT_LE(bytes_in(folder_.file("boxes")), 1'000'000U);
    for (const auto& entry : fs::directory_iterator(folder_.file("boxes"))) {
      seen.insert(entry.path().filename().string());
    }
  }
  EXPECT_EQ(seen.size(), 12U) << "each start has a name of its own";
  EXPECT_EQ(files_in(folder_.file("boxes")), 4U);
  std::set<char> kept;
  for (const auto& entry : fs::directory_iterator(folder_.file("boxes"))) kept.insert(text_of(entry.path())[0]);
  EXPECT_EQ(kept, (std::set<char>{'i', 'j', 'k', 'l'})) << "the newest, and none written over";
}

TEST_F(BlackBoxTest, TheSmallestRoomServesTheRuntimeAndCanBeComputedAgain) {
  const LoadedConfig loaded = settings("1");
  {
    LiveRuntime runtime(
        loaded, [&] { return open_black_box(loaded); }, [](const std::shared_ptr<const LiveResult>&) {},
        [] { return false; });
    runtime.start();
    EXPECT_TRUE(becomes_true([&] { return std::stoull(fact(runtime.health(), "black box written")) > 0; }));
    runtime.stop();
    EXPECT_EQ(fact(runtime.health(), "black box failed"), "0");
  }
  const BoxReplay replay = replay_box(fs::directory_iterator(folder_.file("boxes"))->path().string(), {});
  EXPECT_GT(replay.records, 0U);
  EXPECT_TRUE(replay.is_whole());
  EXPECT_EQ(replay.different, 0U);
}

TEST_F(BlackBoxTest, TellsWhyItIsNotWrittenAndThatItIsAgain) {
  const BlackBox box = open_black_box(settings("10"));
  EXPECT_GT(box.state->free_bytes, 0U);
  const std::array<char, 64> record{};
  ASSERT_EQ(box.write(box.user, 0, record.data(), record.size()), 0);
  EXPECT_EQ(box.state->fault, 0);
  {
    const WritesFail full(0);
    EXPECT_NE(box.write(box.user, 0, record.data(), record.size()), 0);
  }
  EXPECT_EQ(box.state->fault, EFBIG);
  EXPECT_EQ(box.write(box.user, 0, record.data(), record.size()), 0);
  EXPECT_EQ(box.state->fault, 0);
}

TEST_F(BlackBoxTest, AStartThatFailsLeavesNoFile) {
  const LoadedConfig loaded = settings("1");
  for (int start = 0; start < 3; ++start) open_black_box(loaded);
  EXPECT_EQ(files_in(folder_.file("boxes")), 0U);
}

TEST_F(BlackBoxTest, NoFolderIsNoBox) {
  EXPECT_EQ(open_black_box(load_config("", {})).write, nullptr);
}

}  // namespace
// One type a member, or viewers show nothing of the channel.
TEST(JsonSchema, SaysWhichMembersAMessageHas) {
  EXPECT_EQ(
      json_schema_of(R"({"a": 1.5, "b": {"c": "x", "d": null}, "e": [{"f": true}, {"h": 1}, {"f": false}], "g": []})"),
      R"({"type":"object","properties":{"a":{"type":"number","nullable":true},"b":{"type":"object","properties":{)"
      R"("c":{"type":"string","nullable":true}},"nullable":true},"e":{"type":"array","items":{"type":"object",)"
      R"("properties":{"f":{"type":"boolean","nullable":true},"h":{"type":"number","nullable":true}}},)"
      R"("nullable":true}},"$schema":"https://json-schema.org/draft/2020-12/schema"})");
  EXPECT_ANY_THROW(json_schema_of("{"));
}

}  // namespace pose_wall::tools::live
