// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/traced_frame.hpp"

#include <cstring>
#include <string>

namespace pose_wall::tools {
namespace {

void expect_ok(std::int32_t status) {
  if (status != POSE_WALL_OK) throw std::runtime_error(std::string("the engine: ") + pose_wall_status_text(status));
}

}  // namespace

Memento memento_of(pose_wall_engine* engine) {
  Memento memento(static_cast<std::size_t>(pose_wall_memento_bytes()));
  expect_ok(pose_wall_save(engine, nullptr, memento.data(), memento.size()));
  return memento;
}

std::int32_t TracedEngine::open(const api::Config& config) {
  std::uint64_t bytes = 0;
  const std::int32_t status = pose_wall_memory_needed(config.get(), &bytes);
  if (status != POSE_WALL_OK) return status;
  block_.resize(static_cast<std::size_t>((bytes + sizeof(Line) - 1) / sizeof(Line)));
  config_ = config;
  memento_.clear();
  return POSE_WALL_OK;
}

std::int32_t TracedEngine::process(const pose_wall_cloud& cloud, pose_wall_result& result) {
  const void* const before = memento_.empty() ? nullptr : memento_.data();
  const std::int32_t status = pose_wall_trace_frame(config_.get(), before, memento_.size(), &cloud, block_.data(),
                                                    block_.size() * sizeof(Line), &result, trace_.get());
  if (status != POSE_WALL_OK) return status;
  memento_.resize(static_cast<std::size_t>(pose_wall_memento_bytes()));
  return pose_wall_trace_save(block_.data(), memento_.data(), memento_.size());
}

TracedFrame trace_frame(const api::Config& config, const Memento& before, const pose_wall_cloud& cloud) {
  TracedEngine engine;
  expect_ok(engine.open(config));
  engine.remember(before);
  TracedFrame frame{api::make_result(), nullptr};
  expect_ok(engine.process(cloud, frame.result));
  frame.trace = std::make_unique<pose_wall_trace>(engine.trace());
  return frame;
}

bool same_bits(pose_wall_result a, pose_wall_result b) {
  for (int stage = 0; stage < POSE_WALL_STAGES; ++stage) a.stage_ns[stage] = b.stage_ns[stage] = 0;
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace pose_wall::tools
