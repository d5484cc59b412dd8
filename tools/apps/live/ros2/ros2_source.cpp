// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros2/ros2_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "apps/live/log.hpp"
#include "apps/live/ros2/endpoint_watch.hpp"
#include "apps/live/ros_messages/ros_reader.hpp"
#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t kLookEvery_ms = 50;
// Sensors turn five times a second and more.
constexpr auto kPatience = std::chrono::seconds(2);
// SensorDataQoS, but for its depth: the newest cloud counts. It takes clouds of every writer there is.
constexpr RosQos kCloudQos{false, false, 2};
// As tf2_ros listens; best effort to /tf, which also takes what careless broadcasters send.
constexpr RosQos kStaticTransformsQos{true, true, 100}, kTransformsQos{false, false, 100};

// What RosReader reads, the preferred one first.
constexpr std::array<const RosType*, 2> kCloudTypes = {&kPointCloud2Type, &kLivoxCustomType};

class Ros2Source final : public Source {
 public:
  Ros2Source(const LoadedConfig& loaded, std::shared_ptr<Ros2Node> node)
      : node_(std::move(node)), reader_(loaded, MessageEncoding::kCdr), dds_topic_(dds_topic(reader_.topic())) {}
  ~Ros2Source() override { end(); }

  void start(FrameTaker& taker) override {
    node_->start();
    const std::uint64_t granted = node_->receive_buffer_bytes(), asked = node_->receive_buffer_asked_bytes();
    if (granted < asked) log_line(Grade::kWarning, "ros2", receive_buffer_warning(granted, asked));
    reader_.deliver_to(&taker);
    writers_ = std::make_unique<EndpointWatch>(
        *node_, true, std::vector<std::string>{dds_topic_, dds_topic("/tf"), dds_topic("/tf_static")});
    if (reader_.wants_transforms()) {
      static_transforms_ = node_->make_reader("/tf_static", kTfMessageType, kStaticTransformsQos);
      transforms_ = node_->make_reader("/tf", kTfMessageType, kTransformsQos);
    }
    read_type(*kCloudTypes.front());
    ending_ = false;
    thread_ = std::thread([this] { run(); });
  }

  void stop() override { end(); }

  PartHealth health() const override {
    PartHealth health = reader_.health("source ros2 " + reader_.topic());
    const std::lock_guard<std::mutex> locked(lock_);
    const std::string lost = receive_buffer_warning(seen_.granted_bytes, seen_.largest_bytes);
    if (!seen_.trouble.empty()) {
      // Beside a writer that matches, one that does not is a warning.
      health.grade = seen_.matched > 0 ? std::max(health.grade, Grade::kWarning) : Grade::kBad;
      health.summary = seen_.matched > 0 ? health.summary + "; " + seen_.trouble : seen_.trouble;
    } else if (seen_.matched == 0) {
      health.grade = Grade::kBad;
      health.summary = "nobody publishes " + reader_.topic();
      if (!node_->trouble().empty()) health.summary += "; " + node_->trouble();
    } else if (Clock::now() - seen_.fared_well > kPatience) {
      health.grade = Grade::kBad;
      health.summary += fmt::format(
          ": a writer is there, but nothing comes through whole. Clouds above {:.1f} MB are not taken "
          "(frame_points_max), "
          "and the kernel grants a receive buffer of {:.1f} MB (net.core.rmem_max)",
          static_cast<double>(node_->sample_bytes_max()) * 1e-6, static_cast<double>(seen_.granted_bytes) * 1e-6);
    } else if (!lost.empty()) {
      health.grade = std::max(health.grade, Grade::kWarning);
      health.summary += "; " + lost;
    }
    health.add("domain", node_->environment().domain_id);
    health.add("type", seen_.type);
    health.add("writers matched", seen_.matched);
    health.add("largest cloud bytes", seen_.largest_bytes);
    health.add("receive buffer bytes", seen_.granted_bytes);
    health.add("clouds lost by DDS", seen_.lost);
    return health;
  }

 private:
  // Of the thread, for who asks for health: DDS is not asked under its locks by others.
  struct Seen {
    std::string type, trouble;
    std::uint64_t matched = 0, largest_bytes = 0, granted_bytes = 0, lost = 0;
    Clock::time_point fared_well = Clock::now();  // a cloud came, or none could
  };

  // One type at a time, or ROS's tools would take the topic for one of several types.
  void read_type(const RosType& type) {
    clouds_ = node_->make_reader(reader_.topic(), type, kCloudQos);
    const std::lock_guard<std::mutex> locked(lock_);
    seen_.type = type.ros2_name();
    seen_.granted_bytes = node_->receive_buffer_bytes();
  }

  // Another type is read only where nobody sends the present one.
  void follow_writers() {
    const std::vector<RemoteEndpoint> writers = writers_->of(dds_topic_);
    const auto is_sent = [&](const RosType& type) {
      return std::any_of(writers.begin(), writers.end(),
                         [&](const RemoteEndpoint& one) { return one.type == type.dds_name(); });
    };
    if (is_sent(clouds_->type())) return;
    const auto found =
        std::find_if(kCloudTypes.begin(), kCloudTypes.end(), [&](const RosType* type) { return is_sent(*type); });
    if (found == kCloudTypes.end()) return;
    try {
      read_type(**found);
    } catch (const std::exception& fault) {
      log_line(Grade::kBad, "ros2", fault.what());
    }
  }

  std::string trouble() const {
    for (const auto* endpoint : {&clouds_, &static_transforms_, &transforms_}) {
      if (!*endpoint) continue;
      std::string mismatch = writers_->mismatch_with(**endpoint);
      if (!mismatch.empty()) return mismatch;
    }
    return "";
  }

  void look() {
    if (writers_->update()) {
      follow_writers();
      const std::string now = trouble();
      const std::lock_guard<std::mutex> locked(lock_);
      seen_.trouble = now;
    }
    const std::uint64_t matched = clouds_->matched(), lost = clouds_->lost();
    const std::lock_guard<std::mutex> locked(lock_);
    seen_.matched = matched;
    seen_.lost = lost;
    if (matched == 0) seen_.fared_well = Clock::now();
  }

  void take() {
    if (static_transforms_) {
      static_transforms_->take([this](ByteView message) { reader_.take_transforms(message, true); });
      transforms_->take([this](ByteView message) { reader_.take_transforms(message, false); });
      reader_.look_at_transforms();
    }
    const std::string type = clouds_->type().dds_name();
    clouds_->take([&](ByteView message) {
      {
        const std::lock_guard<std::mutex> locked(lock_);
        seen_.fared_well = Clock::now();
        seen_.largest_bytes = std::max<std::uint64_t>(seen_.largest_bytes, message.size);
      }
      reader_.take_cloud(type, message);
    });
  }

  void run() {
    name_this_thread("source-ros2");
    while (!ending_) {
      clouds_->wait(kLookEvery_ms);
      look();
      take();
    }
  }

  void end() {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
    reader_.deliver_to(nullptr);
    clouds_.reset();
    static_transforms_.reset();
    transforms_.reset();
    writers_.reset();
  }

  std::shared_ptr<Ros2Node> node_;
  RosReader reader_;
  std::string dds_topic_;
  std::unique_ptr<EndpointWatch> writers_;
  std::unique_ptr<Ros2Node::Endpoint> clouds_, static_transforms_, transforms_;
  std::thread thread_;
  std::atomic<bool> ending_{false};
  mutable std::mutex lock_;
  Seen seen_;
};

}  // namespace

std::string receive_buffer_warning(std::uint64_t granted_bytes, std::uint64_t cloud_bytes) {
  // What comes first is taken out before the last has come.
  constexpr std::uint64_t kTakenMeanwhile_bytes = 65'536;
  if (granted_bytes == 0 || granted_bytes + kTakenMeanwhile_bytes >= cloud_bytes) return "";
  return fmt::format(
      "clouds of {:.1f} MB lose parts and are dropped, for the kernel grants a receive buffer of {:.1f} MB: set "
      "net.core.rmem_max to {} or more (sysctl -w net.core.rmem_max={}, and a file in /etc/sysctl.d)",
      static_cast<double>(cloud_bytes) * 1e-6, static_cast<double>(granted_bytes) * 1e-6, cloud_bytes, cloud_bytes);
}

std::unique_ptr<Source> make_ros2_source(const LoadedConfig& loaded, std::shared_ptr<Ros2Node> node) {
  return std::make_unique<Ros2Source>(loaded, std::move(node));
}

}  // namespace pose_wall::tools::live
