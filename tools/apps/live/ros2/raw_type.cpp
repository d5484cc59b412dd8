// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros2/raw_type.hpp"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

namespace pose_wall::tools::live {
namespace {

// No key: all samples of a topic are of one instance.
struct RawSample : ddsi_serdata {
  RawSample(const ddsi_sertype* of_type, ddsi_serdata_kind of_kind, std::size_t size_bytes)
      : ddsi_serdata{}, size(size_bytes), bytes(new unsigned char[padded(size_bytes)]) {
    ddsi_serdata_init(this, of_type, of_kind);
    std::fill(bytes.get() + size, bytes.get() + padded(size), static_cast<unsigned char>(0));
  }

  // Cyclone may read up to the next multiple of four.
  static std::size_t padded(std::size_t size_bytes) { return (size_bytes + 3) / 4 * 4; }

  std::size_t size;
  std::unique_ptr<unsigned char[]> bytes;  // not a vector: clouds of megabytes are not filled with zeros first
};

const RawSample* raw(const ddsi_serdata* sample) {
  return static_cast<const RawSample*>(sample);
}

// Cyclone is C: what is thrown must not reach it.
RawSample* new_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size) {
  try {
    return new RawSample(type, kind, size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

bool is_same_key(const ddsi_serdata* /*a*/, const ddsi_serdata* /*b*/) {
  return true;
}

std::uint32_t size_of(const ddsi_serdata* sample) {
  return static_cast<std::uint32_t>(raw(sample)->size);
}

// Fragments come in order and may overlap; a gap or one beyond the end is no message.
ddsi_serdata* from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                             std::size_t size) {
  RawSample* sample = new_sample(type, kind, size);
  if (sample == nullptr) return nullptr;
  std::size_t known = 0;
  for (; fragment != nullptr; fragment = fragment->nextfrag) {
    const std::size_t begin = fragment->min, end = fragment->maxp1;
    if (begin > known || end > size) break;
    if (end <= known) continue;
    const unsigned char* payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    std::memcpy(sample->bytes.get() + known, payload + (known - begin), end - known);
    known = end;
  }
  if (known == size) return sample;
  delete sample;
  return nullptr;
}

ddsi_serdata* from_pieces(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                          const ddsrt_iovec_t* pieces, std::size_t size) {
  RawSample* sample = new_sample(type, kind, size);
  if (sample == nullptr) return nullptr;
  std::size_t known = 0;
  for (ddsrt_msg_iovlen_t i = 0; i < count && known < size; ++i) {
    const std::size_t bytes = std::min<std::size_t>(pieces[i].iov_len, size - known);
    std::memcpy(sample->bytes.get() + known, pieces[i].iov_base, bytes);
    known += bytes;
  }
  return sample;
}

ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash* /*hash*/) {
  return new_sample(type, SDK_KEY, 0);
}

// Of samples of an application there are none but those that end an instance.
ddsi_serdata* from_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* /*sample*/) {
  return kind == SDK_DATA ? nullptr : new_sample(type, kind, 0);
}

void copy_out(const ddsi_serdata* sample, std::size_t offset, std::size_t size, void* to) {
  std::memcpy(to, raw(sample)->bytes.get() + offset, size);
}

ddsi_serdata* lend(const ddsi_serdata* sample, std::size_t offset, std::size_t size, ddsrt_iovec_t* piece) {
  piece->iov_base = raw(sample)->bytes.get() + offset;
  piece->iov_len = size;
  return ddsi_serdata_ref(sample);
}

void give_back(ddsi_serdata* sample, const ddsrt_iovec_t* /*piece*/) {
  ddsi_serdata_unref(sample);
}

bool to_sample(const ddsi_serdata* /*from*/, void* /*sample*/, void** /*buffer*/, void* /*limit*/) {
  return false;
}

ddsi_serdata* to_untyped(const ddsi_serdata* sample) {
  RawSample* untyped = new_sample(sample->type, SDK_KEY, 0);
  if (untyped != nullptr) untyped->type = nullptr;
  return untyped;
}

bool untyped_to_sample(const ddsi_sertype* /*type*/, const ddsi_serdata* /*from*/, void* /*sample*/, void** /*buffer*/,
                       void* /*limit*/) {
  return true;
}

void free_sample(ddsi_serdata* sample) {
  delete static_cast<RawSample*>(sample);
}

std::size_t print(const ddsi_sertype* /*type*/, const ddsi_serdata* sample, char* text, std::size_t size) {
  return static_cast<std::size_t>(std::snprintf(text, size, "%zu bytes", raw(sample)->size));
}

void get_keyhash(const ddsi_serdata* /*sample*/, ddsi_keyhash* hash, bool /*force_md5*/) {
  std::memset(hash, 0, sizeof *hash);
}

ddsi_serdata_ops make_sample_operations() {
  ddsi_serdata_ops operations{};
  operations.eqkey = is_same_key;
  operations.get_size = size_of;
  operations.from_ser = from_fragments;
  operations.from_ser_iov = from_pieces;
  operations.from_keyhash = from_keyhash;
  operations.from_sample = from_sample;
  operations.to_ser = copy_out;
  operations.to_ser_ref = lend;
  operations.to_ser_unref = give_back;
  operations.to_sample = to_sample;
  operations.to_untyped = to_untyped;
  operations.untyped_to_sample = untyped_to_sample;
  operations.free = free_sample;
  operations.print = print;
  operations.get_keyhash = get_keyhash;
  return operations;
}

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}

void zero_samples(const ddsi_sertype* /*type*/, void* /*samples*/, std::size_t /*count*/) {}

void realloc_samples(void** samples, const ddsi_sertype* /*type*/, void* /*old*/, std::size_t /*old_count*/,
                     std::size_t count) {
  std::fill_n(samples, count, nullptr);
}

void free_samples(const ddsi_sertype* /*type*/, void** /*samples*/, std::size_t /*count*/, dds_free_op_t /*how*/) {}

bool is_equal(const ddsi_sertype* /*a*/, const ddsi_sertype* /*b*/) {
  return true;
}

std::uint32_t hash_of(const ddsi_sertype* /*type*/) {
  return 0;
}

// Without type_id, type_map and type_info nothing of XTypes is told to others, as ROS does.
ddsi_sertype_ops make_type_operations() {
  ddsi_sertype_ops operations{};
  operations.version = ddsi_sertype_v0;
  operations.free = free_type;
  operations.zero_samples = zero_samples;
  operations.realloc_samples = realloc_samples;
  operations.free_samples = free_samples;
  operations.equal = is_equal;
  operations.hash = hash_of;
  return operations;
}

}  // namespace

ddsi_sertype* new_raw_type(const std::string& type_name) {
  static const ddsi_sertype_ops type_operations = make_type_operations();
  static const ddsi_serdata_ops sample_operations = make_sample_operations();
  auto type = std::make_unique<ddsi_sertype>();
  ddsi_sertype_init_flags(type.get(), type_name.c_str(), &type_operations, &sample_operations,
                          DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type.release();
}

ddsi_serdata* new_raw_sample(const ddsi_sertype* type, const std::string& bytes) {
  ddsrt_iovec_t piece{};
  piece.iov_base = const_cast<char*>(bytes.data());
  piece.iov_len = bytes.size();
  return from_pieces(type, SDK_DATA, 1, &piece, bytes.size());
}

ByteView raw_bytes(const ddsi_serdata* sample) {
  if (sample->kind != SDK_DATA) return {};
  return {reinterpret_cast<const std::byte*>(raw(sample)->bytes.get()), raw(sample)->size};
}

}  // namespace pose_wall::tools::live
