// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/bag_reader.hpp"

namespace pose_wall::tools {
namespace {

void look_at(const BagMessage& message, const std::function<void(const BagMessage&)>& look) {
  try {
    look(message);
  } catch (const FrameError&) {  // NOLINT(bugprone-empty-catch): said when the message is read
  }
}

}  // namespace

BagSurvey BagReader::survey(const std::function<void(const BagMessage&)>& look) {
  BagSurvey survey;
  for (bool at_end = false; !at_end;) {
    try {
      const std::optional<BagMessage> message = next();
      at_end = !message;
      survey.messages.resize(topics().size());
      if (!message) continue;
      ++survey.messages[message->topic];
      if (look) look_at(*message, look);
    } catch (const FrameError& fault) {
      survey.faults.emplace_back(fault.what());
    }
  }
  survey.messages.resize(topics().size());
  rewind();
  return survey;
}

}  // namespace pose_wall::tools
