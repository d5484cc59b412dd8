// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/image.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>

#include "base/math/finite.hpp"
#include "part/image_words.hpp"

namespace pose_wall {
namespace {

// The floats of "no value" and "no bound", -2^31 and 2^31. Floats that are known stay within +-kFloatMax:
constexpr float kNoValue = -2147483648.0F;
constexpr float kNoBound = 2147483648.0F;
constexpr double kFloatMax = 2147483520.0;  // the last float before 2^31

static_assert(sizeof(pose_wall_image) == POSE_WALL_IMAGE_BYTES && POSE_WALL_IMAGE_BYTES % 4 == 0 &&
                  sizeof(pose_wall_image2) == POSE_WALL_IMAGE2_BYTES && POSE_WALL_IMAGE2_BYTES % 4 == 0 &&
                  offsetof(pose_wall_image2, crc32c) == offsetof(pose_wall_image, crc32),
              "image.def and the compiler disagree");

float float_above(double value) {
  float f = static_cast<float>(within(value, kFloatMax));
  if (static_cast<double>(f) < value && value <= kFloatMax) {
    std::uint32_t bits;
    std::memcpy(&bits, &f, sizeof(bits));
    ++bits;  // the next float of a positive one
    std::memcpy(&f, &bits, sizeof(f));
  }
  return f;
}

// The common members of angles and distances.
struct Entry {
  std::int32_t value_scaled = POSE_WALL_IMAGE_NO_VALUE;
  std::int32_t protection_scaled = POSE_WALL_IMAGE_NO_BOUND;
  float value = kNoValue;
  float protection = kNoBound;
  std::uint32_t age_ms = kMillisecondsNotKnown;
  std::uint32_t state = POSE_WALL_INVALID;
  std::uint32_t reasons = 0;
};
static_assert(sizeof(Entry) == sizeof(pose_wall_image_angle) && sizeof(Entry) == sizeof(pose_wall_image_distance) &&
                  offsetof(pose_wall_image, d_rb) - offsetof(pose_wall_image, roll) == POSE_WALL_D_RB * sizeof(Entry) &&
                  offsetof(Entry, age_ms) == offsetof(pose_wall_image_angle, age_ms) &&
                  offsetof(Entry, age_ms) == offsetof(pose_wall_image_distance, age_ms),
              "the seven lie one behind the other");

// An unknown state counts as invalid.
std::uint32_t known_state(std::uint32_t state) {
  return state <= POSE_WALL_VALID ? state : static_cast<std::uint32_t>(POSE_WALL_INVALID);
}

// A bound beyond the type's range is none.
Entry entry_of(const pose_wall_value& v, double scale) {
  Entry n;
  n.state = known_state(v.state);
  n.reasons = v.reasons;
  if (!is_finite(v.value)) return n;
  n.value_scaled = nearest_integer(v.value * scale);
  n.value = static_cast<float>(within(v.value, kFloatMax));
  n.age_ms = milliseconds_above(v.age_s);
  // The level of an invalid value may come from a clock that jumped.
  if (v.state == POSE_WALL_INVALID || !is_finite(v.protection_level) || v.protection_level < 0.0) return n;
  const double rounded_scaled = std::fabs(v.value * scale - static_cast<double>(n.value_scaled));
  const double rounded = std::fabs(v.value - static_cast<double>(n.value));
  n.protection_scaled = integer_above(v.protection_level * scale + rounded_scaled);
  if (v.protection_level + rounded <= kFloatMax) n.protection = float_above(v.protection_level + rounded);
  return n;
}

// The members of image 2 for each value. The last one is for angles only.
struct Entry2 {
  std::int32_t value_scaled, protection_scaled;
  std::uint32_t age_ms, state, reasons, cause, positive_means;
};
static_assert(sizeof(Entry2) == sizeof(pose_wall_image2_angle) &&
                  offsetof(Entry2, positive_means) == sizeof(pose_wall_image2_distance) &&
                  offsetof(pose_wall_image2, d_rb) - offsetof(pose_wall_image2, roll) ==
                      3 * sizeof(pose_wall_image2_angle) + 3 * sizeof(pose_wall_image2_distance),
              "the seven lie one behind the other");

double scale_of(std::uint32_t quantity) {
  return quantity <= POSE_WALL_YAW ? kMilliDegreesPerRadian : kMillimetresPerMetre;
}

template <typename Image>
void fill_head(const pose_wall_result& result, Image* image) {
  image->sequence = static_cast<std::uint32_t>(result.frame_index + 1);
  image->config_crc32 = result.config_crc32;
  put_version_and_stamp(result.stamp_ns, image);
  image->verdict = POSE_WALL_VALID;
  image->valid = 0;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::uint32_t state = known_state(result.quantity[q].state);
    if (state < image->verdict) image->verdict = state;
    if (state == POSE_WALL_VALID) image->valid |= 1U << q;
  }
  image->frame_reasons = result.frame_reasons;
}

}  // namespace

void fill_image(const pose_wall_result& result, pose_wall_image* image) {
  image->version = POSE_WALL_IMAGE_VERSION;
  fill_head(result, image);
  unsigned char* to = reinterpret_cast<unsigned char*>(image) + offsetof(pose_wall_image, roll);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q, to += sizeof(Entry)) {
    const Entry entry = entry_of(result.quantity[q], scale_of(q));
    std::memcpy(to, &entry, sizeof(entry));
  }
  image->crc32 = image_crc(*image, &pose_wall_image::crc32, kCrcIeee);
}

pose_wall_image_source source_of(const pose_wall_result& result) {
  return {sizeof(pose_wall_image_source), 0, 0, 0, result.publication, -1};
}

void fill_image(const pose_wall_result& result, const pose_wall_image_source& source, pose_wall_image2* image) {
  image->version = POSE_WALL_IMAGE2_VERSION;
  fill_head(result, image);
  image->publication = static_cast<std::uint32_t>(source.publication);
  image->source_id = result.source_id;
  image->latency_ms = latency_ms(source.latency_ns);
  image->thinning = source.thinning;
  image->held_thinning = source.held_thinning;
  image->told_by = source.cause;
  unsigned char* to = reinterpret_cast<unsigned char*>(image) + offsetof(pose_wall_image2, roll);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const bool angle = q <= POSE_WALL_YAW;
    const Entry e = entry_of(result.quantity[q], scale_of(q));
    const bool bound = e.protection_scaled != POSE_WALL_IMAGE_NO_BOUND && result.quantity[q].cause < POSE_WALL_PARTS;
    const std::uint32_t cause = bound ? result.quantity[q].cause : std::uint32_t{POSE_WALL_PARTS};
    const Entry2 entry = {
        e.value_scaled, e.protection_scaled, e.age_ms, e.state, e.reasons, cause, angle ? result.positive_means[q] : 0};
    const std::size_t bytes = angle ? sizeof(pose_wall_image2_angle) : sizeof(pose_wall_image2_distance);
    std::memcpy(to, &entry, bytes);
    to += bytes;
  }
  image->crc32c = image_crc(*image, &pose_wall_image2::crc32c, kCrcCastagnoli);
}

}  // namespace pose_wall
