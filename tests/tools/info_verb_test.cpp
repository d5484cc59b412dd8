// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: info ends with commands that fit the sensor and the input; an input that is not there is one error; nothing
// it prints stays English when Chinese is chosen. What it finds out about sensors: info_sensor_test.cpp.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "io/language/language.hpp"
#include "io/terminal/program_word.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

std::string road(const TempFolder& folder, const std::string& name, const std::string& sensor) {
  EXPECT_EQ(command({"sim", "-q", "--sensor", sensor, "--frames", "2", "--output", folder.file(name)}).exit_status, 0);
  return folder.file(name + "/frames");
}

TEST(InfoVerb, EndsWithCommandsThatFitTheSensor) {
  const TempFolder folder;
  const std::string frames = road(folder, "a road", "vlp16");
  const std::string text = command({"info", "-q", frames}).printed;
  EXPECT_TRUE(contains(text, "pose_wall doctor -o pose_wall.yaml '" + frames + "'\n")) << text;
  EXPECT_TRUE(contains(text, "pose_wall run --config vlp16 -o results.csv '" + frames + "'\n")) << text;
  const std::string other = road(folder, "other", "os1-64");
  EXPECT_FALSE(contains(command({"info", "-q", frames, other}).printed, "pose_wall run")) << "two sensors, two configs";
  EXPECT_TRUE(contains(command({"info", "-q", other, other}).printed, "--config os1-64 -o results.csv " + other + " "));
}

TEST(InfoVerb, WhatIsNotThereIsOneError) {
  const TempFolder folder;
  const std::string nowhere = folder.file("nowhere");
  const Ran ran = command({"info", nowhere});
  EXPECT_EQ(ran.exit_status, 1);
  EXPECT_EQ(ran.printed, "");
  EXPECT_EQ(ran.errors, "pose_wall info: " + nowhere + ": there is no such file or folder\n");
  EXPECT_EQ(command({"info", "--json", nowhere}).printed, "[]\n");
  const Ran broken = command({"info", folder.write("a.pcd", "no cloud")});
  EXPECT_EQ(broken.exit_status, 1);
  EXPECT_EQ(broken.printed, "") << "nothing could be read: no table of it";
  EXPECT_TRUE(contains(broken.errors, "a.pcd: ")) << broken.errors;
}

TEST(InfoVerb, SpeaksChinese) {
  const TempFolder folder;
  const std::string frames = road(folder, "road", "vlp16");
  const std::string english = command({"info", "-q", frames}).printed;
  const std::string chinese = command({"info", "-q", "--language", "zh", frames}).printed;
  choose_language(Language::kEnglish);
  for (const char* word : {"elevation", "looks like", "median", "Next:", "no return", "passed over", "understood"}) {
    EXPECT_FALSE(contains(chinese, word)) << word << "\n" << chinese;
  }
  EXPECT_TRUE(contains(chinese, "下一步")) << chinese;
  EXPECT_TRUE(contains(english, "Next:"));
  const Ran json = command({"info", "-q", "--language", "zh", "--json", frames});
  choose_language(Language::kEnglish);
  EXPECT_EQ(json.printed, command({"info", "-q", "--json", frames}).printed) << "JSON has no language";
}

// A frame of a VLP-16 in this format whose ring is `ring` of the point's own.
std::string frame_with_rings(const std::string& format, const std::function<std::uint32_t(std::size_t)>& ring) {
  const sim::Frame frame = sim::Simulator(sim::make_setup("clean", "vlp16", false, 1), 1).render(0);
  const std::string count = std::to_string(frame.count());
  std::string file = format == "pcd"
                         ? "VERSION 0.7\nFIELDS x y z ring\nSIZE 4 4 4 2\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH " + count +
                               "\nHEIGHT 1\nPOINTS " + count + "\nDATA ascii\n"
                     : format == "ply" ? "ply\nformat ascii 1.0\nelement vertex " + count +
                                             "\nproperty float x\nproperty float y\nproperty float z\n"
                                             "property ushort ring\nend_header\n"
                                       : "x,y,z,ring\n";
  const char* const between = format == "csv" ? "," : " ";
  for (std::size_t i = 0; i < frame.count(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      file += fmt::format("{}{}", frame.xyz_intensity[4 * i + axis], between);
    file += std::to_string(ring(i)) + "\n";
  }
  return file;
}

TEST(InfoVerb, AFieldOfOneRingHidesNoElevations) {
  for (const std::string format : {"pcd", "ply", "csv"}) {
    const TempFolder folder;
    const std::string zeros = folder.write("zeros." + format, frame_with_rings(format, [](std::size_t) { return 0; }));
    const auto sensor = [](const std::string& file) {
      return nlohmann::json::parse(command({"info", "--json", file}).printed).at(0).at("sensor");
    };
    EXPECT_EQ(sensor(zeros).at("class"), "vlp16") << format;
    EXPECT_EQ(sensor(zeros).at("rings"), 16) << format;
    EXPECT_EQ(sensor(zeros).at("rings_by"), "elevations") << format;
    const std::string told =
        folder.write("told." + format, frame_with_rings(format, [](std::size_t i) { return i % 32; }));
    EXPECT_EQ(sensor(told).at("rings"), 32) << format << ": many rings are believed";
  }
  const TempFolder folder;
  std::string planar = "x,y,z,ring\n";
  for (int k = 0; k < 720; ++k) {
    const double azimuth = 0.0087266 * k, tilt = 0.35;  // the scanner leans by 20 deg
    planar += fmt::format("{},{},{},0\n", 5.0 * std::cos(azimuth) * std::cos(tilt), 5.0 * std::sin(azimuth),
                          5.0 * std::cos(azimuth) * std::sin(tilt));
  }
  const Ran ran = command({"info", folder.write("planar.csv", planar)});
  EXPECT_TRUE(contains(ran.printed, "a planar scanner")) << ran.printed;
}

TEST(InfoVerb, NextCommandsBeginAsTheUserCalledTheProgram) {
  const TempFolder folder;
  ASSERT_EQ(command({"sim", "-q", "-n", "2", "-o", folder.file("road")}).exit_status, 0);
  const std::string frames = folder.file("road/frames");
  for (const char* typed : {"build/release/pose_wall", "./my programs/pose_wall"}) {
    const char* const words[] = {typed, "info", frames.c_str()};
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(run_command(3, words), 0);
    const std::string printed = ::testing::internal::GetCapturedStdout();
    const std::string word = contains(typed, " ") ? "'" + std::string(typed) + "'" : typed;
    EXPECT_TRUE(contains(printed, "\n  " + word + " doctor -o ")) << printed;
    EXPECT_FALSE(contains(printed, "\n  pose_wall ")) << printed;
  }
  set_program_word("pose_wall");
}

TEST(InfoVerb, DoesNotAdviseTheConfigThatHoldsTheDefaults) {
  const TempFolder folder;
  ASSERT_EQ(command({"sim", "-q", "-n", "2", "--sensor", "os0-128", "-o", folder.file("road")}).exit_status, 0);
  const std::string text = command({"info", folder.file("road/frames")}).printed;
  EXPECT_TRUE(contains(text, "the defaults are made for it")) << text;
  EXPECT_TRUE(contains(text, "run -o results.csv ")) << text;
  EXPECT_FALSE(contains(text, "--config")) << text;
}

}  // namespace
}  // namespace pose_wall::tools
