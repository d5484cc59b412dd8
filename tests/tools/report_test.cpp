// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a report holds every frame with the numbers that run writes, names what could not be read, stays one file
// that asks for nothing, thins long recordings, and leaves what was there alone where it cannot be made. What the page
// does in a browser: checks/check_report_page.py.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "io/frames/whole_file.hpp"
#include "ran_command.hpp"
#include "study/report/cloud_choice.hpp"
#include "study/report/columns.hpp"
#include "study/results/usability.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// The same way back, by the rules of RFC 4648.
std::string from_base64(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6 | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 255U);
  }
  return bytes;
}

template <typename Number>
std::vector<Number> column(const nlohmann::json& data, const char* name) {
  const std::string bytes = from_base64(data.at(name));
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

nlohmann::json data_of_report(const std::string& file) {
  const std::string page = text_of(file), start = "<script id=\"data\" type=\"application/json\">";
  const std::size_t from = page.find(start) + start.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

// A simulated road in a folder.
struct Road {
  explicit Road(const std::string& frames) {
    EXPECT_EQ(command({"sim", "--scene", "clean", "--sensor", "vlp16", "--frames", frames, "--quiet", "--output",
                       folder.file("road")})
                  .exit_status,
              0);
  }
  Ran report(std::vector<std::string> more = {}) const {
    return command({"report", "--config", folder.file("road/pose_wall.yaml"), "--output", folder.file("out.html"),
                    folder.file("road/frames")},
                   more);
  }
  nlohmann::json data() const { return data_of_report(folder.file("out.html")); }

  TempFolder folder;
};

TEST(Base64, IsThatOfTheStandard) {
  // RFC 4648, section 10.
  EXPECT_EQ(report::base64(""), "");
  EXPECT_EQ(report::base64("f"), "Zg==");
  EXPECT_EQ(report::base64("fo"), "Zm8=");
  EXPECT_EQ(report::base64("foo"), "Zm9v");
  EXPECT_EQ(report::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(report::base64("\xff\xfe\xfd"), "//79");
}

TEST(ReportVerb, HoldsTheNumbersThatRunWrites) {
  const Road road("3");
  const Ran ran = road.report({"--truth", road.folder.file("road/truth.csv")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "3 frames, points of 3 of them")) << ran.errors;
  ASSERT_EQ(command({"run", "--quiet", "--config", road.folder.file("road/pose_wall.yaml"), "--output",
                     road.folder.file("o.csv"), road.folder.file("road/frames")})
                .exit_status,
            0);
  const CsvTable table = table_of(road.folder.file("o.csv"));
  const nlohmann::json data = road.data();
  const auto values = column<float>(data, "value"), levels = column<float>(data, "level");
  const auto truth = column<float>(data, "truth");
  const auto raw_levels = column<float>(data, "raw_level"), parts = column<float>(data, "part");
  const auto causes = column<std::uint8_t>(data, "cause");
  ASSERT_EQ(values.size(), 21U);
  ASSERT_EQ(parts.size(), 21U * POSE_WALL_PARTS);
  const char* const names[] = {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"};
  for (std::size_t f = 0; f < 3; ++f) {
    for (std::size_t q = 0; q < 7; ++q) {
      const std::string name = names[q];
      EXPECT_FLOAT_EQ(values[7 * f + q], static_cast<float>(table.number(f, *table.find_column(name)))) << name << f;
      EXPECT_FLOAT_EQ(levels[7 * f + q], static_cast<float>(table.number(f, *table.find_column(name + "_pl"))));
      EXPECT_FLOAT_EQ(raw_levels[7 * f + q], static_cast<float>(table.number(f, *table.find_column(name + "_raw_pl"))));
      const auto first = parts.begin() + static_cast<std::ptrdiff_t>(POSE_WALL_PARTS * (7 * f + q));
      EXPECT_NEAR(std::accumulate(first, first + POSE_WALL_PARTS, 0.0), levels[7 * f + q], 1e-6 * levels[7 * f + q]);
      EXPECT_EQ(causes[7 * f + q], std::max_element(first, first + POSE_WALL_PARTS) - first) << name << f;
      EXPECT_EQ(pose_wall_part_name(causes[7 * f + q]), table.cell(f, *table.find_column(name + "_cause")));
      EXPECT_NEAR(values[7 * f + q], truth[7 * f + q], levels[7 * f + q]) << name << f;
    }
  }
  EXPECT_GT(column<std::uint8_t>(data, "point_label").size(), 1000U);
}

// The page falls back to English, which nobody would notice.
TEST(ReportVerb, ChineseHasEveryReasonPartAndSense) {
  const Road road("1");
  ASSERT_EQ(road.report().exit_status, 0);
  const nlohmann::json data = road.data();
  EXPECT_EQ(data.at("positive_means"),
            (std::vector<std::uint32_t>{POSE_WALL_SENSE_RIGHT_DOWN, POSE_WALL_SENSE_NOSE_DOWN,
                                        POSE_WALL_SENSE_TURNED_RIGHT}));
  const std::string page = text_of(road.folder.file("out.html"));
  const std::string chinese = page.substr(page.find("\n  zh: {"));
  for (const std::string name : data.at("words").at("reason_names")) {
    EXPECT_TRUE(contains(chinese, " " + name + ": '")) << name;
  }
  for (const std::string name : data.at("words").at("parts"))
    EXPECT_TRUE(contains(chinese, " " + name + ": '")) << name;
  for (const std::string name : data.at("words").at("senses")) {
    EXPECT_TRUE(contains(chinese, name.find(' ') == std::string::npos ? name + ": '" : "'" + name + "': '")) << name;
  }
}

TEST(ReportVerb, ShowsAPartOfTheFramesWithTheirOwnTruth) {
  const Road road("3");
  const std::string frames = road.folder.file("road/frames"), out = road.folder.file("out.html");
  const auto report = [&](const std::string& truth) {
    return command({"report", "-q", "-o", out, "--truth", truth, frames + "/000002.pcd"});
  };
  const std::string head = "frame,stamp_ns,roll,pitch,yaw,d_lf,d_lb,d_rf,d_rb\n";
  const CsvTable simulated = table_of(road.folder.file("road/truth.csv"));
  const std::string stamp_ns = simulated.cell(2, *simulated.find_column("stamp_ns"));
  const std::string rows = "0,1,0,0,0,2,2,2,2\n1,2,0,0,0,2,2,2,2\n2," + stamp_ns + ",0.25,0,0,2,2,2,2\n";
  const Ran ran = report(road.folder.write("t.csv", head + rows));
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_EQ(ran.errors, "");
  EXPECT_EQ(column<float>(road.data(), "truth").at(0), 0.25F);
  const Ran other = report(road.folder.write("t.csv", head + "0,7,0.5,0,0,2,2,2,2\n"));
  EXPECT_TRUE(contains(other.errors, "the stamps differ in 1 of 1 pairs")) << other.errors;
  EXPECT_EQ(column<float>(road.data(), "truth").at(0), 0.5F);
  EXPECT_TRUE(
      contains(report(road.folder.write("t.csv", head + "5,7,0,0,0,2,2,2,2\n")).errors, "no row matches these frames"));
  EXPECT_TRUE(contains(report(road.folder.write("t.csv", head + rows + rows)).errors, "frame 0 appears twice"));
}

// The page judges by the shares of usability.hpp and names the axis of its signs; stderr has the verdict, too.
TEST(ReportVerb, HoldsTheRuleOfTheVerdictAndTheAxisOfTheSigns) {
  const Road road("1");
  const Ran ran = road.report({"--set", "forward_axis=-Y"});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "\nverdict: ")) << ran.errors;
  const nlohmann::json head = road.data().at("head");
  EXPECT_EQ(head.at("usable_share"), kUsableShare);
  EXPECT_EQ(head.at("in_part_share"), kInPartShare);
  EXPECT_EQ(head.at("forward_axis"), "-Y");
}

TEST(ReportVerb, SpeaksChineseOnStderrAndInItsHelp) {
  const Road road("1");
  const Ran ran = road.report(
      {"--language", "zh", "--truth",
       road.folder.write("t.csv", "frame,stamp_ns,roll,pitch,yaw,d_lf,d_lb,d_rf,d_rb\n5,7,0,0,0,2,2,2,2\n")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  for (const char* part : {"没有一行与这些帧匹配", "结论：", "1 帧，其中 1 帧含点云", "请用浏览器打开"}) {
    EXPECT_TRUE(contains(ran.errors, part)) << part << " | " << ran.errors;
  }
  EXPECT_EQ(road.data().at("head").at("language"), "zh");
  const Ran help = command({"report", "--language", "zh", "--help"});
  EXPECT_TRUE(contains(help.printed, "退出码：")) << help.printed;
  EXPECT_FALSE(contains(help.printed, "Exit status")) << help.printed;
}

TEST(ReportVerb, IsOneFileThatAsksForNothing) {
  const Road road("1");
  ASSERT_EQ(road.report().exit_status, 0);
  std::string page = text_of(road.folder.file("out.html"));
  const std::string name = "http://www.w3.org/1999/xhtml";  // names a kind of elements, and nothing is asked of it
  for (std::size_t at = 0; (at = page.find(name)) != std::string::npos;) page.erase(at, name.size());
  for (const char* outside : {"http://", "https://", "src=", "<link", "@import", "url("}) {
    EXPECT_FALSE(contains(page, outside)) << outside;
  }
  EXPECT_FALSE(std::filesystem::exists(part_of(road.folder.file("out.html"))));
  ASSERT_EQ(road.report().exit_status, 0);
}

TEST(ReportVerb, AFileThatCannotBeReadIsAFrameThatSaysSo) {
  const Road road("2");
  road.folder.write("road/frames/000000a.pcd", "no cloud");
  EXPECT_TRUE(test::says(road.report(), 1, "000000a.pcd"));
  const nlohmann::json data = road.data();
  ASSERT_EQ(data.at("frames"), 3);
  EXPECT_EQ(data.at("error")[0], "");
  EXPECT_NE(data.at("error")[1], "");
  EXPECT_EQ(column<std::uint8_t>(data, "state")[7], POSE_WALL_VALID + 1) << "unreadable, not invalid";
  EXPECT_EQ(column<std::uint32_t>(data, "cloud_frame"), (std::vector<std::uint32_t>{0, 2}));
}

// Its guessed stamp is that of the next frame, which must keep its own truth.
TEST(ReportVerb, AFileThatCannotBeReadLeavesTheOthersTheirTruth) {
  const Road road("3");
  road.folder.write("road/frames/000001b.pcd", "no cloud");
  const Ran ran = road.report({"--truth", road.folder.file("road/truth.csv")});
  EXPECT_FALSE(contains(ran.errors, "stamps differ")) << ran.errors;
  const CsvTable truth = table_of(road.folder.file("road/truth.csv"));
  const auto shown = column<float>(road.data(), "truth");
  ASSERT_EQ(shown.size(), 4U * POSE_WALL_QUANTITIES);
  EXPECT_FLOAT_EQ(shown[7 * 3], static_cast<float>(truth.number(2, *truth.find_column("roll"))));
  EXPECT_FALSE(std::isfinite(shown[7 * 2])) << "nothing is known of the frame itself";
}

TEST(ReportVerb, NamesCannotBreakOutOfTheData) {
  const Road road("1");
  // A file "script>.pcd" in a folder "<".
  std::filesystem::create_directories(road.folder.file("<"));
  std::filesystem::rename(road.folder.file("road/frames/000000.pcd"), road.folder.file("</script>.pcd"));
  const std::string title = "</title></script>@data@<b>&";
  ASSERT_EQ(
      command({"report", "--quiet", "--title", title, "--output", road.folder.file("out.html"), road.folder.file("<")})
          .exit_status,
      0);
  EXPECT_EQ(road.data().at("head").at("title"), title);
  EXPECT_EQ(road.data().at("source")[0], road.folder.file("</script>.pcd"));
  EXPECT_TRUE(
      contains(text_of(road.folder.file("out.html")), "<title>&lt;/title>&lt;/script>@data@&lt;b>&amp;</title>"));
}

TEST(ReportVerb, WhatWasThereStaysWhereNothingCanBeMade) {
  const Road road("1");
  road.folder.write("out.html", "precious");
  const std::string broken = road.folder.write("broken.pcd", "no cloud");
  EXPECT_EQ(command({"report", "--output", road.folder.file("out.html"), broken}).exit_status, 1);
  EXPECT_EQ(road.report({"--config", "nowhere.yaml"}).exit_status, 2);
  EXPECT_EQ(road.report({"--truth", "nowhere.csv"}).exit_status, 2);
  EXPECT_EQ(road.report({"--language", "fr"}).exit_status, 2);
  EXPECT_EQ(text_of(road.folder.file("out.html")), "precious");
  const std::string frame = road.folder.file("road/frames/000000.pcd"), before = text_of(frame);
  EXPECT_TRUE(test::says(command({"report", "--output", frame, frame}), 2, "it would be overwritten"));
  EXPECT_EQ(text_of(frame), before);
  EXPECT_EQ(command({"report", "--output", road.folder.path(), frame}).exit_status, 2);
}

TEST(CloudChoice, LongRecordingsKeepSomeCloudsAndTheChanges) {
  pose_wall_result result{};
  report::CloudChoice few(100, 100000);
  EXPECT_EQ(few.points_per_frame(), 1000U);
  for (std::size_t f = 0; f < 100; ++f) EXPECT_TRUE(few.takes(f, result)) << f;

  report::CloudChoice many(10000, 1'200'000);
  std::size_t taken = 0, changes_seen = 0;
  for (std::size_t f = 0; f < 10000; ++f) {
    const bool changes = f % 97 == 13;
    if (changes) result.quantity[2].state ^= POSE_WALL_VALID;
    const bool takes = many.takes(f, result);
    taken += takes ? 1 : 0;
    changes_seen += changes && takes ? 1 : 0;
  }
  EXPECT_EQ(changes_seen, 103U) << "each of them, while there are no more than two hundred";
  EXPECT_GE(taken, 400U);
  EXPECT_LE(taken * many.points_per_frame(), 1'200'000U);
}

TEST(ReportVerb, ATableOfRunMakesAPageThatSaysSo) {
  const Road road("4");
  const std::string table_file = road.folder.file("o.csv"), frames_folder = road.folder.file("road/frames");
  const std::string config = road.folder.file("road/pose_wall.yaml"), page = road.folder.file("out.html");
  const std::string truth = road.folder.file("road/truth.csv");
  road.folder.write("road/frames/9.pcd", "no PCD");
  EXPECT_EQ(command({"run", "-q", "--parts", "-c", config, "-o", table_file, frames_folder}).exit_status, 1);
  ASSERT_EQ(road.report({"-q", "--truth", truth}).exit_status, 1) << "a frame of it is broken";
  const nlohmann::json frames = road.data();
  const Ran ran = command({"report", "-c", config, "--truth", truth, "-o", page, table_file});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "from the table alone: no clouds, no pictures of them")) << ran.errors;
  const nlohmann::json data = road.data();
  EXPECT_EQ(data.at("head").at("from_table"), true);
  EXPECT_EQ(frames.at("head").at("from_table"), false);
  for (const char* same :
       {"frames", "source", "error", "state", "reasons", "frame_reasons", "cause", "stamp_s", "counts"}) {
    EXPECT_EQ(data.at(same), frames.at(same)) << same;
  }
  const auto states = column<std::uint8_t>(data, "state");
  for (const char* name : {"value", "raw", "sigma", "level", "raw_level", "part", "truth"}) {
    const auto of_table = column<float>(data, name), of_frames = column<float>(frames, name);
    ASSERT_EQ(of_table.size(), of_frames.size()) << name;
    const std::size_t each = of_table.size() / states.size();
    for (std::size_t i = 0; i < of_table.size(); ++i) {
      if (states[i / each] == POSE_WALL_INVALID) continue;  // empty in a table
      const bool are_none = std::isnan(of_table[i]) && std::isnan(of_frames[i]);
      EXPECT_TRUE(are_none || std::fabs(of_table[i] - of_frames[i]) <= 1e-5F * std::fabs(of_frames[i]) + 1e-7F)
          << name << " " << i << ": " << of_table[i] << " and " << of_frames[i];
    }
  }
  EXPECT_TRUE(column<std::uint8_t>(data, "point_label").empty());
  EXPECT_EQ(command({"report", "-q", "-o", page, table_file}).exit_status, 0) << "without --config, too";
}

// What was valid by wide limits must not stand beside narrow ones.
TEST(ReportVerb, ATableBringsTheAlertLimitsOfItsRun) {
  const Road road("3");
  const std::string table_file = road.folder.file("o.csv"), page = road.folder.file("out.html");
  ASSERT_EQ(command({"run", "-q", "-c", road.folder.file("road/pose_wall.yaml"), "-s", "alert_limit_distance=0.25",
                     "-s", "alert_limit_angle_deg=2.5", "-o", table_file, road.folder.file("road/frames")})
                .exit_status,
            0);
  ASSERT_EQ(command({"report", "-q", "-o", page, table_file}).exit_status, 0);
  const nlohmann::json head = road.data().at("head");
  EXPECT_NEAR(head.at("alert_deg").get<double>(), 2.5, 1e-7);
  EXPECT_NEAR(head.at("alert_m").get<double>(), 0.25, 1e-9);
  std::ifstream stream(table_file);
  const std::string table{std::istreambuf_iterator<char>(stream), {}}, first = table.substr(0, table.find('\n') + 1);
  std::string others = table.substr(first.size());
  for (std::size_t at = others.find(",0.25"); at != std::string::npos; at = others.find(",0.25", at + 1))
    others[at + 1] = '1';
  const Ran mixed = command({"report", "-o", page, road.folder.write("m.csv", table + others)});
  EXPECT_EQ(mixed.exit_status, 1);
  EXPECT_TRUE(contains(mixed.errors, "its rows have different alert limits")) << mixed.errors;
}

TEST(ReportVerb, ATableThatItCannotShowIsToldWhatIsMissing) {
  const TempFolder folder;
  std::string wide = "x0";
  for (int k = 1; k < 100; ++k) wide += ",x" + std::to_string(k);
  const std::string page = folder.file("p.html");
  const Ran other = command({"report", "-o", page, folder.write("wide.csv", wide + "\n")});
  EXPECT_EQ(other.exit_status, 1);
  EXPECT_TRUE(contains(other.errors, "this is no table of run")) << other.errors;
  EXPECT_TRUE(contains(other.errors, "x11 and 88 more")) << other.errors;
  EXPECT_FALSE(contains(other.errors, "x12")) << "not a hundred names: " << other.errors;
  const Ran lacks =
      command({"report", "-o", page, folder.write("lacks.csv", "frame,source,stamp_ns,status,roll,roll_state\n")});
  EXPECT_EQ(lacks.exit_status, 1);
  EXPECT_TRUE(contains(lacks.errors, "the table of run lacks the columns roll_raw, roll_sigma, roll_pl, pitch,"))
      << lacks.errors;
  EXPECT_FALSE(std::filesystem::exists(page));
}

}  // namespace
}  // namespace pose_wall::tools
