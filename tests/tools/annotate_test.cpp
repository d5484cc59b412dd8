// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: annotated clouds are files that our own readers take, with labels, colours and distances that agree with the
// result; that no folder of somebody's frames is written into. That other programs read them was tried by hand with
// PCL.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/frames/load_frame.hpp"
#include "io/frames/point_position.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

struct Road {
  Road() {
    EXPECT_EQ(command({"sim", "--scene", "clean", "--sensor", "vlp16", "-n", "3", "--set", "range_noise_m=0.01", "-q",
                       "-o", folder.file("road")})
                  .exit_status,
              0);
  }
  Ran annotate(const std::string& to, std::vector<std::string> more = {}) const {
    return command({"run", "-q", "-c", folder.file("road/pose_wall.yaml"), "-o", folder.file("o.csv"), "--annotate",
                    folder.file(to), folder.file("road/frames")},
                   more);
  }
  std::vector<std::string> files_of(const std::string& name) const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder.file(name))) {
      files.push_back(entry.path().filename().string());
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  TempFolder folder;
};

// The fields behind x y z by hand: PCD label residual rgb, PLY red green blue label residual, both as floats.
struct Row {
  Eigen::Vector3d p_base_m;
  std::uint32_t label;
  float residual_m;
  std::uint32_t rgb;
};

std::vector<Row> rows_of(const std::string& file) {
  const Frame frame = load_frame(file);
  const bool is_ply = file.substr(file.size() - 3) == "ply";
  EXPECT_EQ(frame.cloud.point_step, is_ply ? 23U : 24U);
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < frame.cloud.width; ++i) {
    Row row{point_position(frame.cloud, 0, i), 0, 0, 0};
    const auto* point = static_cast<const char*>(frame.cloud.data) + std::size_t{i} * frame.cloud.point_step;
    std::memcpy(&row.residual_m, point + (is_ply ? 19 : 16), 4);
    const auto* colour = reinterpret_cast<const unsigned char*>(point + (is_ply ? 12 : 20));
    if (is_ply) {
      float label = -1.0F;
      std::memcpy(&label, point + 15, 4);
      row.label = static_cast<std::uint32_t>(label);
    } else {
      std::memcpy(&row.label, point + 12, 4);
    }
    row.rgb = is_ply ? static_cast<std::uint32_t>(colour[0] << 16 | colour[1] << 8 | colour[2])
                     : static_cast<std::uint32_t>(colour[2] << 16 | colour[1] << 8 | colour[0]);
    rows.push_back(row);
  }
  return rows;
}

TEST(Annotate, LabelsDistancesAndColoursAgree) {
  const Road road;
  ASSERT_EQ(road.annotate("labelled").exit_status, 0);
  EXPECT_EQ(road.files_of("labelled"), (std::vector<std::string>{"000000.pcd", "000001.pcd", "000002.pcd"}));
  std::array<std::size_t, 4> counts{};
  for (const Row& row : rows_of(road.folder.file("labelled/000001.pcd"))) {
    ASSERT_LT(row.label, 4U);
    ++counts[row.label];
    EXPECT_EQ(row.rgb, (std::array<std::uint32_t, 4>{0xb3b8bc, 0xb98b4e, 0x2274a5, 0x7a4ea3})[row.label]);
    if (row.label == POSE_WALL_LABEL_OTHER) {
      EXPECT_TRUE(std::isnan(row.residual_m));
      continue;
    }
    // A clean road, the walls 2.5 m from a machine that stands straight in it: five standard deviations of the ranges,
    // and of what the machine leans (less than 0.1 degrees) over 20 m.
    EXPECT_LT(std::abs(row.residual_m), 0.05 + 0.035) << row.label;
    const double to_machine_m = row.label == POSE_WALL_LABEL_FLOOR  ? row.residual_m
                                : row.label == POSE_WALL_LABEL_LEFT ? 2.5 - row.p_base_m.y()
                                                                    : 2.5 + row.p_base_m.y();
    EXPECT_NEAR(row.residual_m, to_machine_m, 0.04) << row.label << " + is the machine's side";
  }
  for (const std::size_t count : counts) EXPECT_GT(count, 500U);
}

TEST(Annotate, PlyHoldsTheSame) {
  const Road road;
  ASSERT_EQ(road.annotate("pcd").exit_status, 0);
  ASSERT_EQ(road.annotate("ply", {"--annotate-format", "ply"}).exit_status, 0);
  const std::vector<Row> a = rows_of(road.folder.file("pcd/000002.pcd")),
                         b = rows_of(road.folder.file("ply/000002.ply"));
  ASSERT_EQ(a.size(), b.size());
  const std::string head = text_of(road.folder.file("ply/000002.ply")).substr(0, 1000);
  for (const char* property : {"float scalar_label\n", "float scalar_residual_m\n", "uchar red\n"}) {
    EXPECT_TRUE(contains(head, std::string("property ") + property)) << "CloudCompare and Open3D pass others over";
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].p_base_m, b[i].p_base_m);
    ASSERT_EQ(a[i].label, b[i].label);
    ASSERT_EQ(a[i].rgb, b[i].rgb);
    ASSERT_TRUE(a[i].residual_m == b[i].residual_m || (std::isnan(a[i].residual_m) && std::isnan(b[i].residual_m)));
  }
}

TEST(Annotate, AnUnreadableFrameLeavesNoFileNotEvenAnOldOne) {
  const Road road;
  ASSERT_EQ(road.annotate("labelled").exit_status, 0);
  road.folder.write("road/frames/000001.pcd", "no cloud");
  std::filesystem::remove(road.folder.file("road/frames/000002.pcd"));
  EXPECT_EQ(road.annotate("labelled").exit_status, 1);
  EXPECT_EQ(road.files_of("labelled"), std::vector<std::string>{"000000.pcd"});
}

TEST(Annotate, OthersFramesAreNotWrittenOver) {
  const Road road;
  const std::string frame = road.folder.file("road/frames/000000.pcd"), before = text_of(frame);
  std::filesystem::create_directories(road.folder.file("other"));
  std::filesystem::copy(frame, road.folder.file("other/000000.pcd"));
  for (const char* to : {"road/frames", "other"}) {
    EXPECT_TRUE(test::says(road.annotate(to), 2, "choose another folder"));
  }
  const Ran single = command({"run", "-q", "--annotate", road.folder.file("road/frames"), frame});
  EXPECT_EQ(single.exit_status, 2);
  EXPECT_EQ(text_of(frame), before);
  EXPECT_EQ(text_of(road.folder.file("other/000000.pcd")), before);
  EXPECT_EQ(road.annotate("o.csv").exit_status, 2) << "a file is in the way";
}

}  // namespace
}  // namespace pose_wall::tools
