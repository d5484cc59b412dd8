// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine_memento.hpp"

#include <cstring>

namespace pose_wall {
namespace {

// To be changed with what visit() walks over.
constexpr std::uint64_t kVersion = 0x706F73652D6D0003ULL;
constexpr std::uint64_t kHeadWords = 2;  // version, checksum

// Every member is one word of eight bytes, least significant first.
void put_word(std::uint64_t word, unsigned char* to) {
  for (int i = 0; i < 8; ++i) to[i] = static_cast<unsigned char>(word >> (8 * i));
}

std::uint64_t word_at(const unsigned char* from) {
  std::uint64_t word = 0;
  for (int i = 0; i < 8; ++i) word |= static_cast<std::uint64_t>(from[i]) << (8 * i);
  return word;
}

class Counter {
 public:
  void word(std::uint64_t* /*word*/) { ++words_; }
  void failed() {}
  std::uint64_t words() const { return words_; }

 private:
  std::uint64_t words_ = 0;
};

class Writer {
 public:
  explicit Writer(unsigned char* to) : to_(to) {}
  void word(const std::uint64_t* word) {
    put_word(*word, to_);
    to_ += 8;
  }
  void failed() {}

 private:
  unsigned char* to_;
};

class Reader {
 public:
  explicit Reader(const unsigned char* from) : from_(from) {}
  void word(std::uint64_t* word) {
    *word = word_at(from_);
    from_ += 8;
  }
  void failed() { good_ = false; }
  bool good() const { return good_; }

 private:
  const unsigned char* from_;
  bool good_ = true;
};

template <typename Way>
void visit(Way* way, double* number) {
  std::uint64_t word;
  std::memcpy(&word, number, sizeof(word));
  way->word(&word);
  std::memcpy(number, &word, sizeof(word));
}
template <typename Way>
void visit(Way* way, std::uint64_t* count) {
  way->word(count);
}
template <typename Way>
void visit(Way* way, std::int64_t* stamp) {
  std::uint64_t word = static_cast<std::uint64_t>(*stamp);
  way->word(&word);
  *stamp = static_cast<std::int64_t>(word);
}
template <typename Way>
void visit(Way* way, std::uint32_t* count) {
  std::uint64_t word = *count;
  way->word(&word);
  if (word > 0xFFFFFFFFU) way->failed();
  *count = static_cast<std::uint32_t>(word);
}
// A bool that holds anything but 0 and 1 is no bool.
template <typename Way>
void visit(Way* way, bool* flag) {
  std::uint64_t word = *flag ? 1 : 0;
  way->word(&word);
  if (word > 1) way->failed();
  *flag = word == 1;
}

template <typename Way, typename First, typename... Rest>
void visit_all(Way* way, First* first, Rest*... rest) {
  visit(way, first);
  if constexpr (sizeof...(rest) > 0) visit_all(way, rest...);
}

template <typename Way>
void visit(Way* way, Plane* plane) {
  visit_all(way, &plane->n.x(), &plane->n.y(), &plane->n.z(), &plane->d);
}

template <typename Way>
void visit(Way* way, Track* t) {
  visit_all(way, &t->has_value, &t->value, &t->raw, &t->raw_protection, &t->sigma, &t->protection, &t->age_s,
            &t->expired, &t->to_confirm, &t->doubted_frames);
  LastGood& good = t->good;
  visit_all(way, &good.exists, &good.raw, &good.raw_protection, &good.value, &good.value_protection, &good.age_s);
}

// The one walk over the memory, whichever way.
template <typename Way>
void visit(Way* way, Memory* m) {
  for (Track& track : m->temporal.track) visit(way, &track);
  TemporalState& t = m->temporal;
  visit_all(way, &t.has_stamp, &t.still_frames, &t.stamp_ns, &t.last_dt_s, &t.dt_before_s);
  visit(way, &m->last.floor_base);
  for (Plane& wall : m->last.wall_level) visit(way, &wall);
  visit_all(way, &m->last.has_floor, &m->last.has_wall[0], &m->last.has_wall[1], &m->leaf.begin_with, &m->leaf.voxels,
            &m->repeats, &m->frames);
  for (SeenCloud& cloud : m->seen.cloud) visit_all(way, &cloud.fingerprint, &cloud.stamp_ns);
}

// FNV-1a: for accidents, not for attackers. Begun with the config's, so that what was measured by another config, with
// its axes and extrinsic, is never held by this one.
std::uint64_t checksum(std::uint32_t config_crc32, const unsigned char* bytes, std::uint64_t count) {
  std::uint64_t sum = 0xCBF29CE484222325ULL ^ config_crc32;
  for (std::uint64_t i = 0; i < count; ++i) sum = (sum ^ bytes[i]) * 0x100000001B3ULL;
  return sum;
}

std::uint64_t body_bytes() {
  Memory any;
  Counter counter;
  visit(&counter, &any);
  return 8 * counter.words();
}

}  // namespace

std::uint64_t memento_bytes() {
  return 8 * kHeadWords + body_bytes();
}

void save_memory(const Memory& memory, std::uint32_t config_crc32, void* to) {
  unsigned char* const bytes = static_cast<unsigned char*>(to);
  Memory copy = memory;
  Writer writer(bytes + 8 * kHeadWords);
  visit(&writer, &copy);
  put_word(kVersion, bytes);
  put_word(checksum(config_crc32, bytes + 8 * kHeadWords, body_bytes()), bytes + 8);
}

bool load_memory(const void* from, std::uint32_t config_crc32, Memory* memory) {
  const unsigned char* const bytes = static_cast<const unsigned char*>(from);
  if (word_at(bytes) != kVersion) return false;
  if (word_at(bytes + 8) != checksum(config_crc32, bytes + 8 * kHeadWords, body_bytes())) return false;
  Memory read;
  Reader reader(bytes + 8 * kHeadWords);
  visit(&reader, &read);
  if (!reader.good()) return false;
  Reader again(bytes + 8 * kHeadWords);  // a copy would bring padding along that nobody wrote
  visit(&again, memory);
  return true;
}

}  // namespace pose_wall
