// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a cloud's description that lies is refused by the status in the header, and result and engine stay as they
// were; one that is odd but true is read as it says; one that cannot be known to lie (overlapping fields, the wrong
// byte order) gives nothing that is wrong: two coordinates that are read as they are may still be a floor.

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
  std::int32_t status;
  const char* states;  // of a frame that is taken; the room is still the truth of what is told
  void (*spoil)(Described*);
};

void PrintTo(const DescriptionCase& c, std::ostream* out) {
  *out << c.name;
}

constexpr std::int32_t kOk = POSE_WALL_OK, kField = POSE_WALL_E_CLOUD_FIELD, kStep = POSE_WALL_E_CLOUD_STEP;
constexpr std::int32_t kSize = POSE_WALL_E_CLOUD_SIZE, kStruct = POSE_WALL_E_STRUCT_SIZE,
                       kNewer = POSE_WALL_E_STRUCT_NEWER;
constexpr std::uint32_t kMost = 0xFFFFFFFF;

const DescriptionCase kDescriptions[] = {
    {"struct_size_0", kStruct, "", [](auto* d) { d->cloud.struct_size = 0; }},
    {"struct_size_of_a_cloud_without_ring", kOk, "V",
     [](auto* d) { d->cloud.struct_size = offsetof(pose_wall_cloud, ring); }},
    {"struct_size_one_less_than_that", kStruct, "",
     [](auto* d) { d->cloud.struct_size = offsetof(pose_wall_cloud, ring) - 1; }},
    {"struct_size_8_more", kNewer, "", [](auto* d) { d->cloud.struct_size += 8; }},
    {"struct_size_most", kStruct, "", [](auto* d) { d->cloud.struct_size = kMost; }},

    {"data_null", POSE_WALL_E_NULL, "", [](auto* d) { d->cloud.data = nullptr; }},
    {"data_null_without_points", kOk, "H", [](auto* d) { d->cloud.data = nullptr, d->cloud.width = 0; }},
    {"data_at_1", kOk, "V", [](auto* d) { d->begin_at(1); }},
    {"data_at_2", kOk, "V", [](auto* d) { d->begin_at(2); }},
    {"data_at_3", kOk, "V", [](auto* d) { d->begin_at(3); }},
    {"data_bytes_0", kSize, "", [](auto* d) { d->cloud.data_bytes = 0; }},
    {"data_bytes_one_less", kSize, "", [](auto* d) { --d->cloud.data_bytes; }},
    {"data_bytes_one_more", kOk, "V",
     [](auto* d) { d->begin_at(0), d->bytes.push_back(1), d->cloud.data = d->bytes.data(), ++d->cloud.data_bytes; }},

    {"width_0", kOk, "H", [](auto* d) { d->cloud.width = 0; }},
    {"width_1", kOk, "H", [](auto* d) { d->cloud.width = 1; }},
    {"width_2", kOk, "H", [](auto* d) { d->cloud.width = 2; }},
    {"width_3", kOk, "H", [](auto* d) { d->cloud.width = 3; }},
    {"width_one_less", kOk, "V", [](auto* d) { --d->cloud.width; }},
    {"width_one_more", kSize, "", [](auto* d) { ++d->cloud.width; }},
    {"width_2_to_26_and_1", kSize, "", [](auto* d) { d->cloud.width = (1U << 26) + 1; }},
    {"width_most", kSize, "", [](auto* d) { d->cloud.width = kMost; }},
    {"height_0", kOk, "H", [](auto* d) { d->cloud.height = 0; }},
    {"height_2", kSize, "", [](auto* d) { d->cloud.height = 2; }},
    {"height_most", kSize, "", [](auto* d) { d->cloud.height = kMost; }},
    {"width_and_height_most", kSize, "", [](auto* d) { d->cloud.width = d->cloud.height = kMost; }},
    {"width_most_height_0", kOk, "H", [](auto* d) { d->cloud.width = kMost, d->cloud.height = 0; }},
    {"width_0_height_most", kOk, "H", [](auto* d) { d->cloud.width = 0, d->cloud.height = kMost; }},

    {"point_step_0", kStep, "", [](auto* d) { d->cloud.point_step = 0; }},
    {"point_step_4_overlaps", kStep, "", [](auto* d) { d->cloud.point_step = 4; }},
    {"point_step_11", kStep, "", [](auto* d) { d->cloud.point_step = 11; }},
    {"point_step_13", kSize, "", [](auto* d) { d->cloud.point_step = 13; }},
    {"point_step_13_as_far_as_there_is", kOk, "..hhhhh",
     [](auto* d) { d->cloud.point_step = 13, d->cloud.width = d->cloud.width * 12 / 13; }},
    {"point_step_24_every_second_point", kOk, "VV.....",
     [](auto* d) { d->cloud.point_step = 24, d->cloud.width /= 2; }},
    {"point_step_most", kSize, "", [](auto* d) { d->cloud.point_step = kMost; }},

    {"row_step_1", kStep, "", [](auto* d) { d->cloud.row_step = 1; }},
    {"row_step_one_less", kStep, "",
     [](auto* d) { d->cloud.row_step = static_cast<std::uint32_t>(d->cloud.data_bytes - 1); }},
    {"row_step_packed", kOk, "V", [](auto* d) { d->cloud.row_step = static_cast<std::uint32_t>(d->cloud.data_bytes); }},
    {"row_step_most_of_one_row", kOk, "V", [](auto* d) { d->cloud.row_step = kMost; }},
    {"row_step_most_of_two_rows", kSize, "",
     [](auto* d) { d->cloud.row_step = kMost, d->cloud.height = 2, d->cloud.width /= 2; }},
    {"rows_of_one_point_each", kOk, "V",
     [](auto* d) { d->cloud.height = d->cloud.width, d->cloud.width = 1, d->cloud.row_step = 12; }},
    {"row_step_of_points_that_overlap", kStep, "",
     [](auto* d) { d->cloud.height = d->cloud.width, d->cloud.width = 1, d->cloud.row_step = 4; }},

    {"x_offset_1", kOk, "..xxxxx", [](auto* d) { d->cloud.x.offset = 1; }},
    {"x_offset_9", kStep, "", [](auto* d) { d->cloud.x.offset = 9; }},
    {"x_offset_wraps_to_0", kStep, "", [](auto* d) { d->cloud.x.offset = kMost - 3; }},
    {"x_offset_most", kStep, "", [](auto* d) { d->cloud.x.offset = kMost; }},
    {"y_offset_wraps_to_4", kStep, "", [](auto* d) { d->cloud.y.offset = kMost - 3; }},
    {"z_offset_one_more", kStep, "", [](auto* d) { d->cloud.z.offset = 9; }},
    {"z_offset_most", kStep, "", [](auto* d) { d->cloud.z.offset = kMost; }},
    {"y_on_x", kOk, "x", [](auto* d) { d->cloud.y.offset = 0; }},
    {"z_on_y", kOk, "x", [](auto* d) { d->cloud.z.offset = 4; }},
    {"z_on_x", kOk, "x", [](auto* d) { d->cloud.z.offset = 0; }},
    {"x_y_and_z_on_one_place", kOk, "h", [](auto* d) { d->cloud.y.offset = d->cloud.z.offset = 0; }},
    {"y_half_on_x", kOk, "..xxxxx", [](auto* d) { d->cloud.y.offset = 2; }},
    {"x_a_double_over_x_and_y", kOk, "..hhhhh", [](auto* d) { d->cloud.x.type = POSE_WALL_FIELD_FLOAT64; }},
    {"z_a_double_past_the_point", kStep, "", [](auto* d) { d->cloud.z.type = POSE_WALL_FIELD_FLOAT64; }},

    {"big_endian_2", kField, "", [](auto* d) { d->cloud.big_endian = 2; }},
    {"big_endian_most", kField, "", [](auto* d) { d->cloud.big_endian = kMost; }},
    {"big_endian_lies", kOk, "h", [](auto* d) { d->cloud.big_endian = 1; }},
    {"big_endian_is_true", kOk, "V",
     [](auto* d) {
       d->encode_as({false, true, 0, 0, 0, 1, 0});
     }},
    {"big_endian_doubles", kOk, "V",
     [](auto* d) {
       d->encode_as({true, true, 3, 9, 5, 1, 0});
     }},
    {"little_endian_lies", kOk, "h",
     [](auto* d) {
       d->encode_as({true, true}), d->cloud.big_endian = 0;
     }},
    {"doubles_at_18", kOk, "V",
     [](auto* d) {
       d->encode_as({true, false, 18, 8, 1, 1, 0});
     }},

    {"intensity_past_the_point", kStep, "",
     [](auto* d) {
       d->cloud.intensity = {12, POSE_WALL_FIELD_UINT8};
     }},
    {"intensity_offset_most", kStep, "",
     [](auto* d) {
       d->cloud.intensity = {kMost, POSE_WALL_FIELD_UINT8};
     }},
    {"intensity_unknown", kField, "",
     [](auto* d) {
       d->cloud.intensity = {0, 9};
     }},
    {"intensity_type_most", kField, "",
     [](auto* d) {
       d->cloud.intensity = {0, kMost};
     }},
    {"intensity_on_x", kOk, "V",
     [](auto* d) {
       d->cloud.intensity = {0, POSE_WALL_FIELD_FLOAT32};
     }},
    {"time_is_garbage", kField, "",
     [](auto* d) {
       d->cloud.time = {kMost, kMost};
     }},
    {"time_beyond_the_point", kStep, "",
     [](auto* d) {
       d->cloud.time = {d->cloud.point_step - 3, POSE_WALL_FIELD_UINT32};
     }},
    {"ring_is_garbage", kField, "",
     [](auto* d) {
       d->cloud.ring = {kMost, kMost};
     }},
};

pose_wall_result result_of_garbage() {
  pose_wall_result result;
  std::memset(&result, 0x5A, sizeof result);
  result.struct_size = sizeof result;
  return result;
}

// The engine next to it never saw the refused cloud: the next frames are the same bits.
void expect_refused(std::int32_t status, const pose_wall_cloud& cloud) {
  FaultRoom disturbed, undisturbed;
  disturbed.good(0);
  undisturbed.good(0);
  pose_wall_result result = result_of_garbage();
  EXPECT_EQ(pose_wall_cloud_check(&cloud), status);
  EXPECT_EQ(pose_wall_process(disturbed.engine(), &cloud, &result), status);
  EXPECT_TRUE(same(result, result_of_garbage())) << "a refused call wrote a result";
  EXPECT_TRUE(same(disturbed.good(2 * kPeriod_ns), undisturbed.good(2 * kPeriod_ns)));
}

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

TEST_P(Descriptions, AreRefusedOrRead) {
  Described d;
  GetParam().spoil(&d);
  const std::clock_t before = std::clock();
  if (GetParam().status != POSE_WALL_OK) {
    expect_refused(GetParam().status, d.cloud);
  } else {
    expect_taken(GetParam().states, d.cloud);
  }
  // Bounded by the points there are, not by what the description says: 2^32 empty rows would take longer.
  EXPECT_LT(std::clock() - before, 4 * CLOCKS_PER_SEC);
}

INSTANTIATE_TEST_SUITE_P(Faults, Descriptions, ::testing::ValuesIn(kDescriptions),
                         [](const auto& test) { return name_of(test.param.name); });

// Every type of each coordinate. Floats are the room; of a double that reaches over the next field, or is the point's
// last, see above.
class CoordinateTypes : public ::testing::TestWithParam<std::tuple<int, std::uint32_t>> {};

TEST_P(CoordinateTypes, OnlyFloatsAreCoordinates) {
  const auto [axis, type] = GetParam();
  Described d;
  pose_wall_field* const field[] = {&d.cloud.x, &d.cloud.y, &d.cloud.z};
  field[axis]->type = type;
  expect_refused(POSE_WALL_E_CLOUD_FIELD, d.cloud);
}

INSTANTIATE_TEST_SUITE_P(Faults, CoordinateTypes,
                         ::testing::Combine(::testing::Values(0, 1, 2),
                                            ::testing::Values(0U, 1U, 2U, 3U, 4U, 5U, 6U, 9U, 255U, 0xFFFFFFFFU)),
                         [](const auto& test) {
                           const char axes[] = "xyz";
                           return std::string(1, axes[std::get<0>(test.param)]) + "_type_" +
                                  std::to_string(std::get<1>(test.param));
                         });

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
