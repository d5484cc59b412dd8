// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/cloud_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/bags/livox_custom.hpp"
#include "io/bags/point_cloud2.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

struct CloudType {
  std::string_view name;
  DecodedCloud (*decode)(MessageEncoding, ByteView, const Place&);
  SourceIdentity (*source)(MessageEncoding, ByteView, const Place&);
};

constexpr std::array<CloudType, 6> kCloudTypes = {
    {{"sensor_msgs/PointCloud2", decode_point_cloud2, source_of_point_cloud2},
     {"sensor_msgs/msg/PointCloud2", decode_point_cloud2, source_of_point_cloud2},
     {"livox_ros_driver/CustomMsg", decode_livox_custom, source_of_livox_custom},
     {"livox_ros_driver/msg/CustomMsg", decode_livox_custom, source_of_livox_custom},
     {"livox_ros_driver2/CustomMsg", decode_livox_custom, source_of_livox_custom},
     {"livox_ros_driver2/msg/CustomMsg", decode_livox_custom, source_of_livox_custom}}};

const CloudType* find_cloud_type(std::string_view name) {
  const auto* const found =
      std::find_if(kCloudTypes.begin(), kCloudTypes.end(), [&](const CloudType& type) { return type.name == name; });
  return found != kCloudTypes.end() ? found : nullptr;
}

const CloudType& required_cloud_type(std::string_view name) {
  const CloudType* const found = find_cloud_type(name);
  if (found == nullptr) throw FrameError(say("messages of type {} are no clouds", name));
  return *found;
}

}  // namespace

bool is_cloud_type(std::string_view type) {
  return find_cloud_type(type) != nullptr;
}

DecodedCloud decode_cloud(std::string_view type, MessageEncoding encoding, ByteView message, const Place& place) {
  return required_cloud_type(type).decode(encoding, message, place);
}

SourceIdentity source_of_cloud(std::string_view type, MessageEncoding encoding, ByteView message, const Place& place) {
  return required_cloud_type(type).source(encoding, message, place);
}

std::optional<ScanSpan> span_of_cloud(std::string_view type, MessageEncoding encoding, ByteView message,
                                      const Place& place) {
  if (required_cloud_type(type).decode != decode_livox_custom) return std::nullopt;
  return span_of_livox_custom(encoding, message, place);
}

}  // namespace pose_wall::tools
