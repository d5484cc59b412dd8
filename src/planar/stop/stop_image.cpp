// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/stop_image.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>

#include "base/math/finite.hpp"
#include "part/image_words.hpp"

namespace pose_wall::planar {
namespace {

static_assert(sizeof(pose_wall_planar_stop_image) == POSE_WALL_PLANAR_STOP_IMAGE_BYTES &&
                  POSE_WALL_PLANAR_STOP_IMAGE_BYTES % 4 == 0,
              "image.def and the compiler disagree");

constexpr double kNanosecondsPerMillisecond = 1e6;  // of stamps, by definition

void add_number(double number, Crc32* sum) {
  const double one_zero = number + 0.0;  // -0 and 0 are the same setting
  std::uint64_t bits;
  std::memcpy(&bits, &one_zero, sizeof(bits));
  sum->add_word(static_cast<std::uint32_t>(bits & 0xFFFFFFFFU));
  sum->add_word(static_cast<std::uint32_t>(bits >> 32U));
}

// Rounded down: a controller must not drive faster than the answer allows.
std::int32_t allowed_mm_s(const pose_wall_planar_stop_result& r) {
  const bool drives = r.state == POSE_WALL_PLANAR_STOP_SLOW || r.state == POSE_WALL_PLANAR_STOP_GO;
  if (!drives || !is_finite(r.allowed_speed_m_s) || !(r.allowed_speed_m_s > 0.0)) return 0;
  return static_cast<std::int32_t>(std::floor(within(r.allowed_speed_m_s * kMillimetresPerMetre, kIntegerMax)));
}

// As the result has them: a frame of the future is as new as one can be.
std::uint32_t age_ms(const pose_wall_planar_stop_result& r) {
  if (r.frames == 0) return kMillisecondsNotKnown;
  const double age_ns = static_cast<double>(r.now_ns) - static_cast<double>(r.stamp_ns);
  return milliseconds_above(age_ns > 0.0 ? age_ns / kNanosecondsPerSecond : 0.0);
}

}  // namespace

std::uint32_t settings_crc(const pose_wall_config& config, const pose_wall_planar_stop_settings& settings) {
  std::uint32_t config_crc = 0;
  static_cast<void>(pose_wall_config_crc(&config, &config_crc));
  Crc32 sum;
  sum.add_word(config_crc);
  sum.add_word(settings.struct_size);
  sum.add_word(settings.corners);
  for (std::uint32_t i = 0; i < POSE_WALL_PLANAR_STOP_CORNERS_MAX && i < settings.corners; ++i) {
    for (const double coordinate_m : settings.corner_m[i]) add_number(coordinate_m, &sum);
  }
  // From floor_z_m on there are numbers only.
  constexpr std::size_t kFirst = offsetof(pose_wall_planar_stop_settings, floor_z_m);
  static_assert((sizeof(settings) - kFirst) % sizeof(double) == 0);
  for (std::size_t at = kFirst; at < sizeof(settings); at += sizeof(double)) {
    double number;
    std::memcpy(&number, reinterpret_cast<const unsigned char*>(&settings) + at, sizeof(number));
    add_number(number, &sum);
  }
  return sum.value();
}

void fill_image(const pose_wall_planar_stop_result& result, pose_wall_planar_stop_image* image) {
  image->version = POSE_WALL_PLANAR_STOP_IMAGE_VERSION;
  image->heartbeat = result.heartbeat;
  image->settings_crc32 = result.settings_crc32;
  put_version_and_stamp(result.stamp_ns, image);
  image->allowed_speed_mm_s = allowed_mm_s(result);
  image->state = image->allowed_speed_mm_s > 0 ? result.state : static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP);
  image->reasons = result.reasons;
  image->age_ms = age_ms(result);
  // Rounded down also below zero, so that differences of clocks that begin there are right.
  const double now_ms = std::floor(static_cast<double>(result.now_ns) / kNanosecondsPerMillisecond);
  image->answered_ms = static_cast<std::uint32_t>(static_cast<std::int64_t>(now_ms));
  image->crc32c = image_crc(*image, &pose_wall_planar_stop_image::crc32c, kCrcCastagnoli);
}

}  // namespace pose_wall::planar
