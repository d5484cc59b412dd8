// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "io/planar_files/map_files.hpp"
#include "io/planar_files/pgm_image.hpp"
#include "support/said_by.hpp"

namespace {

using namespace pose_wall::tools;

class PlanarMapFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("planar_map_files_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string text(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  std::string refusal(const std::filesystem::path& yaml) const {
    return test::said_by<MapFileError>([&] { (void)read_map_files(yaml); });
  }

  std::filesystem::path folder_;
};

// As ROS 1's map_saver writes them, byte by byte: top row first.
const std::string kSaverImage =
    "P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n3 2\n255\n" + std::string("\xFE\x00\xCD\xFE\xFE\xCD", 6);
constexpr const char* kSaverYaml =
    "image: map.pgm\nresolution: 0.050000\norigin: [-1.000000, 2.500000, 0.000000]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n\n";

TEST_F(PlanarMapFiles, AMapOfMapSaverIsReadFromItsBottomRowUp) {
  file("map.pgm", kSaverImage);
  const MapFile map = read_map_files(file("map.yaml", kSaverYaml));
  EXPECT_EQ(map.width, 3U);
  EXPECT_EQ(map.height, 2U);
  EXPECT_EQ(map.resolution_m, 0.05);
  EXPECT_EQ(map.origin_x_m, -1.0);
  EXPECT_EQ(map.origin_y_m, 2.5);
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{0, 0, -1, 0, 100, -1}));
  EXPECT_EQ(map.note, "");
  const pose_wall_planar_grid grid = map.grid();
  EXPECT_EQ(grid.struct_size, sizeof(grid));
  EXPECT_EQ(grid.cells[4], 100);
}

TEST_F(PlanarMapFiles, OneIsWrittenAsMapSaverWritesIt) {
  const std::vector<std::int8_t> cells = {0, 34, -1, 35, 65, 50};
  const pose_wall_planar_grid grid{sizeof(grid), 3, 2, 0, 0.05, -1.25, 2.5, cells.data()};
  write_map_files(folder_ / "road.yaml", grid);
  EXPECT_EQ(text("road.pgm"), "P5\n# pose_wall 0.050 m/pix\n3 2\n255\n" + std::string("\xFE\x00\xCD\xFE\xFE\xCD", 6));
  EXPECT_EQ(text("road.yaml"),
            "image: road.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.25, 2.5, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const MapFile map = read_map_files(folder_ / "road.yaml");
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{0, 0, -1, 0, 100, -1}));
  EXPECT_EQ(map.origin_x_m, -1.25);
}

TEST_F(PlanarMapFiles, NamesThatYamlWouldMisreadAreQuoted) {
  const std::int8_t cell = 0;
  const pose_wall_planar_grid grid{sizeof(grid), 1, 1, 0, 0.05, 0.0, 0.0, &cell};
  for (const char* const name : {"road #1: east.yaml", "it's.yaml", "- a.yaml", "井下.yaml"}) {
    write_map_files(folder_ / name, grid);
    EXPECT_EQ(read_map_files(folder_ / name).cells.size(), 1U) << name;
  }
}

TEST_F(PlanarMapFiles, NegateTurnsDarkAndBright) {
  file("map.pgm", kSaverImage);
  std::string yaml = kSaverYaml;
  yaml.replace(yaml.find("negate: 0"), 9, "negate: true");
  const MapFile map = read_map_files(file("map.yaml", yaml));
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{100, 100, 100, 100, 0, 100}));
}

TEST_F(PlanarMapFiles, ThresholdsDecideAndAreNotReachedByTheirOwnValue) {
  // Darkness 0.8, 0.6, 0.4, 0.2 of a white of 10, as text.
  file("map.pgm", "P2\n# by hand\n4 1\n10\n2 4\n6 8");
  const auto with = [&](const char* occupied, const char* free, const char* mode) {
    return read_map_files(
               file("map.yaml", std::string("image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n") +
                                    "occupied_thresh: " + occupied + "\nfree_thresh: " + free + "\nmode: " + mode +
                                    "\n"))
        .cells;
  };
  using Cells = std::vector<std::int8_t>;
  EXPECT_EQ(with("0.7", "0.3", "trinary"), (Cells{100, -1, -1, 0}));
  EXPECT_EQ(with("0.5", "0.45", "trinary"), (Cells{100, 100, 0, 0}));
  EXPECT_EQ(with("0.9", "0.1", "trinary"), (Cells{-1, -1, -1, -1}));
  EXPECT_EQ(with("0.9", "0.1", "scale"), (Cells{88, 62, 38, 12}));
  EXPECT_EQ(with("0.7", "0.3", "scale"), (Cells{100, 75, 25, 0}));
  EXPECT_EQ(with("0.7", "0.3", "raw"), (Cells{2, 4, 6, 8}));
}

// Nav2's own saver wrote 0.25 until its pull request 5278 (2025).
TEST_F(PlanarMapFiles, UnknownStaysUnknownUnderThresholdsThatWouldFreeIt) {
  file("map.pgm", kSaverImage);
  std::string yaml = kSaverYaml;
  yaml.replace(yaml.find("0.196"), 5, "0.25");
  const MapFile map = read_map_files(file("map.yaml", yaml));
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{0, 0, -1, 0, 100, -1}));
  EXPECT_EQ(map.note, "free_thresh (0.25) would make 2 unknown cells free (pixel 205); they stay unknown");
}

TEST_F(PlanarMapFiles, SixteenBitsAreReadHighByteFirst) {
  file("map.pgm", "P5 2 1 1000\n" + std::string("\x03\xE8\x00\x64", 4));
  const MapFile map = read_map_files(file("map.yaml", kSaverYaml));
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{0, 100}));
}

TEST_F(PlanarMapFiles, WhatIsWrongIsNamedWithFileLineAndKey) {
  file("map.pgm", kSaverImage);
  const auto with = [&](const std::string& key, const std::string& value) {
    std::string yaml;
    for (const char* const line : {"image: map.pgm", "resolution: 0.05", "origin: [-1, 2.5, 0]", "negate: 0",
                                   "occupied_thresh: 0.65", "free_thresh: 0.196"}) {
      const std::string text = line;
      if (text.compare(0, key.size() + 1, key + ":") != 0)
        yaml += text + "\n";
      else if (!value.empty())
        yaml += key + ": " + value + "\n";
    }
    return refusal(file("map.yaml", yaml));
  };
  const std::string name = (folder_ / "map.yaml").string();
  EXPECT_EQ(with("none", ""), "");
  EXPECT_EQ(with("resolution", ""), name + ": the key 'resolution' is missing");
  EXPECT_EQ(with("resolution", "5 cm"), name + ":2: resolution (5 cm) must be a number from 0.01 to 1");
  EXPECT_EQ(with("resolution", ".nan"), name + ":2: resolution (.nan) must be a number from 0.01 to 1");
  EXPECT_EQ(with("origin", "[1, 2]"), name + ":3: origin (1 2) must be three numbers, [x, y, yaw]");
  EXPECT_EQ(with("origin", "[1, 2, 3, 4]"), name + ":3: origin (1 2 3 4) must be three numbers, [x, y, yaw]");
  EXPECT_EQ(with("origin", "[1, 2, 0.5]"),
            name + ":3: origin (1 2 0.5) must be without a yaw: turned maps are not read");
  EXPECT_EQ(with("negate", "maybe"), name + ":4: negate (maybe) must be 0 or 1");
  EXPECT_EQ(with("occupied_thresh", "65"), name + ":5: occupied_thresh (65) must be a number from 0 to 1");
  EXPECT_EQ(with("free_thresh", "0.7"), name + ":6: free_thresh (0.7) must be below occupied_thresh (0.65)");
  EXPECT_EQ(with("image", "none.pgm"), (folder_ / "none.pgm").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(refusal(folder_ / "gone.yaml"),
            (folder_ / "gone.yaml").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(refusal(file("map.yaml", "image: [")).find(name + ":2: not YAML"), 0U);
}

TEST_F(PlanarMapFiles, AnImageThatIsNoneIsRefused) {
  const std::string picture = (folder_ / "map.pgm").string();
  const auto with = [&](const std::string& bytes) {
    file("map.pgm", bytes);
    return refusal(file("map.yaml", kSaverYaml));
  };
  EXPECT_EQ(with(""), picture + ": the image is no PGM: it must begin with P5 or P2");
  EXPECT_EQ(with("P6 1 1 255\nabc"), picture + ": the image is no PGM: it must begin with P5 or P2");
  EXPECT_EQ(with("P5 0 1 255\n"), picture + ": the image's width must be from 1 to 32768");
  EXPECT_EQ(with("P5 99999999999 1 255\n"), picture + ": the image's width must be from 1 to 32768");
  EXPECT_EQ(with("P5 32768 32768 255\nxxx"), picture + ": the image is cut off: 22 of 1073741824 bytes of pixels");
  EXPECT_EQ(with("P5 5 1 255\nxxxx"), picture + ": the image is cut off: 4 of 5 bytes of pixels");
  EXPECT_EQ(with("P5 1 1 100\nx"), picture + ": a pixel of 120 is whiter than the image's white, 100");
  EXPECT_EQ(with("P5 1 1 # no end"), picture + ": the image ends or has no number where its white is expected");
  EXPECT_EQ(with("P5 1 1 255"), picture + ": the image ends before its first pixel");
}

// Whatever stands in the files: a map or a refusal.
TEST_F(PlanarMapFiles, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(1);
  std::uint32_t refused = 0, read = 0;
  for (int round = 0; round < 400; ++round) {
    std::string image = kSaverImage, yaml = kSaverYaml;
    for (std::string* const bytes : {&image, &yaml}) {
      for (auto k = random() % 3; k > 0; --k) (*bytes)[random() % bytes->size()] = static_cast<char>(random());
      if (random() % 8 == 0) bytes->resize(random() % bytes->size());
    }
    file("map.pgm", image);
    const auto path = file("map.yaml", yaml);
    try {
      const MapFile map = read_map_files(path);
      ASSERT_EQ(map.cells.size(), std::size_t{map.width} * map.height);
      for (const std::int8_t cell : map.cells) ASSERT_TRUE(cell >= -1 && cell <= 100);
      ++read;
    } catch (const MapFileError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 40U);
  EXPECT_GT(read, 40U);
}

}  // namespace
