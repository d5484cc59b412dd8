// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: for points that are no numbers, out of every range, without a shape, in wrong units or with axes mixed up,
// the seven states are those of the table; nothing valid comes of what shows no road; and the engine is back as
// promised. States also what cannot be known: a road mirrored or scaled is a road. In a sequence the jump gives it away
// (degraded, and the level reaches to both); from the first frame on nothing does, see Undetectable.

#include <array>
#include <limits>
#include <random>

#include "fault_room.hpp"

namespace pose_wall::test {
namespace {

using Point = std::array<float, 3>;

struct PointCase {
  const char* name;
  const char* states;  // of the frame with the fault, after a good one
  bool is_the_room;    // what is told must be true of the room
  void (*spoil)(Points*);
};

void PrintTo(const PointCase& c, std::ostream* out) {
  *out << c.name;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
constexpr float kGreatest = std::numeric_limits<float>::max(), kLeast = std::numeric_limits<float>::min();
constexpr float kDenormal = std::numeric_limits<float>::denorm_min();

void all(Points* points, float value) {
  points->assign(points->size(), {value, value, value});
}
void axis(Points* points, std::size_t k, float value, std::size_t every = 1) {
  for (std::size_t i = 0; i < points->size(); i += every) (*points)[i][k] = value;
}
void scale(Points* points, float factor) {
  for (Point& p : *points) {
    for (float& c : p) c *= factor;
  }
}
void swap_axes(Points* points, std::size_t a, std::size_t b) {
  for (Point& p : *points) std::swap(p[a], p[b]);
}
template <typename Where>
void keep(Points* points, const Where& where) {
  points->erase(std::remove_if(points->begin(), points->end(), [&](const Point& p) { return !where(p); }),
                points->end());
}
void zero(Points* points, std::uint32_t percent) {
  std::mt19937 random(4);
  for (Point& p : *points) {
    if (random() % 100 < percent) p = {0, 0, 0};
  }
}
// As many points as the room has, by their number.
template <typename Make>
void make(Points* points, const Make& of) {
  for (std::size_t i = 0; i < points->size(); ++i) (*points)[i] = of(static_cast<float>(i));
}
float part(float i, float of) {
  return std::fmod(i, of) / of;
}
// Every point onto a sphere about the sensor.
void onto_range(Points* points, float range) {
  for (Point& p : *points) {
    const float factor = range / std::hypot(p[0], p[1], p[2]);
    for (float& c : p) c *= factor;
  }
}
void noise(Points* points, double sigma_m) {
  std::mt19937 random(5);
  std::normal_distribution<double> error(0.0, sigma_m);
  for (Point& p : *points) {
    for (float& c : p) c += static_cast<float>(error(random));
  }
}

// Some of what comes back from the left wall comes by way of another face: a wall more, this far behind.
void throw_ghosts(Points* points, std::uint32_t percent, float behind_m) {
  std::mt19937 random(6);
  for (Point& p : *points) {
    if (p[1] < 2.4F || random() % 100 >= percent) continue;
    const float factor = 1.0F + behind_m / p[1];
    for (float& c : p) c *= factor;
  }
}

const PointCase kPointCases[] = {
    {"nan_everywhere", "H", true, [](auto* p) { all(p, kNan); }},
    {"nan_in_x", "H", true, [](auto* p) { axis(p, 0, kNan); }},
    {"nan_in_y", "H", true, [](auto* p) { axis(p, 1, kNan); }},
    {"nan_in_z", "H", true, [](auto* p) { axis(p, 2, kNan); }},
    {"nan_in_every_second_x", "VVx....", true, [](auto* p) { axis(p, 0, kNan, 2); }},
    {"inf_in_x", "H", true, [](auto* p) { axis(p, 0, kInf); }},
    {"inf_in_y", "H", true, [](auto* p) { axis(p, 1, kInf); }},
    {"inf_in_z", "H", true, [](auto* p) { axis(p, 2, kInf); }},
    {"minus_inf_in_x", "H", true, [](auto* p) { axis(p, 0, -kInf); }},
    {"minus_inf_in_y", "H", true, [](auto* p) { axis(p, 1, -kInf); }},
    {"minus_inf_in_z", "H", true, [](auto* p) { axis(p, 2, -kInf); }},
    {"inf_in_every_second_z", "VVx....", true, [](auto* p) { axis(p, 2, kInf, 2); }},
    {"largest_float_in_x", "H", true, [](auto* p) { axis(p, 0, kGreatest); }},
    {"largest_float_in_y", "H", true, [](auto* p) { axis(p, 1, kGreatest); }},
    {"largest_float_in_z", "H", true, [](auto* p) { axis(p, 2, kGreatest); }},
    {"minus_largest_float_everywhere", "H", true, [](auto* p) { all(p, -kGreatest); }},
    {"largest_float_now_and_then", "L", true, [](auto* p) { axis(p, 0, kGreatest, 50); }},
    {"denormals", "H", true, [](auto* p) { all(p, kDenormal); }},
    {"least_floats", "H", true, [](auto* p) { all(p, kLeast); }},
    {"denormals_in_z", "h", true, [](auto* p) { axis(p, 2, kDenormal); }},
    {"squares_that_overflow", "H", true, [](auto* p) { all(p, 2e19F); }},

    {"zeros_everywhere", "H", true, [](auto* p) { all(p, 0.0F); }},
    {"zeros_of_74_percent", "VVVVVVV", true, [](auto* p) { zero(p, 74); }},
    {"zeros_of_99_percent", "x", true, [](auto* p) { zero(p, 99); }},
    {"all_points_equal", "H", false, [](auto* p) { all(p, 2.0F); }},
    {"two_points", "H", false, [](auto* p) { make(p, [](float i) {
                                               return Point{1, 2, part(i, 2)};
                                             }); }},
    {"on_a_line_along_x", "H", false, [](auto* p) { make(p, [](float i) {
                                                      return Point{part(i, 997) * 9, 2, -1};
                                                    }); }},
    {"on_a_line_along_z", "H", false, [](auto* p) { make(p, [](float i) {
                                                      return Point{2, 2, part(i, 997) * 3};
                                                    }); }},
    {"on_a_diagonal", "H", false,
     [](auto* p) { make(p, [](float i) {
                     return Point{part(i, 997) * 9, part(i, 997) * 3, part(i, 997) - 1.4F};
                   }); }},
    {"on_one_level", "LLhhhhh", false,
     [](auto* p) { make(p, [](float i) {
                     return Point{part(i, 151) * 12 - 6, part(i, 97) * 5 - 2.5F, -1.4F};
                   }); }},
    {"on_one_upright_plane", "h", false,
     [](auto* p) { make(p, [](float i) {
                     return Point{part(i, 151) * 12 - 6, 2.5F, part(i, 97) * 3 - 1.4F};
                   }); }},
    {"pairs", "H", false,
     [](auto* p) { make(p, [](float i) {
                     return Point{part(i, 2) * 2, 3, part(i, 997) * 0.02F};
                   }); }},
    {"a_floor_and_a_line_beside_it", "LLhhhhh", false,
     [](auto* p) {
       make(p, [](float i) {
         const bool floor = part(i, 2) == 0.0F;
         return floor ? Point{part(i, 151) * 12 - 6, part(i, 97) * 5 - 2.5F, -1.4F} : Point{part(i, 151) * 9, 2.5F, 0};
       });
     }},
    {"a_lattice_that_fills_the_air", "x", false,
     [](auto* p) {
       make(p, [](float i) { return Point{part(i, 29) * 12 - 6, part(i, 31) * 8 - 4, part(i, 23) * 4 - 2}; });
     }},
    {"a_fine_lattice", "x", false,
     [](auto* p) { make(p, [](float i) {
                     return Point{part(i, 29) + 1, part(i, 31), part(i, 23) - 1.5F};
                   }); }},
    {"one_ring_on_the_floor", "LLhhhhh", true,
     [](auto* p) { make(p, [](float i) {
                     return Point{3 * std::cos(i), 3 * std::sin(i), -1.4F};
                   }); }},
    {"one_ring_all_around", "h", true,
     [](auto* p) { keep(p, [](const Point& q) { return std::fabs(q[2]) < 0.03F * std::hypot(q[0], q[1]); }); }},

    {"all_at_range_max", "x", false, [](auto* p) { onto_range(p, 30.0F); }},
    {"all_just_beyond_range_max", "H", false, [](auto* p) { onto_range(p, 30.001F); }},
    {"all_at_range_min", "x", false, [](auto* p) { onto_range(p, 0.3F); }},
    {"all_just_within_range_min", "H", false, [](auto* p) { onto_range(p, 0.299F); }},
    {"a_sphere_of_5_m", "x", false, [](auto* p) { onto_range(p, 5.0F); }},

    {"millimetres", "H", true, [](auto* p) { scale(p, 1000.0F); }},
    {"centimetres", "H", true, [](auto* p) { scale(p, 100.0F); }},
    {"inches", "H", true, [](auto* p) { scale(p, 39.37F); }},
    {"feet", "h", true, [](auto* p) { scale(p, 3.2808F); }},
    {"kilometres", "H", true, [](auto* p) { scale(p, 0.001F); }},
    {"decimetres", "h", true, [](auto* p) { scale(p, 10.0F); }},

    {"x_and_y_swapped", "VVhhhhh", true, [](auto* p) { swap_axes(p, 0, 1); }},
    {"x_and_z_swapped", "x", true, [](auto* p) { swap_axes(p, 0, 2); }},
    {"y_and_z_swapped", "VVhhhhh", true, [](auto* p) { swap_axes(p, 1, 2); }},

    {"left_half_only", "...LLhh", true, [](auto* p) { keep(p, [](const Point& q) { return q[1] > 0.0F; }); }},
    {"right_half_only", "...hhLL", true, [](auto* p) { keep(p, [](const Point& q) { return q[1] < 0.0F; }); }},
    {"front_half_only", ".", true, [](auto* p) { keep(p, [](const Point& q) { return q[0] > 0.0F; }); }},
    {"floor_only", "..hhhhh", true, [](auto* p) { keep(p, [](const Point& q) { return q[2] < -1.35F; }); }},
    {"no_floor", "h", true, [](auto* p) { keep(p, [](const Point& q) { return q[2] > -1.0F; }); }},
    {"roof_only", "h", true, [](auto* p) { keep(p, [](const Point& q) { return q[2] > 1.7F; }); }},
    {"every_tenth_point", ".", true,
     [](auto* p) {
       Points some;
       for (std::size_t i = 0; i < p->size(); i += 10) some.push_back((*p)[i]);
       *p = some;
     }},
    {"ghosts_of_a_tenth_of_a_wall", "V", true, [](auto* p) { throw_ghosts(p, 10, 1.5F); }},
    {"ghosts_of_a_fifth_of_a_wall", "V", true, [](auto* p) { throw_ghosts(p, 20, 1.5F); }},
    {"noise_of_half_a_metre", "x", true, [](auto* p) { noise(p, 0.5); }},
    {"noise_of_10_cm", ".", true, [](auto* p) { noise(p, 0.1); }},
    {"moved_by_100_m", "H", true,
     [](auto* p) {
       for (Point& q : *p) q[0] += 100.0F;
     }},
    {"rounded_to_centimetres", "V", true,
     [](auto* p) {
       for (Point& q : *p) {
         for (float& c : q) c = std::round(c * 100.0F) / 100.0F;
       }
     }},
    {"every_point_twice", "V", true, [](auto* p) { p->insert(p->end(), room_frame(1).begin(), room_frame(1).end()); }},
    {"the_last_frame_again", "D", true, [](auto* p) { *p = room_frame(0); }},
    {"backwards", "V", true, [](auto* p) { std::reverse(p->begin(), p->end()); }},
};

class PointFaults : public ::testing::TestWithParam<PointCase> {};

TEST_P(PointFaults, GiveTheStatesOfTheTable) {
  FaultRoom room;
  ASSERT_EQ(states_of(room.good(0)), "VVVVVVV");
  Points points = room_frame(1);
  GetParam().spoil(&points);
  const pose_wall_result r = room.process(cloud_of(points, kPeriod_ns));
  EXPECT_TRUE(matches(states_of(r), GetParam().states)) << states_of(r) << ", not " << GetParam().states;
  if (GetParam().is_the_room) {
    EXPECT_EQ(misleading(r, kRoomTruth), "") << states_of(r);
  }
  EXPECT_LE(room.frames_until_valid(kPeriod_ns), kBackWithin);
}

INSTANTIATE_TEST_SUITE_P(Faults, PointFaults, ::testing::ValuesIn(kPointCases),
                         [](const auto& test) { return name_of(test.param.name); });

// As many voxels as there is room for, one less and one more: points on a level, each in a voxel of its own.
class Capacity : public ::testing::TestWithParam<int> {};

TEST_P(Capacity, OneVoxelTooManyGrowsTheLeaf) {
  constexpr int kPointsMax = 5000;
  pose_wall_config config = small_config();
  set(&config, "points_max", std::to_string(kPointsMax).c_str());
  FaultRoom room(config);
  Points points;
  for (int i = 0; i < kPointsMax + GetParam(); ++i) {
    points.push_back({0.1F * static_cast<float>(i % 80) - 4.0F, 0.1F * static_cast<float>(i / 80) - 3.0F, -1.4F});
  }
  const pose_wall_result r = room.process(cloud_of(points, 0));
  const bool grown = (r.frame_reasons & POSE_WALL_R_LEAF_GROWN) != 0;
  EXPECT_EQ(grown, GetParam() > 0);
  if (GetParam() <= 0) {
    EXPECT_EQ(r.voxels, points.size());
  }
  EXPECT_EQ(r.points_in, points.size());
}

const char* capacity_name(int more) {
  return more == 0 ? "points_max" : (more > 0 ? "one_more_than_points_max" : "one_less_than_points_max");
}

INSTANTIATE_TEST_SUITE_P(Faults, Capacity, ::testing::Values(-1, 0, 1),
                         [](const auto& test) { return capacity_name(test.param); });

}  // namespace
}  // namespace pose_wall::test
