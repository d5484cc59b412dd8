// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "bags/bag_reader.hpp"

namespace pose_wall::tools {

BagSurvey BagReader::survey() {
  BagSurvey survey;
  for (bool at_end = false; !at_end;) {
    try {
      const std::optional<BagMessage> message = next();
      at_end = !message;
      survey.messages.resize(topics().size());
      if (message) ++survey.messages[message->topic];
    } catch (const FrameError& fault) {
      survey.faults.emplace_back(fault.what());
    }
  }
  survey.messages.resize(topics().size());
  rewind();
  return survey;
}

}  // namespace pose_wall::tools
