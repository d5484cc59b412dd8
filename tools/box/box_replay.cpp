// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "box/box_replay.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "box/mapped_file.hpp"
#include "pose_wall.hpp"
#include "pose_wall_box.h"
#include "pose_wall_runtime.h"

namespace pose_wall::tools {
namespace {

std::vector<pose_wall_box_record> read_records(const MappedFile& file, BoxReplay* replay) {
  std::vector<pose_wall_box_record> records;
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record record;
  while (pose_wall_box_next(file.data(), file.size(), &offset, &record) == POSE_WALL_OK) {
    replay->passed_over += record.passed_over;
    if (record.damaged != 0) {
      ++replay->damaged;
    } else {
      records.push_back(record);
    }
  }
  replay->passed_over += record.passed_over;
  std::stable_sort(records.begin(), records.end(),
                   [](const auto& a, const auto& b) { return a.sequence < b.sequence; });
  return records;
}

void compute(const pose_wall_box_record& record, pose_wall_engine* engine, BoxReplay* replay) {
  pose_wall_result recorded, computed = api::make_result();
  std::memcpy(&recorded, record.result, sizeof recorded);
  const std::int32_t status = pose_wall_box_compute(&record, engine, &computed);
  if (status == POSE_WALL_BOX_E_EMPTY) {
    ++replay->digests_only;
  } else if (status != POSE_WALL_OK) {
    ++replay->refused;
  } else if (const auto difference = first_difference(recorded, computed)) {
    ++replay->different;
    if (!replay->first) replay->first = {record.sequence, recorded.frame_index, recorded.stamp_ns, *difference};
  } else {
    ++replay->equal;
  }
}

void count(const std::vector<pose_wall_box_record>& records, BoxReplay* replay) {
  replay->records = records.size();
  if (records.empty()) return;
  replay->first_sequence = records.front().sequence;
  replay->last_sequence = records.back().sequence;
  replay->missing = replay->last_sequence - replay->first_sequence + 1 - records.size();
  for (const pose_wall_box_record& record : records) {
    ++(record.kind == POSE_WALL_BOX_SILENCE ? replay->silences : replay->frames);
    replay->thinned += record.thinning > 1 ? 1 : 0;
  }
}

}  // namespace

BoxReplay replay_box(const std::string& path, const ReplayProgress& progress) {
  const MappedFile file(path);
  pose_wall_box_info info;
  std::int32_t status =
      file.size() > 0 ? pose_wall_box_open(file.data(), file.size(), &info) : std::int32_t{POSE_WALL_BOX_E_FORMAT};
  if (status != POSE_WALL_OK) throw std::runtime_error(path + ": " + pose_wall_runtime_status_text(status));
  std::uint64_t bytes = 0;
  status = pose_wall_memory_needed(&info.config, &bytes);
  if (status != POSE_WALL_OK) throw std::runtime_error(path + ": its config: " + pose_wall_status_text(status));
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };
  std::vector<Line> block(bytes / sizeof(Line) + 1);
  pose_wall_engine* engine = nullptr;
  status = pose_wall_open(&info.config, block.data(), block.size() * sizeof(Line), &engine);
  if (status != POSE_WALL_OK) throw std::runtime_error(path + ": " + pose_wall_status_text(status));

  BoxReplay replay;
  replay.version = info.version;
  const std::vector<pose_wall_box_record> records = read_records(file, &replay);
  count(records, &replay);
  for (std::size_t i = 0; i < records.size(); ++i) {
    compute(records[i], engine, &replay);
    if (progress) progress(i + 1, records.size());
  }
  return replay;
}

}  // namespace pose_wall::tools
