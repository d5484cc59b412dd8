// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The edge of ROS 1: clouds and transforms in, results out, by one node.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/live/edges.hpp"
#include "apps/live/ros1/ros1_proxy.hpp"
#include "apps/live/ros_messages/command_reader.hpp"
#include "apps/live/ros_messages/ros_publisher.hpp"
#include "apps/live/ros_messages/ros_reader.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr const char* kNodeName = "pose_walld";
// The newest cloud and the newest command count; of transforms none may be lost.
constexpr std::uint32_t kCloudQueue = 2, kTransformQueue = 100, kCommandQueue = 1;

class Ros1Source final : public Source {
 public:
  Ros1Source(const LoadedConfig& loaded, std::shared_ptr<Ros1Proxy> node)
      : node_(std::move(node)), reader_(loaded, MessageEncoding::kRos1) {
    node_->subscribe(reader_.topic(), kCloudQueue,
                     [this](const std::string& type, ByteView message) { reader_.take_cloud(type, message); });
    if (!reader_.wants_transforms()) return;
    for (const bool is_static : {true, false}) {
      node_->subscribe(
          is_static ? "/tf_static" : "/tf", kTransformQueue,
          [this, is_static](const std::string&, ByteView message) { reader_.take_transforms(message, is_static); });
    }
  }
  ~Ros1Source() override { node_->stop(); }  // it calls the reader

  void start(FrameTaker& taker) override {
    reader_.deliver_to(&taker);
    node_->start();
  }
  void stop() override { reader_.deliver_to(nullptr); }

  PartHealth health() const override {
    PartHealth health = reader_.health("source ros1 " + reader_.topic());
    node_->add_facts(&health);
    if (health.grade == Grade::kBad && node_->publishers() == 0) health.summary = "nobody publishes " + reader_.topic();
    const std::string trouble = node_->trouble();
    if (trouble.empty()) return health;
    // Who is connected goes on sending without a master.
    health.summary = health.grade == Grade::kBad ? trouble : fmt::format("{}; {}", health.summary, trouble);
    health.grade = std::max(health.grade, Grade::kWarning);
    return health;
  }

 private:
  std::shared_ptr<Ros1Proxy> node_;
  RosReader reader_;
};

class Ros1Out final : public RosOut {
 public:
  explicit Ros1Out(std::shared_ptr<Ros1Proxy> node) : node_(std::move(node)) {}

  std::size_t advertise(const std::string& topic, const RosType& type, bool is_latched) override {
    return node_->advertise(topic, type, is_latched);
  }
  void publish(std::size_t number, const std::string& message) override { node_->publish(number, message); }
  std::uint32_t subscribers(std::size_t number) const override { return node_->subscribers(number); }
  void start() override { node_->start(); }
  void stop() override { node_->stop(); }
  std::string trouble() const override { return node_->trouble(); }
  void add_facts(PartHealth* health) const override { node_->add_facts(health); }

 private:
  std::shared_ptr<Ros1Proxy> node_;
};

}  // namespace

RosEdge make_ros1_edge(const LoadedConfig& loaded, const HealthBoard& health, bool subscribes, bool publishes,
                       CommandBoard* commands) {
  const auto node = std::make_shared<Ros1Proxy>(kNodeName);
  if (commands != nullptr && !loaded.planar.command_ros.empty()) {
    const auto reader = std::make_shared<CommandReader>(*commands, MessageEncoding::kRos1);
    node->subscribe(loaded.planar.command_ros, kCommandQueue,
                    [reader](const std::string& type, ByteView message) { reader->take(type, message); });
  }
  RosEdge edge;
  if (subscribes) edge.source = std::make_unique<Ros1Source>(loaded, node);
  if (publishes) {
    edge.sink =
        make_ros_publisher("sink ros1", loaded, health, MessageEncoding::kRos1, std::make_unique<Ros1Out>(node));
  }
  return edge;
}

}  // namespace pose_wall::tools::live
