// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "explain/traced_frame.hpp"

#include <cstring>
#include <string>

namespace pose_wall::tools {
namespace {

void expect_ok(std::int32_t status) {
  if (status != POSE_WALL_OK) throw std::runtime_error(std::string("the engine: ") + pose_wall_status_text(status));
}

struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
  unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
};

}  // namespace

Memento memento_of(pose_wall_engine* engine) {
  Memento memento(static_cast<std::size_t>(pose_wall_memento_bytes()));
  expect_ok(pose_wall_save(engine, nullptr, memento.data(), memento.size()));
  return memento;
}

TracedFrame trace_frame(const api::Config& config, const Memento& before, const pose_wall_cloud& cloud) {
  std::uint64_t bytes = 0;
  expect_ok(pose_wall_memory_needed(config.get(), &bytes));
  std::vector<Line> block(static_cast<std::size_t>((bytes + sizeof(Line) - 1) / sizeof(Line)));
  TracedFrame frame{api::make_result(), std::make_unique<pose_wall_trace>()};
  expect_ok(pose_wall_trace_frame(config.get(), before.data(), before.size(), &cloud, block.data(),
                                  block.size() * sizeof(Line), &frame.result, frame.trace.get()));
  return frame;
}

bool same_bits(pose_wall_result a, pose_wall_result b) {
  for (int stage = 0; stage < POSE_WALL_STAGES; ++stage) a.stage_ns[stage] = b.stage_ns[stage] = 0;
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace pose_wall::tools
