// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros_messages/command_reader.hpp"

#include <fmt/format.h>

#include <array>

#include "apps/live/clocks.hpp"
#include "io/bags/message_cursor.hpp"

namespace pose_wall::tools::live {
namespace {

// As the message has them.
enum TwistMember : std::size_t { kLinearX, kLinearY, kLinearZ, kAngularX, kAngularY, kAngularZ, kTwistMembers };
constexpr std::array<const char*, kTwistMembers> kNames = {"linear.x",  "linear.y",  "linear.z",
                                                           "angular.x", "angular.y", "angular.z"};
using Twist = std::array<double, kTwistMembers>;

Twist read_twist(MessageEncoding encoding, ByteView bytes, bool is_stamped) {
  MessageCursor message(encoding, bytes, {});
  if (is_stamped) static_cast<void>(read_header(message));
  Twist twist{};
  for (std::size_t i = 0; i < kTwistMembers; ++i) twist[i] = message.number<double>(kNames[i]);
  if (message.left() > 0) message.refuse(fmt::format("{} bytes are left behind the twist", message.left()));
  return twist;
}

}  // namespace

void CommandReader::take(const std::string& type, ByteView message) {
  const bool is_stamped = type == kTwistStampedType.name;
  if (!is_stamped && type != kTwistType.name) {
    return commands_.refuse(
        fmt::format("is of type {}; {} and {} are read", type, kTwistType.name, kTwistStampedType.name));
  }
  try {
    const Twist twist = read_twist(encoding_, message, is_stamped);
    for (const TwistMember other : {kLinearY, kLinearZ, kAngularX, kAngularY}) {
      if (twist[other] == 0.0) continue;
      return commands_.refuse(
          fmt::format("{} is {:g}; 0 is allowed beside linear.x and angular.z", kNames[other], twist[other]));
    }
    static_cast<void>(commands_.take({twist[kLinearX], twist[kAngularZ]}, monotonic_ns()));
  } catch (const FrameError& fault) {
    commands_.refuse(fault.what());
  }
}

}  // namespace pose_wall::tools::live
