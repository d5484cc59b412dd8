// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: a saved trail, a saved map and a saved tile that nobody vouches for. The first byte says which, and
// whether its checksum is made right, so that what lies behind it is reached, too. What is refused changes nothing.
// What is taken can be saved again to the same bytes, and the next scans keep the contract.

#include "base/math/crc32.hpp"
#include "fuzz/fuzz_target.hpp"
#include "fuzz/scans_from_input.hpp"
#include "pose_wall_planar_map.h"
#include "pose_wall_planar_slam.h"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

constexpr std::uint64_t kRoom = 1U << 20U;  // more than 64 keyframes and 16 tiles take

std::uint32_t sum_of(const unsigned char* bytes, std::uint64_t count) {
  pose_wall::Crc32 crc;
  for (std::uint64_t k = 0; k < count; ++k) crc.add_byte(bytes[k]);
  return crc.value();
}

void put_u32(std::uint32_t number, unsigned char* to) {
  for (int k = 0; k < 4; ++k) to[k] = static_cast<unsigned char>(number >> (8 * k));
}

// A copy as long as the input, for AddressSanitizer.
class Bytes {
 public:
  explicit Bytes(Input* input)
      : count_(input->left()), data_(static_cast<unsigned char*>(std::malloc(count_ > 0 ? count_ : 1))) {
    require(data_ != nullptr, "memory");
    if (count_ > 0) std::memcpy(data_, input->rest(), count_);
  }
  ~Bytes() { std::free(data_); }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;
  unsigned char* data() const { return data_; }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_;
  unsigned char* data_;
};

// What a part is saved to.
struct Saved {
  const unsigned char* data;
  std::uint64_t count;
};

bool are_equal(const Saved& a, const Saved& b) {
  return a.count == b.count && std::memcmp(a.data, b.data, a.count) == 0;
}

void require_whole_or_not_at_all(const Bytes& given, std::int32_t status, const Saved& before, const Saved& after) {
  if (status == POSE_WALL_OK)
    return require(are_equal(after, {given.data(), given.count()}), "saved to the same bytes");
  require(are_equal(after, before), "a refusal changes nothing");
}

ScanOfInput* hall_seen(std::uint32_t step) {
  static ScanOfInput seen;
  Input none(nullptr, 0);
  begin_scan(&none, &seen);
  see_hall(Hall(), {0.2 * step, 0.0, 0.0}, &seen);
  seen.scan.stamp_ns = std::int64_t{step} * 100000000;
  return &seen;
}

// ---------------------------------------------------------------------------------------------- a trail

std::uint64_t save(const pose_wall_planar_slam* slam, unsigned char* to) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_slam_save(slam, to, kRoom, &bytes), "save");
  return bytes;
}

void drive_on(pose_wall_planar_slam* slam) {
  for (std::uint32_t step = 0; step < 4; ++step) {
    pose_wall_planar_slam_result result{};
    result.struct_size = sizeof result;
    require_ok(pose_wall_planar_slam_process(slam, &hall_seen(step)->scan, nullptr, &result), "process");
    require(is_result(result.pose) && is_finite(result.in_keyframe), "a pose that is a number");
  }
}

void load_trail(Bytes* saved, bool mended) {
  static KeptBlock block;
  static unsigned char before[kRoom], after[kRoom];
  pose_wall_planar_slam_settings settings;
  require_ok(pose_wall_planar_slam_settings_init(&settings), "settings");
  settings.keyframes_most = 64;
  std::uint64_t bytes = 0;
  pose_wall_planar_slam* slam = nullptr;
  require_ok(pose_wall_planar_slam_memory_needed(&settings, &bytes), "memory needed");
  require_ok(pose_wall_planar_slam_open(&settings, block.filled(bytes, 0xA5), bytes, &slam), "open");
  drive_on(slam);
  const std::uint64_t had = save(slam, before);
  if (mended && saved->count() >= 4) {
    const std::uint64_t at = saved->count() - 4;
    put_u32(sum_of(saved->data(), at), saved->data() + at);
  }
  const std::int32_t status = pose_wall_planar_slam_load(slam, saved->data(), saved->count(), nullptr);
  require(status == POSE_WALL_OK || status == POSE_WALL_PLANAR_E_MAP_FILE || status == POSE_WALL_E_BLOCK_SMALL,
          "a refusal that the header knows");
  const std::uint64_t has = save(slam, after);
  require_whole_or_not_at_all(*saved, status, {before, had}, {after, has});
  drive_on(slam);
}

// ---------------------------------------------------------------------------------------------- a map

std::uint64_t save(pose_wall_planar_map* map, unsigned char* to) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_map_save_all(map, to, kRoom, &bytes), "save");
  return bytes;
}

pose_wall_planar_map* open_map() {
  static KeptBlock block;
  pose_wall_planar_map_settings settings;
  require_ok(pose_wall_planar_map_settings_init(&settings), "settings");
  settings.tiles = 16;
  std::uint64_t bytes = 0;
  pose_wall_planar_map* map = nullptr;
  require_ok(pose_wall_planar_map_memory_needed(&settings, &bytes), "memory needed");
  require_ok(pose_wall_planar_map_open(&settings, block.filled(bytes, 0xA5), bytes, &map), "open");
  return map;
}

void insert_next(pose_wall_planar_map* map) {
  pose_wall_planar_map_report report{};
  report.struct_size = sizeof report;
  const pose_wall_planar_pose base{0.2, 0.0, 0.0};
  require_ok(pose_wall_planar_map_insert(map, &hall_seen(1)->scan, &base, &report), "insert");
  require(report.tiles <= 16, "no more tiles than there are");
}

void load_map(Bytes* saved, bool mended) {
  static unsigned char before[kRoom], after[kRoom];
  pose_wall_planar_map* const map = open_map();
  insert_next(map);
  const std::uint64_t had = save(map, before);
  if (mended && saved->count() >= 8) {
    const std::uint64_t at = saved->count() - 8;
    put_u32(sum_of(saved->data(), at), saved->data() + at);
  }
  const std::int32_t status = pose_wall_planar_map_load_all(map, saved->data(), saved->count());
  require(status == POSE_WALL_OK || status == POSE_WALL_PLANAR_E_MAP_FILE || status == POSE_WALL_E_BUFFER_SMALL,
          "a refusal that the header knows");
  const std::uint64_t has = save(map, after);
  require_whole_or_not_at_all(*saved, status, {before, had}, {after, has});
  insert_next(map);
}

// The input is the record behind its struct_size and sum; where it is short, the rest is 0.
void put_tile(const Bytes& saved, bool mended) {
  static unsigned char before[kRoom], after[kRoom];
  static pose_wall_planar_tile tile;
  std::memset(&tile, 0, sizeof tile);
  auto* const bytes = reinterpret_cast<unsigned char*>(&tile);
  constexpr std::size_t kHead = 8;
  const std::size_t room = sizeof tile - kHead;
  const std::size_t count = saved.count() < room ? saved.count() : room;
  std::memcpy(bytes + kHead, saved.data(), count);
  tile.struct_size = sizeof tile;
  if (mended) {
    tile.cell_m = 0.05;
    tile.crc32 = sum_of(bytes + kHead, room);  // on a host with low bytes first
  }
  pose_wall_planar_map* const map = open_map();
  insert_next(map);
  const std::uint64_t had = save(map, before);
  const std::int32_t status = pose_wall_planar_map_put_tile(map, &tile);
  if (status != POSE_WALL_OK) {
    require(status == POSE_WALL_PLANAR_E_MAP_FILE || status == POSE_WALL_E_BUFFER_SMALL,
            "a refusal that the header knows");
    const std::uint64_t has = save(map, after);
    require(are_equal({after, has}, {before, had}), "a refusal changes nothing");
  }
  insert_next(map);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const std::uint8_t what = input.byte();
  const bool mended = (what & 4U) != 0;
  Bytes saved(&input);
  switch (what % 4U) {
    case 0:
    case 3:
      load_trail(&saved, mended);
      break;
    case 1:
      load_map(&saved, mended);
      break;
    default:
      put_tile(saved, mended);
  }
  return 0;
}
