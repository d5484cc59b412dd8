// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros_messages/ros_reader.hpp"
#include "apps/live/clocks.hpp"
#include "io/config_file/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/live/log.hpp"
#include "io/bags/cloud_message.hpp"

namespace pose_wall::tools::live {
namespace {

// As the source by UDP: ten turns of the slowest sensor.
constexpr std::int64_t kSilent_ns = 1'000'000'000;
// Garbage may be another one each time; the journal shall not be filled by who sends it.
constexpr std::int64_t kRefusalsLoggedEvery_ns = 10'000'000'000;

// "sensor_msgs::msg::dds_::PointCloud2_", as DDS has it, is sensor_msgs/msg/PointCloud2.
std::string ros_type(const std::string& type) {
  constexpr std::string_view kDds = "::msg::dds_::";
  const std::size_t at = type.find(kDds);
  if (at == std::string::npos || type.back() != '_') return type;
  return type.substr(0, at) + "/msg/" + type.substr(at + kDds.size(), type.size() - at - kDds.size() - 1);
}

}  // namespace

RosReader::RosReader(const LoadedConfig& loaded, MessageEncoding encoding)
    : encoding_(encoding),
      topic_(config_text(*loaded.config.get(), "pointcloud_topic")),
      base_frame_(config_text(*loaded.config.get(), "base_frame")),
      lidar_frame_(config_text(*loaded.config.get(), "lidar_frame")),
      wants_transforms_(loaded.live.extrinsic_from == "tf"),
      sources_(loaded.live.ros_source) {}

void RosReader::deliver_to(FrameTaker* taker) {
  const std::lock_guard<std::mutex> locked(lock_);
  taker_ = taker;
}

void RosReader::refuse(const std::string& why) {
  ++refused_;
  const std::int64_t now_ns = monotonic_ns();
  const bool is_due = !refusal_logged_ns_ || now_ns - *refusal_logged_ns_ >= kRefusalsLoggedEvery_ns;
  if (why != last_refusal_ && is_due) {
    log_line(Grade::kWarning, topic_, why);
    refusal_logged_ns_ = now_ns;
  }
  last_refusal_ = why;
}

void RosReader::take_cloud(const std::string& type, ByteView message) {
  const std::lock_guard<std::mutex> locked(lock_);
  last_cloud_ns_ = monotonic_ns();
  const std::string known = ros_type(type);
  if (!is_cloud_type(known)) {
    return refuse(fmt::format("is of type {}; sensor_msgs/PointCloud2 and Livox's CustomMsg are read", type));
  }
  LiveFrame frame;
  SourceIdentity source;
  try {
    DecodedCloud cloud = decode_cloud(known, encoding_, message);
    frame.frame = std::move(cloud.frame);
    frame.stamp_ns = cloud.stamp_ns;
    source = std::move(cloud.source);
    frame.frame_id = source.frame_id.value_or("");
  } catch (const FrameError& fault) {
    return refuse(fault.what());
  }
  // Who stamps nothing gets the time of arrival, or the engine would take every cloud for the one before.
  if (frame.stamp_ns == 0) ++without_stamp_;
  frame.frame.cloud.stamp_ns = frame.stamp_ns != 0 ? frame.stamp_ns : last_cloud_ns_;
  if (!is_of_this_sensor(source)) return;
  if (wants_transforms_) tell_extrinsic();
  ++frames_;
  last_taken_ns_ = last_cloud_ns_;
  if (taker_ != nullptr) taker_->take(std::move(frame));
}

// Of two that send at once the first is read for good: the other one is mounted elsewhere, and its walls would be
// measured from where the first one stands. Who comes after a silence, and never beside the first, is its successor.
bool RosReader::is_of_this_sensor(const SourceIdentity& source) {
  const bool is_silent = last_taken_ns_ != 0 && last_cloud_ns_ - last_taken_ns_ > kSilent_ns;
  if (is_silent && !are_two_ && sources_.chosen() && source != *sources_.chosen()) {
    sources_ = SourceGate(sources_.wanted());
  }
  const bool is_first = !sources_.chosen();
  const std::size_t known = sources_.heard().size();
  const bool is_admitted = sources_.admits(source);
  if (!is_admitted && sources_.heard().size() > known) log_line(Grade::kWarning, topic_, of_others_text("cloud"));
  if (is_admitted && sources_.refused() > 0) are_two_ = true;
  if (!is_admitted || !is_first) return is_admitted;
  cloud_frame_ = source.frame_id.value_or("");
  if (!cloud_frame_.empty() && cloud_frame_ != lidar_frame_) {
    log_line(Grade::kWarning, topic_,
             fmt::format("frame_id is '{}', lidar_frame is '{}': {}", cloud_frame_, lidar_frame_,
                         wants_transforms_ ? "the transform from the cloud's frame is used"
                                           : "the extrinsic of the config is taken for it"));
  }
  return true;
}

std::string RosReader::of_others_text(const char* one) const {
  if (sources_.chosen()) return sources_.note(fmt::format("on {}", topic_), one, "ros_source");
  std::vector<std::string> names;
  for (const HeardSource& heard : sources_.heard()) names.push_back(sources_.name_of(heard.who));
  return fmt::format("ros_source is '{}'; clouds come from {}", sources_.wanted(), fmt::join(names, ", "));
}

void RosReader::take_transforms(ByteView message, bool is_static) {
  const std::lock_guard<std::mutex> locked(lock_);
  try {
    transforms_.take(encoding_, message, is_static, monotonic_ns());
    ++transforms_taken_;
  } catch (const FrameError& fault) {
    return refuse(fmt::format("{}: {}", is_static ? "/tf_static" : "/tf", fault.what()));
  }
  tell_extrinsic();
}

void RosReader::look_at_transforms() {
  const std::lock_guard<std::mutex> locked(lock_);
  if (wants_transforms_) tell_extrinsic();
}

void RosReader::tell_extrinsic() {
  const std::string& from = cloud_frame_.empty() ? lidar_frame_ : cloud_frame_;
  const std::optional<Extrinsic> extrinsic = transforms_.extrinsic(base_frame_, from, monotonic_ns());
  extrinsic_known_ = extrinsic.has_value();
  if (taker_ != nullptr) taker_->set_extrinsic(extrinsic);
}

PartHealth RosReader::health(const std::string& part) const {
  const std::lock_guard<std::mutex> locked(lock_);
  PartHealth health;
  health.part = part;
  const std::int64_t now_ns = monotonic_ns();
  const bool is_silent = last_cloud_ns_ == 0 || now_ns - last_cloud_ns_ > kSilent_ns;
  if (is_silent) {
    health.grade = Grade::kBad;
    health.summary = last_cloud_ns_ == 0 ? "waits for clouds" : "no cloud comes any more";
  } else if (last_taken_ns_ == 0 || now_ns - last_taken_ns_ > kSilent_ns) {
    health.grade = Grade::kBad;
    health.summary = "messages come, and none is a cloud of this sensor: " +
                     (last_refusal_.empty() ? of_others_text("") : last_refusal_);
  } else if (wants_transforms_ && !extrinsic_known_) {
    health.grade = Grade::kBad;
    health.summary = fmt::format("no transform from '{}' to '{}': nothing is measured",
                                 cloud_frame_.empty() ? lidar_frame_ : cloud_frame_, base_frame_);
  } else {
    health.summary = "receives";
  }
  health.add("clouds", frames_.load());
  health.add("messages refused", refused_.load());
  health.add("clouds without stamp", without_stamp_.load());
  if (sources_.refused() > 0) {
    health.add("clouds of another frame_id, dropped", sources_.refused());
    health.add("sources", of_others_text("cloud"));
  }
  if (wants_transforms_) health.add("transform messages", transforms_taken_.load());
  if (!last_refusal_.empty()) health.add("last refusal", last_refusal_);
  return health;
}

}  // namespace pose_wall::tools::live
