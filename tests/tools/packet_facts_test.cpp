// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: of whoever sent a capture is told what its packets say, and nothing that they leave open; packets that are
// missing are counted, those that came twice or late are not.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_PCAP

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/packets/hesai_models.hpp"
#include "io/packets/packet_words.hpp"
#include "ouster_packets.hpp"
#include "packet_files.hpp"
#include "ran_command.hpp"
#include "robosense_packets.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::uint32_t kVlp16Packet_us = 1327;

// "" where it is not told.
std::string found(const SourceSender& sender, const std::string& word) {
  for (const SourceFact& fact : sender.facts) {
    if (fact.word == word) return fact.found;
  }
  return "";
}

SourceSender only_sender(const std::string& file, const SensorOptions& options = {}) {
  const std::vector<SourceSender> senders = read(file, options).about.senders;
  EXPECT_EQ(senders.size(), 1U);
  return senders.empty() ? SourceSender{} : senders.front();
}

// 12 degrees a packet, 30 a turn.
std::string vlp16_packet(std::size_t number, std::uint8_t mode = 0x37) {
  test::VelodynePacket packet;
  packet.first_deg = 12.0 * static_cast<double>(number % 30);
  packet.step_deg = 1.0;
  packet.clock_us = kVlp16Packet_us * static_cast<std::uint32_t>(number);
  packet.mode = mode;
  return payload_of(packet);
}

std::string vlp16_capture(const std::vector<std::size_t>& numbers, std::uint8_t mode = 0x37) {
  std::string file = test::capture_head();
  std::uint32_t at_us = 0;
  for (const std::size_t number : numbers) {
    at_us = std::max(at_us + 5, kVlp16Packet_us * static_cast<std::uint32_t>(number));
    file += captured(datagram(vlp16_packet(number, mode)), at_us);
  }
  return file;
}

std::vector<std::size_t> up_to(std::size_t count) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

std::string position_packet(const std::string& sentence) {
  std::string payload(512, '\0');
  payload.replace(206, sentence.size(), sentence);
  return big(8308) + big(8308) + big(520) + big(0) + payload;
}

TEST(PacketFacts, OfAVelodyne) {
  const TempFolder folder;
  const SourceSender sender = only_sender(folder.write("a.pcap", vlp16_capture(up_to(120))));
  EXPECT_EQ(found(sender, "address"), "10.1.1.1");
  EXPECT_EQ(found(sender, "sends to port"), "2368");
  EXPECT_EQ(found(sender, "network card"), "65:65:65:65:65:65");
  EXPECT_EQ(found(sender, "model"), "Velodyne VLP-16");
  EXPECT_EQ(found(sender, "return mode"), "strongest");
  EXPECT_EQ(found(sender, "turn rate"), "1507 rpm");
  EXPECT_EQ(found(sender, "field of view"), "360°");
  EXPECT_EQ(found(sender, "packets lost"), "0.00 % (0)");
  EXPECT_EQ(found(sender, "synchronised"), "") << "nobody told";
  EXPECT_EQ(sender.oddities, std::vector<std::string>{});
}

TEST(PacketFacts, MissingPacketsAreCounted) {
  const TempFolder folder;
  std::vector<std::size_t> numbers = up_to(120);
  numbers.erase(numbers.begin() + 70, numbers.begin() + 73);  // lost
  std::swap(numbers[50], numbers[51]);                        // out of order
  numbers.insert(numbers.begin() + 20, 18);                   // twice
  const SourceSender sender = only_sender(folder.write("a.pcap", vlp16_capture(numbers)));
  EXPECT_EQ(found(sender, "packets lost"), "2.50 % (3)");
  ASSERT_EQ(sender.oddities.size(), 3U);
  EXPECT_EQ(sender.oddities[0].find("3 of its packets are not in the recording, 2.50 %"), 0U);
  EXPECT_EQ(sender.oddities[1].find("1 of its packets came twice"), 0U);
  EXPECT_EQ(sender.oddities[2].find("1 of its packets came behind later ones"), 0U);
}

TEST(PacketFacts, AFieldOfViewIsNoLoss) {
  const TempFolder folder;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < 150; ++i) {
    if (i % 30 >= 8 && i % 30 < 22) numbers.push_back(i);
  }
  const SourceSender sender = only_sender(folder.write("a.pcap", vlp16_capture(numbers)));
  EXPECT_EQ(found(sender, "field of view"), "95°-265°");
  EXPECT_EQ(found(sender, "turn rate"), "1507 rpm");
  EXPECT_EQ(found(sender, "packets lost"), "");
  EXPECT_EQ(sender.oddities, std::vector<std::string>{});
}

TEST(PacketFacts, AReceiverOfGpsTellsOfTheTime) {
  const TempFolder folder;
  const std::string data = vlp16_capture(up_to(90));
  const auto with = [&](const std::string& sentence) {
    return only_sender(folder.write("a.pcap", data + captured(position_packet(sentence), 200'000)));
  };
  EXPECT_EQ(found(with("$GPRMC,095534,A,3717,N,12156,W,0,0,140317,0,E\r\n"), "synchronised"), "yes");
  const SourceSender invalid = with("$GPRMC,095534,V,3717,N,12156,W,0,0,140317,0,E\r\n");
  EXPECT_EQ(found(invalid, "synchronised"), "no");
  EXPECT_EQ(invalid.oddities.size(), 1U);
  const SourceSender none = with("");
  EXPECT_EQ(found(none, "time source"), "no sentence of a GPS receiver");
  EXPECT_EQ(found(none, "synchronised"), "");
}

TEST(PacketFacts, OfAHesai) {
  const TempFolder folder;
  for (const test::HesaiPacket& kind :
       {test::HesaiPacket{}, test::HesaiPacket{16, 8}, test::xt32m_packet(), test::HesaiPacket{40, 10},
        test::HesaiPacket{64, 4}, test::qt128_packet(), test::pandar64_packet()}) {
    SCOPED_TRACE(kind.lasers);
    const std::size_t behind_number = kind.lasers == 128 ? 4 + 32 : 0;
    const bool has_no_number = kind.lasers == 40 || (kind.lasers == 64 && kind.blocks == 6);
    std::vector<std::string> payloads;
    for (std::uint32_t i = 0; i < 40; ++i) {
      if (i == 11 || i == 20) continue;
      test::HesaiPacket packet = kind;
      packet.step_deg = 4.0;
      packet.first_deg = 4.0 * static_cast<double>(kind.blocks * i % 90);
      std::string payload = payload_of(packet);
      if (has_no_number) payload += "none";
      payload.replace(payload.size() - behind_number - 4, 4, raw(i + 0xFFFFFFF0U));
      payloads.push_back(payload);
    }
    const SourceSender sender = only_sender(folder.write("a.pcap", test::capture_of(payloads)));
    EXPECT_EQ(found(sender, "return mode"), "strongest");
    EXPECT_EQ(found(sender, "turn rate"), "600 rpm");
    EXPECT_EQ(found(sender, "packets lost"), "5.00 % (2)");
  }
}

TEST(PacketFacts, OfAMid360) {
  const TempFolder folder;
  const std::string point = raw(1000) + raw(0) + raw(0) + "\x2A" + '\0';
  const auto sender_of = [&](char time_type, bool is_counted) {
    std::vector<std::string> payloads;
    for (std::uint32_t i = 0; i < 900; ++i) {
      if (i == 100) continue;
      std::string payload = test::mid360_payload(1, 480'000ULL * i, {point, point});
      payload[11] = time_type;
      // Of each frame anew.
      payload.replace(7, 2, raw(static_cast<std::uint16_t>(is_counted ? i % 200 : 9)));
      payloads.push_back(payload);
    }
    return only_sender(folder.write("a.pcap", test::capture_of(payloads)));
  };
  const SourceSender free = sender_of(0, true);
  EXPECT_EQ(found(free, "return mode"), "one return");
  EXPECT_EQ(found(free, "time source"), "none: since its start");
  EXPECT_EQ(found(free, "synchronised"), "no");
  EXPECT_EQ(found(free, "packets lost"), "0.11 % (1)");
  const SourceSender synchronised = sender_of(1, false);
  EXPECT_EQ(found(synchronised, "time source"), "PTP");
  EXPECT_EQ(found(synchronised, "synchronised"), "yes");
  EXPECT_EQ(found(synchronised, "packets lost"), "") << "its packets have no numbers";
}

TEST(PacketFacts, OfALivoxThatCountsOn) {
  const TempFolder folder;
  const std::string point = raw(1000) + raw(0) + raw(0) + "\x2A" + '\0';
  std::vector<std::string> payloads;
  for (std::uint32_t i = 0; i < 900; ++i) {
    if (i == 700) continue;
    std::string payload = test::mid360_payload(0x11, 480'000ULL * i, {point + point});
    payload.replace(7, 2, raw(static_cast<std::uint16_t>(65136 + i)));  // from 65535 to 0 at the 400th
    payloads.push_back(payload);
  }
  const SourceSender sender = only_sender(folder.write("a.pcap", test::capture_of(payloads)));
  EXPECT_EQ(found(sender, "return mode"), "two returns");
  EXPECT_EQ(found(sender, "model"), "Livox Mid-360, Mid-360S, HAP or Avia 2");
  EXPECT_EQ(found(sender, "packets lost"), "0.11 % (1)");
}

TEST(PacketFacts, OfAnOuster) {
  const TempFolder folder;
  const auto sender_of = [&](const std::string& of_format) {
    test::OusterPacket first;
    first.serial = test::kOusterSerial;
    std::vector<std::string> payloads;
    for (const test::OusterPacket& packet : test::turns_of(first, 10)) payloads.push_back(payload_of(packet));
    payloads.erase(payloads.begin() + 13);
    const std::string more =
        ", \"build_rev\": \"v3.1.0\", \"config_params\": {\"lidar_mode\": \"1024x10\", \"timestamp_mode\": "
        "\"TIME_FROM_PTP_1588\"}" +
        test::ouster_serial_told(test::kOusterSerial);
    SensorOptions options;
    options.metadata = folder.write("told.json", test::ouster_json({"RNG15_RFL8_NIR8", of_format, more}));
    return only_sender(folder.write("a.pcap", test::capture_of(payloads)), options);
  };
  const SourceSender sender = sender_of("");
  EXPECT_EQ(found(sender, "model"), "Ouster OS-test");
  EXPECT_EQ(found(sender, "serial"), "122201000111");
  EXPECT_EQ(found(sender, "firmware"), "v3.1.0");
  EXPECT_EQ(found(sender, "profile"), "RNG15_RFL8_NIR8");
  EXPECT_EQ(found(sender, "lidar mode"), "1024x10");
  EXPECT_EQ(found(sender, "time source"), "TIME_FROM_PTP_1588");
  EXPECT_EQ(found(sender, "packets lost"), "2.50 % (1)");
  const SourceSender window = sender_of(", \"column_window\": [0, 13]");
  EXPECT_EQ(found(window, "column window"), "0-13 / 16");
  EXPECT_EQ(found(window, "packets lost"), "") << "not all packets of a turn are sent";
}

// Bytes 18 and 19 of its head.
std::string heated(std::string payload, char shutting_down, char limiting) {
  payload[18] = shutting_down;
  payload[19] = limiting;
  return payload;
}

TEST(PacketFacts, TheHeatOfAnOusterIsThatOfItsNewestPacketAndARecordingTellsAllOfIt) {
  for (const bool is_fusa : {false, true}) {
    SCOPED_TRACE(is_fusa);
    test::OusterPacket packet;
    packet.profile = is_fusa ? "FUSA_RNG15_RFL8_NIR8_DUAL" : "RNG15_RFL8_NIR8";
    packet.is_fusa = is_fusa;
    packet.serial = test::kOusterSerial;
    const std::string json = test::ouster_json(
        {packet.profile, is_fusa ? ", \"header_type\": \"FUSA\"" : "", test::ouster_serial_told(packet.serial)});
    const std::string cool = payload_of(packet);
    const std::unique_ptr<PacketWords> words = packet_words_for(test::view_of(cool), json);
    ASSERT_TRUE(words);
    const auto alert_of = [&](const std::string& payload) {
      words->hear({0, {}, test::view_of(payload)});
      return words->state().alert.value_or("not told");
    };
    EXPECT_EQ(alert_of(cool), "");
    EXPECT_EQ(alert_of(heated(cool, 0, 1)), "the sensor is hot and will soon send fewer shots: cool it");
    EXPECT_EQ(alert_of(heated(cool, 0, 5)),
              "the sensor is too hot and sends up to 40 % fewer shots, so that dark walls may be missing: cool it");
    EXPECT_EQ(alert_of(heated(cool, 1, 5)), "the sensor is too hot and will switch itself off: cool it");
    EXPECT_EQ(alert_of(heated(cool, 0x10, 0x30)), "") << "only the lower halves tell it";
    SourceSender sender;
    words->describe(&sender);
    ASSERT_EQ(sender.oddities.size(), 3U);
    EXPECT_EQ(sender.oddities.front(), "1 of 5 packets: the sensor is hot and will soon send fewer shots: cool it");
  }
  test::OusterPacket legacy;
  legacy.profile = "LEGACY";
  const std::string payload = payload_of(legacy);
  const std::unique_ptr<PacketWords> words = packet_words_for(test::view_of(payload), test::ouster_json({"LEGACY"}));
  ASSERT_TRUE(words);
  words->hear({0, {}, test::view_of(payload)});
  EXPECT_FALSE(words->state().alert) << "it has no place for it";
}

// Of an XT32: bytes 9, 13 and 19 of its tail.
std::string hesai_tail(const std::string& date, char heat) {
  std::string payload = payload_of(test::HesaiPacket{});
  const std::size_t tail = hesai_traits(HesaiModel::kXt32).tail_at();
  payload[tail + 9] = heat;
  payload.replace(tail + 13, 6, date);
  payload.replace(tail + 19, 4, raw(250'000U));
  return payload;
}

TEST(PacketFacts, AHesaiTellsItsHeatAndADateOrSeconds) {
  const auto state_of = [](const std::string& payload) {
    const std::unique_ptr<PacketWords> words = packet_words_for(test::view_of(payload), "");
    words->hear({0, {}, test::view_of(payload)});
    return words->state();
  };
  const std::string new_year_2026("\x7E\x01\x01\0\0\0", 6), in_seconds("\0\0\x69\x55\xB9\0", 6);
  EXPECT_EQ(state_of(hesai_tail(new_year_2026, 0)).alert.value(), "");
  EXPECT_EQ(state_of(hesai_tail(new_year_2026, 1)).alert.value(), "the sensor is too hot and pauses: cool it");
  constexpr std::int64_t kNewYear_ns = 1'767'225'600'250'000'000;  // date -u -d 2026-01-01 +%s, and the microseconds
  EXPECT_EQ(state_of(hesai_tail(new_year_2026, 0)).clock.value().clock_ns, kNewYear_ns);
  EXPECT_EQ(state_of(hesai_tail(in_seconds, 0)).clock.value().clock_ns, kNewYear_ns);
  EXPECT_FALSE(state_of(hesai_tail(std::string(6, '\0'), 0)).clock) << "nobody set it";
  EXPECT_FALSE(state_of(hesai_tail(std::string("\x7E\x0D\x01\0\0\0", 6), 0)).clock) << "there is no 13th month";
}

TEST(PacketFacts, OfARoboSense) {
  const TempFolder folder;
  const auto sender_of = [&](test::RoboSenseExample example) {
    example.device.bytes = {{32, 0x23}, {33, 0x28}, {34, 0x69}, {35, 0x78}};  // 90 to 270 degrees
    std::vector<std::string> payloads = test::robosense_data(example, 400);
    payloads.insert(payloads.begin(), payload_of(example.device));
    return only_sender(folder.write("a.pcap", test::capture_of(payloads)));
  };
  const SourceSender sender = sender_of(test::helios32_example());
  EXPECT_EQ(found(sender, "serial"), "1A2B3C4D5E6F");
  EXPECT_EQ(found(sender, "firmware"), "00 06 23 09 00 / 08 03 01 01 01");
  EXPECT_EQ(found(sender, "return mode"), "one return");
  EXPECT_EQ(found(sender, "turn rate"), "600 rpm");
  EXPECT_EQ(found(sender, "field of view"), "90°-270°");
  EXPECT_EQ(found(sender_of(test::with_two_returns(test::helios32_example())), "return mode"), "two returns");
}

// Its packets are numbered from 1 to 630 in each frame (rs_driver 4eeadace).
TEST(PacketFacts, OfARoboSenseM1) {
  const TempFolder folder;
  std::vector<std::string> payloads;
  for (std::uint16_t i = 0; i < 1260; ++i) {
    if (i == 100 || i == 700) continue;
    std::string payload = "\x55\xAA\x5A\xA5" + big(static_cast<std::uint16_t>(i % 630 + 1));
    payload.resize(1210, '\0');
    payloads.push_back(payload);
  }
  const SourceSender sender = only_sender(folder.write("a.pcap", test::capture_of(payloads)));
  EXPECT_EQ(found(sender, "model"), "RoboSense M1");
  EXPECT_EQ(found(sender, "packets lost"), "0.16 % (2)");
}

TEST(PacketFacts, AClockThatDoesNotGoAsPacketsArriveIsOdd) {
  const auto oddity = [](double goes_by) {
    ClockBesideArrival clock;
    for (std::int64_t i = 0; i <= 2000; ++i) {
      clock.hear(static_cast<std::int64_t>(goes_by * 1e6 * static_cast<double>(i)), 1'000'000 * i, 500'000'000'000);
    }
    return clock.oddity();
  };
  EXPECT_EQ(oddity(1.0), "");
  EXPECT_EQ(oddity(0.0), "its clock stands still while its packets came in 2.00 s");
  EXPECT_EQ(oddity(2.0).find("its clock went 4.00 s while its packets came in 2.00 s"), 0U);
}

TEST(PacketFacts, InfoPrintsThem) {
  const TempFolder folder;
  std::vector<std::size_t> numbers = up_to(120);
  numbers.erase(numbers.begin() + 70, numbers.begin() + 73);
  const std::string file = folder.write("a.pcap", vlp16_capture(numbers, 0x38));
  const std::string text = test::command({"info", "-q", file}).printed;
  for (const char* const told :
       {"10.1.1.1", "return mode", "1507 rpm", "2.50 % (3)", "3 of its packets are not in the recording"}) {
    EXPECT_TRUE(test::contains(text, told)) << told << " in\n" << text;
  }
  const auto page = nlohmann::json::parse(test::command({"info", "-q", "--json", file}).printed);
  const auto& source = page.is_array() ? page.at(0).at("sources").at(0) : page.at("sources").at(0);
  EXPECT_EQ(source.at("facts").at("return_mode"), "last");
  EXPECT_EQ(source.at("facts").at("packets_lost"), "2.50 % (3)");
  EXPECT_EQ(source.at("oddities").size(), 1U);
}

}  // namespace
}  // namespace pose_wall::tools

#endif
