// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// tf2_msgs/TFMessage as bytes.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/bags/message_writer.hpp"

namespace pose_wall::test {

struct TfLink {
  std::string parent, child;
  std::array<double, 3> position_m{};
  std::array<double, 4> xyzw = {0.0, 0.0, 0.0, 1.0};
};

inline std::string tf_message(const std::vector<TfLink>& links,
                              tools::MessageEncoding encoding = tools::MessageEncoding::kRos1) {
  tools::MessageWriter message(encoding);
  message.count(links.size());
  for (const TfLink& link : links) {
    if (!message.is_cdr()) message.number(std::uint32_t{0});
    message.number(std::uint32_t{12});
    message.number(std::uint32_t{34});
    message.text(link.parent);
    message.text(link.child);
    for (const double number : link.position_m) message.number(number);
    for (const double number : link.xyzw) message.number(number);
  }
  return message.take();
}

inline tools::ByteView view_of(const std::string& bytes) {
  return {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
}

}  // namespace pose_wall::test
