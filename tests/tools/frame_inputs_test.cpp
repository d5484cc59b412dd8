// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what a file begins with decides the reader, then its ending; folders come in natural order, and stamps as
// documented.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>

#include "io/frames/file_source.hpp"
#include "io/frames/frame_stamps.hpp"
#include "io/frames/input_list.hpp"
#include "io/frames/load_frame.hpp"
#include "io/frames/natural_order.hpp"
#include "io/frames/pcd_writer.hpp"
#include "support/said_by.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

const std::string kPoint = raw(1.0F) + raw(2.0F) + raw(3.0F) + raw(0.5F);

std::string load_refusal(const std::string& path) {
  return test::said_by<FrameError>([&] { load_frame(path); });
}

TEST(LoadFrame, WhereBytesDoNotTellTheEndingDecidesAndFaultsAreSaid) {
  const TempFolder folder;
  EXPECT_EQ(load_frame(folder.write("a.BIN", kPoint)).cloud.width, 1U);
  EXPECT_NE(load_refusal(folder.write("a.dat", kPoint)).find("unknown ending '.dat'"), std::string::npos);
  EXPECT_NE(load_refusal(folder.write("a.pcd", kPoint)).find("this is no PCD"), std::string::npos);
  EXPECT_EQ(load_refusal(folder.write("b.pcd", "")), "the file is empty");
  EXPECT_EQ(load_refusal(folder.file("missing.pcd")), "not there: no such file or folder");
  EXPECT_EQ(load_refusal(folder.file("nofolder")), "not there: no such file or folder") << "not an unknown ending";
  std::filesystem::create_directories(folder.file("folder.ply"));
  EXPECT_EQ(load_refusal(folder.file("folder.ply")), "not a regular file");
}

TEST(LoadFrame, WhatAFileBeginsWithTellsMoreThanItsEnding) {
  const TempFolder folder;
  const std::string header =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
      "TYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n";
  const std::string padded = header + std::string(16 - header.size() % 16, '\n');
  for (const char* name : {"a.bin", "a.ply", "a.txt", "a"}) {
    EXPECT_EQ(load_frame(folder.write(name, padded)).cloud.width, 2U) << name;
  }
  EXPECT_EQ(load_frame(folder.write("b.pcd",
                                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                    "property float y\nproperty float z\nend_header\n1 2 3\n"))
                .cloud.width,
            1U);
}

// The format has none: others pass over a comment.
TEST(LoadFrame, APcdMayCarryAStampInAComment) {
  const TempFolder folder;
  const float points[] = {1.0F, 2.0F, 3.0F, 0.5F};
  const std::string file = folder.file("a.pcd");
  write_pcd_binary(file, points, 1, 1'234'567'890'123'456'789);
  const Frame frame = load_frame(file);
  EXPECT_EQ(frame.cloud.width, 1U);
  EXPECT_EQ(frame.stamp_ns.value_or(0), 1'234'567'890'123'456'789);
  const std::string header =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n";
  for (const char* comment : {"# stamp_ns\n", "# stamp_ns soon\n", "# stamp_ns 1 2\n", "# 12\n"}) {
    EXPECT_FALSE(load_frame(folder.write("b.pcd", comment + header)).stamp_ns) << comment;
  }
}

TEST(LoadFrame, ATimedPcdHasTheSamePointsTheirTimesAndRings) {
  const TempFolder folder;
  const float points[] = {1.0F, 2.0F, 3.0F, 0.5F, 4.0F, 5.0F, 6.0F, 0.25F};
  const std::uint32_t time_ns[] = {0, 99'000'000};
  const std::uint16_t ring[] = {7, 63};
  const std::string file = folder.file("a.pcd");
  write_timed_pcd_binary(file, points, time_ns, ring, 2, 5);
  const Frame frame = load_frame(file);
  EXPECT_EQ(frame.cloud.width, 2U);
  EXPECT_EQ(frame.stamp_ns.value_or(0), 5);
  const auto* data = static_cast<const std::byte*>(frame.cloud.data);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::byte* point = data + i * frame.cloud.point_step;
    EXPECT_EQ(std::memcmp(point + frame.cloud.x.offset, &points[4 * i], 16), 0);
    EXPECT_EQ(std::memcmp(point + 16, &time_ns[i], 4), 0);
    EXPECT_EQ(std::memcmp(point + 20, &ring[i], 2), 0);
  }
}

TEST(InputList, FoldersGiveTheirFramesInNaturalOrderAndFilesStay) {
  const TempFolder folder;
  for (const char* name : {"9.pcd", "10.pcd", "notes.txt", "b.bin", "B.ply", "inner/1.pcd"}) folder.write(name, "");
  const FrameInputs inputs = collect_inputs({"missing.pcd", folder.path(), folder.file("notes.txt")});
  std::vector<std::string> names;
  for (const auto& file : inputs.files) names.push_back(file.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"missing.pcd", "9.pcd", "10.pcd", "B.ply", "b.bin", "notes.txt"}));
  EXPECT_TRUE(inputs.errors.empty());
  ASSERT_EQ(inputs.notes.size(), 1U);
  EXPECT_EQ(inputs.notes.front(), folder.path() + ": read by the numbers in the names: 9.pcd before 10.pcd");
}

TEST(InputList, WherePaddedNumbersMakeBothOrdersOneNothingIsSaid) {
  const TempFolder folder;
  for (const char* name : {"009.pcd", "010.pcd", "100.pcd"}) folder.write(name, "");
  EXPECT_TRUE(collect_inputs({folder.path()}).notes.empty());
}

TEST(NaturalOrder, NumbersCountAsNumbersAndTheOrderIsTotal) {
  const std::vector<std::string> sorted = {"",   "1",    "2.pcd", "2a",      "10", "99999999999999999999999",
                                           "a",  "a1b2", "a1b10", "a01b10c", "a2", "b007",
                                           "b7", "b7.5"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      EXPECT_EQ(natural_less(sorted[i], sorted[j]), i < j) << sorted[i] << " and " << sorted[j];
    }
  }
}

TEST(InputList, ALinkThatLeadsNowhereIsAFrameThatCannotBeRead) {
  const TempFolder folder;
  folder.write("f/1.pcd", "");
  std::filesystem::create_directories(folder.file("f/folder.pcd"));
  std::filesystem::create_symlink(folder.file("gone.pcd"), folder.file("f/2.pcd"));
  const FrameInputs inputs = collect_inputs({folder.file("f")});
  ASSERT_EQ(inputs.files.size(), 2U);
  EXPECT_EQ(inputs.files[1].filename(), "2.pcd");
  EXPECT_EQ(load_refusal(inputs.files[1]),
            "not there: it is a link to " + folder.file("gone.pcd") + ", which leads to no file");
}

TEST(InputList, AFolderThatHoldsWhatIsMeantNamesIt) {
  const TempFolder folder;
  const auto error = [&folder](const char* name) { return collect_inputs({folder.file(name)}).errors.at(0); };
  folder.write("road/frames/1.pcd", "");
  EXPECT_NE(error("road").find("; did you mean '" + folder.file("road/frames") + "'?"), std::string::npos);
  for (const char* name : {"captures/b.pcap", "captures/a.pcapng", "captures/a.json"}) folder.write(name, "");
  const std::string named = "; bags and captures are named themselves: " + folder.file("captures/a.pcapng");
  EXPECT_NE(error("captures").find(named), std::string::npos);
  folder.write("bare/frames/notes.txt", "");
  EXPECT_EQ(error("bare").find("mean"), std::string::npos);
  folder.write("road/truth.csv", "0,0.1,0.2,0.3\n1,0.1,0.2,0.3\n");
  EXPECT_NE(error("road").find("; did you mean '"), std::string::npos) << "a table beside frames is no cloud";
}

TEST(InputList, RecordingsBesideFramesAreNamedAndNotRead) {
  const TempFolder folder;
  for (const char* name : {"1.pcd", "b.pcap", "a.db3"}) folder.write(name, "");
  const FrameInputs inputs = collect_inputs({folder.path()});
  EXPECT_EQ(inputs.files.size(), 1U);
  ASSERT_EQ(inputs.notes.size(), 1U);
  EXPECT_NE(inputs.notes.front().find(folder.file("a.db3") + ", " + folder.file("b.pcap")), std::string::npos);
}

TEST(InputList, AnEmptyFolderIsAnErrorThatNamesTheEndings) {
  const TempFolder folder;
  folder.write("notes.txt", "");
  const FrameInputs inputs = collect_inputs({folder.path()});
  ASSERT_EQ(inputs.errors.size(), 1U);
  EXPECT_NE(inputs.errors.front().find(folder.path()), std::string::npos);
  EXPECT_NE(inputs.errors.front().find(".pcd, .bin, .ply, .xyz"), std::string::npos);
}

TEST(FrameStamps, NamesOfDigitsAreStampsInTheUnitOfTheirLength) {
  EXPECT_EQ(stamp_from_name("a/1700000000123456789.pcd"), 1700000000123456789);
  EXPECT_EQ(stamp_from_name("1700000000123456.bin"), 1700000000123456000);
  EXPECT_EQ(stamp_from_name("1700000000123.bin"), 1700000000123000000);
  EXPECT_EQ(stamp_from_name("100000000000000001.bin"), 100000000000000001);
  EXPECT_EQ(stamp_from_name("0000000000100000000.bin"), 100000000) << "padded nanoseconds";
  for (const char* counter : {"0000000000012.pcd", "0000000000000012.pcd", "1700000000.pcd", "20240131235959123.pcd"}) {
    EXPECT_FALSE(stamp_from_name(counter)) << counter;
  }
  EXPECT_FALSE(stamp_from_name("170000000012345.pcd"));
  EXPECT_FALSE(stamp_from_name("99999999999999999999.pcd"));
  EXPECT_FALSE(stamp_from_name("9999999999999999999.pcd")) << "does not fit 63 bits";
  EXPECT_FALSE(stamp_from_name("1700000000123456789a.pcd"));
  EXPECT_FALSE(stamp_from_name(""));
}

// The stamps of files of one folder behind 1700000000 s, in the order in which they are read; -1: none.
std::vector<std::int64_t> stamps_of(const std::vector<std::string>& names) {
  const TempFolder folder;
  for (const std::string& name : names) folder.write("f/" + name + ".bin", "");
  FileSource source(collect_inputs({folder.file("f")}).files);
  std::vector<std::int64_t> stamps_ns;
  while (const std::optional<SourcedFrame> frame = source.next()) {
    stamps_ns.push_back(frame->stamp_ns ? *frame->stamp_ns - 1'700'000'000'000'000'000 : -1);
  }
  return stamps_ns;
}

TEST(FrameStamps, SecondsWithAFractionAreReadAsTheNamesTellTogether) {
  using Stamps = std::vector<std::int64_t>;
  EXPECT_EQ(stamps_of({"1700000000.000000000", "1700000000.100000000"}), (Stamps{0, 100'000'000})) << "padded";
  EXPECT_EQ(stamps_of({"1700000000.25", "1700000000.5", "1700000000.125"}),
            (Stamps{125'000'000, 250'000'000, 500'000'000}))
      << "floats";
  EXPECT_EQ(stamps_of({"1700000000.05", "1700000000.123456789"}), (Stamps{50'000'000, 123'456'789})) << "decimals";
  EXPECT_EQ(stamps_of({"1700000000.50000000", "1700000000.150000000", "1700000000.999"}),
            (Stamps{999, 50'000'000, 150'000'000}))
      << "nanoseconds that are not padded";
  EXPECT_EQ(stamps_of({"1700000000000000", "1700000000100000", "1700000000200000"}),
            (Stamps{0, 100'000'000, 200'000'000}))
      << "microseconds";
  EXPECT_EQ(stamps_of({"1.5", "1.10"}), (Stamps{-1, -1})) << "numbers of parts";
}

TEST(FrameStamps, OtherFramesFollowAtTheRateWithoutDrift) {
  FrameStamps stamps(3.0);
  EXPECT_EQ(stamps.next("a.pcd"), 0);
  EXPECT_EQ(stamps.next("b.pcd"), 333333333);
  EXPECT_EQ(stamps.next("c.pcd"), 666666667);
  EXPECT_EQ(stamps.next("d.pcd"), 1000000000);
  EXPECT_EQ(stamps.next("1700000000000000000.pcd"), 1700000000000000000);
  EXPECT_EQ(stamps.next("f.pcd"), 1700000000333333333);
}

TEST(FrameStamps, StepsOfTheEpochKeepTheirNanosecondsAndDamagedOnesTheirSign) {
  EXPECT_DOUBLE_EQ(seconds_between(1700000000000000000, 1700000000000000001), 1e-9);
  EXPECT_DOUBLE_EQ(seconds_between(1700000000000000003, 1700000000000000000), -3e-9);
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min(), kLast = -(kFirst + 1);
  EXPECT_NEAR(seconds_between(kFirst, kLast), 18446744073.7, 0.1);
  EXPECT_NEAR(seconds_between(kLast, kFirst), -18446744073.7, 0.1);
}

}  // namespace
}  // namespace pose_wall::tools
