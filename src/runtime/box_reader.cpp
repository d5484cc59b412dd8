// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Finds records in untrusted bytes. Every offset is checked in 64 bits before it is used.

#include "base/math/crc32.hpp"
#include "box_layout.hpp"
#include "lidar/cloud_fields.hpp"
#include "part/export.hpp"
#include "part/status.hpp"
#include "pose_wall_box.h"
#include "thinning.hpp"

namespace pose_wall::runtime {
namespace {

bool head_is_whole(const unsigned char* head) {
  return get<std::uint32_t>(head + kAtSync) == kRecordSync &&
         get<std::uint32_t>(head + kAtHeadCrc) == crc32(head, kAtHeadCrc);
}

bool sizes_are_plausible(const unsigned char* head, std::uint64_t room) {
  const std::uint64_t bytes = get<std::uint64_t>(head + kAtRecordBytes);
  const std::uint64_t cloud_bytes = get<std::uint64_t>(head + kAtCloudBytes);
  const std::uint64_t fixed = kHeadBytes + body_without_cloud();
  if (bytes > room || bytes < fixed || cloud_bytes > bytes - fixed) return false;
  return bytes == fixed + aligned(cloud_bytes);
}

bool body_is_whole(const unsigned char* head) {
  const std::uint64_t bytes = get<std::uint64_t>(head + kAtRecordBytes);
  const std::uint64_t cloud_bytes = get<std::uint64_t>(head + kAtCloudBytes);
  if (get<std::uint32_t>(head + kAtBodyCrc) != crc32(head + kHeadBytes, bytes - kHeadBytes)) return false;
  const unsigned char* const description = head + kHeadBytes;
  const std::uint64_t points = get<std::uint32_t>(description + kAtPoints);
  return cloud_bytes == 0 || cloud_bytes == points * get<std::uint32_t>(description + kAtPointBytes);
}

pose_wall_field field_at(const unsigned char* description, std::uint32_t index) {
  const unsigned char* const at = description + kAtFields + 8 * index;
  return {get<std::uint32_t>(at), get<std::uint32_t>(at + 4)};
}

void read_body(const unsigned char* head, pose_wall_box_record* record) {
  const unsigned char* const description = head + kHeadBytes;
  record->digest = get<std::uint64_t>(description + kAtDigest);
  record->point_count = get<std::uint32_t>(description + kAtPoints);
  record->point_bytes = get<std::uint32_t>(description + kAtPointBytes);
  record->big_endian = get<std::uint32_t>(description + kAtBigEndian);
  record->left_out_not_finite = get<std::uint32_t>(description + kAtNotFinite);
  record->left_out_zero = get<std::uint32_t>(description + kAtZero);
  for (std::uint32_t k = 0; k < kFields; ++k) *fields_of(record)[k] = field_at(description, k);
  const unsigned char* const inputs = description + kAtInputs;
  record->inputs = get<std::uint32_t>(inputs) != 0 ? inputs : nullptr;
  record->memento = description + kAtMemento;
  record->result = description + at_result();
  const unsigned char* const motion = description + at_motion();
  record->motion = get<std::uint32_t>(motion) != 0 ? motion : nullptr;
  const bool with_points = get<std::uint64_t>(head + kAtCloudBytes) > 0 || record->point_count == 0;
  record->points = with_points ? description + body_without_cloud() : nullptr;
}

// The first whole head at or behind `at`; `count` and what is less than a head before it where there is none.
std::uint64_t find_head(const unsigned char* bytes, std::uint64_t count, std::uint64_t at) {
  while (at < count && count - at >= kHeadBytes && !head_is_whole(bytes + at)) at += kBoxAlignment;
  return at;
}

bool holds_head(const unsigned char* bytes, std::uint64_t count, std::uint64_t from) {
  const std::uint64_t at = find_head(bytes, count, from);
  return at < count && count - at >= kHeadBytes;
}

// A damaged header makes its records another run's at worst, and those are not computed.
bool is_of_another_run(const unsigned char* header, std::uint64_t count, const unsigned char* head) {
  if (count < kHeaderBytes) return false;
  const unsigned char* const description = head + kHeadBytes;
  return get<std::uint32_t>(header + kAtHeaderRun) != get<std::uint16_t>(head + kAtRun) ||
         get<std::uint32_t>(header + kAtHeaderConfigCrc) != get<std::uint32_t>(description + kAtConfigCrc);
}

// At `offset` is a whole head. Returns the place to go on. Each byte is summed once only, or forged heads that all
// claim the rest of the file would keep a reader busy for ever. Behind a broken body it goes on at the end that the
// head gives. A whole head was true when it was written, so nothing lies before that end, unless the disk lost a part
// of a later write. That is reported, and the caller may look there.
std::uint64_t read_record(const unsigned char* bytes, std::uint64_t count, std::uint64_t offset,
                          pose_wall_box_record* record) {
  const unsigned char* const head = bytes + offset;
  record->offset = offset;
  record->kind = get<std::uint32_t>(head + kAtKind);
  record->sequence = get<std::uint64_t>(head + kAtSequence);
  record->received_ns = get<std::int64_t>(head + kAtReceived);
  record->stamp_ns = get<std::int64_t>(head + kAtStamp);
  record->thinning = get<std::uint32_t>(head + kAtThinning);
  record->damaged = POSE_WALL_BOX_DAMAGED;
  if (!sizes_are_plausible(head, count - offset)) return offset + kHeadBytes;  // cut off: nothing was summed
  const std::uint64_t end = offset + get<std::uint64_t>(head + kAtRecordBytes);
  if (!body_is_whole(head)) {
    if (holds_head(bytes, end, offset + kHeadBytes)) record->damaged = POSE_WALL_BOX_OVERLAPPED;
    return end;
  }
  read_body(head, record);
  record->damaged = is_of_another_run(bytes, count, head) ? std::uint32_t{POSE_WALL_BOX_OTHER_RUN}
                                                          : std::uint32_t{POSE_WALL_BOX_WHOLE};
  return end;
}

pose_wall_cloud cloud_of(const pose_wall_box_record& record) {
  pose_wall_cloud cloud = cloud_in_a_row(record.points, record.point_count, record.point_bytes, record.stamp_ns);
  cloud.big_endian = record.big_endian;
  pose_wall_box_record copy = record;
  for (std::uint32_t k = 0; k < kFields; ++k) *fields_of(&cloud)[k] = *fields_of(&copy)[k];
  return cloud;
}

// Of any format.
bool is_header(const unsigned char* header, std::uint64_t count) {
  return count >= kHeaderBytes && std::memcmp(header, kBoxMagic, 8) == 0 &&
         get<std::uint32_t>(header + kAtHeaderCrc) == crc32(header, kAtHeaderCrc);
}

std::int32_t check_header(const unsigned char* header, std::uint64_t count) {
  if (!is_header(header, count)) return POSE_WALL_BOX_E_FORMAT;
  bool same = true;
  for (const HeaderWord& one : header_words()) same = same && get<std::uint32_t>(header + one.at) == one.word;
  return ok_if(same, POSE_WALL_BOX_E_VERSION);
}

void copy_version(const unsigned char* header, char (&version)[kLibraryBytes]) {
  std::memcpy(version, header + kAtLibrary, kLibraryBytes);
  version[kLibraryBytes - 1] = '\0';
}

// The record's stamps are of the memento's clock.
constexpr pose_wall_moment kSameClock = {sizeof(pose_wall_moment), POSE_WALL_MOMENT_SAME_CLOCK, {}, 0, 0};

}  // namespace

extern "C" {

#undef pose_wall_box_open
POSE_WALL_EXPORT int32_t pose_wall_box_open(const void* /*bytes*/, uint64_t /*count*/, pose_wall_box_info* /*info*/) {
  return POSE_WALL_E_ABI;
}

POSE_WALL_EXPORT int32_t pose_wall_box_open_2(const void* /*bytes*/, uint64_t /*count*/, pose_wall_box_info* /*info*/) {
  return POSE_WALL_E_ABI;
}

POSE_WALL_EXPORT int32_t pose_wall_box_open_3(const void* bytes, uint64_t count, pose_wall_box_info* info) {
  if (bytes == nullptr || info == nullptr) return POSE_WALL_E_NULL;
  const unsigned char* const header = static_cast<const unsigned char*>(bytes);
  const int32_t status = check_header(header, count);
  if (status != POSE_WALL_OK) return status;
  std::memcpy(&info->config, header + kAtConfig, sizeof(info->config));
  copy_version(header, info->version);
  info->box_bytes = get<uint64_t>(header + kAtBoxBytes);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_box_written_by(const void* bytes, uint64_t count, uint32_t* format,
                                                  char version[24]) {
  if (bytes == nullptr || format == nullptr || version == nullptr) return POSE_WALL_E_NULL;
  const unsigned char* const header = static_cast<const unsigned char*>(bytes);
  if (!is_header(header, count)) return POSE_WALL_BOX_E_FORMAT;
  *format = get<uint32_t>(header + kAtVersion);
  char text[kLibraryBytes];
  copy_version(header, text);
  std::memcpy(version, text, sizeof(text));
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_box_next(const void* bytes, uint64_t count, uint64_t* offset,
                                            pose_wall_box_record* record) {
  if (bytes == nullptr || offset == nullptr || record == nullptr) return POSE_WALL_E_NULL;
  const unsigned char* const start = static_cast<const unsigned char*>(bytes);
  *record = pose_wall_box_record{};
  const uint64_t from = *offset;
  // An offset near 2^64 must not come round.
  const uint64_t at = find_head(start, count, from < count ? aligned(from) : count);
  const bool found = at < count && count - at >= kHeadBytes;
  const uint64_t end = found ? at : count;
  record->passed_over = end > from ? end - from : 0;
  *offset = found ? read_record(start, count, at, record) : end;
  return ok_if(found, POSE_WALL_BOX_E_END);
}

POSE_WALL_EXPORT int32_t pose_wall_box_compute(const pose_wall_box_record* record, pose_wall_engine* engine,
                                               pose_wall_result* result) {
  if (record == nullptr || engine == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  if (record->damaged == POSE_WALL_BOX_OTHER_RUN) return POSE_WALL_BOX_E_RUN;
  const bool silence = record->kind == POSE_WALL_BOX_SILENCE;
  if (!silence && record->kind != POSE_WALL_BOX_FRAME) return POSE_WALL_BOX_E_KIND;
  if (record->memento == nullptr || (record->points == nullptr && !silence)) return POSE_WALL_BOX_E_EMPTY;
  int32_t status = pose_wall_load(engine, &kSameClock, record->memento, pose_wall_memento_bytes());
  if (status != POSE_WALL_OK) return status;
  if (silence) return pose_wall_age(engine, record->stamp_ns, result);
  pose_wall_cloud cloud = cloud_of(*record);
  pose_wall_inputs inputs;
  if (record->inputs != nullptr) {
    std::memcpy(&inputs, record->inputs, sizeof(inputs));
    cloud.inputs = &inputs;
  }
  status = pose_wall_process(engine, &cloud, result);
  if (status == POSE_WALL_OK) {
    finish_result(record->left_out_not_finite, record->left_out_zero, record->thinning, result);
  }
  return status;
}

}  // extern "C"

}  // namespace pose_wall::runtime
