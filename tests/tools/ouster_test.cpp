// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every profile and both heads of an Ouster's packets are read by their layout, which stands here a second
// time. Packets of another serial number than the metadata's are refused with both. A window of azimuth, late packets
// and packets captured twice give whole frames in order. Metadata that is no sensor's is refused.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_PCAP

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/packets/ouster.hpp"
#include "ouster_packets.hpp"
#include "packet_files.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

std::vector<std::string> payloads_of(const std::vector<OusterPacket>& packets) {
  std::vector<std::string> payloads;
  for (const OusterPacket& packet : packets) payloads.push_back(payload_of(packet));
  return payloads;
}

ReadCapture read_turns(const OusterDescription& told, const std::vector<std::string>& payloads) {
  const TempFolder folder;
  folder.write("o.json", ouster_json(told));
  return read(folder.write("o.pcap", capture_of(payloads)));
}

// What an assembler makes of them.
struct Assembled {
  Assembled(const OusterDescription& told, const std::vector<OusterPacket>& packets)
      : assembler(parse_ouster_metadata(ouster_json(told))) {
    for (const OusterPacket& packet : packets) {
      if (test::add(assembler, payload_of(packet))) ++taken;
      take();
    }
    at_once = scans.size();
    assembler.finish();
    take();
  }
  void take() {
    while (std::optional<Scan> scan = assembler.take()) scans.push_back(std::move(*scan));
  }
  std::vector<std::int64_t> stamps_ns() const {
    std::vector<std::int64_t> stamps;
    for (const Scan& scan : scans) stamps.push_back(scan.stamp_ns);
    return stamps;
  }

  OusterAssembler assembler;
  std::vector<Scan> scans;
  std::size_t at_once = 0, taken = 0;
};

std::size_t returns_of(const Scan& scan) {
  std::size_t returns = 0;
  for (const ScanPoint& point : scan.points) {
    if (std::hypot(point.x_m, point.y_m, point.z_m) > 0.0F) ++returns;
  }
  return returns;
}

std::int64_t stamp_of_frame(std::int64_t frame) {
  return frame * kOusterColumnsOfTurn * static_cast<std::int64_t>(kOusterColumn_ns);
}

TEST(OusterProfiles, EachIsReadByItsLayoutWithEitherHead) {
  for (const OusterProfile& profile : ouster_profiles()) {
    for (const bool is_fusa : {false, true}) {
      const bool is_named_fusa = std::string(profile.name).rfind("FUSA_", 0) == 0;
      OusterPacket packet;
      packet.profile = profile.name;
      packet.is_fusa = is_fusa;
      packet.serial = kOusterSerial;
      OusterDescription told{profile.name, is_fusa ? ", \"header_type\": \"FUSA\"" : ", \"header_type\": \"STANDARD\"",
                             ouster_serial_told(kOusterSerial)};
      if (is_fusa == is_named_fusa) told.more_of_format.clear();  // as firmware before 3.2
      const Assembled seen(told, turns_of(packet, 2));
      ASSERT_EQ(seen.scans.size(), 2U) << profile.name;
      for (const Scan& scan : seen.scans) {
        EXPECT_TRUE(scan.is_complete);
        // Column 0 looks along +x of the lidar, which is -x of the sensor; straight down are 4.9 m, 0.1 m out.
        test::expect_at(test::point_at(scan, 0, 0), -5.0, 0.0, 0.036);
        test::expect_at(test::point_at(scan, 0, 4), 0.0, 5.0, 0.036);
        test::expect_at(test::point_at(scan, 1, 0), -0.1, 0.0, -4.9 + 0.036);
        EXPECT_EQ(test::point_at(scan, 0, 0).intensity, 7.0F) << profile.name;
        EXPECT_EQ(test::point_at(scan, 0, 3).t_ns, 3 * kOusterColumn_ns);
      }
    }
  }
}

TEST(OusterProfiles, AnUnknownOneIsRefusedWithThoseThatAreRead) {
  const auto refused = [](const OusterDescription& told) -> std::string {
    return test::said_by<FrameError>([&] { parse_ouster_metadata(ouster_json(told)); });
  };
  const std::string unknown = refused({"RNG19_RFL8_SIG16_NIR16_QUAD"});
  EXPECT_TRUE(contains(unknown, "'RNG19_RFL8_SIG16_NIR16_QUAD' is not read")) << unknown;
  for (const OusterLayout& layout : ouster_layouts()) EXPECT_TRUE(contains(unknown, layout.profile)) << unknown;
  EXPECT_TRUE(contains(refused({"OFF"}), "sends no points"));
  EXPECT_TRUE(contains(refused({"RNG15_RFL8_NIR8", ", \"header_type\": \"OTHER\""}), "STANDARD and FUSA are"));
}

// Dust at 5 m before a wall at 8 m: only where the sensor was told to send the nearest first, it comes first.
TEST(OusterProfiles, OfTwoReturnsTheFirstIsTakenButNotTheNearestFirst) {
  for (const OusterProfile& profile : ouster_profiles()) {
    if (!ouster_layout_of(profile.name).has_two) continue;
    OusterPacket packet;
    packet.profile = profile.name;
    packet.is_fusa = std::string(profile.name).rfind("FUSA_", 0) == 0;
    for (const auto& [order, x_m] : {std::pair("STRONGEST_TO_WEAKEST", -5.0), std::pair("FARTHEST_TO_NEAREST", -5.0),
                                     std::pair("NEAREST_TO_FARTHEST", -8.0)}) {
      const std::string config = fmt::format(", \"config_params\": {{\"return_order\": \"{}\"}}", order);
      const Assembled seen({profile.name, "", config}, turns_of(packet, 1));
      ASSERT_EQ(seen.scans.size(), 1U);
      test::expect_at(test::point_at(seen.scans[0], 0, 0), x_m, 0.0, 0.036);
      EXPECT_EQ(test::point_at(seen.scans[0], 0, 0).intensity, x_m == -8.0 ? 9.0F : 7.0F) << profile.name;
    }
  }
}

TEST(OusterSerial, PacketsOfAnotherSensorThanTheMetadataAreRefusedWithBothNumbers) {
  for (const bool is_fusa : {false, true}) {
    OusterPacket packet;
    packet.is_fusa = is_fusa;
    packet.serial = kOusterSerial;
    const OusterDescription told{"RNG15_RFL8_NIR8", is_fusa ? ", \"header_type\": \"FUSA\"" : "",
                                 ouster_serial_told(kOtherOusterSerial)};
    const std::string refused = refusal_of(read_turns(told, payloads_of(turns_of(packet, 2))));
    EXPECT_TRUE(contains(refused, "122201000111") && contains(refused, "122201000222")) << refused;
    const Assembled live(told, turns_of(packet, 2));
    EXPECT_EQ(live.taken, 0U);
    EXPECT_TRUE(contains(live.assembler.hint(), "122201000111") && contains(live.assembler.hint(), "122201000222"));
  }
}

TEST(OusterSerial, WhereOneSideTellsNoneNothingIsCompared) {
  OusterPacket packet;
  for (const auto& [serial, more] :
       {std::pair(kOusterSerial, std::string()), std::pair(std::uint64_t{0}, ouster_serial_told(kOusterSerial)),
        std::pair(kOusterSerial, ouster_serial_told(123)), std::pair(kOusterSerial, ouster_serial_told(kOusterSerial)),
        std::pair(kOusterSerial, std::string(", \"prod_sn\": \"by hand\"")),
        std::pair(kOusterSerial, std::string(", \"prod_sn\": 7"))}) {
    packet.serial = serial;
    EXPECT_EQ(Assembled({packet.profile, "", more}, turns_of(packet, 2)).scans.size(), 2U) << more;
  }
  packet.profile = "LEGACY";
  EXPECT_EQ(Assembled({"LEGACY", "", ouster_serial_told(kOtherOusterSerial)}, turns_of(packet, 2)).scans.size(), 2U);
}

// Two sensors of one kind, whose packets come in turn.
TEST(OusterSerial, PacketsOfAnotherSensorAreNotMixedIn) {
  OusterPacket ours, others;
  ours.serial = kOusterSerial;
  others.serial = kOtherOusterSerial;
  others.first_mm = 9000;
  std::vector<OusterPacket> both;
  for (const OusterPacket& packet : turns_of(ours, 3)) {
    both.push_back(others);
    both.back().first_column = packet.first_column;
    both.back().frame = packet.frame;
    both.push_back(packet);
  }
  const Assembled seen({ours.profile, "", ouster_serial_told(kOusterSerial)}, both);
  ASSERT_EQ(seen.scans.size(), 3U);
  EXPECT_EQ(seen.taken, both.size() / 2);
  EXPECT_EQ(seen.assembler.hint(), "");
  for (const Scan& scan : seen.scans) test::expect_at(test::point_at(scan, 0, 8), 5.0, 0.0, 0.036);
}

TEST(OusterHeads, AnotherKindThanTheMetadataTellsIsRefusedByName) {
  for (const std::string& serial : {std::string(), ouster_serial_told(kOusterSerial)}) {
    for (const bool is_fusa : {false, true}) {
      OusterPacket packet;
      packet.is_fusa = is_fusa;
      packet.serial = kOusterSerial;
      const OusterDescription told{packet.profile, is_fusa ? "" : ", \"header_type\": \"FUSA\"", serial};
      const std::string refused = refusal_of(read_turns(told, payloads_of(turns_of(packet, 2))));
      EXPECT_TRUE(contains(refused, is_fusa ? "kind FUSA, but the metadata's header_type is STANDARD"
                                            : "kind STANDARD, but the metadata's header_type is FUSA"))
          << refused;
    }
  }
}

TEST(OusterHeads, AnotherProfileThanTheMetadataTellsIsHintedAt) {
  OusterPacket packet;
  packet.profile = "RNG19_RFL8_SIG16_NIR16";
  const std::string refused = refusal_of(read_turns({"RNG15_RFL8_NIR8"}, payloads_of(turns_of(packet, 2))));
  EXPECT_TRUE(contains(refused, "of the size of RNG19_RFL8_SIG16_NIR16 or ")) << refused;
  EXPECT_TRUE(contains(refused, "udp_profile_lidar is RNG15_RFL8_NIR8")) << refused;
}

struct Window {
  std::uint32_t first, last;

  bool holds(std::uint32_t column) const {
    return first <= last ? column >= first && column <= last : column >= first || column <= last;
  }
};

// Packets without a column in the window are not sent; columns beside it are not valid.
std::vector<OusterPacket> turns_of_window(OusterPacket packet, const Window& window, std::uint32_t count) {
  packet.is_valid = [window](std::uint32_t column) { return window.holds(column); };
  std::vector<OusterPacket> sent;
  for (const OusterPacket& one : turns_of(packet, count)) {
    bool holds_one = false;
    for (std::uint32_t i = 0; i < kOusterColumnsOfPacket; ++i)
      holds_one = holds_one || window.holds(one.first_column + i);
    if (holds_one) sent.push_back(one);
  }
  return sent;
}

TEST(OusterWindow, GivesAFrameATurn) {
  constexpr std::uint32_t kTurns = 10;
  for (const char* profile : {"RNG15_RFL8_NIR8", "LEGACY"}) {
    OusterPacket packet;
    packet.profile = profile;
    for (const Window& window : {Window{0, 7}, {8, 15}, {12, 3}, {5, 6}, {3, 4}, {9, 9}, {15, 0}, {0, 15}}) {
      const std::string told = fmt::format(", \"column_window\": [{}, {}]", window.first, window.last);
      const std::vector<std::string> payloads = payloads_of(turns_of_window(packet, window, kTurns));
      const ReadCapture capture = read_turns({profile, told}, payloads);
      ASSERT_EQ(capture.frames.size(), kTurns) << profile << told;
      for (std::size_t i = 0; i < kTurns; ++i) {
        const Frame& frame = *capture.frames[i].frame;
        for (std::uint32_t column = 0; column < kOusterColumnsOfTurn; ++column) {
          const double x_m = test::number_at(frame, frame.cloud.x, column);
          const double y_m = test::number_at(frame, frame.cloud.y, column);
          EXPECT_NEAR(std::hypot(x_m, y_m), window.holds(column) ? 5.0 : 0.0, 1e-5) << told << " column " << column;
        }
      }
    }
  }
}

// The first turn may have begun before the capture: nothing tells that it is whole.
TEST(OusterWindow, IsSeenWhereTheMetadataTellsNoneOrThatOfBefore) {
  for (const char* told : {"", ", \"column_window\": [0, 15]", ", \"column_window\": [2, 9]"}) {
    for (const Window& window : {Window{8, 15}, {12, 3}, {5, 6}}) {
      const std::vector<std::string> payloads = payloads_of(turns_of_window({}, window, 10));
      EXPECT_GE(read_turns({"RNG15_RFL8_NIR8", told}, payloads).frames.size(), 9U) << told << window.first;
    }
  }
}

TEST(OusterWindow, AWindowThatIsWiderThanToldLosesNothing) {
  const Assembled seen({"RNG15_RFL8_NIR8", ", \"column_window\": [0, 7]"}, turns_of({}, 5));
  ASSERT_EQ(seen.scans.size(), 5U);
  for (const Scan& scan : seen.scans) EXPECT_EQ(returns_of(scan), 2 * kOusterColumnsOfTurn);
}

// The end of one turn, and the beginning of the next: none of them is whole, though both have what was seen.
TEST(OusterWindow, PartsOfTurnsAtTheEndsOfACaptureAreNoWindow) {
  std::vector<OusterPacket> packets = turns_of({}, 4);
  packets.erase(packets.begin(), packets.begin() + 3);
  packets.pop_back();
  packets.pop_back();
  const ReadCapture capture = read_turns({}, payloads_of(packets));
  ASSERT_EQ(capture.frames.size(), 2U);
  EXPECT_EQ(*capture.frames[0].stamp_ns, stamp_of_frame(2));
}

std::vector<std::int64_t> stamps_of_frames(std::int64_t first, std::int64_t count) {
  std::vector<std::int64_t> stamps;
  for (std::int64_t i = 0; i < count; ++i) stamps.push_back(stamp_of_frame(first + i));
  return stamps;
}

TEST(OusterOrder, ALatePacketAtATurnsBorderBelongsToItsTurn) {
  for (const auto& [profile, is_fusa] :
       {std::pair("LEGACY", false), std::pair("RNG15_RFL8_NIR8", false), std::pair("RNG15_RFL8_NIR8", true)}) {
    OusterPacket packet;
    packet.profile = profile;
    packet.is_fusa = is_fusa;
    for (int late = 1; late <= 3; ++late) {
      std::vector<OusterPacket> packets = turns_of(packet, 4);
      // The last packet of each turn comes behind so many of the next one.
      for (const int last : {11, 7, 3}) {
        std::rotate(packets.begin() + last, packets.begin() + last + 1, packets.begin() + last + 1 + late);
      }
      const Assembled seen({profile, is_fusa ? ", \"header_type\": \"FUSA\"" : ""}, packets);
      ASSERT_EQ(seen.stamps_ns(), stamps_of_frames(1, 4)) << profile << late;
      EXPECT_EQ(seen.assembler.dropped_packets(), 0U);
      for (const Scan& scan : seen.scans) {
        EXPECT_EQ(returns_of(scan), 2 * kOusterColumnsOfTurn) << profile << late;
        EXPECT_EQ(test::point_at(scan, 0, 15).t_ns, 15 * kOusterColumn_ns);
      }
    }
  }
}

TEST(OusterOrder, PacketsOfATurnInAnyOrderGiveTheSameFrame) {
  const std::vector<OusterPacket> in_order = turns_of({}, 3);
  std::vector<OusterPacket> turned = in_order;
  std::swap(turned[0], turned[2]);
  std::swap(turned[5], turned[7]);
  const Assembled expected({}, in_order), seen({}, turned);
  ASSERT_EQ(seen.stamps_ns(), expected.stamps_ns());
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t point = 0; point < 2 * kOusterColumnsOfTurn; ++point) {
      EXPECT_EQ(seen.scans[i].points[point].x_m, expected.scans[i].points[point].x_m);
      EXPECT_EQ(seen.scans[i].points[point].t_ns, expected.scans[i].points[point].t_ns);
    }
  }
}

TEST(OusterOrder, PacketsCapturedTwiceChangeNothing) {
  std::vector<OusterPacket> once = turns_of({}, 4), twice;
  for (const OusterPacket& packet : once) twice.insert(twice.end(), 2, packet);
  const Assembled seen({}, twice);
  EXPECT_EQ(seen.stamps_ns(), stamps_of_frames(1, 4));
  EXPECT_EQ(seen.assembler.dropped_packets(), once.size());
  for (const Scan& scan : seen.scans) EXPECT_TRUE(scan.is_complete);
}

TEST(OusterOrder, APacketOfAFrameThatIsGoneIsDropped) {
  std::vector<OusterPacket> packets = turns_of({}, 4);
  const OusterPacket gone = packets[2];
  packets.insert(packets.begin() + 10, gone);
  packets.push_back(gone);
  const Assembled seen({}, packets);
  EXPECT_EQ(seen.stamps_ns(), stamps_of_frames(1, 4));
  EXPECT_EQ(seen.assembler.dropped_packets(), 2U);
}

TEST(OusterOrder, FramesGoOnWhereTheirNumberBeginsAnew) {
  for (const auto& [is_fusa, last] :
       {std::pair(false, std::uint64_t{0xFFFF}), std::pair(true, std::uint64_t{0xFFFFFFFF})}) {
    OusterPacket packet;
    packet.is_fusa = is_fusa;
    std::vector<OusterPacket> packets;
    for (std::uint32_t turn = 0; turn < 4; ++turn) {
      packet.frame = static_cast<std::uint32_t>((last - 1 + turn) & last);
      // Time goes on.
      packet.began_ns = kOusterColumn_ns * kOusterColumnsOfTurn * (last - 1 + turn - packet.frame);
      for (const OusterPacket& one : turns_of(packet, 1)) packets.push_back(one);
    }
    std::swap(packets[7], packets[8]);
    const Assembled seen({packet.profile, is_fusa ? ", \"header_type\": \"FUSA\"" : ""}, packets);
    EXPECT_EQ(seen.stamps_ns(), stamps_of_frames(static_cast<std::int64_t>(last - 1), 4));
  }
}

TEST(OusterOrder, AFrameOfWhichAllColumnsCameIsHandedOnAtOnceOnceTheirNumberIsSure) {
  EXPECT_EQ(Assembled({}, turns_of({}, 1)).at_once, 0U) << "it might go on";
  EXPECT_EQ(Assembled({}, turns_of({}, 3)).at_once, 3U);
}

// It counts anew, and its clock may, too: not a packet of before is joined to what comes.
TEST(OusterOrder, ASensorThatIsStartedAnewIsReadOn) {
  for (const char* profile : {"LEGACY", "RNG15_RFL8_NIR8"}) {
    OusterPacket before;
    before.profile = profile;
    before.frame = 300;
    OusterPacket after = before;
    after.frame = std::string(profile) == "LEGACY" ? 3 : 299;
    after.session = 0x654321;
    after.began_ns = 1'000'000'000;
    std::vector<OusterPacket> packets = turns_of(before, 2);
    packets.pop_back();
    for (const OusterPacket& packet : turns_of(after, 3)) packets.push_back(packet);
    const Assembled seen({profile}, packets);
    ASSERT_EQ(seen.scans.size(), 5U) << profile;
    EXPECT_EQ(returns_of(seen.scans[1]), 2 * (kOusterColumnsOfTurn - kOusterColumnsOfPacket));
    EXPECT_EQ(returns_of(seen.scans[2]), 2 * kOusterColumnsOfTurn);
    EXPECT_EQ(seen.scans[2].stamp_ns, 1'000'000'000 + stamp_of_frame(after.frame));
  }
}

TEST(OusterOrder, AFrameWithinWhichTheClockWasSetIsLeftOut) {
  std::vector<OusterPacket> packets = turns_of({}, 4);
  for (std::size_t i = 6; i < packets.size(); ++i) packets[i].began_ns = 1'700'000'000'000'000'000;
  const Assembled seen({}, packets);
  ASSERT_EQ(seen.scans.size(), 3U);
  for (const Scan& scan : seen.scans) EXPECT_LT(test::point_at(scan, 0, 15).t_ns, 16 * kOusterColumn_ns);
}

TEST(OusterMetadataBeside, IsTheOneOfItsNameOrTheOneThatOusterCliWrites) {
  const TempFolder folder;
  const std::filesystem::path capture = folder.write("road.pcap", "");
  const auto name = [&] { return ouster_metadata_beside(capture).filename().string(); };
  EXPECT_EQ(name(), "road.json") << "to be named where none is";
  folder.write("road_0.json", "{}");
  EXPECT_EQ(name(), "road_0.json");
  folder.write("road.json", "{}");
  EXPECT_EQ(name(), "road.json");
}

TEST(OusterMetadata, BeamsThatAreNoSensorsAreRefused) {
  const auto refused = [](const std::string& from, const std::string& to) -> std::string {
    std::string text = ouster_json({});
    const std::size_t at = text.find(from);
    if (at == std::string::npos) return "not found";
    return test::said_by<FrameError>([&] { parse_ouster_metadata(text.replace(at, from.size(), to)); });
  };
  EXPECT_EQ(refused("[0, -90]", "[0, -90]"), "");
  for (const char* angles : {"[0, 0]", "[7, 7]", "[-1, 1]"}) {
    EXPECT_TRUE(contains(refused("[0, -90]", angles), "'beam_altitude_angles' do not fall")) << angles;
  }
  EXPECT_TRUE(contains(refused("[0, -90]", "[0, -900]"), "altitude -900"));
  EXPECT_TRUE(contains(refused("_mm\": 100", "_mm\": 27670"), "27670 mm from the centre"));
  const std::string turn = "[-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36, 0, 0, 0, 1]";
  for (const char* other :
       {"[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]", "[-2, 0, 0, 0, 0, -2, 0, 0, 0, 0, 2, 36, 0, 0, 0, 1]",
        "[1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36, 0, 0, 0, 1]",
        "[-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36180, 0, 0, 0, 1]"}) {
    EXPECT_TRUE(contains(refused(turn, other), "'lidar_to_sensor_transform' is no rotation")) << other;
  }
  const std::string format = "\"data_format\": {";
  for (const char* window : {"[0, 16]", "[-1, 3]", "[1]", "7", "[0.5, 3]"}) {
    EXPECT_TRUE(contains(refused(format, format + "\"column_window\": " + window + ", "), "two columns of 0 to 15"))
        << window;
  }
}

// Pairs that sensors of firmware 2.3, 2.5 and 3.1 told.
TEST(OusterMetadata, AWindowThatIsToldAsAnglesIsThatOfColumns) {
  const auto window_of = [](std::uint32_t columns, const std::string& angles) {
    OusterDescription told;
    told.more = ", \"config_params\": {\"azimuth_window\": " + angles + "}";
    std::string text = ouster_json(told);
    const std::string of_frame = "\"columns_per_frame\": 16";
    text.replace(text.find(of_frame), of_frame.size(), fmt::format("\"columns_per_frame\": {}", columns));
    const std::optional<OusterWindow> window = parse_ouster_metadata(text).window;
    return window ? fmt::format("{} to {}", window->first, window->last) : "none";
  };
  EXPECT_EQ(window_of(1024, "[583, 39402]"), "912 to 1022");
  EXPECT_EQ(window_of(512, "[300000, 100000]"), "370 to 85");
  EXPECT_EQ(window_of(1024, "[0, 360000]"), "0 to 1023");
  EXPECT_EQ(window_of(512, "[180000, 360000]"), "0 to 256") << "the sensor told 1 to 256";
  EXPECT_EQ(window_of(512, "[-1, 7]"), "none");
}

// ouster-sdk, sensor_info.cpp: before 2.0 the sensor does not tell where its beams begin.
TEST(OusterMetadata, BeforeFirmware2BeamsBeginWhereTheDesignHasThem) {
  const std::pair<const char*, double> origins_mm[] = {
      {"OS-0-32-U0", 27.67}, {"OS-1-64", 15.806}, {"OS-2-128", 13.762}};
  for (const auto& [product, origin_mm] : origins_mm) {
    const std::string text =
        std::string("{\"prod_line\": \"") + product +
        "\", \"build_rev\": \"v1.13.0\", \"lidar_mode\": \"1024x10\", \"beam_altitude_angles\": [1, 0, -1], "
        "\"beam_azimuth_angles\": [3, 1, -1], \"lidar_data_format\": \"error: Command not "
        "recognized.\", \"lidar_to_sensor_transform\": [1,0,0,0, 0,1,0,0, 0,0,1,36, 0,0,0,1]}";
    EXPECT_DOUBLE_EQ(parse_ouster_metadata(text).beam_origin_out_m, 1e-3 * origin_mm) << product;
    // Of later firmware it is missing, and of another product it is not known.
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"v1.13", "v2.0"}, {"\"OS-", "\"XS-"}}) {
      std::string other = text;
      other.replace(other.find(from), from.size(), to);
      EXPECT_TRUE(contains(test::said_by<FrameError>([&] { parse_ouster_metadata(other); }),
                           "no 'lidar_origin_to_beam_origin_mm'"));
    }
  }
}

// Firmware 1.13 lists 64 lasers of an OS-1-16, of which 48 are not there. What their rows hold is no point.
TEST(OusterMetadata, RowsWithoutALaserAreNoBeams) {
  const auto of_angles = [](const char* altitudes, const char* azimuths) {
    return std::string(
               "{\"prod_line\": \"OS-1-16-A0\", \"build_rev\": \"v1.13.0\", \"lidar_mode\": \"512x10\", "
               "\"beam_altitude_angles\": [") +
           altitudes + "], \"beam_azimuth_angles\": [" + azimuths +
           "], \"lidar_to_sensor_transform\": [1,0,0,0, 0,1,0,0, 0,0,1,36, 0,0,0,1]}";
  };
  const OusterMetadata metadata = parse_ouster_metadata(of_angles("0, 14.8, 0, -16.9", "0, -3.4, 0, -3.0"));
  EXPECT_EQ(metadata.rings, 4U);
  for (std::size_t ring = 0; ring < 4; ++ring) EXPECT_EQ(metadata.has_laser(ring), ring % 2 == 1) << ring;
  EXPECT_TRUE(parse_ouster_metadata(of_angles("1, 0, -1", "0, 0, 0")).has_laser(1)) << "one row of zeros is a beam";
  EXPECT_NE(test::said_by<FrameError>([&] { parse_ouster_metadata(of_angles("0, 0, 0", "0, 0, 0")); }), "");
}

// Firmware 1 tells no layout of its packets: it has one.
TEST(OusterMetadata, ThatOfFirmware1IsReadByItsMode) {
  const std::string text =
      "{\"prod_line\": \"OS-1-16\", \"lidar_mode\": \"2048x10\", \"beam_altitude_angles\": [1, 0, -1], "
      "\"beam_azimuth_angles\": [0, 0, 0], \"lidar_origin_to_beam_origin_mm\": 12.163, "
      "\"lidar_to_sensor_transform\": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1]}";
  const OusterMetadata metadata = parse_ouster_metadata(text);
  EXPECT_EQ(metadata.columns_per_frame, 2048U);
  EXPECT_EQ(metadata.columns_per_packet, 16U);
  EXPECT_EQ(metadata.rings, 3U);
  EXPECT_STREQ(metadata.profile.name, "LEGACY");
}

}  // namespace
}  // namespace pose_wall::tools

#endif
