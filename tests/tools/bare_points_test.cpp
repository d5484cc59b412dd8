// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: how many numbers make a point of a file without a header is found by the numbers, in any order of the points,
// for every layout that is known; where they do not show it the file is refused with the layouts that are possible; the
// files of a recording are read alike; --layout says otherwise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "io/frames/bare_layout_guess.hpp"
#include "io/frames/load_frame.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

struct Point {
  double x, y, z;
};

// A road of 5 m by 3 m, looked at all round; `shift_m` moves it, so that all coordinates may be positive.
std::vector<Point> road(std::size_t count, double shift_m, bool shuffled) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> along(-15.0, 15.0), around(-2.5, 2.5), up(-1.5, 1.5);
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2.0 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(count);
    const double x = shuffled ? along(random) : 15.0 * std::cos(turn);
    const double y = i % 3 == 0 ? around(random) : (i % 3 == 1 ? 2.5 : -2.5);
    const double z = i % 3 == 0 ? -1.5 : up(random);
    points.push_back({x + shift_m, y + shift_m, z + shift_m});
  }
  return points;
}

// The points as the layout has them: intensity 0 to 1, rings 0 to 15, times within 0.1 s, 1 in columns passed over.
std::string written(const std::vector<Point>& points, const std::string& word, double intensity_max = 1.0) {
  const BareLayout layout = *parse_bare_layout(word);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::string text;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const char letter : layout.columns) {
      const double value = letter == 'x'   ? points[i].x
                           : letter == 'y' ? points[i].y
                           : letter == 'z' ? points[i].z
                           : letter == 'i' ? std::floor(share(random) * 100.0) / 100.0 * intensity_max
                           : letter == 'r' ? static_cast<double>(i % 16)
                           : letter == 't' ? 1e-5 * static_cast<double>(i % 10000)
                                           : 1.0;
      text += layout.value_bytes == 8 ? raw(value) : raw(static_cast<float>(value));
    }
  }
  return text;
}

TEST(BareLayout, IsOneLetterForEachValue) {
  EXPECT_EQ(parse_bare_layout("xyzi")->point_step(), 16U);
  EXPECT_EQ(parse_bare_layout("xyz64")->point_step(), 24U);
  EXPECT_EQ(parse_bare_layout("i_zyx__")->point_step(), 28U);
  for (const char* word : {"", "xy", "xyzz", "xyzq", "XYZ", "xyz32", "64", "xyzii"}) {
    EXPECT_FALSE(parse_bare_layout(word)) << word;
  }
  const Frame frame =
      read_bare_points(bytes_of(raw(9.0) + raw(3.0) + raw(2.0) + raw(1.0)), *parse_bare_layout("_zyx64"));
  EXPECT_EQ(frame.cloud.width, 1U);
  EXPECT_EQ(number_at(frame, frame.cloud.x, 0), 1.0);
  EXPECT_EQ(number_at(frame, frame.cloud.z, 0), 3.0);
}

TEST(BareLayout, ASizeThatIsNoWholeNumberOfPointsIsRefused) {
  const auto read_xyzi = [](Bytes bytes) { return read_bare_points(std::move(bytes), *parse_bare_layout("xyzi")); };
  EXPECT_EQ(refusal(read_xyzi, std::string(17, 'x')),
            "17 bytes are not a multiple of 16 (float32 x y z intensity, 16 bytes a point)");
}

// 960 points: their bytes divide by every candidate's, so that only the values tell.
TEST(BareGuess, EveryLayoutIsFoundInAnyOrderAndPlace) {
  for (const bool shuffled : {false, true}) {
    for (const double shift_m : {0.0, 20.0}) {
      const std::vector<Point> points = road(9600, shift_m, shuffled);
      for (const char* word : {"xyz", "xyzi", "xyzir", "xyzi_", "xyz64", "xyzi64", "xyzirt", "xyz_i___"}) {
        const BareGuess guess = guess_bare_layout(bytes_of(written(points, word)));
        ASSERT_FALSE(guess.possible.empty()) << word;
        EXPECT_TRUE(guess.is_clear) << word << ", shuffled " << shuffled << ", shift " << shift_m;
        EXPECT_TRUE(guess.possible.front().same_bytes(*parse_bare_layout(word)))
            << word << " taken for " << bare_layout_word(guess.possible.front()) << ", shuffled " << shuffled
            << ", shift " << shift_m;
      }
    }
  }
}

// A turn of a sensor with 16 rings in a road, in the order of measurement: x y z intensity ring time and padding.
std::string turn(const std::string& word, bool shuffled) {
  std::vector<std::string> points;
  for (int step = 0; step < 600; ++step) {
    for (int ring = 0; ring < 16; ++ring) {
      const double azimuth = step * M_PI / 300.0, elevation = (2 * ring - 15) * M_PI / 180.0;
      const double side = 2.5 / std::max(std::fabs(std::sin(azimuth)), 0.05), up = 1.5 / std::fabs(std::tan(elevation));
      const double across = std::min(side, up);
      std::string point;
      for (const char letter : word) {
        const double value = letter == 'x'   ? across * std::cos(azimuth)
                             : letter == 'y' ? across * std::sin(azimuth)
                             : letter == 'z' ? across * std::tan(elevation)
                             : letter == 'i' ? (step * 7919 + ring * 104729) % 251
                             : letter == 'r' ? ring
                             : letter == 't' ? step * 166e-6 + ring * 2e-6
                             : letter == 'n' ? std::sin(step * 7.0 + ring)
                             : letter == '1' ? 1.0
                                             : 0.0;
        point += raw(static_cast<float>(value));
      }
      points.push_back(point);
    }
  }
  if (shuffled) std::shuffle(points.begin(), points.end(), std::mt19937(2));
  std::string text;
  for (const std::string& point : points) text += point;
  return text;
}

TEST(BareGuess, PointsThatAreHalvesOfOthersAreNotTaken) {
  const std::pair<const char*, const char*> cases[] = {
      {"xyz", "xyz"},       {"xyzi", "xyzi"},         {"xyzir", "xyzir"},       {"xyzit", "xyzit"},
      {"xyzirt", "xyzirt"}, {"xyzitr", "xyzitr"},     {"xyz1irt0", "xyz_irt_"}, {"xyz1itr0", "xyz_itr_"},
      {"xyz1", "xyzi"},     {"xyz1i000", "xyz_i___"}, {"xyzi01", "xyzi__"}};
  for (const bool shuffled : {false, true}) {
    for (const auto& [word, right] : cases) {
      const BareGuess guess = guess_bare_layout(bytes_of(turn(word, shuffled)));
      ASSERT_FALSE(guess.possible.empty()) << word;
      EXPECT_TRUE(guess.is_clear) << word << (shuffled ? " shuffled" : "");
      EXPECT_EQ(bare_layout_word(guess.possible.front()), right) << word << (shuffled ? " shuffled" : "");
    }
  }
}

TEST(BareGuess, LayoutsThatNobodyKnowsAreAskedAbout) {
  for (const char* word : {"xyznnn", "xyz1nnn0i000", "xyzt"}) {
    const std::string said = refusal(read_guessed_points, turn(word, false));
    EXPECT_TRUE(contains(said, "--layout")) << word << ": " << said;
  }
}

TEST(BareGuess, IntensitiesOfAByteAndMillimetresAreFoundToo) {
  const std::vector<Point> points = road(9600, 0.0, true);
  EXPECT_EQ(bare_layout_word(guess_bare_layout(bytes_of(written(points, "xyzi", 255.0))).possible.front()), "xyzi");
  std::vector<Point> millimetres = points;
  for (Point& p : millimetres) p = {1e3 * p.x, 1e3 * p.y, 1e3 * p.z};
  for (const char* word : {"xyz", "xyzi"}) {
    const BareGuess guess = guess_bare_layout(bytes_of(written(millimetres, word)));
    EXPECT_TRUE(guess.is_clear && bare_layout_word(guess.possible.front()) == word) << word;
  }
}

// What a float32 x y z file whose size divides by 16 used to be: KITTI, without a word.
TEST(BareGuess, NeverTakesAnotherLayoutForSure) {
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    std::vector<Point> points;
    std::normal_distribution<double> wide(0.0, 1.0 + round), low(0.0, 0.3 + 0.1 * round);
    for (int i = 0; i < 960; ++i) points.push_back({wide(random), wide(random), low(random) - 1.0});
    for (const char* word : {"xyz", "xyzi", "xyz64"}) {
      const BareGuess guess = guess_bare_layout(bytes_of(written(points, word)));
      if (!guess.is_clear) continue;
      EXPECT_TRUE(guess.possible.front().same_bytes(*parse_bare_layout(word))) << word << " in round " << round;
    }
  }
}

TEST(BareGuess, WhatTheValuesDoNotShowIsRefusedWithTheChoice) {
  const std::string few = written(road(4, 0.0, false), "xyz");  // 48 bytes
  const std::string said = refusal(read_guessed_points, few);
  for (const char* part : {"leave a choice", "float32 x y z intensity, 16 bytes a point",
                           "float32 x y z, 12 bytes a point", "--layout xyzi or --layout xyz"}) {
    EXPECT_TRUE(contains(said, part)) << said;
  }
  std::mt19937 random(7);
  std::string noise, same;
  for (int i = 0; i < 4800; ++i) noise += raw(static_cast<std::uint32_t>(random()));
  for (int i = 0; i < 4800; ++i) same += raw(std::uniform_real_distribution<float>(1.0F, 2.0F)(random));
  EXPECT_TRUE(contains(refusal(read_guessed_points, noise), "do not look like bare points")) << "random bits";
  EXPECT_TRUE(contains(refusal(read_guessed_points, same), "--layout")) << "one kind of value, as a file of times";
  EXPECT_TRUE(contains(refusal(read_guessed_points, "abc"), "3 bytes do not look like"));
}

TEST(BareGuess, AFewPointsAreTakenByTheirSizeWhereOnlyOneFits) {
  EXPECT_EQ(read_guessed_points(bytes_of(written(road(1, 0.0, false), "xyzi"))).cloud.width, 1U);
  EXPECT_EQ(read_guessed_points(bytes_of(written(road(3, 0.0, false), "xyz"))).cloud.width, 3U);
  EXPECT_EQ(read_guessed_points({}).cloud.width, 0U);
}

TEST(BareGuess, DamageNeverDescribesMoreThanThereIs) {
  EXPECT_TRUE(test::survives_damage(read_guessed_points, written(road(12, 0.0, false), "xyzi")));
}

TEST(BareFiles, TheFilesOfARecordingAreReadAlikeAndTheChoiceIsSaid) {
  const TempFolder folder;
  folder.write("f/0.bin", written(road(4, 0.0, false), "xyz"));  // does not tell
  folder.write("f/1.bin", written(road(960, 0.0, false), "xyz"));
  folder.write("f/2.bin", written(road(960, 0.0, false), "xyzi"));  // tells otherwise
  FrameSequence frames({folder.file("f")});
  ASSERT_EQ(frames.notes().size(), 1U);
  EXPECT_EQ(frames.notes().front(), folder.file("f/1.bin") +
                                        ": there is no header; by its values read as float32 x y z, 12 bytes a point. "
                                        "--layout says otherwise");
  EXPECT_EQ(frames.next()->frame->cloud.width, 4U);
  EXPECT_EQ(frames.next()->frame->cloud.width, 960U);
  const std::optional<SourcedFrame> other = frames.next();
  EXPECT_FALSE(other->frame);
  EXPECT_TRUE(contains(other->error, "look like float32 x y z intensity, 16 bytes a point")) << other->error;
  EXPECT_TRUE(contains(frames.about().kind, "float32 x y z, 12 bytes a point"));
}

TEST(BareFiles, FilesThatAreNamedOneByOneAreOneRecording) {
  const TempFolder folder;
  const std::string few = folder.write("a.bin", written(road(4, 0.0, false), "xyz"));
  const std::string many = folder.write("b.bin", written(road(960, 0.0, false), "xyz"));
  FrameSequence frames({few, many});
  EXPECT_EQ(frames.notes().size(), 1U);
  EXPECT_EQ(frames.next()->frame->cloud.width, 4U);
}

TEST(RunVerb, SaysHowItReadsPointsWithoutAHeader) {
  const TempFolder folder;
  const std::string file = folder.write("a.bin", written(road(960, 0.0, false), "xyz"));
  const std::string out = folder.file("o.csv");
  Ran ran = command({"run", "-o", out, file});
  EXPECT_TRUE(contains(ran.errors, "by its values read as float32 x y z, 12 bytes a point")) << ran.errors;
  ran = command({"run", "-o", out, "--layout", "xyzi", file});
  EXPECT_TRUE(contains(ran.errors, "read as float32 x y z intensity, 16 bytes a point, as --layout says"))
      << ran.errors;
  EXPECT_EQ(test::table_of(out).cell(0, *test::table_of(out).find_column("points_in")), "720");
  EXPECT_FALSE(contains(command({"run", "-q", "-o", out, file}).errors, "header"));
  ran = command({"run", "-o", out, "--layout", "xyq", file});
  EXPECT_EQ(ran.exit_status, 2);
  EXPECT_TRUE(contains(ran.errors, "one letter for each value")) << ran.errors;
  const std::string ply =
      folder.write("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                   "end_header\n1 2 3\n");
  ran = command({"run", "-o", out, "--layout", "xyz", ply});
  EXPECT_EQ(ran.exit_status, 2);
  EXPECT_TRUE(contains(ran.errors, "every input has a header")) << ran.errors;
}

}  // namespace
}  // namespace pose_wall::tools
