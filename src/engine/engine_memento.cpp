// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/engine_memento.hpp"

#include <cstring>
#include <type_traits>

#include "base/math/elementary.hpp"
#include "base/math/fnv1a.hpp"
#include "part/saved_bytes.hpp"

namespace pose_wall {
namespace {

// Definition: 'pose-m' in ASCII and a count. Raise it with each change of visit().
constexpr std::uint64_t kVersion = 0x706F73652D6D000BULL;
constexpr std::uint64_t kHeadWords = 2;  // version and checksum stand first

// A member is a word of eight bytes; small numbers and rounded ones share a word.
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
  void word(const std::uint64_t* word) { to_.put(*word); }
  void failed() {}

 private:
  SavedWriter to_;
};

class Reader {
 public:
  explicit Reader(const unsigned char* from) : from_(from) {}
  void word(std::uint64_t* word) { *word = from_.get<std::uint64_t>(); }
  void failed() { good_ = false; }
  bool good() const { return good_; }

 private:
  SavedReader from_;
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
// An index that is used as one.
template <typename Way>
void visit_below(Way* way, std::uint32_t bound, std::uint32_t* index) {
  visit(way, index);
  if (*index >= bound) way->failed();
}
// Two in a word.
template <typename Way>
void visit_pair(Way* way, std::uint32_t* low, std::uint32_t* high) {
  std::uint64_t word = static_cast<std::uint64_t>(*high) << 32 | *low;
  way->word(&word);
  *low = static_cast<std::uint32_t>(word);
  *high = static_cast<std::uint32_t>(word >> 32);
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
void visit(Way* way, ProtectionParts* protection) {
  for (double& part : protection->of) visit(way, &part);
}

template <typename Way>
void visit(Way* way, Unknown* u) {
  visit_all(way, &u->sum, &u->drift2, &u->place_level_then, &u->place_level, &u->steps_by_places, &u->blind_s);
}

template <typename Way>
void visit(Way* way, Eigen::Vector3d* v) {
  visit_all(way, &v->x(), &v->y(), &v->z());
}

// Two of less digits in a word: what round_off() leaves.
template <typename Way>
void visit_floats(Way* way, double* low, double* high) {
  const float halves[2] = {static_cast<float>(*low), static_cast<float>(*high)};
  std::uint32_t bits[2];
  std::memcpy(bits, halves, sizeof(bits));
  visit_pair(way, &bits[0], &bits[1]);
  float read[2];
  std::memcpy(read, bits, sizeof(read));
  *low = static_cast<double>(read[0]);
  *high = static_cast<double>(read[1]);
}

// Small numbers in a word, each of so many bits.
template <typename Way, typename... Numbers>
void visit_bits(Way* way, Numbers... numbers) {
  std::uint64_t word = 0;
  std::uint32_t at = 0;
  const auto pack = [&](auto number) {
    word |= static_cast<std::uint64_t>(*number.of) << at;
    at += number.bits;
  };
  (pack(numbers), ...);
  way->word(&word);
  const auto unpack = [&](auto number) {
    using Of = std::remove_pointer_t<decltype(number.of)>;
    *number.of = static_cast<Of>(word & ((std::uint64_t{1} << number.bits) - 1));
    word >>= number.bits;
  };
  (unpack(numbers), ...);
  if (word != 0) way->failed();
}
template <typename Of>
struct Bits {
  Of* of;
  std::uint32_t bits;
};
inline Bits<bool> flag(bool* of) {
  return {of, 1};
}
// Up to 65535.
inline Bits<std::uint32_t> small(std::uint32_t* of) {
  return {of, 16};
}

template <typename Way>
void visit(Way* way, RoadMemory* r) {
  ProtectionParts& b = r->bound;
  visit_floats(way, &r->value, &r->variance);
  visit_floats(way, &r->way_sigma, &r->with_rock);
  visit_floats(way, &b[POSE_WALL_PART_RANGE_BIAS], &b[POSE_WALL_PART_BEND]);
  visit_floats(way, &b[POSE_WALL_PART_RIVAL], &b[POSE_WALL_PART_EXTRAPOLATION]);
  visit_floats(way, &b[POSE_WALL_PART_AGE], &r->last_share);
  visit_floats(way, &r->stretch, &r->noise);
  visit_floats(way, &r->weight, &r->weight_here);
  visit_floats(way, &r->looks_here, &r->usual_variance);
  visit_floats(way, &r->usual_dof, &r->looks);
}

template <typename Way>
void visit_rock(Way* way, SeenSurface* surface) {
  visit_all(way, &surface->rock_m, &surface->waves[0], &surface->waves[1]);
}

template <typename Way>
void visit_wall(Way* way, SeenSurface* wall) {
  visit_all(way, &wall->normal, &wall->along, &wall->from_m, &wall->to_m, &wall->slope_level);
  visit_rock(way, wall);
}

template <typename Way>
void visit(Way* way, OdometryMemory* m) {
  visit_all(way, &m->run, &m->position_m);
  for (int k = 0; k < 9; ++k) visit(way, m->R_run_base.data() + k);
  for (double& level : m->place_level) visit(way, &level);
  for (double& variance : m->drift_variance) visit(way, &variance);
  for (double& drift : m->drift) visit(way, &drift);
  visit_bits(way, flag(&m->floor.exists), flag(&m->wall[0].exists), flag(&m->wall[1].exists), flag(&m->has_up));
  visit_all(way, &m->up, &m->floor.normal, &m->floor.centre_m, &m->floor.radius_m, &m->floor.slope_level);
  visit_rock(way, &m->floor);
  visit_wall(way, &m->wall[0]);
  visit_wall(way, &m->wall[1]);
}

template <typename Way>
void visit(Way* way, OwnChanges* own) {
  for (double& raw : own->raw) visit(way, &raw);
  for (double& level : own->level) visit(way, &level);
  for (double& random : own->random) visit(way, &random);
  for (double& rate : own->taken_out) visit(way, &rate);
  for (double& change : own->change) visit(way, &change);
  visit_all(way, &own->scan_s, &own->up_base, &own->wall_base[0], &own->wall_base[1]);
}

template <typename Way>
void visit(Way* way, Track* t) {
  LastGood& good = t->good;
  RoadMemory& road = t->road;
  visit_bits(way, flag(&t->has_value), flag(&t->expired), flag(&good.exists), flag(&road.exists),
             small(&t->smoothed_frames), Bits<std::uint32_t>{&t->to_confirm, 8},
             Bits<std::uint32_t>{&t->doubted_frames, 8}, Bits<std::uint32_t>{&road.contradicted, 8},
             Bits<std::uint32_t>{&road.frames, 8});
  visit_all(way, &t->value, &t->rate, &t->raw, &t->raw_protection, &t->sigma, &t->protection, &t->grown, &t->age_s);
  visit_all(way, &good.raw, &good.raw_protection, &good.value, &good.protection, &good.grown, &good.age_s);
  visit(way, &road);
}

template <typename Way>
void visit(Way* way, RepeatGuard* f) {
  for (SeenCloud& cloud : f->clouds.cloud) visit_all(way, &cloud.print, &cloud.stamp_ns);
  for (auto& sector : f->sectors.print) {
    for (std::uint32_t k = 0; k < SeenSectors::kCount; k += 2) visit_pair(way, &sector[k], &sector[k + 1]);
  }
  for (std::int64_t& stamp_ns : f->sectors.stamp_ns) visit(way, &stamp_ns);
  visit_below(way, SeenSectors::kCount, &f->sectors.next);
}

// The moment of the save.
template <typename Way>
void visit(Way* way, pose_wall_moment* moment) {
  std::uint64_t halves[2];
  static_assert(sizeof(halves) == sizeof(moment->boot_id), "two words");
  std::memcpy(halves, moment->boot_id, sizeof(halves));
  visit_all(way, &moment->known, &halves[0], &halves[1], &moment->wall_ns, &moment->stamp_ns);
  std::memcpy(moment->boot_id, halves, sizeof(halves));
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
            &m->repeats, &m->frames, &m->publications);
  visit(way, &m->repeat_guard);
  visit(way, &m->odometry);
  visit(way, &m->own);
}

// FNV-1a: for accidents, not for attackers. Starts with the config's checksum, so that no config holds values that
// another one measured, with other axes and extrinsic.
std::uint64_t checksum(std::uint32_t config_crc32, const unsigned char* bytes, std::uint64_t count) {
  return fnv1a(bytes, count, kFnv1aOfNothing ^ config_crc32);
}

std::uint64_t body_bytes() {
  pose_wall_moment any_moment{};
  Memory any;
  Counter counter;
  visit(&counter, &any_moment);
  visit(&counter, &any);
  return 8 * counter.words();
}

}  // namespace

std::uint64_t memento_bytes() {
  return 8 * kHeadWords + body_bytes();
}

void save_memory(const Memory& memory, const pose_wall_moment& now, std::uint32_t config_crc32, void* to) {
  unsigned char* const bytes = static_cast<unsigned char*>(to);
  pose_wall_moment moment = now;
  Memory copy = memory;
  Writer writer(bytes + 8 * kHeadWords);
  visit(&writer, &moment);
  visit(&writer, &copy);
  SavedWriter head(bytes);
  head.put(kVersion);
  head.put(checksum(config_crc32, bytes + 8 * kHeadWords, body_bytes()));
}

bool load_memory(const void* from, std::uint32_t config_crc32, pose_wall_moment* then, Memory* memory) {
  const unsigned char* const bytes = static_cast<const unsigned char*>(from);
  SavedReader head(bytes);
  if (head.get<std::uint64_t>() != kVersion) return false;
  if (head.get<std::uint64_t>() != checksum(config_crc32, bytes + 8 * kHeadWords, body_bytes())) return false;
  Reader reader(bytes + 8 * kHeadWords);
  visit(&reader, then);
  visit(&reader, memory);
  return reader.good();
}

void take_up(const Memory& memory, const pose_wall_moment& then, const pose_wall_moment& now, Engine* engine) {
  const std::uint32_t both = then.known & now.known;
  const bool same_boot =
      (both & POSE_WALL_MOMENT_BOOT) != 0 && std::memcmp(then.boot_id, now.boot_id, sizeof(now.boot_id)) == 0;
  if (same_boot || (now.known & POSE_WALL_MOMENT_SAME_CLOCK) != 0) {
    engine->set_memory(memory);
    return;
  }
  // In floating point: the difference of two arbitrary stamps need not fit an int64.
  const double by_wall_s = (static_cast<double>(now.wall_ns) - static_cast<double>(then.wall_ns)) * kNanosecond_s;
  const double before_save_s =
      (static_cast<double>(then.stamp_ns) - static_cast<double>(memory.temporal.stamp_ns)) * kNanosecond_s;
  const bool went_back = now.wall_ns < then.wall_ns || then.stamp_ns < memory.temporal.stamp_ns;
  const bool dated = (both & POSE_WALL_MOMENT_WALL) != 0 && !went_back;
  engine->set_memory_of_other_clock(memory, dated ? by_wall_s + before_save_s : -1.0, now.stamp_ns);
}

}  // namespace pose_wall
