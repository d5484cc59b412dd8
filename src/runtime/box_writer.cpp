// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "box_writer.hpp"

#include <cstddef>
#include <cstring>
#include <initializer_list>

#include "base/math/crc32.hpp"
#include "base/math/fnv1a.hpp"
#include "box_layout.hpp"

namespace pose_wall::runtime {
namespace {

constexpr unsigned char kZeros[kBoxAlignment] = {};  // fills up to the next step

std::uint64_t head_and_body_bytes() {
  return kHeadBytes + body_without_cloud();
}

}  // namespace

std::uint64_t BoxWriter::scratch_bytes() {
  const std::uint64_t record = head_and_body_bytes();
  return record > kHeaderBytes ? record : kHeaderBytes;
}

std::uint64_t BoxWriter::box_bytes_min(std::uint64_t cloud_bytes_max) {
  return kHeaderBytes + head_and_body_bytes() + aligned(cloud_bytes_max);
}

void BoxWriter::open(const pose_wall_runtime_options& options, unsigned char* scratch) {
  sink_ = options.sink;
  sink_user_ = options.sink_user;
  box_bytes_ = options.box_bytes & ~(kBoxAlignment - 1);
  with_clouds_ = options.box_clouds != 0;
  scratch_ = scratch;
}

bool BoxWriter::sink(std::uint64_t offset, const void* bytes, std::uint64_t count) {
  if (count == 0) return true;
  if (sink_(sink_user_, offset, bytes, count) != 0) return false;
  bytes_written_ += count;
  return true;
}

bool BoxWriter::begin(const pose_wall_config& config, std::uint16_t run) {
  unsigned char* const header = scratch_;
  std::memset(header, 0, kHeaderBytes);
  std::memcpy(header, kBoxMagic, 8);
  for (const HeaderWord& one : header_words()) put<std::uint32_t>(one.word, header + one.at);
  put<std::uint64_t>(box_bytes_, header + kAtBoxBytes);
  const char* const version = pose_wall_version();
  for (std::uint32_t i = 0; i + 1 < kLibraryBytes && version[i] != '\0'; ++i) {
    header[kAtLibrary + i] = static_cast<unsigned char>(version[i]);
  }
  std::memcpy(header + kAtConfig, &config, sizeof(config));
  pose_wall_config_crc(&config, &config_crc32_);
  run_ = run;
  lap_ = 0;
  put<std::uint32_t>(run_, header + kAtHeaderRun);
  put<std::uint32_t>(config_crc32_, header + kAtHeaderConfigCrc);
  put<std::uint32_t>(crc32(header, kAtHeaderCrc), header + kAtHeaderCrc);
  at_ = kHeaderBytes;
  begun_ = sink(0, header, kHeaderBytes);
  return begun_;
}

void BoxWriter::fill_body(const FrameSlot& slot, unsigned char* body) const {
  std::memset(body, 0, static_cast<std::size_t>(body_without_cloud()));
  const pose_wall_cloud& c = slot.cloud;
  put<std::uint64_t>(fnv1a(c.data, c.data_bytes), body + kAtDigest);
  put<std::uint32_t>(c.width, body + kAtPoints);
  put<std::uint32_t>(c.point_step, body + kAtPointBytes);
  put<std::uint32_t>(c.big_endian, body + kAtBigEndian);
  put<std::uint32_t>(slot.left_out_not_finite, body + kAtNotFinite);
  put<std::uint32_t>(slot.left_out_zero, body + kAtZero);
  put<std::uint32_t>(config_crc32_, body + kAtConfigCrc);
  unsigned char* to = body + kAtFields;
  for (const pose_wall_field& field : {c.x, c.y, c.z, c.intensity, c.time, c.ring}) {
    put<std::uint32_t>(field.offset, to);
    put<std::uint32_t>(field.type, to + 4);
    to += 8;
  }
  if (c.inputs != nullptr) std::memcpy(body + kAtInputs, c.inputs, sizeof(pose_wall_inputs));
  std::memcpy(body + kAtMemento, slot.memento, static_cast<std::size_t>(pose_wall_memento_bytes()));
  const pose_wall_publication& p = slot.publication;
  std::memcpy(body + at_result(), &p.result, sizeof(pose_wall_result));
  if (p.has_motion != 0) std::memcpy(body + at_motion(), &p.motion, sizeof(pose_wall_motion_result));
}

void BoxWriter::fill_head(const FrameSlot& slot, std::uint64_t record_bytes, std::uint64_t cloud_bytes,
                          std::uint32_t body_crc, unsigned char* head) const {
  put<std::uint32_t>(kRecordSync, head + kAtSync);
  put<std::uint32_t>(slot.kind, head + kAtKind);
  put<std::uint64_t>(record_bytes, head + kAtRecordBytes);
  put<std::uint64_t>(slot.sequence, head + kAtSequence);
  put<std::int64_t>(slot.publication.received_ns, head + kAtReceived);
  put<std::int64_t>(slot.publication.result.stamp_ns, head + kAtStamp);
  put<std::uint64_t>(cloud_bytes, head + kAtCloudBytes);
  put<std::uint32_t>(slot.publication.thinning, head + kAtThinning);
  put<std::uint32_t>(body_crc, head + kAtBodyCrc);
  put<std::uint16_t>(run_, head + kAtRun);
  put<std::uint16_t>(lap_, head + kAtLap);
  put<std::uint32_t>(crc32(head, kAtHeadCrc), head + kAtHeadCrc);
}

bool BoxWriter::write(const FrameSlot& slot) {
  if (!begun_) return false;
  unsigned char* const head = scratch_;
  unsigned char* const body = scratch_ + kHeadBytes;
  const std::uint64_t body_bytes = body_without_cloud();
  const std::uint64_t cloud_bytes = with_clouds_ ? slot.cloud.data_bytes : 0;
  const std::uint64_t padding = aligned(cloud_bytes) - cloud_bytes;
  const std::uint64_t record_bytes = kHeadBytes + body_bytes + cloud_bytes + padding;
  if (at_ + record_bytes > box_bytes_) {
    at_ = kHeaderBytes;
    lap_ = static_cast<std::uint16_t>(lap_ == 0xFFFFU ? 1U : lap_ + 1U);  // 0: the ring never came round
  }
  fill_body(slot, body);
  BulkCrc32 crc;
  crc.add(body, body_bytes);
  crc.add(slot.cloud.data, cloud_bytes);
  crc.add(kZeros, padding);
  fill_head(slot, record_bytes, cloud_bytes, crc.value(), head);
  const std::uint64_t at_body = at_ + kHeadBytes, at_cloud = at_body + body_bytes;
  // Writes the head last, so that a record cut off before has none.
  const bool written = sink(at_body, body, body_bytes) && sink(at_cloud, slot.cloud.data, cloud_bytes) &&
                       sink(at_cloud + cloud_bytes, kZeros, padding) && sink(at_, head, kHeadBytes);
  if (written) at_ += record_bytes;
  return written;
}

}  // namespace pose_wall::runtime
