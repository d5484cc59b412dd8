// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "inputs/frame_sequence.hpp"

#include <chrono>
#include <utility>

#include "frames/file_source.hpp"
#include "frames/input_list.hpp"

namespace pose_wall::tools {

FrameSequence::FrameSequence(const std::vector<std::string>& arguments, const InputOptions& options) {
  for (const std::string& argument : arguments) add(argument, options);
}

void FrameSequence::add(const std::string& argument, const InputOptions& /*options*/) {
  FrameInputs inputs = collect_inputs({argument});
  files_.insert(files_.end(), inputs.files.begin(), inputs.files.end());
  errors_.insert(errors_.end(), inputs.errors.begin(), inputs.errors.end());
  sources_.push_back(std::make_unique<FileSource>(std::move(inputs.files)));
}

std::optional<SourcedFrame> FrameSequence::next() {
  using Clock = std::chrono::steady_clock;
  for (; current_ < sources_.size(); ++current_) {
    const Clock::time_point start = Clock::now();
    if (std::optional<SourcedFrame> sourced = sources_[current_]->next()) {
      if (sourced->frame) {
        sourced->load_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
      }
      return sourced;
    }
  }
  return std::nullopt;
}

std::size_t FrameSequence::frames() const {
  std::size_t frames = 0;
  for (const auto& source : sources_) frames += source->frames();
  return frames;
}

}  // namespace pose_wall::tools
