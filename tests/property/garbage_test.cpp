// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a thousand clouds of garbage (not finite, huge, denormal, all equal, on a line, two points, none, real frames
// with damage) are processed, and no result breaks a promise: states, numbers where numbers are promised, bounded
// counts. Deterministic; the libFuzzer targets in tests/fuzz look further.

#include <gtest/gtest.h>

#include <limits>

#include "support/garbage.hpp"
#include "support/promises.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

constexpr int kRounds = 40;

struct Kind {
  const char* name;
  void (*fill)(std::mt19937* random, Points* points);
};

void scatter(std::mt19937* random, Points* points, float reach) {
  for (auto& p : *points) {
    for (float& c : p) c = within(random, reach);
  }
}

const Kind kKinds[] = {
    {"any bits",
     [](std::mt19937* random, Points* points) {
       for (auto& p : *points) {
         for (float& c : p) c = any_bits(random);
       }
     }},
    {"scattered in a room", [](std::mt19937* random, Points* points) { scatter(random, points, 6.0F); }},
    {"scattered far and wide", [](std::mt19937* random, Points* points) { scatter(random, points, 200.0F); }},
    {"huge", [](std::mt19937* random, Points* points) { scatter(random, points, 1e30F); }},
    {"denormal", [](std::mt19937* random, Points* points) { scatter(random, points, 1e-40F); }},
    {"all zero",
     [](std::mt19937*, Points* points) {
       points->assign(points->size(), {0, 0, 0});
     }},
    {"all equal",
     [](std::mt19937* random, Points* points) {
       points->assign(points->size(), {within(random, 5), within(random, 5), within(random, 5)});
     }},
    {"no number among them",
     [](std::mt19937*, Points* points) {
       constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
       points->assign(points->size(), {kNan, kInf, -kInf});
     }},
    {"on a line",
     [](std::mt19937* random, Points* points) {
       const float dx = within(random, 1), dy = within(random, 1), dz = within(random, 1);
       for (auto& p : *points) {
         const float s = within(random, 9);
         p = {s * dx, s * dy + 2.0F, s * dz - 1.0F};
       }
     }},
    {"on a vertical line",
     [](std::mt19937* random, Points* points) {
       for (auto& p : *points) p = {1.0F, 2.0F, within(random, 3)};
     }},
    {"on one plane",
     [](std::mt19937* random, Points* points) {
       for (auto& p : *points) p = {within(random, 9), within(random, 9), -1.4F};
     }},
    {"a floor and points on one line beside it",
     [](std::mt19937* random, Points* points) {
       for (std::size_t i = 0; i < points->size(); ++i) {
         (*points)[i] = i % 2 == 0 ? std::array<float, 3>{within(random, 9), within(random, 3), -1.4F}
                                   : std::array<float, 3>{within(random, 9), 2.5F, 0.0F};
       }
     }},
    {"pairs",
     [](std::mt19937* random, Points* points) {
       for (std::size_t i = 0; i < points->size(); ++i)
         (*points)[i] = {static_cast<float>(i % 2), 3.0F, within(random, 0.01F)};
     }},
};

class Garbage : public ::testing::TestWithParam<Kind> {};

TEST_P(Garbage, BreaksNoPromise) {
  std::mt19937 random(11);
  const pose_wall_config config =
      config_with({{"points_max", "5000"}, {"ground_inlier_min", "20"}, {"wall_inlier_min", "20"}});
  EngineUnderTest engine(config);
  ContractWatch watch(config);
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t counts[] = {0, 1, 2, 3, 50, 99, 101, 1000, 6000};
    Points points(counts[static_cast<std::size_t>(round) % 9]);
    GetParam().fill(&random, &points);
    const pose_wall_result r = engine.process(cloud_of(points, round * 100000000LL));
    EXPECT_EQ(watch.processed(r), "") << round;
    EXPECT_EQ(r.points_in, points.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Garbage, ::testing::ValuesIn(kKinds), [](const auto& test) {
  std::string name = test.param.name;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

// Dust as thick as can be: points that fill the air evenly, at any number of them for the room there is. Voxels that
// had to grow would lie in layers. The lowest points may be told as a doubtful floor, but nothing passes for sure.
TEST(Garbage, OfPointsThatFillTheAirNothingIsValid) {
  std::mt19937 random(13);
  int without_voxels = 0;
  for (const char* points_max : {"5000", "16000", "60000"}) {
    for (const std::size_t count : {5000U, 20000U, 65000U, 131000U, 260000U}) {
      Points points(count);
      for (auto& p : points) p = {within(&random, 20), within(&random, 20), within(&random, 2.5F)};
      const pose_wall_config config = config_with({{"points_max", points_max}, {"ground_inlier_min", "150"}});
      EngineUnderTest engine(config);
      const pose_wall_result r = engine.process(cloud_of(points, 0));
      expect_promises(r, config, points_max);
      for (const pose_wall_value& v : r.quantity) EXPECT_NE(v.state, POSE_WALL_VALID) << points_max << " " << count;
      if (r.voxels == 0) {
        ++without_voxels;
        EXPECT_NE(r.frame_reasons & POSE_WALL_R_LEAF_GROWN, 0U) << points_max << " " << count;
        for (const pose_wall_value& v : r.quantity) EXPECT_NE(v.reasons & POSE_WALL_R_LEAF_GROWN, 0U) << points_max;
      }
      for (std::uint32_t q = POSE_WALL_YAW; q < POSE_WALL_QUANTITIES; ++q) {
        EXPECT_EQ(r.quantity[q].state, POSE_WALL_INVALID) << points_max << " " << count;
      }
    }
  }
  EXPECT_GT(without_voxels, 0);
}

// The lists of the frame before lie where other stages have written since.
TEST(Garbage, APointCloudThatDoesNotFitBetweenTwoRoadsLeavesNothingBehind) {
  const Points road = points_of(sim::Simulator(sim::make_setup("clean", "vlp16", false, 1), 1).render(0));
  std::mt19937 random(14);
  Points air(65000);
  for (auto& p : air) p = {within(&random, 20), within(&random, 20), within(&random, 2.5F)};
  for (const char* points_max : {"5000", "16000"}) {
    const pose_wall_config config = config_with({{"points_max", points_max}});
    EngineUnderTest engine(config);
    for (int round = 0; round < 3; ++round) {
      const pose_wall_result r = engine.process(cloud_of(road, 200000000LL * round));
      EXPECT_GT(r.voxels, 0U) << points_max;
      const pose_wall_result none = engine.process(cloud_of(air, 200000000LL * round + 100000000));
      EXPECT_EQ(none.voxels, 0U) << points_max;
      EXPECT_NE(none.frame_reasons & POSE_WALL_R_LEAF_GROWN, 0U) << points_max;
    }
  }
}

// A real-looking frame with a growing share of its coordinates replaced: the engine measures, weakens, holds, gives up.
TEST(Garbage, ADamagedRoadBreaksNoPromise) {
  const Points road = points_of(sim::Simulator(sim::make_setup("rough", "os1-64", false, 1), 1).render(0));
  std::mt19937 random(12);
  const pose_wall_config config = config_with();
  EngineUnderTest engine(config);
  ContractWatch watch(config);
  for (std::uint32_t percent = 0; percent <= 100; percent += 10) {
    Points points = road;
    for (auto& p : points) {
      if (random() % 100 < percent) p[random() % 3] = any_bits(&random);
    }
    EXPECT_EQ(watch.processed(engine.process(cloud_of(points, percent * 10000000LL))), "") << percent;
  }
}

TEST(Garbage, RandomDescriptionsAreRefusedOrProcessed) {
  std::mt19937 random(13);
  const pose_wall_config config = config_with({{"points_max", "5000"}});
  EngineUnderTest engine(config);
  ContractWatch watch(config);
  std::vector<unsigned char> bytes(6000);
  for (unsigned char& b : bytes) b = static_cast<unsigned char>(random());
  int processed = 0;
  for (int round = 0; round < 5000; ++round) {
    const auto small = [&](std::uint32_t bound) { return static_cast<std::uint32_t>(random() % bound); };
    const auto sometimes_huge = [&](std::uint32_t bound) {
      return random() % 8 == 0 ? static_cast<std::uint32_t>(random()) : small(bound);
    };
    const auto field = [&] { return pose_wall_field{sometimes_huge(20), small(10)}; };
    pose_wall_cloud c{};
    c.struct_size = sizeof c;
    c.big_endian = small(3);
    c.data = random() % 50 == 0 ? nullptr : bytes.data();
    c.data_bytes = random() % 2 == 0 ? bytes.size() : small(6000);
    c.width = sometimes_huge(60);
    c.height = sometimes_huge(4);
    c.point_step = sometimes_huge(40);
    c.row_step = random() % 2 == 0 ? 0 : sometimes_huge(3000);
    c.x = random() % 2 == 0 ? pose_wall_field{0, 7} : field();
    c.y = random() % 2 == 0 ? pose_wall_field{4, 7} : field();
    c.z = random() % 2 == 0 ? pose_wall_field{8, 7} : field();
    c.intensity = field();
    c.stamp_ns = static_cast<std::int64_t>((static_cast<std::uint64_t>(random()) << 32) | random());
    pose_wall_result r{};
    r.struct_size = sizeof r;
    const std::int32_t status = pose_wall_process(engine.get(), &c, &r);
    if (status == POSE_WALL_OK) {
      ++processed;
      EXPECT_EQ(watch.processed(r), "") << round;
    } else {
      EXPECT_STRNE(pose_wall_status_text(status), "unknown status") << status;
    }
  }
  EXPECT_GT(processed, 50) << "the descriptions are too wild to test anything";
}

TEST(Garbage, RandomConfigTextsAreRefusedOrKept) {
  std::mt19937 random(14);
  const char kLetters[] = "0123456789+-.eE ,[]xXyYzZ|nai\t";
  for (int round = 0; round < 20000; ++round) {
    pose_wall_config config = config_with();
    pose_wall_key_info key;
    ASSERT_EQ(pose_wall_config_key(static_cast<std::uint32_t>(random() % pose_wall_config_key_count()), &key),
              POSE_WALL_OK);
    std::string text(random() % 40, ' ');
    for (char& c : text) c = kLetters[random() % (sizeof kLetters - 1)];
    const std::int32_t status = pose_wall_config_set(&config, key.name, text.c_str());
    EXPECT_STRNE(pose_wall_status_text(status), "unknown status");
    const std::int32_t checked = pose_wall_config_check(&config, nullptr);
    EXPECT_TRUE(checked == POSE_WALL_OK || checked == POSE_WALL_E_CONFIG_RULE) << key.name << ": " << text;
  }
}

}  // namespace
}  // namespace pose_wall::test
