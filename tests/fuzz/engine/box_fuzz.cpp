// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: a black box as a file that nobody vouches for. The first byte says which of its checksums are made right
// before it is read, so that what lies behind them is reached, too. Whatever it holds: the reader ends, points nowhere
// outside, and the engine that its config opens computes its records without undefined behaviour.

#include "fuzz/fuzz_target.hpp"
#include "fuzz/mended_box.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

// An input's config may ask for any memory, and its records for any time: larger engines are not opened, and of the
// records that are read only these are computed.
constexpr std::uint64_t kBlockToOpen = 4ULL << 20U;
constexpr int kRecordsMax = 8;

// The engine for the box's config, where there is one that is small enough.
pose_wall_engine* engine_of(const pose_wall_config& config, KeptBlock* block) {
  std::uint64_t bytes = 0;
  if (pose_wall_memory_needed(&config, &bytes) != POSE_WALL_OK || bytes > kBlockToOpen) return nullptr;
  return open_engine(config, block, 0xA5);
}

bool is_inside(const void* part, std::uint64_t bytes, const unsigned char* box, std::uint64_t count) {
  const auto* const from = static_cast<const unsigned char*>(part);
  return from >= box && bytes <= count && static_cast<std::uint64_t>(from - box) <= count - bytes;
}

void require_inside(const pose_wall_box_record& r, const unsigned char* box, std::uint64_t count) {
  require(is_inside(r.memento, pose_wall_memento_bytes(), box, count), "the memento is inside");
  require(is_inside(r.result, sizeof(pose_wall_result), box, count), "the result is inside");
  require(r.inputs == nullptr || is_inside(r.inputs, sizeof(pose_wall_inputs), box, count), "the inputs are inside");
  require(r.points == nullptr || is_inside(r.points, std::uint64_t{r.point_count} * r.point_bytes, box, count),
          "the points are inside");
}

void compute(const pose_wall_box_record& record, pose_wall_engine* engine) {
  pose_wall_result result = empty_result();
  const std::int32_t status = pose_wall_box_compute(&record, engine, &result);
  if (status != POSE_WALL_OK) return;
  for (const pose_wall_value& v : result.quantity) require(v.state <= POSE_WALL_VALID, "a known state");
}

void read_records(const unsigned char* box, std::uint64_t count, pose_wall_engine* engine) {
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES, passed = 0;
  pose_wall_box_record record;
  for (int n = 0;; ++n) {
    const std::uint64_t from = offset < count ? offset : count;
    const std::int32_t status = pose_wall_box_next(box, count, &offset, &record);
    require(offset >= from && offset <= count, "it goes on, and not behind the end");
    passed += record.passed_over;
    if (status == POSE_WALL_BOX_E_END) break;
    require_ok(status, "next");
    require(offset > from, "no record twice");
    if (record.damaged != 0) continue;
    require_inside(record, box, count);
    if (engine != nullptr && n < kRecordsMax) compute(record, engine);
  }
  require(passed <= count, "no byte is passed over twice");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block;
  if (size < 1) return 0;
  const std::uint64_t count = size - 1;
  // Exactly as long, for AddressSanitizer; aligned as a mapped file is.
  void* place = nullptr;
  require(posix_memalign(&place, 64, count > 0 ? static_cast<std::size_t>(count) : 1) == 0, "memory for a box");
  auto* const box = static_cast<unsigned char*>(place);
  std::memcpy(box, data + 1, static_cast<std::size_t>(count));
  mend_box(box, count, data[0]);
  pose_wall_box_info info;
  std::memset(&info, 0, sizeof info);
  pose_wall_engine* engine = nullptr;
  if (pose_wall_box_open(box, count, &info) == POSE_WALL_OK) {
    require(std::memchr(info.version, 0, sizeof info.version) != nullptr, "the version ends");
    engine = engine_of(info.config, &block);
  }
  read_records(box, count, engine);
  std::free(place);
  return 0;
}
