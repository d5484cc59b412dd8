// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the image in a map's picture holds the map's cells, by an independent reader of its stream; things survive
// where cells are drawn coarser; lines lie where their places say.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#if POSE_WALL_HAS_ZLIB
#include <zlib.h>
#endif

#include "io/planar_files/map_files.hpp"
#include "study/planar/indexed_png.hpp"
#include "study/planar/map_picture.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::contains;

constexpr std::array<Rgb, 4> kColours = {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word = word << 8U | static_cast<unsigned char>(bytes.at(at + k));
  return word;
}

TEST(IndexedPng, HasItsChunksInOrder) {
  const std::string png = indexed_png(3, 2, {0, 1, 2, 3, 0, 1}, kColours);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::vector<std::string> kinds;
  for (std::size_t at = 8; at < png.size(); at += 12 + word_at(png, at)) kinds.push_back(png.substr(at + 4, 4));
  EXPECT_EQ(kinds, (std::vector<std::string>{"IHDR", "PLTE", "IDAT", "IEND"}));
  EXPECT_EQ(word_at(png, 16), 3U);
  EXPECT_EQ(word_at(png, 20), 2U);
}

#if POSE_WALL_HAS_ZLIB
// The pixels, as zlib and the rule of the filter give them; checksums are checked.
std::vector<std::uint8_t> pixels_of(const std::string& png, std::size_t width, std::size_t height) {
  std::string stream;
  for (std::size_t at = 8; at < png.size(); at += 12 + word_at(png, at)) {
    const std::string content = png.substr(at + 4, 4 + word_at(png, at));
    const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
    EXPECT_EQ(word_at(png, at + 4 + content.size()), crc);
    if (content.substr(0, 4) == "IDAT") stream = content.substr(4);
  }
  const std::size_t row_bytes = (width + 3) / 4;
  std::vector<Bytef> rows((row_bytes + 1) * height);
  uLongf size = rows.size();
  EXPECT_EQ(uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(stream.data()), stream.size()), Z_OK);
  EXPECT_EQ(size, rows.size());
  std::vector<std::uint8_t> pixels;
  std::vector<Bytef> above(row_bytes);
  for (std::size_t y = 0; y < height; ++y) {
    const Bytef* row = &rows[y * (row_bytes + 1)];
    EXPECT_EQ(row[0], 2) << "the difference from the row above";
    for (std::size_t k = 0; k < row_bytes; ++k) above[k] = static_cast<Bytef>(above[k] + row[k + 1]);
    for (std::size_t x = 0; x < width; ++x) {
      pixels.push_back(static_cast<std::uint8_t>(above[x / 4] >> (6 - 2 * (x % 4)) & 3));
    }
  }
  return pixels;
}

TEST(IndexedPng, AnIndependentReaderFindsItsPixels) {
  std::mt19937 random(7);
  for (const auto& [width, height] : {std::pair<std::uint32_t, std::uint32_t>{1, 1}, {5, 3}, {640, 200}, {1031, 7}}) {
    for (const unsigned change_one_in : {1U, 40U, 100'000U}) {  // noise, a map, hardly anything
      std::vector<std::uint8_t> pixels(std::size_t{width} * height);
      std::uint8_t shade = 0;
      for (std::uint8_t& pixel : pixels) {
        if (random() % change_one_in == 0) shade = static_cast<std::uint8_t>(random() & 3U);
        pixel = shade;
      }
      EXPECT_EQ(pixels_of(indexed_png(width, height, pixels, kColours), width, height), pixels) << width;
    }
  }
}
#endif

TEST(MapPicture, DrawsLinesAndPlacesAndEscapesWords) {
  MapFile map;
  map.width = 100;
  map.height = 50;
  map.resolution_m = 0.1;
  map.cells.assign(5000, 0);
  MapScene scene;
  scene.grid = map.grid();
  scene.title = "a <b> & c";
  scene.lines = {{{{0.0, 0.0}, {10.0, 5.0}}, kTrailColour}};
  scene.machines = {{{5.0, 2.5, 0.0}, roadheader_outline(), kPathColour, "here"}};
  scene.legend = {{kTrailColour, "trail"}};
  const std::string svg = map_picture(scene);
  EXPECT_TRUE(contains(svg, "a &lt;b> &amp; c")) << svg.substr(0, 600);
  // The map is 10 x 5 m: from its corner below left to the one above right, 1300 pixels long.
  EXPECT_TRUE(contains(svg, R"(<polyline points="36.0,734.0 1336.0,84.0 ")")) << svg.substr(svg.find("<polyline"), 80);
  EXPECT_TRUE(contains(svg, ">here</text>"));
  EXPECT_EQ(svg, map_picture(scene));
}

// Where words begin, by their text.
std::pair<double, double> place_of_words(const std::string& svg, const std::string& words) {
  const std::size_t end = svg.find(">" + words + "</text>");
  const std::size_t begin = svg.rfind("<text", end);
  double x = 0.0, y = 0.0;
  EXPECT_EQ(std::sscanf(svg.c_str() + begin, "<text x=\"%lf\" y=\"%lf\"", &x, &y), 2) << svg.substr(begin, 60);
  return {x, y};
}

TEST(MapPicture, WordsOfNeighboursCoverNeitherEachOtherNorTheEdge) {
  MapFile map;
  map.width = 100;
  map.height = 50;
  map.resolution_m = 0.1;
  map.cells.assign(5000, 0);
  MapScene scene;
  scene.grid = map.grid();
  for (const char* words : {"start", "end", "goal", "here"}) {
    scene.machines.push_back({{9.9, 2.5, 0.0}, {}, kPathColour, words});
  }
  const std::string svg = map_picture(scene);
  std::vector<std::pair<double, double>> places;
  for (const MapMachine& machine : scene.machines) {
    const auto [x, y] = place_of_words(svg, machine.words);
    EXPECT_LT(x + 6.0 * static_cast<double>(machine.words.size()), 1336.0) << machine.words << " is cut off";
    for (const auto& [other_x, other_y] : places) {
      EXPECT_TRUE(std::abs(y - other_y) >= 13.0 || std::abs(x - other_x) >= 30.0) << machine.words;
    }
    places.emplace_back(x, y);
  }
}

TEST(MapPicture, NumbersAtTheEdgesArePlacesOfTheMap) {
  MapFile map;
  map.width = 100;
  map.height = 50;
  map.resolution_m = 0.1;
  map.origin_x_m = -4.0;
  map.origin_y_m = 20.0;
  map.cells.assign(5000, 0);
  MapScene scene;
  scene.grid = map.grid();
  const std::string svg = map_picture(scene);  // 130 pixels a metre, from 36, 84
  EXPECT_NEAR(place_of_words(svg, "-3").first, 36.0 + 130.0, 0.1);
  EXPECT_NEAR(place_of_words(svg, "24").second, 84.0 + 130.0, 5.0);
}

TEST(MapPicture, AThingOfOneCellIsSeenInALargeMap) {
  MapFile map;
  map.width = 8000;
  map.height = 10;
  map.resolution_m = 0.05;
  map.cells.assign(80'000, 0);
  MapScene scene;
  scene.grid = map.grid();
  const std::string without = map_picture(scene);
  map.cells[5 * 8000 + 4321] = 100;
  scene.grid = map.grid();
  EXPECT_NE(map_picture(scene), without);
}

}  // namespace
}  // namespace pose_wall::tools
