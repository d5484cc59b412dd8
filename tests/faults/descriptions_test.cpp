// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a cloud's description that is odd but true is read as it says; one that cannot be known to lie (overlapping
// fields, the wrong byte order) gives nothing that is wrong: two coordinates that are read as they are may still be a
// floor. Those that are refused are in tests/abi/refusals/cloud_refusals_test.cpp.

#include <ctime>
#include <vector>

#include "fault_room.hpp"

namespace pose_wall::test {
namespace {

// A room's frame, and room for what a case makes of it.
struct Described {
  Points points = room_frame(1);
  std::vector<unsigned char> bytes;
  EncodedCloud encoded;
  pose_wall_cloud cloud = cloud_of(points, kPeriod_ns);

  void encode_as(const CloudLayout& layout) {
    encoded = encode(points, layout, kPeriod_ns);
    cloud = encoded.cloud;
  }
  void begin_at(std::size_t odd_address) {
    const auto* const from = static_cast<const unsigned char*>(cloud.data);
    bytes.assign(odd_address, 0);
    bytes.insert(bytes.end(), from, from + cloud.data_bytes);
    cloud.data = bytes.data() + odd_address;
  }
};

struct DescriptionCase {
  const char* name;
  const char* states;  // of the frame; the room is still the truth of what is told
  void (*spoil)(Described*);
};

void PrintTo(const DescriptionCase& c, std::ostream* out) {
  *out << c.name;
}

constexpr std::uint32_t kMost = 0xFFFFFFFF;

const DescriptionCase kDescriptions[] = {
    {"struct_size_of_a_cloud_without_ring", "V",
     [](auto* d) { d->cloud.struct_size = offsetof(pose_wall_cloud, ring); }},
    {"data_null_without_points", "H", [](auto* d) { d->cloud.data = nullptr, d->cloud.width = 0; }},
    {"data_at_1", "V", [](auto* d) { d->begin_at(1); }},
    {"data_at_2", "V", [](auto* d) { d->begin_at(2); }},
    {"data_at_3", "V", [](auto* d) { d->begin_at(3); }},
    {"data_bytes_one_more", "V",
     [](auto* d) { d->begin_at(0), d->bytes.push_back(1), d->cloud.data = d->bytes.data(), ++d->cloud.data_bytes; }},
    {"width_0", "H", [](auto* d) { d->cloud.width = 0; }},
    {"width_1", "H", [](auto* d) { d->cloud.width = 1; }},
    {"width_2", "H", [](auto* d) { d->cloud.width = 2; }},
    {"width_3", "H", [](auto* d) { d->cloud.width = 3; }},
    {"width_one_less", "V", [](auto* d) { --d->cloud.width; }},
    {"height_0", "H", [](auto* d) { d->cloud.height = 0; }},
    {"width_most_height_0", "H", [](auto* d) { d->cloud.width = kMost, d->cloud.height = 0; }},
    {"width_0_height_most", "H", [](auto* d) { d->cloud.width = 0, d->cloud.height = kMost; }},
    {"point_step_13_as_far_as_there_is", "..hhhhh",
     [](auto* d) { d->cloud.point_step = 13, d->cloud.width = d->cloud.width * 12 / 13; }},
    {"point_step_24_every_second_point", "VV.....", [](auto* d) { d->cloud.point_step = 24, d->cloud.width /= 2; }},
    {"row_step_packed", "V", [](auto* d) { d->cloud.row_step = static_cast<std::uint32_t>(d->cloud.data_bytes); }},
    {"row_step_most_of_one_row", "V", [](auto* d) { d->cloud.row_step = kMost; }},
    {"rows_of_one_point_each", "V",
     [](auto* d) { d->cloud.height = d->cloud.width, d->cloud.width = 1, d->cloud.row_step = 12; }},
    {"x_offset_1", "..xxxxx", [](auto* d) { d->cloud.x.offset = 1; }},
    {"y_on_x", "x", [](auto* d) { d->cloud.y.offset = 0; }},
    {"z_on_y", "x", [](auto* d) { d->cloud.z.offset = 4; }},
    {"z_on_x", "x", [](auto* d) { d->cloud.z.offset = 0; }},
    {"x_y_and_z_on_one_place", "h", [](auto* d) { d->cloud.y.offset = d->cloud.z.offset = 0; }},
    {"y_half_on_x", "..xxxxx", [](auto* d) { d->cloud.y.offset = 2; }},
    {"x_a_double_over_x_and_y", "..hhhhh", [](auto* d) { d->cloud.x.type = POSE_WALL_FIELD_FLOAT64; }},
    {"big_endian_lies", "h", [](auto* d) { d->cloud.big_endian = 1; }},
    {"big_endian_is_true", "V",
     [](auto* d) {
       d->encode_as({false, true, 0, 0, 0, 1, 0});
     }},
    {"big_endian_doubles", "V",
     [](auto* d) {
       d->encode_as({true, true, 3, 9, 5, 1, 0});
     }},
    {"little_endian_lies", "h",
     [](auto* d) {
       d->encode_as({true, true}), d->cloud.big_endian = 0;
     }},
    {"doubles_at_18", "V",
     [](auto* d) {
       d->encode_as({true, false, 18, 8, 1, 1, 0});
     }},
    {"intensity_on_x", "V",
     [](auto* d) {
       d->cloud.intensity = {0, POSE_WALL_FIELD_FLOAT32};
     }},
    {"ring_on_z", "V",
     [](auto* d) {
       d->cloud.ring = {8, POSE_WALL_FIELD_UINT32};
     }},
};

void expect_taken(const char* states, const pose_wall_cloud& cloud) {
  FaultRoom room;
  ASSERT_EQ(states_of(room.good(0)), "VVVVVVV");
  EXPECT_EQ(pose_wall_cloud_check(&cloud), POSE_WALL_OK);
  const pose_wall_result r = room.process(cloud);
  EXPECT_TRUE(matches(states_of(r), states)) << states_of(r) << ", not " << states;
  EXPECT_EQ(misleading(r, kRoomTruth), "") << states_of(r);
  EXPECT_LE(room.frames_until_valid(cloud.stamp_ns), kBackWithin);
}

class Descriptions : public ::testing::TestWithParam<DescriptionCase> {};

TEST_P(Descriptions, AreReadAsTheySay) {
  Described d;
  GetParam().spoil(&d);
  const std::clock_t before = std::clock();
  expect_taken(GetParam().states, d.cloud);
  // Bounded by the points there are, not by what the description says: 2^32 empty rows would take longer.
  EXPECT_LT(std::clock() - before, 4 * CLOCKS_PER_SEC);
}

INSTANTIATE_TEST_SUITE_P(Faults, Descriptions, ::testing::ValuesIn(kDescriptions),
                         [](const auto& test) { return name_of(test.param.name); });

// With a weight intensity is read, whatever its bytes: it moves weights and nothing else.
class IntensityTypes : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(IntensityTypes, AnyBytesOnlyWeigh) {
  pose_wall_config config = small_config();
  set(&config, "intensity_weight", 1.0);
  FaultRoom room(config);
  room.good(0);
  Described d;
  d.cloud.intensity = {GetParam() == POSE_WALL_FIELD_FLOAT64 ? 2U : 5U, GetParam()};
  const pose_wall_result r = room.process(d.cloud);
  EXPECT_TRUE(matches(states_of(r), "L")) << states_of(r);
  EXPECT_EQ(misleading(r, kRoomTruth), "");
}

INSTANTIATE_TEST_SUITE_P(Faults, IntensityTypes, ::testing::Range(1U, 9U),
                         [](const auto& test) { return "type_" + std::to_string(test.param); });

}  // namespace
}  // namespace pose_wall::test
