// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: clouds of a drive become scans, places and a map in which things are where they stand. A machine that is set
// down in the saved map is found in it, by its folder, cells and trail. Saved maps survive power cuts. Without a floor,
// in silence and with odometry of another run nothing is made up. Maps that cannot be read are named. A map whose
// earlier poses moved is built anew.

#include "apps/live/planar/roadway_sink.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "apps/live/planar/live_map.hpp"
#include "io/frames/whole_file.hpp"
#include "live/frame_catcher.hpp"
#include "live/hall_frames.hpp"
#include "live/synced_files.hpp"
#include "study/planar/plane_pose.hpp"
#include "support/said_by.hpp"
#include "tools/test_files.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

constexpr std::int64_t kFrame_ns = 100'000'000;

// No two places of it look alike.
Hall furnished_hall() {
  Hall hall;
  hall.wall_m = 7.0;
  hall.posts = {{4.0, 3.0, 0.4},   {5.5, -4.0, 0.8}, {-3.0, 4.5, 0.3},
                {-5.0, -2.0, 0.6}, {1.5, -5.5, 0.5}, {-5.5, 6.0, 0.7}};
  return hall;
}

class RoadwaySinkTest : public ::testing::Test {
 protected:
  void open(const std::string& mode, const std::vector<std::string>& more = {}) {
    std::vector<std::string> settings = hall_settings(mode);
    settings.insert(settings.end(), more.begin(), more.end());
    loaded_ = load_config("", settings);
    news_.clear();
    sink_ =
        make_roadway_sink(loaded_, [this](const std::shared_ptr<const RoadwayNews>& news) { news_.push_back(news); });
    sink_->start();
  }

  // What the engine publishes of such a cloud: a level floor 0 m below base.
  LiveResult result_of(const Hall& hall) {
    ++number_;
    LiveResult result;
    result.config = *loaded_.config.get();
    result.header_stamp_ns = number_ * kFrame_ns + 7;
    result.frame = hall_frame(number_ * kFrame_ns, number_, hall, 48);
    result.publication.cause = POSE_WALL_RUNTIME_FRAME;
    pose_wall_result& r = result.publication.result;
    r.struct_size = sizeof r;
    r.floor.found = 1;
    r.floor.normal[2] = 1.0;
    r.floor.extent_max_m = 15.0;
    for (const std::size_t q : {POSE_WALL_ROLL, POSE_WALL_PITCH}) {
      r.quantity[q].state = r.quantity[q].raw_state = POSE_WALL_VALID;
      r.quantity[q].sigma = 1e-3;
      r.quantity[q].raw_protection_level = r.quantity[q].protection_level = 5e-3;
    }
    return result;
  }
  const RoadwayNews& take(const LiveResult& result) {
    sink_->take(result);
    return *news_.back();
  }
  // On a bend, a decimetre a frame.
  const RoadwayNews& drive(int frames, Hall* hall) {
    for (int k = 0; k < frames; ++k) {
      take(result_of(*hall));
      hall->x_m += 0.1 * std::cos(hall->yaw_rad), hall->y_m += 0.1 * std::sin(hall->yaw_rad);
      hall->yaw_rad += 0.02;
    }
    return *news_.back();
  }
  static std::int8_t cell_at(const RoadwayMap& map, double x_m, double y_m) {
    const auto column = static_cast<std::size_t>((x_m - map.origin_x_m) / map.resolution_m);
    const auto row = static_cast<std::size_t>((y_m - map.origin_y_m) / map.resolution_m);
    return map.cells.at(row * map.width + column);
  }

  LoadedConfig loaded_;
  std::unique_ptr<Sink> sink_;
  std::vector<std::shared_ptr<const RoadwayNews>> news_;
  int number_ = 0;
};

TEST_F(RoadwaySinkTest, ADriveBecomesAMapAndPlaces) {
  open("map", {"planar_map_every_s=1"});
  Hall hall = furnished_hall();
  for (int k = 0; k < 40; ++k) {
    const Hall truth = hall;
    const RoadwayNews& news = drive(1, &hall);
    ASSERT_TRUE(news.has_scan);
    ASSERT_TRUE(news.pose) << news.state;
    EXPECT_NEAR(news.pose->x_m, truth.x_m, 0.03) << k;
    EXPECT_NEAR(news.pose->y_m, truth.y_m, 0.03) << k;
    EXPECT_NEAR(news.pose->yaw_rad, truth.yaw_rad, 0.01) << k;
    EXPECT_EQ(news.header_stamp_ns, number_ * kFrame_ns + 7);
  }
  EXPECT_EQ(sink_->health().summary, "maps");
  EXPECT_EQ(fact(sink_->health(), "scans with a place"), "40");
  EXPECT_GT(std::stoi(fact(sink_->health(), "keyframes")), 5);
  ASSERT_TRUE(news_.front()->map) << "the first map is there with the first scan";
  EXPECT_EQ(news_.front()->map->version, 1U);
}

TEST_F(RoadwaySinkTest, TheMapHasThingsWhereTheyStandAndFreeCellsBetween) {
  open("map", {"planar_map_every_s=1"});
  Hall hall = furnished_hall();
  drive(6, &hall);
  std::this_thread::sleep_for(std::chrono::milliseconds(1010));  // planar_map_every_s
  const RoadwayNews& news = drive(1, &hall);
  ASSERT_TRUE(news.map);
  EXPECT_GE(news.map->version, 2U) << "where the drive took longer than a second, a map came on the way";
  EXPECT_EQ(news.map->resolution_m, 0.05);
  int thing = -1;
  for (const double y_m : {-0.1, -0.05, 0.0, 0.05, 0.1}) {
    for (const double x_m : {6.9, 6.95, 7.0, 7.05}) thing = std::max<int>(thing, cell_at(*news.map, x_m, y_m));
  }
  EXPECT_GE(thing, 65) << "the wall ahead";
  EXPECT_LE(cell_at(*news.map, 3.0, 0.5), 35);
  EXPECT_GE(cell_at(*news.map, 3.0, 0.5), 0);
  EXPECT_EQ(cell_at(*news.map, 5.5, -4.0), POSE_WALL_PLANAR_UNKNOWN) << "inside of a post";
  ASSERT_TRUE(news.track);
  EXPECT_GE(news.track->size(), 2U);
}

TEST_F(RoadwaySinkTest, ASavedMapIsWhereAMachineIsFoundAgain) {
  test::TempFolder folder;
  const std::string trail = folder.path() + "/trail.pwt";
  open("map", {"planar_map=" + trail, "planar_map_every_s=1"});
  Hall hall = furnished_hall();
  drive(39, &hall);
  std::this_thread::sleep_for(std::chrono::milliseconds(1010));  // planar_map_every_s
  const std::uint32_t width = drive(1, &hall).map->width;
  watch_syncs(trail);
  sink_->stop();
  std::vector<std::string> synced;
  for (const auto& one : synced_files()) synced.push_back(one.path.filename().string());
  for (const std::string part : {part_of("trail.pwt"), part_of("map.pgm"), part_of("map.yaml")}) {
    EXPECT_EQ(std::count(synced.begin(), synced.end(), part), 1) << part << " survives no power cut";
  }

  Hall set_down = furnished_hall();
  set_down.x_m = 1.5, set_down.y_m = 0.6, set_down.yaw_rad = 0.7;
  for (const char* file : {"", "trail.pwt", "map.yaml"}) {  // the folder first
    open("localise", {"planar_map=" + folder.path() + "/" + file, "planar_map_whole=yes"});
    Hall at = set_down;
    const RoadwayNews* news = nullptr;
    for (int k = 0; k < 60; ++k) {
      const Hall truth = at;
      news = &drive(1, &at);
      ASSERT_TRUE(news->has_scan);
      if (!news->pose) continue;
      EXPECT_EQ(news->state, "unique");
      EXPECT_NEAR(news->pose->x_m, truth.x_m, 0.1) << file;
      EXPECT_NEAR(news->pose->y_m, truth.y_m, 0.1) << file;
      EXPECT_GT(news->covariance[0], 0.0);
    }
    EXPECT_TRUE(news->pose) << file << ": " << news->state;
    ASSERT_TRUE(news->map) << file;
    EXPECT_EQ(news->map->width, width);
  }
  std::filesystem::remove(folder.path() + "/map.yaml");
  open("localise", {"planar_map=" + trail});
  const RoadwayNews& alone = drive(1, &set_down);
  ASSERT_TRUE(alone.map) << "a trail alone is shown by its surfaces";
  EXPECT_NE(std::count(alone.map->cells.begin(), alone.map->cells.end(), 100), 0);
}

TEST_F(RoadwaySinkTest, AMapThatIsThereAlreadyIsKeptAndAFolderThatIsGoneLaterHurtsNobody) {
  test::TempFolder folder;
  folder.write("trail.pwt", "an earlier one");
  Hall hall = furnished_hall();
  std::filesystem::create_directory(folder.path() + "/gone");
  for (const char* file : {"/trail.pwt", "/gone/trail.pwt"}) {
    open("map", {"planar_map=" + folder.path() + file});
    std::filesystem::remove(folder.path() + "/gone");
    EXPECT_TRUE(drive(2, &hall).pose);
    sink_->stop();
    std::filesystem::create_directory(folder.path() + "/gone");
  }
  std::ifstream earlier(folder.path() + "/trail.pwt");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(earlier), {}), "an earlier one");
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/map.yaml"));
}

TEST_F(RoadwaySinkTest, AFolderThatIsMissingAtTheStartIsNamed) {
  test::TempFolder folder;
  const std::string path = folder.path() + "/missing/trail.pwt";
  const std::string said = test::said_by<std::runtime_error>([&] { open("map", {"planar_map=" + path}); });
  EXPECT_EQ(said, "planar_map: " + path + ": there is no folder " + folder.path() +
                      "/missing; allowed: a file in a folder that is there");
}

TEST_F(RoadwaySinkTest, MapsThatCannotBeReadAreNamed) {
  test::TempFolder folder;
  folder.write("broken.pwt", "no trail");
  folder.write("broken.yaml", "image: x.pgm\n");
  for (const char* file : {"nowhere.pwt", "broken.pwt", "nowhere.yaml", "broken.yaml"}) {
    const std::string path = folder.path() + "/" + file;
    const std::string said = test::said_by<std::runtime_error>([&] {
      open("localise", {"planar_map=" + path, "planar_map_whole=yes"});
    });
    EXPECT_EQ(said.rfind("planar_map: " + path, 0), 0U) << file << ": " << said;
  }
}

TEST_F(RoadwaySinkTest, WithoutAFloorThereIsNoScanAndInSilenceNoNews) {
  open("map");
  LiveResult no_floor = result_of(furnished_hall());
  no_floor.publication.result.floor.found = 0;
  no_floor.publication.result.quantity[POSE_WALL_ROLL].state = POSE_WALL_INVALID;
  const RoadwayNews& news = take(no_floor);
  EXPECT_FALSE(news.has_scan || news.pose || news.map);
  EXPECT_EQ(sink_->health().grade, Grade::kWarning);
  EXPECT_EQ(sink_->health().summary, "no floor is measured: there is no scan");
  LiveResult silence = result_of(furnished_hall());
  silence.publication.cause = POSE_WALL_RUNTIME_SILENCE;
  sink_->take(silence);
  EXPECT_EQ(news_.size(), 1U);
}

TEST_F(RoadwaySinkTest, OdometryOfAnotherRunTellsNoWay) {
  open("map");
  Hall hall = furnished_hall();
  for (int k = 0; k < 12; ++k) {
    LiveResult result = result_of(hall);
    result.publication.has_motion = 1;
    pose_wall_motion_result& moved = result.publication.motion;
    moved.along_state = POSE_WALL_ALONG_MEASURED;
    moved.run = k < 6 ? 5 : 9;
    // The new run counts from elsewhere, 100 m away.
    moved.position_m[0] = 0.1 * k + (k < 6 ? 0.0 : 100.0);
    moved.quaternion[3] = 1.0;
    const RoadwayNews& news = take(result);
    ASSERT_TRUE(news.pose) << k << " " << news.state;
    ASSERT_TRUE(news.odometry);
    EXPECT_NEAR(news.pose->x_m, 0.1 * k, 0.05) << k;
    hall.x_m += 0.1;
  }
}

TEST_F(RoadwaySinkTest, AFloorThatIsNotWhereTheKeySaysIsTold) {
  open("map", {"planar_floor_z=-1"});
  take(result_of(furnished_hall()));
  EXPECT_EQ(sink_->health().summary, "maps; the floor is not at planar_floor_z");
  EXPECT_EQ(fact(sink_->health(), "floor z m"), "-0.00");
  EXPECT_EQ(sink_->health().grade, Grade::kWarning);
}

TEST(LiveMap, ThingsSurviveLargerCells) {
  const std::vector<std::int8_t> cells = {-1, 0,  100, -1, -1,  //
                                          -1, 20, 0,   -1, 50};
  std::vector<std::int8_t> coarse(3);
  coarsen_rows(cells.data(), 5, 2, 2, coarse.data());
  EXPECT_EQ(coarse, (std::vector<std::int8_t>{20, 100, 50}));
}

// A SLAM that says that earlier poses have moved, though they have not: the map built anew is the same.
TEST(LiveMap, IsBuiltAnewBesideThePresentOne) {
  pose_wall_planar_slam_settings settings{};
  ASSERT_EQ(pose_wall_planar_slam_settings_init(&settings), POSE_WALL_OK);
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_planar_slam_memory_needed(&settings, &bytes), POSE_WALL_OK);
  const PartBlock block(bytes);
  pose_wall_planar_slam* slam = nullptr;
  ASSERT_EQ(pose_wall_planar_slam_open(&settings, block.data(), block.bytes(), &slam), POSE_WALL_OK);
  LiveMap map(0.1);
  Hall hall = furnished_hall();
  std::vector<float> range_m(720);
  pose_wall_planar_slam_result placed{};
  placed.struct_size = sizeof placed;
  const auto add = [&](std::uint32_t moved) {
    for (std::size_t k = 0; k < range_m.size(); ++k) {
      range_m[k] = static_cast<float>(hall.range_m(-M_PI + 2.0 * M_PI * static_cast<double>(k) / 720.0));
    }
    pose_wall_planar_scan scan{};
    scan.struct_size = sizeof scan;
    scan.beams = 720;
    scan.angle_min_rad = -M_PI, scan.angle_step_rad = 2.0 * M_PI / 720.0;
    scan.range_max_m = 30.0, scan.sigma_m = 0.01;
    scan.range_m = range_m.data();
    ASSERT_EQ(pose_wall_planar_slam_process(slam, &scan, nullptr, &placed), POSE_WALL_OK);
    placed.solution += moved;
    map.add(scan, placed, slam);
    hall.x_m += 0.1;
  };
  for (int k = 0; k < 60; ++k) add(0);
  const auto before = map.changed(1);
  ASSERT_TRUE(before);
  EXPECT_FALSE(map.changed(2)) << "nothing has changed since";
  EXPECT_EQ(map.rebuilt(), 0U);
  hall.x_m -= 0.1;  // stands: no new keyframe, so the same scans
  for (int k = 0; k < 5; ++k) add(1000), hall.x_m -= 0.1;
  EXPECT_EQ(map.rebuilt(), 1U);
  const auto after = map.changed(3);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->version, 2U);
  ASSERT_EQ(after->width, before->width);
  ASSERT_EQ(after->height, before->height);
  std::size_t differing = 0;
  for (std::size_t k = 0; k < after->cells.size(); ++k) {
    const auto is_thing = [k](const RoadwayMap& of) { return of.cells[k] >= 65; };
    if (is_thing(*after) != is_thing(*before)) ++differing;
  }
  EXPECT_LE(differing, 20U);
}

}  // namespace
}  // namespace pose_wall::tools::live
