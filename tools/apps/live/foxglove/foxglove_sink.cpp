// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The edge of Foxglove and Lichtblick: the channels of recordings, live, for a few viewers at once. Nobody can change
// anything.

#include <fmt/format.h>

#include <mutex>
#include <utility>

#include "apps/live/channels/live_messages.hpp"
#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/foxglove/origins.hpp"
#include "apps/live/foxglove/viewer_talk.hpp"
#include "apps/live/log.hpp"

namespace pose_wall::tools::live {
namespace {

// As /diagnostics of ROS.
constexpr std::int64_t kHealthEvery_ns = 1'000'000'000;

// How each channel is kept for viewers that are slower than it.
std::vector<Keeping> keeping_of(std::size_t channels) {
  std::vector<Keeping> keeping(channels);
  // Two seconds and a cloud's way over a slow line; each message is small.
  for (const std::size_t channel : {kResultChannel, kPoseChannel}) keeping[channel].messages = 20;
  // Who comes later reads what happened: all parts tell of themselves some times.
  keeping[kLogChannel] = {64, true};
  if (channels > kMapChannel) keeping[kMapChannel] = {1, true};
  return keeping;
}

class FoxgloveSink final : public Sink, private ChannelOut {
 public:
  FoxgloveSink(const LoadedConfig& loaded, const HealthBoard& board)
      : place_(*parse_host_port(loaded.live.foxglove)),
        address_(loaded.live.foxglove),
        has_planar_(loaded.planar.is_on()),
        board_(board),
        channels_(live_channels(loaded)),
        messages_(loaded),
        health_messages_(loaded),
        session_(std::to_string(wall_ns())),
        news_(keeping_of(channels_.size())),
        server_(place_, manners(loaded.live.foxglove_origin)) {}
  ~FoxgloveSink() override { stop(); }

  void start() override {
    try {
      server_.start();
    } catch (const std::exception& fault) {
      throw std::runtime_error(fmt::format("foxglove: {}", fault.what()));
    }
    log_line(Grade::kGood, part(),
             fmt::format("ws://{} serves viewers; {}", address_,
                         is_loopback(place_.host) ? "only this machine reaches it"
                                                  : "everybody who reaches this address may look, nobody can change"));
  }

  void take(const LiveResult& result) override {
    messages_.tell(result, this);
    tell_health_now_and_then();
    wake();
  }
  bool wants_planar() const override { return has_planar_; }
  void take_stop(const StopNews& news) override {
    messages_.tell(news, this);
    wake();
  }
  void take_roadway(const RoadwayNews& news) override {
    messages_.tell(news, this);
    wake();
  }

  void stop() override { server_.stop(); }

  PartHealth health() const override {
    PartHealth health;
    health.part = part();
    health.grade = server_.serves() ? Grade::kGood : Grade::kBad;
    health.summary = server_.serves() ? "serves" : "serves no more: its loop failed";
    health.add("viewers", counts_.viewers.load());
    health.add("viewers turned away", server_.turned_away());
    health.add("viewers cut off", server_.cut_off());
    health.add("messages sent", counts_.sent.load());
    health.add("messages skipped for slow viewers", counts_.skipped.load());
    health.add("requests refused", counts_.refused.load());
    return health;
  }

  bool wants_points() const override { return news_.has_subscribers(kPointsChannel); }
  bool wants_clouds() const override { return news_.has_subscribers(kCloudChannel); }

 private:
  std::string part() const { return "sink foxglove " + address_; }

  void wake() {
    if (counts_.viewers > 0) server_.wake();
  }

  // What is kept for those who come later is made without subscribers, but for the map, which is large.
  bool wants(ChannelNumber channel) const override { return channel == kLogChannel || news_.has_subscribers(channel); }
  void put(ChannelNumber channel, std::string message) override { news_.put(channel, std::move(message), wall_ns()); }

  SocketServer::Manners manners(const std::string& origin) {
    SocketServer::Manners manners;
    manners.protocols = {"foxglove.websocket.v1", "foxglove.sdk.v1"};
    manners.greeting = "This is an address for Foxglove and Lichtblick: open it there as ws://" + address_;
    manners.admits = [origin](const std::string& asked) { return is_admitted_origin(asked, origin); };
    manners.begins = [this] {
      return std::make_unique<ViewerTalk>(channels_, session_, news_, counts_, [this] { tell_health_now_and_then(); });
    };
    return manners;
  }

  // By the server's thread, too, for a worker that hangs publishes nothing.
  void tell_health_now_and_then() {
    const std::unique_lock<std::mutex> locked(health_lock_, std::try_to_lock);
    const std::int64_t now_ns = monotonic_ns();
    if (!locked || now_ns - health_last_ns_ < kHealthEvery_ns) return;
    health_last_ns_ = now_ns;
    health_messages_.tell(board_.all(), wall_ns(), this);
  }

  HostPort place_;
  std::string address_;
  bool has_planar_;
  const HealthBoard& board_;
  std::vector<McapChannel> channels_;
  LiveMessages messages_;         // of the sink's thread
  LiveMessages health_messages_;  // under the lock
  std::string session_;
  ViewerBoard news_;
  ViewerCounts counts_;
  std::mutex health_lock_;
  std::int64_t health_last_ns_ = -kHealthEvery_ns;
  SocketServer server_;  // last: its talks know the others
};

}  // namespace

std::unique_ptr<Sink> make_foxglove_sink(const LoadedConfig& loaded, const HealthBoard& health) {
  return std::make_unique<FoxgloveSink>(loaded, health);
}

}  // namespace pose_wall::tools::live
