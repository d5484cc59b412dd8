// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The edge of ROS 2: clouds and transforms in, results out, by one node that speaks DDS itself.

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/ros2/endpoint_watch.hpp"
#include "apps/live/ros2/ros2_commands.hpp"
#include "apps/live/ros2/ros2_node.hpp"
#include "apps/live/ros2/ros2_source.hpp"
#include "apps/live/ros_messages/ros_publisher.hpp"

namespace pose_wall::tools::live {
namespace {

// A subscriber that lost a result is told as slow for so long: whoever looks now and then still sees it.
constexpr std::int64_t kSlowFor_ns = 10'000'000'000;

constexpr const char* kNodeName = "pose_walld";
// Reliable, the newest, and nothing for who comes later.
constexpr RosQos kResultQos{true, false, 1};
// The map, as map_server has it.
constexpr RosQos kLatchedQos{true, true, 1};
// tf2 keeps what it hears; several transforms may wait for a slow listener.
constexpr RosQos kTransformQos{true, false, 100};

class Ros2Out final : public RosOut {
 public:
  explicit Ros2Out(std::shared_ptr<Ros2Node> node) : node_(std::move(node)) {}

  std::size_t advertise(const std::string& topic, const RosType& type, bool is_latched) override {
    topics_.push_back({topic, type, is_latched, nullptr});
    return topics_.size() - 1;
  }

  void start() override {
    node_->start();
    const std::lock_guard<std::mutex> locked(lock_);
    std::vector<std::string> names;
    for (Topic& topic : topics_) {
      const RosQos& qos = topic.is_latched ? kLatchedQos : topic.name == "/tf" ? kTransformQos : kResultQos;
      topic.writer = node_->make_writer(topic.name, topic.type, qos);
      names.push_back(dds_topic(topic.name));
    }
    readers_ = std::make_unique<EndpointWatch>(*node_, false, std::move(names));
  }

  void stop() override {
    const std::lock_guard<std::mutex> locked(lock_);
    readers_.reset();
    for (Topic& topic : topics_) topic.writer.reset();
  }

  // One thread publishes, the same that stops.
  void publish(std::size_t number, const std::string& message) override {
    const Ros2Node::Endpoint* writer = topics_[number].writer.get();
    if (writer != nullptr && !writer->write(message)) last_not_sent_ns_ = monotonic_ns();
  }

  std::uint32_t subscribers(std::size_t number) const override {
    const std::lock_guard<std::mutex> locked(lock_);
    const Ros2Node::Endpoint* writer = topics_[number].writer.get();
    return writer == nullptr ? 0 : writer->matched();
  }

  std::string trouble() const override {
    const std::lock_guard<std::mutex> locked(lock_);
    if (readers_ && readers_->update()) {
      trouble_.clear();
      for (const Topic& topic : topics_) {
        if (trouble_.empty()) trouble_ = readers_->mismatch_with(*topic.writer);
      }
    }
    if (trouble_.empty() && !node_->trouble().empty()) return node_->trouble();
    if (trouble_.empty() && monotonic_ns() - last_not_sent_ns_ < kSlowFor_ns) {
      return "a subscriber does not keep up: results were not sent to it";
    }
    return trouble_;
  }

 private:
  struct Topic {
    std::string name;
    RosType type;
    bool is_latched;
    std::unique_ptr<Ros2Node::Endpoint> writer;
  };

  std::shared_ptr<Ros2Node> node_;
  mutable std::mutex lock_;
  std::vector<Topic> topics_;
  std::unique_ptr<EndpointWatch> readers_;
  mutable std::string trouble_;
  std::atomic<std::int64_t> last_not_sent_ns_{-kSlowFor_ns};
};

CycloneLimits limits_of(const LoadedConfig& loaded) {
  // x, y, z and intensity are what a usual point has; the widest drivers' points have 48 bytes.
  constexpr std::uint64_t kUsualPoint_bytes = 16, kWidestPoint_bytes = 128, kBeside_bytes = 1'000'000;
  constexpr std::uint64_t kBufferLeast_bytes = 4'194'304, kBufferMost_bytes = 67'108'864;
  const auto points = static_cast<std::uint64_t>(loaded.live.frame_points_max);
  CycloneLimits limits;
  limits.receive_buffer_bytes = std::clamp(points * kUsualPoint_bytes, kBufferLeast_bytes, kBufferMost_bytes);
  // DDS counts a sample's bytes in 32 bits, of which Cyclone takes 31.
  limits.sample_bytes_max = std::min<std::uint64_t>(points * kWidestPoint_bytes + kBeside_bytes, INT32_MAX);
  return limits;
}

}  // namespace

RosEdge make_ros2_edge(const LoadedConfig& loaded, const HealthBoard& health, bool subscribes, bool publishes,
                       CommandBoard* commands) {
  const RosEnvironment environment = read_ros_environment(ros_distro_of(loaded.live.ros_distro), get_variable);
  const auto node = std::make_shared<Ros2Node>(kNodeName, environment, limits_of(loaded));
  RosEdge edge;
  if (subscribes) edge.source = make_ros2_source(loaded, node);
  if (commands != nullptr && !loaded.planar.command_ros.empty()) {
    edge.commands = make_ros2_commands(loaded.planar.command_ros, *commands, node);
  }
  if (publishes) {
    edge.sink = make_ros_publisher("sink ros2", loaded, health, MessageEncoding::kCdr, std::make_unique<Ros2Out>(node));
  }
  return edge;
}

}  // namespace pose_wall::tools::live
