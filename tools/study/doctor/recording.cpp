// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/recording.hpp"

#include <cstring>
#include <optional>
#include <utility>

#include "io/frames/frame_stamps.hpp"
#include "io/frames/told_rings.hpp"
#include "io/terminal/interrupt.hpp"

namespace pose_wall::tools::doctor {
namespace {

// Frames of a thousand points hold no roadway, and a frame without any would only spoil the statistics.
constexpr std::uint32_t kReturnsMin = 100;
constexpr std::size_t kKeptMax = 48;

// FNV-1a, by the bytes.
void mix(std::uint64_t& digest, float number) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8) digest = (digest ^ (bits >> shift & 255U)) * 1099511628211U;
}

void add_frame(Recording& recording, SourcedFrame& sourced, FrameStamps& stamps) {
  FrameNote note;
  KeptFrame kept;
  std::string error = std::move(sourced.error);
  if (sourced.frame) {
    const std::int32_t status = pose_wall_cloud_check(&sourced.frame->cloud);
    if (status == POSE_WALL_OK) {
      note = note_of(sourced.frame->cloud, kept);
      note.rings = told_rings(*sourced.frame);
      recording.times.add(*sourced.frame);
    } else {
      error = pose_wall_status_text(status);
    }
  }
  if (!error.empty()) recording.errors.push_back(sourced.name + ": " + error);
  note.error = std::move(error);
  note.source = sourced.name;
  note.stamp_ns = stamps.next(sourced.stamp_ns);
  note.has_own_stamp = sourced.stamp_ns.has_value();
  recording.add(std::move(note), std::move(kept));
}

}  // namespace

pose_wall_cloud KeptFrame::cloud() const {
  pose_wall_cloud cloud{};
  pose_wall_cloud_xyz32(&cloud, xyz_lidar_m.data(), static_cast<std::uint32_t>(count()), 3 * sizeof(float), 0);
  return cloud;
}

void Recording::add(FrameNote note, KeptFrame frame) {
  const bool usable = note.error.empty() && note.returns >= kReturnsMin;
  if (note.error.empty()) sensor.add(frame.xyz_lidar_m, note.rings);
  notes.push_back(std::move(note));
  if (!usable || readable_++ % stride_ != 0) return;
  kept.push_back(std::move(frame));
  if (kept.size() <= kKeptMax) return;
  std::size_t stays = 0;
  for (std::size_t i = 0; i < kept.size(); i += 2) {
    if (i != stays) kept[stays] = std::move(kept[i]);
    ++stays;
  }
  kept.resize(stays);
  stride_ *= 2;
}

FrameNote note_of(const pose_wall_cloud& cloud, KeptFrame& frame) {
  FrameNote note;
  note.points = cloud.width * cloud.height;
  note.digest = 14695981039346656037U;
  frame.xyz_lidar_m = returns_of(cloud);
  note.returns = static_cast<std::uint32_t>(frame.count());
  for (const float number : frame.xyz_lidar_m) mix(note.digest, number);
  return note;
}

Recording read_recording(FrameSequence& inputs, double rate_hz,
                         const std::function<void(const std::string&)>& progress) {
  Recording recording;
  recording.errors = inputs.errors();
  FrameStamps stamps(rate_hz);
  while (std::optional<SourcedFrame> frame = inputs.next()) {
    if (InterruptWatch::is_interrupted()) {
      recording.interrupted = true;
      break;
    }
    add_frame(recording, *frame, stamps);
    progress(frame->name);
  }
  return recording;
}

}  // namespace pose_wall::tools::doctor
