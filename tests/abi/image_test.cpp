// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the process image holds the result's numbers, rounded so that no pair of value and protection level promises
// more than the result did; it never holds NaN; what does not fit saturates; damage to any bit is found; refused calls
// change nothing. Does not prove: that a controller reads it so (tests/checks/plc_test.py).

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::test {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

pose_wall_config small_config() {
  return config_with({{"points_max", "5000"}});
}

// A frame of no points: its head is an engine's, so that there are images of it.
pose_wall_result empty_frame(std::uint64_t frame_index, std::int64_t stamp_ns) {
  EngineUnderTest engine(config_with({{"points_max", "5000"}, {"source_id", "7"}, {"forward_axis", "-X"}}));
  pose_wall_cloud cloud;
  for (std::uint64_t i = 0; i < frame_index; ++i) {
    const std::int64_t before_ns = static_cast<std::int64_t>(frame_index - i) * 100000000;
    EXPECT_EQ(pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, stamp_ns - before_ns), POSE_WALL_OK);
    engine.process(cloud);
  }
  EXPECT_EQ(pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, stamp_ns), POSE_WALL_OK);
  return engine.process(cloud);
}

// What an engine could have measured: 1.2345 deg and 2.3456 m, everywhere valid.
pose_wall_result some_result() {
  static const pose_wall_result frame = empty_frame(41, -2);
  pose_wall_result r = frame;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const bool angle = q <= POSE_WALL_YAW;
    r.quantity[q].value = angle ? 1.2345 * kDegree : 2.3456;
    r.quantity[q].protection_level = angle ? 0.5 * kDegree : 0.05;
    r.quantity[q].age_s = 0.1001;
    r.quantity[q].state = POSE_WALL_VALID;
    r.quantity[q].reasons = 1U << q;
    r.quantity[q].cause = q;
  }
  return r;
}

pose_wall_image image_of(const pose_wall_result& result) {
  pose_wall_image image;
  std::memset(&image, 0x5A, sizeof image);
  image.struct_size = sizeof image;
  EXPECT_EQ(pose_wall_image_fill(&result, &image), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_image_check(&image), POSE_WALL_OK);
  return image;
}

pose_wall_image2 image2_of(const pose_wall_result& result, const pose_wall_image_source* source = nullptr) {
  pose_wall_image2 image;
  std::memset(&image, 0x5A, sizeof image);
  image.struct_size = sizeof image;
  EXPECT_EQ(pose_wall_image2_fill(&result, source, &image), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_image2_check(&image), POSE_WALL_OK);
  return image;
}

pose_wall_image_distance distance_image(double value, double protection, std::uint32_t state = POSE_WALL_VALID) {
  pose_wall_result r = some_result();
  r.quantity[POSE_WALL_D_LF].state = state;
  r.quantity[POSE_WALL_D_LF].value = value;
  r.quantity[POSE_WALL_D_LF].protection_level = protection;
  return image_of(r).d_lf;
}

TEST(Image, HoldsTheResult) {
  const pose_wall_image image = image_of(some_result());
  EXPECT_EQ(image.version, 1U);
  EXPECT_EQ(image.sequence, 42U);
  EXPECT_EQ(image.stamp_low, 0xFFFFFFFEU);
  EXPECT_EQ(image.stamp_high, 0xFFFFFFFFU);
  EXPECT_EQ(image.library_version,
            POSE_WALL_VERSION_MAJOR * 65536U + POSE_WALL_VERSION_MINOR * 256U + POSE_WALL_VERSION_PATCH);
  EXPECT_EQ(image.verdict, static_cast<std::uint32_t>(POSE_WALL_VALID));
  EXPECT_EQ(image.valid, 0x7FU);
  EXPECT_EQ(image.yaw.value_mdeg, 1235);  // 1234.5 rounds up
  EXPECT_FLOAT_EQ(image.yaw.value_rad, static_cast<float>(1.2345 * kDegree));
  EXPECT_EQ(image.d_rb.value_mm, 2346);
  EXPECT_FLOAT_EQ(image.d_rb.value_m, 2.3456F);
  EXPECT_EQ(image.d_rb.age_ms, 101U);
  EXPECT_EQ(image.roll.reasons, 1U);
  EXPECT_EQ(image.d_rb.reasons, 1U << POSE_WALL_D_RB);
}

TEST(Image, TheVerdictIsTheWorstState) {
  pose_wall_result r = some_result();
  r.quantity[POSE_WALL_D_RF].state = POSE_WALL_HELD;
  r.quantity[POSE_WALL_PITCH].state = POSE_WALL_DEGRADED;
  const pose_wall_image image = image_of(r);
  EXPECT_EQ(image.verdict, static_cast<std::uint32_t>(POSE_WALL_HELD));
  EXPECT_EQ(image.valid, 0x7FU & ~(1U << POSE_WALL_D_RF) & ~(1U << POSE_WALL_PITCH));
  r.quantity[POSE_WALL_YAW].state = 77;
  EXPECT_EQ(image_of(r).verdict, static_cast<std::uint32_t>(POSE_WALL_INVALID));
  EXPECT_EQ(image_of(r).yaw.state, static_cast<std::uint32_t>(POSE_WALL_INVALID));
}

// Doubles of a few thousand round at 5e-13, and a compiler may fuse what is computed here.
constexpr double kRounding = 1e-11;

// Truth at the far end of the result's bound stays within the image's: in whole millimetres and in floats.
TEST(Image, ProtectionCoversTheRoundingOfItsValue) {
  for (int i = 0; i < 2000; ++i) {
    const double value = 1.0 + 0.00137 * i, protection = 0.00011 * i;
    const pose_wall_image_distance d = distance_image(value, protection);
    const double off_mm = std::fabs(value * 1e3 - d.value_mm),
                 off_m = std::fabs(value - static_cast<double>(d.value_m));
    EXPECT_GE(d.protection_mm, protection * 1e3 + off_mm - kRounding) << i;
    EXPECT_LE(d.protection_mm, protection * 1e3 + off_mm + 1.0 + kRounding) << i;
    EXPECT_GE(static_cast<double>(d.protection_m), protection + off_m - kRounding) << i;
    EXPECT_LE(static_cast<double>(d.protection_m), protection + off_m + 1e-6) << i;
  }
}

TEST(Image, NoNumberIsTheWorstNumber) {
  for (const double nothing : {kNaN, kInfinity, -kInfinity}) {
    const pose_wall_image_distance none = distance_image(nothing, nothing);
    EXPECT_EQ(none.value_mm, POSE_WALL_IMAGE_NO_VALUE);
    EXPECT_EQ(none.value_m, -2147483648.0F);
    EXPECT_EQ(none.protection_mm, POSE_WALL_IMAGE_NO_BOUND);
    EXPECT_EQ(none.protection_m, 2147483648.0F);
    EXPECT_EQ(none.age_ms, 0xFFFFFFFFU) << "what is not there is not fresh";
    const pose_wall_image_distance unbound = distance_image(2.0, nothing);
    EXPECT_EQ(unbound.value_mm, 2000);
    EXPECT_EQ(unbound.protection_mm, POSE_WALL_IMAGE_NO_BOUND);
    EXPECT_EQ(unbound.protection_m, 2147483648.0F);
    EXPECT_EQ(unbound.age_ms, 101U);
  }
  EXPECT_EQ(distance_image(2.0, -1.0).protection_mm, POSE_WALL_IMAGE_NO_BOUND);
  EXPECT_NE(distance_image(2.0, 0.1).protection_mm, POSE_WALL_IMAGE_NO_BOUND);
  EXPECT_EQ(distance_image(2.0, 0.1, POSE_WALL_INVALID).protection_mm, POSE_WALL_IMAGE_NO_BOUND);
}

TEST(Image, WhatDoesNotFitSaturates) {
  for (const double far : {3e6, 1e300}) {
    EXPECT_EQ(distance_image(far, 0.1).value_mm, 2147483647);
    // 3e6 m and 0.1 m end 852516453 mm beyond the largest value.
    EXPECT_EQ(distance_image(far, 0.1).protection_mm, far > 1e9 ? POSE_WALL_IMAGE_NO_BOUND : 852516453);
    EXPECT_EQ(distance_image(-far, 0.1).value_mm, -2147483647);
    EXPECT_EQ(distance_image(1.0, far).protection_mm, POSE_WALL_IMAGE_NO_BOUND);
  }
  EXPECT_EQ(distance_image(1e300, 0.1).value_m, 2147483520.0F);
  EXPECT_EQ(distance_image(1.0, 1e300).protection_m, 2147483648.0F);
  pose_wall_result r = some_result();
  for (const double age_s : {1e9, kNaN, -1.0}) {
    r.quantity[POSE_WALL_D_LF].age_s = age_s;
    EXPECT_EQ(image_of(r).d_lf.age_ms, 0xFFFFFFFFU) << age_s;
  }
}

template <typename Image>
void expect_every_bit_counts(const Image& good, std::int32_t (*check)(const Image*)) {
  for (std::size_t bit = 0; bit < 8 * sizeof good; ++bit) {
    Image damaged;
    unsigned char bytes[sizeof good];
    std::memcpy(bytes, &good, sizeof good);
    bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1U << bit % 8));
    std::memcpy(&damaged, bytes, sizeof damaged);
    EXPECT_EQ(check(&damaged), bit < 64 ? POSE_WALL_E_IMAGE_VERSION : POSE_WALL_E_IMAGE_CRC) << bit;
  }
  const Image zeros{};
  EXPECT_EQ(check(&zeros), POSE_WALL_E_IMAGE_VERSION);
}

TEST(Image, DamageToAnyBitIsFound) {
  expect_every_bit_counts(image_of(some_result()), pose_wall_image_check);
  expect_every_bit_counts(image2_of(some_result()), pose_wall_image2_check);
}

TEST(Image, OfFramesOfAnEngine) {
  EngineUnderTest engine(small_config());
  pose_wall_cloud cloud;
  pose_wall_image image;
  image.struct_size = sizeof image;
  for (std::uint32_t frame = 1; frame <= 3; ++frame) {
    ASSERT_EQ(pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, frame * 100000000LL), POSE_WALL_OK);
    const pose_wall_result result = engine.process(cloud);
    ASSERT_EQ(pose_wall_image_fill(&result, &image), POSE_WALL_OK);
    EXPECT_EQ(image.sequence, frame);
    EXPECT_EQ(image.verdict, static_cast<std::uint32_t>(POSE_WALL_INVALID));
    EXPECT_EQ(image.d_lf.value_mm, POSE_WALL_IMAGE_NO_VALUE);
    EXPECT_EQ(image.d_lf.age_ms, 0xFFFFFFFFU);
    EXPECT_EQ(image.frame_reasons, result.frame_reasons);
  }
  std::uint32_t crc = 0;
  const pose_wall_config config = small_config();
  ASSERT_EQ(pose_wall_config_crc(&config, &crc), POSE_WALL_OK);
  EXPECT_EQ(image.config_crc32, crc);
}

// A reader waits for another sequence: the first frame must differ from what was told before it.
TEST(Image, TheSequenceTellsTheFirstFrameFromNone) {
  EngineUnderTest engine(small_config());
  const auto sequence_of = [](const pose_wall_result& result) {
    pose_wall_image image;
    image.struct_size = sizeof image;
    EXPECT_EQ(pose_wall_image_fill(&result, &image), POSE_WALL_OK);
    return image.sequence;
  };
  pose_wall_cloud cloud;
  pose_wall_result aged{};
  aged.struct_size = sizeof aged;
  for (int open = 0; open < 2; ++open) {
    ASSERT_EQ(pose_wall_age(engine.get(), 0, &aged), POSE_WALL_OK);
    EXPECT_EQ(sequence_of(aged), 0U);
    for (std::uint32_t frame = 1; frame <= 2; ++frame) {
      ASSERT_EQ(pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, frame * 100000000LL), POSE_WALL_OK);
      EXPECT_EQ(sequence_of(engine.process(cloud)), frame);
      ASSERT_EQ(pose_wall_age(engine.get(), frame * 100000000LL, &aged), POSE_WALL_OK);
      EXPECT_EQ(sequence_of(aged), frame) << "silence is no news";
    }
    ASSERT_EQ(pose_wall_reset(engine.get()), POSE_WALL_OK);
  }
}

TEST(Image2, HoldsWhatImage1Holds) {
  pose_wall_result r = some_result();
  r.quantity[POSE_WALL_D_RF].state = POSE_WALL_HELD;
  r.quantity[POSE_WALL_PITCH].protection_level = kNaN;
  const pose_wall_image one = image_of(r);
  const pose_wall_image2 two = image2_of(r);
  EXPECT_EQ(two.version, 2U);
  EXPECT_EQ(two.sequence, one.sequence);
  EXPECT_EQ(two.config_crc32, one.config_crc32);
  EXPECT_EQ(two.library_version, one.library_version);
  EXPECT_EQ(two.stamp_low, one.stamp_low);
  EXPECT_EQ(two.stamp_high, one.stamp_high);
  EXPECT_EQ(two.verdict, one.verdict);
  EXPECT_EQ(two.valid, one.valid);
  EXPECT_EQ(two.frame_reasons, one.frame_reasons);
  const auto expect_same = [](const auto& a, const auto& b) {
    EXPECT_EQ(a.age_ms, b.age_ms);
    EXPECT_EQ(a.state, b.state);
    EXPECT_EQ(a.reasons, b.reasons);
  };
  expect_same(one.pitch, two.pitch);
  expect_same(one.d_rf, two.d_rf);
  EXPECT_EQ(two.pitch.value_mdeg, one.pitch.value_mdeg);
  EXPECT_EQ(two.pitch.protection_mdeg, POSE_WALL_IMAGE_NO_BOUND);
  EXPECT_EQ(two.d_rf.value_mm, one.d_rf.value_mm);
  EXPECT_EQ(two.d_rf.protection_mm, one.d_rf.protection_mm);
  EXPECT_EQ(two.d_rb.value_mm, 2346);
}

TEST(Image2, TellsCausesAndSigns) {
  pose_wall_result r = some_result();
  r.quantity[POSE_WALL_D_LF].state = POSE_WALL_INVALID;
  r.quantity[POSE_WALL_D_LB].cause = 99;
  const pose_wall_image2 image = image2_of(r);
  EXPECT_EQ(image.roll.cause, std::uint32_t{POSE_WALL_PART_RANDOM});
  EXPECT_EQ(image.yaw.cause, std::uint32_t{POSE_WALL_PART_BEND});
  EXPECT_EQ(image.d_rb.cause, std::uint32_t{POSE_WALL_PART_AGE});
  EXPECT_EQ(image.d_lf.cause, std::uint32_t{POSE_WALL_PARTS}) << "no level, no cause";
  EXPECT_EQ(image.d_lb.cause, std::uint32_t{POSE_WALL_PARTS}) << "an unknown one is none";
  // The engine of some_result looks along -X.
  EXPECT_EQ(image.roll.positive_means, std::uint32_t{POSE_WALL_SENSE_LEFT_DOWN});
  EXPECT_EQ(image.pitch.positive_means, std::uint32_t{POSE_WALL_SENSE_NOSE_UP});
  EXPECT_EQ(image.yaw.positive_means, std::uint32_t{POSE_WALL_SENSE_TURNED_RIGHT});
}

TEST(Image2, TellsWhereItComesFrom) {
  const pose_wall_result r = some_result();
  const pose_wall_image2 alone = image2_of(r);
  EXPECT_EQ(alone.source_id, 7U);
  EXPECT_EQ(alone.publication, 42U);
  EXPECT_EQ(alone.latency_ms, 0xFFFFFFFFU);
  EXPECT_EQ(alone.thinning, 0U);
  EXPECT_EQ(alone.held_thinning, 0U);
  EXPECT_EQ(alone.told_by, 0U);
  pose_wall_image_source source = {sizeof(pose_wall_image_source), 2, 3, 4, 0x500000006ULL, 20000001};
  const pose_wall_image2 told = image2_of(r, &source);
  EXPECT_EQ(told.publication, 6U);
  EXPECT_EQ(told.latency_ms, 21U) << "rounded up";
  EXPECT_EQ(told.thinning, 3U);
  EXPECT_EQ(told.held_thinning, 4U);
  EXPECT_EQ(told.told_by, 2U);
  EXPECT_EQ(told.source_id, 7U);
  source.latency_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(image2_of(r, &source).latency_ms, 0xFFFFFFFFU) << "what does not fit is not known";
  source.latency_ns = 0;
  EXPECT_EQ(image2_of(r, &source).latency_ms, 0U);
}

// A reader sees by it that silence is told: image 1 does not change then.
TEST(Image2, ThePublicationChangesWithSilence) {
  EngineUnderTest engine(small_config());
  pose_wall_cloud cloud;
  ASSERT_EQ(pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, 0), POSE_WALL_OK);
  const pose_wall_image2 frame = image2_of(engine.process(cloud));
  pose_wall_result aged{};
  aged.struct_size = sizeof aged;
  ASSERT_EQ(pose_wall_age(engine.get(), 100000000, &aged), POSE_WALL_OK);
  const pose_wall_image2 silence = image2_of(aged);
  EXPECT_EQ(silence.sequence, frame.sequence);
  EXPECT_EQ(silence.publication, frame.publication + 1);
}

// By bits, and over "123456789" the sum that is published for CRC-32C.
std::uint32_t castagnoli(const unsigned char* bytes, std::size_t count, std::size_t left_out) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 0; i < count; ++i) {
    if (i / 4 == left_out) continue;
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0x82F63B78U : 0U);
  }
  return ~crc;
}

TEST(Image2, ItsSumIsNotTheFieldbuss) {
  const unsigned char digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  ASSERT_EQ(castagnoli(digits, sizeof digits, sizeof digits), 0xE3069283U);
  const pose_wall_image2 image = image2_of(some_result());
  unsigned char bytes[sizeof image];
  std::memcpy(bytes, &image, sizeof image);
  EXPECT_EQ(image.crc32c, castagnoli(bytes, sizeof bytes, 2));
}

TEST(Image2, FitsOneModbusRead) {
  EXPECT_LE(sizeof(pose_wall_image2) / 2, 125U);
}

TEST(ConfigCrc, ToldBySettingsAlone) {
  pose_wall_config a = config_with(), b = config_with();
  std::uint32_t crc_a = 1, crc_b = 2;
  ASSERT_EQ(pose_wall_config_crc(&a, &crc_a), POSE_WALL_OK);
  set(&b, "s_front", "2");
  set(&b, "lateral_offset_left", "-0.0");
  ASSERT_EQ(pose_wall_config_crc(&b, &crc_b), POSE_WALL_OK);
  EXPECT_EQ(crc_a, crc_b) << "the same settings, written otherwise";
  for (const auto& [key, value] : {KeyValue{"s_front", "2.001"}, {"forward_axis", "-X"}, {"lidar_frame", "os"}}) {
    pose_wall_config c = config_with({{key, value}});
    ASSERT_EQ(pose_wall_config_crc(&c, &crc_b), POSE_WALL_OK);
    EXPECT_NE(crc_a, crc_b) << key;
  }
}

// So that another table of keys gives another number.
TEST(ConfigCrc, CoversNamesUnitsNumbersAndTexts) {
  std::uint32_t crc = 0xFFFFFFFFU;
  const auto add = [&crc](const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      crc ^= static_cast<const unsigned char*>(bytes)[i];
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
  };
  pose_wall_config config = config_with({{"s_front", "2.5"}, {"lidar_frame", "os"}});
  add(&config.layout, sizeof config.layout);
  for (std::uint32_t key = 0; key < pose_wall_config_key_count(); ++key) {
    pose_wall_key_info info;
    ASSERT_EQ(pose_wall_config_key(key, &info), POSE_WALL_OK);
    add(info.name, std::strlen(info.name) + 1);
    add(info.unit, std::strlen(info.unit) + 1);
  }
  add(config.number, sizeof config.number);
  add(config.text, sizeof config.text);
  std::uint32_t told = 0;
  ASSERT_EQ(pose_wall_config_crc(&config, &told), POSE_WALL_OK);
  EXPECT_EQ(told, ~crc);
}

}  // namespace
}  // namespace pose_wall::test
