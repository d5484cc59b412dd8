// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/self_test.hpp"

#include <cstdint>
#include <cstring>

#include "base/math/fnv1a.hpp"
#include "engine/self_test_code.hpp"
#include "engine/self_test_road.hpp"

namespace pose_wall {
namespace {

constexpr std::int64_t kPeriod_ns = 100000000;  // a tenth of a second, as LiDARs turn

// The road; with steel sets; with an open side; without a floor. Each allows other values.
constexpr SelfTestScene kScenes[POSE_WALL_SELF_TEST_FRAMES] = {
    {true, true, true, false}, {true, true, true, true}, {true, false, true, false}, {false, true, true, false}};

// At the start of the block; the engine lies behind it.
struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Room {
  pose_wall_config config;
  pose_wall_result result;
  pose_wall_image image;
  float points_base_m[kSelfTestPointsMax][3];
};

static_assert(kSelfTestPointsMax == POSE_WALL_SELF_TEST_POINTS, "as the header says");

// As many points as let the block stay below 2.5 MiB.
std::int32_t configure(pose_wall_config* config) {
  const std::int32_t status = pose_wall_config_init(config);
  return status == POSE_WALL_OK ? pose_wall_config_set_number(config, "points_max", 15800.0) : status;
}

void add(const void* data, std::uint64_t bytes, std::uint64_t* digest) {
  *digest = fnv1a(data, bytes, *digest);
}

bool may_be_measured(std::uint32_t quantity, const SelfTestScene& scene) {
  const bool of_left = quantity == POSE_WALL_D_LF || quantity == POSE_WALL_D_LB;
  return scene.floor && (scene.left || !of_left);
}

// Valid and within its level, or not measured. So no wrong value passes, whatever digest was noted.
bool is_right(const pose_wall_value& v, std::uint32_t quantity, const SelfTestScene& scene) {
  if (!may_be_measured(quantity, scene)) return v.state == POSE_WALL_HELD || v.state == POSE_WALL_INVALID;
  const double error = v.value - kSelfTestTruth[quantity];
  const bool within = error <= v.protection_level && -error <= v.protection_level;
  // Between steel sets, and beside an open side, a wall may be known less well.
  const bool plain = scene.left && !scene.steel;
  return within && (v.state == POSE_WALL_VALID || (!plain && v.state == POSE_WALL_DEGRADED));
}

std::int32_t add_points(const pose_wall_engine* engine, std::uint64_t* digest) {
  pose_wall_points points;
  const std::int32_t status = pose_wall_last_points(engine, &points);
  if (status != POSE_WALL_OK) return status;
  add(points.x_base_m, std::uint64_t{points.count} * sizeof(float), digest);
  add(points.y_base_m, std::uint64_t{points.count} * sizeof(float), digest);
  add(points.z_base_m, std::uint64_t{points.count} * sizeof(float), digest);
  add(points.label, points.count, digest);
  return POSE_WALL_OK;
}

std::int32_t add_image(Room* room, std::uint64_t* digest) {
  room->image.struct_size = sizeof(room->image);
  std::int32_t status = pose_wall_image_fill(&room->result, &room->image);
  if (status == POSE_WALL_OK) status = pose_wall_image_check(&room->image);
  add(&room->image, sizeof(room->image), digest);
  return status;
}

std::int32_t run_frame(std::uint32_t frame, pose_wall_engine* engine, Room* room, pose_wall_self_test_report* report) {
  const SelfTestScene& scene = kScenes[frame];
  const std::uint32_t count = scan_self_test_road(scene, frame, room->points_base_m);
  pose_wall_cloud cloud;
  std::int32_t status = pose_wall_cloud_xyz32(&cloud, room->points_base_m, count, sizeof(room->points_base_m[0]),
                                              static_cast<std::int64_t>(frame) * kPeriod_ns);
  room->result.struct_size = sizeof(room->result);
  if (status == POSE_WALL_OK) status = pose_wall_process(engine, &cloud, &room->result);
  if (status != POSE_WALL_OK) return status;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    report->values_wrong += is_right(room->result.quantity[q], q, scene) ? 0U : 1U;
  }
  add(&room->result, sizeof(room->result), &report->digest_found);
  status = add_image(room, &report->digest_found);
  return status == POSE_WALL_OK ? add_points(engine, &report->digest_found) : status;
}

}  // namespace

std::uint64_t self_test_bytes() {
  pose_wall_config config;
  std::uint64_t engine_bytes = 0;
  std::int32_t status = configure(&config);
  if (status == POSE_WALL_OK) status = pose_wall_memory_needed(&config, &engine_bytes);
  return status == POSE_WALL_OK ? sizeof(Room) + engine_bytes : 0;
}

std::int32_t self_test(std::uint64_t digest_expected, void* block, pose_wall_self_test_report* report) {
  *report = pose_wall_self_test_report{};
  report->struct_size = sizeof(*report);
  report->digest_expected = digest_expected;
  report->digest_found = kFnv1aOfNothing;
  const CodeSum code = sum_of_code();
  report->code_bytes = code.bytes;
  report->code_crc32 = code.crc32;

  Room* const room = static_cast<Room*>(block);
  std::memset(static_cast<void*>(&room->image), 0, sizeof(room->image));
  pose_wall_engine* engine = nullptr;
  std::int32_t status = configure(&room->config);
  if (status == POSE_WALL_OK) {
    status = pose_wall_open(&room->config, static_cast<unsigned char*>(block) + sizeof(Room),
                            self_test_bytes() - sizeof(Room), &engine);
  }
  for (; status == POSE_WALL_OK && report->frames < POSE_WALL_SELF_TEST_FRAMES; ++report->frames) {
    status = run_frame(report->frames, engine, room, report);
  }
  report->refused = status;
  const bool passed =
      status == POSE_WALL_OK && report->values_wrong == 0 && report->digest_found == report->digest_expected;
  return passed ? POSE_WALL_OK : POSE_WALL_E_SELF_TEST;
}

}  // namespace pose_wall
