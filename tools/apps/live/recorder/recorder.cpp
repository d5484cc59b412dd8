// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The recorder: results, health and, where asked, clouds as MCAP in a folder of bounded size. A disk that is full or
// gone makes a pause in the recording and nothing else.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <memory>
#include <mutex>
#include <system_error>
#include <utility>

#include "apps/live/channels/live_messages.hpp"
#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/recorder/bounded_folder.hpp"
#include "apps/live/recorder/mcap_writer.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kFiles = 8;  // of the room: so much of it goes when the oldest file does
// A loss of power takes at most so much, and a chunk holds no more.
constexpr auto kChunkTime = std::chrono::seconds(1);
constexpr std::uint64_t kChunkBytes = 4'000'000;
constexpr auto kTryAgain = std::chrono::seconds(5);
constexpr auto kHealthEvery = std::chrono::seconds(1);
class Recorder final : public Sink, private ChannelOut {
 public:
  Recorder(const LoadedConfig& loaded, const HealthBoard& health)
      : board_(health),
        channels_(live_channels(loaded)),
        with_clouds_(loaded.live.recording_clouds),
        folder_(loaded.live.recording, ".mcap", static_cast<std::uint64_t>(loaded.live.recording_mb * kBytesPerMb)),
        has_planar_(loaded.planar.is_on()),
        messages_(loaded),
        part_("sink recorder " + loaded.live.recording) {}

  // A folder that cannot be written is a fault of the settings now, and of the disk later. A disk that is full at
  // power-on is no reason to measure nothing.
  void start() override {
    try {
      open();
    } catch (const std::system_error& fault) {
      if (fault.code() != std::errc::no_space_on_device && fault.code().value() != EDQUOT) throw;
      pause(fault.what());
    }
  }

  void take(const LiveResult& result) override {
    if (!writer_ && Clock::now() < try_again_) {
      ++not_recorded_;
      return;
    }
    ++in_chunk_;
    try {
      if (!writer_) open();
      record(result);
    } catch (const std::exception& fault) {
      pause(fault.what());
    }
  }

  // Into the file that results have begun. Where no result comes any more, they still write what was gathered.
  void take_stop(const StopNews& news) override { tell(news); }
  void take_roadway(const RoadwayNews& news) override { tell(news); }
  bool wants_planar() const override { return has_planar_; }

  void stop() override {
    try {
      if (writer_) {
        write_chunk();
        writer_->finish();
      }
    } catch (const std::exception& fault) {
      pause(fault.what());
    }
    writer_.reset();
  }

  PartHealth health() const override {
    const std::lock_guard<std::mutex> locked(trouble_lock_);
    PartHealth health;
    health.part = part_;
    health.grade = trouble_.empty() ? Grade::kGood : Grade::kBad;
    health.summary = trouble_.empty() ? "records" : "pauses: " + trouble_;
    health.add("results recorded", recorded_.load());
    health.add("results not recorded", not_recorded_.load());
    health.add("files", files_.load());
    health.add("disk free MB", whole_mb(free_bytes_));
    return health;
  }

  // A disk that stalls for a second costs nothing.
  std::size_t backlog() const override { return 20; }
  bool wants_clouds() const override { return with_clouds_; }

 private:
  // A map is large and comes every other second: the replay makes it again. Labels are told by results.
  bool wants(ChannelNumber channel) const override {
    if (channel == kCloudChannel) return with_clouds_;
    return channel != kMapChannel && channel != kPointsChannel;
  }
  void put(ChannelNumber channel, std::string message) override {
    writer_->add(channel, static_cast<std::uint64_t>(std::max<std::int64_t>(wall_ns(), 0)), message);
  }

  std::uint64_t file_bytes_most() const { return folder_.room_bytes() / kFiles; }

  void open() {
    writer_ = std::make_unique<McapWriter>(folder_.next(file_bytes_most()).string(), channels_);
    chunk_began_ = Clock::now();
    ++files_;
    free_bytes_ = folder_.free_bytes();
  }

  template <typename News>
  void tell(const News& news) {
    if (!writer_) return;
    try {
      messages_.tell(news, this);
      write_chunk_in_time();
    } catch (const std::exception& fault) {
      pause(fault.what());
    }
  }

  void record(const LiveResult& result) {
    messages_.tell(result, this);
    if (Clock::now() - health_last_ >= kHealthEvery) {
      health_last_ = Clock::now();
      messages_.tell(board_.all(), wall_ns(), this);
    }
    write_chunk_in_time();
  }

  void write_chunk_in_time() {
    if (Clock::now() - chunk_began_ < kChunkTime && writer_->gathered_bytes() < kChunkBytes) return;
    write_chunk();
    if (writer_->bytes() < file_bytes_most()) return;
    writer_->finish();
    open();
  }

  // Room is made before it is taken, also for the summary that is to come: the folder never holds more.
  void write_chunk() {
    const std::uint64_t finished = writer_->finished_bytes();
    if (!folder_.make_room(finished - writer_->bytes(), writer_->path())) {
      throw std::runtime_error(fmt::format("{}: a second's recording is {} bytes, recording_mb allows {} for all",
                                           writer_->path(), writer_->gathered_bytes(), folder_.room_bytes()));
    }
    writer_->flush();
    free_bytes_ = folder_.free_bytes();
    chunk_began_ = Clock::now();
    recorded_ += std::exchange(in_chunk_, 0);
    set_trouble("");
  }

  void pause(const std::string& why) {
    writer_.reset();
    free_bytes_ = folder_.free_bytes();
    not_recorded_ += std::exchange(in_chunk_, 0);
    try_again_ = Clock::now() + kTryAgain;
    set_trouble(why);
  }

  // The first stays until something is on the disk: a try that fails again is no news.
  void set_trouble(const std::string& why) {
    const std::lock_guard<std::mutex> locked(trouble_lock_);
    if (why.empty() || trouble_.empty()) trouble_ = why;
  }

  const HealthBoard& board_;
  std::vector<McapChannel> channels_;
  bool with_clouds_;
  BoundedFolder folder_;
  bool has_planar_;
  LiveMessages messages_;
  std::string part_;
  std::unique_ptr<McapWriter> writer_;
  Clock::time_point chunk_began_, health_last_, try_again_;
  std::uint64_t in_chunk_ = 0;  // results that are not on the disk yet
  mutable std::mutex trouble_lock_;
  std::string trouble_;
  std::atomic<std::uint64_t> recorded_{0}, not_recorded_{0}, files_{0}, free_bytes_{0};
};

}  // namespace

std::unique_ptr<Sink> make_recorder(const LoadedConfig& loaded, const HealthBoard& health) {
  return std::make_unique<Recorder>(loaded, health);
}

}  // namespace pose_wall::tools::live
