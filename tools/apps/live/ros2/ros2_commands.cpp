// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros2/ros2_commands.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "apps/live/log.hpp"
#include "apps/live/ros2/endpoint_watch.hpp"
#include "apps/live/ros_messages/command_reader.hpp"
#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::int64_t kLookEvery_ms = 50;
// Takes commands of every writer there is; the newest counts.
constexpr RosQos kCommandQos{false, false, 1};
// The usual one first.
constexpr std::array<const RosType*, 2> kCommandTypes = {&kTwistType, &kTwistStampedType};

// A part of the daemon that takes no results, as the Modbus server: it has a start, a stop and a health.
class Ros2Commands final : public Sink {
 public:
  Ros2Commands(std::string topic, CommandBoard& commands, std::shared_ptr<Ros2Node> node)
      : topic_(std::move(topic)),
        dds_topic_(dds_topic(topic_)),
        reader_(commands, MessageEncoding::kCdr),
        node_(std::move(node)) {}
  ~Ros2Commands() override { stop(); }

  void start() override {
    node_->start();
    writers_ = std::make_unique<EndpointWatch>(*node_, true, std::vector<std::string>{dds_topic_});
    endpoint_ = node_->make_reader(topic_, *kCommandTypes.front(), kCommandQos);
    ending_ = false;
    thread_ = std::thread([this] { run(); });
  }
  void take(const LiveResult&) override {}
  void stop() override {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
    endpoint_.reset();
    writers_.reset();
  }

  PartHealth health() const override {
    const std::lock_guard<std::mutex> locked(lock_);
    PartHealth health;
    health.part = "commands ros2 " + topic_;
    const bool is_heard = matched_ > 0 && trouble_.empty();
    health.grade = is_heard ? Grade::kGood : Grade::kWarning;
    health.summary = "receives";
    if (matched_ == 0) health.summary = "nobody publishes " + topic_;
    if (!trouble_.empty()) health.summary = trouble_;
    health.add("writers matched", matched_);
    return health;
  }

 private:
  // One type at a time, or ROS's tools would take the topic for one of several types. Another one is read only where
  // nobody sends the present one.
  void follow_writers() {
    const std::vector<RemoteEndpoint> writers = writers_->of(dds_topic_);
    const auto is_sent = [&](const RosType& type) {
      return std::any_of(writers.begin(), writers.end(),
                         [&](const RemoteEndpoint& one) { return one.type == type.dds_name(); });
    };
    if (is_sent(endpoint_->type())) return;
    const auto found =
        std::find_if(kCommandTypes.begin(), kCommandTypes.end(), [&](const RosType* type) { return is_sent(*type); });
    if (found == kCommandTypes.end()) return;
    try {
      endpoint_ = node_->make_reader(topic_, **found, kCommandQos);
    } catch (const std::exception& fault) {
      log_line(Grade::kBad, "ros2", fault.what());
    }
  }

  void look() {
    const bool is_change = writers_->update();
    if (is_change) follow_writers();
    const std::uint64_t matched = endpoint_->matched();
    const std::lock_guard<std::mutex> locked(lock_);
    if (is_change) trouble_ = writers_->mismatch_with(*endpoint_);
    matched_ = matched;
  }

  void run() {
    name_this_thread("commands-ros2");
    while (!ending_) {
      endpoint_->wait(kLookEvery_ms);
      look();
      const std::string type = endpoint_->type().name;
      endpoint_->take([&](ByteView message) { reader_.take(type, message); });
    }
  }

  const std::string topic_, dds_topic_;
  CommandReader reader_;
  std::shared_ptr<Ros2Node> node_;
  std::unique_ptr<EndpointWatch> writers_;
  std::unique_ptr<Ros2Node::Endpoint> endpoint_;
  std::thread thread_;
  std::atomic<bool> ending_{false};
  mutable std::mutex lock_;
  std::string trouble_;
  std::uint64_t matched_ = 0;
};

}  // namespace

std::unique_ptr<Sink> make_ros2_commands(const std::string& topic, CommandBoard& commands,
                                         std::shared_ptr<Ros2Node> node) {
  return std::make_unique<Ros2Commands>(topic, commands, std::move(node));
}

}  // namespace pose_wall::tools::live
