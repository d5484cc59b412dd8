// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what daemon and node of ROS 1 hand each other arrives whole, however the socket cuts it. What is truncated,
// too long or no parcel is told as such, and costs no memory before its bytes are there. Nobody waits for who is slow:
// of each topic the newest messages stay.

#ifdef POSE_WALL_LIVE_HAS_ROS1

#include "apps/live/ros1/parcels.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "apps/live/ros1/node_words.hpp"

namespace pose_wall::tools::live {
namespace {

using Outcome = ParcelReader::Outcome;
using TakenParcel = std::tuple<ParcelKind, std::uint32_t, std::string, std::string>;

ByteView parcel_view(const std::string& text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

struct ParcelPair {
  ParcelPair() { is_open = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0; }
  ParcelPair(const ParcelPair&) = delete;
  ParcelPair& operator=(const ParcelPair&) = delete;
  ~ParcelPair() {
    hang_up();
    close(ends[1]);
  }
  void hang_up() {
    if (is_open) close(ends[0]);
    is_open = false;
  }
  bool say(std::string_view bytes) const {
    return send(ends[0], bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  // Until nothing more is there.
  Outcome hear(ParcelReader* reader, std::vector<TakenParcel>* taken) const {
    char one = 0;
    while (recv(ends[1], &one, 1, MSG_PEEK | MSG_DONTWAIT) >= 0) {
      const Outcome outcome = reader->read(ends[1], [taken](const Parcel& parcel) {
        taken->emplace_back(parcel.kind, parcel.number, std::string(parcel.type), std::string(text_of(parcel.bytes)));
      });
      if (outcome != Outcome::kOpen) return outcome;
    }
    return Outcome::kOpen;
  }

  int ends[2] = {-1, -1};
  bool is_open = false;
};

std::string written_parcel(const TakenParcel& parcel) {
  const auto& [kind, number, type, bytes] = parcel;
  return parcel_head({kind, number, type, {nullptr, bytes.size()}}) + bytes;
}

const std::vector<TakenParcel>& some_parcels() {
  static const std::vector<TakenParcel> parcels = {{ParcelKind::kMessage, 7, "a/B", "bytes"},
                                                   {ParcelKind::kStart, 0, "", ""},
                                                   {ParcelKind::kMessage, 4'000'000'000U, "", "x"},
                                                   {ParcelKind::kStatus, 1, "type alone", ""}};
  return parcels;
}

std::string some_bytes() {
  std::string bytes;
  for (const TakenParcel& parcel : some_parcels()) bytes += written_parcel(parcel);
  return bytes;
}

TEST(Parcels, ArriveHoweverTheyAreCut) {
  const std::string bytes = some_bytes();
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    const ParcelPair pair;
    ParcelReader reader;
    std::vector<TakenParcel> taken;
    for (const std::string& part : {bytes.substr(0, cut), bytes.substr(cut)}) {
      ASSERT_TRUE(pair.say(part));
      EXPECT_EQ(pair.hear(&reader, &taken), Outcome::kOpen);
    }
    EXPECT_EQ(taken, some_parcels()) << "cut at " << cut;
  }
  const ParcelPair pair;
  ParcelReader reader;
  std::vector<TakenParcel> taken;
  for (const char one : bytes) {
    ASSERT_TRUE(pair.say({&one, 1}));
    EXPECT_EQ(pair.hear(&reader, &taken), Outcome::kOpen);
  }
  EXPECT_EQ(taken, some_parcels()) << "byte by byte";
}

TEST(Parcels, TheEndIsToldWhereverItComes) {
  const std::string bytes = some_bytes();
  std::size_t end = 0;
  std::vector<std::size_t> ends;
  for (const TakenParcel& parcel : some_parcels()) ends.push_back(end += written_parcel(parcel).size());
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    ParcelPair pair;
    ParcelReader reader;
    std::vector<TakenParcel> taken;
    ASSERT_TRUE(pair.say(bytes.substr(0, length)));
    pair.hang_up();
    EXPECT_EQ(pair.hear(&reader, &taken), Outcome::kClosed);
    std::size_t whole = 0;
    while (whole < ends.size() && ends[whole] <= length) ++whole;
    EXPECT_EQ(taken.size(), whole) << "a parcel that was cut off is none: " << length;
  }
}

TEST(Parcels, WhatIsNoneIsRefused) {
  const std::string head = parcel_head({ParcelKind::kMessage, 0, {}, {}});
  const auto with = [&](std::size_t word, std::uint32_t value) {
    std::string changed = head;
    std::memcpy(changed.data() + 4 * word, &value, sizeof value);
    return changed;
  };
  const auto type_most = static_cast<std::uint32_t>(kParcelTypeMost);
  const auto bytes_most = static_cast<std::uint32_t>(kParcelBytesMost);
  for (const auto& [bytes, outcome] :
       std::vector<std::pair<std::string, Outcome>>{{head, Outcome::kOpen},
                                                    {with(0, 0), Outcome::kBroken},
                                                    {with(1, 0), Outcome::kBroken},
                                                    {with(1, 5), Outcome::kOpen},
                                                    {with(1, 6), Outcome::kBroken},
                                                    {with(3, type_most), Outcome::kOpen},
                                                    {with(3, type_most + 1), Outcome::kBroken},
                                                    {with(4, bytes_most), Outcome::kOpen},
                                                    {with(4, bytes_most + 1), Outcome::kBroken},
                                                    {with(4, 0xFFFFFFFF), Outcome::kBroken},
                                                    {"HTTP/1.1 200 OK, a long line", Outcome::kBroken}}) {
    const ParcelPair pair;
    ParcelReader reader;
    std::vector<TakenParcel> taken;
    ASSERT_TRUE(pair.say(bytes));
    EXPECT_EQ(pair.hear(&reader, &taken), outcome) << testing::PrintToString(bytes);
  }
  const std::string long_type(kParcelTypeMost + 1, 't');
  EXPECT_THROW(parcel_head({ParcelKind::kMessage, 0, long_type, {}}), std::length_error);
  EXPECT_THROW(parcel_head({ParcelKind::kMessage, 0, {}, {nullptr, kParcelBytesMost + 1}}), std::length_error);
}

std::size_t resident_bytes() {
  std::ifstream about("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  about >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(Parcels, ALengthAloneTakesNoMemory) {
  const ParcelPair pair;
  ParcelReader reader;
  std::vector<TakenParcel> taken;
  const std::size_t before = resident_bytes();
  ASSERT_TRUE(pair.say(parcel_head({ParcelKind::kMessage, 0, {}, {nullptr, kParcelBytesMost}}) + "begin"));
  EXPECT_EQ(pair.hear(&reader, &taken), Outcome::kOpen);
  EXPECT_LT(resident_bytes(), before + kParcelBytesMost / 10);
  EXPECT_TRUE(taken.empty());
}

TEST(Parcels, CloudsPassAndTheBufferServesSmallOnesAfterThem) {
  ParcelPair pair;
  const std::string large(65'536 * 32, 'c'), larger(20'000'000, 'd');
  std::thread sends([&] {
    for (const std::string* bytes : {&large, &larger, &large}) {
      EXPECT_TRUE(send_parcel(pair.ends[0], {ParcelKind::kMessage, 1, "sensor_msgs/PointCloud2", parcel_view(*bytes)}));
      EXPECT_TRUE(send_parcel(pair.ends[0], {ParcelKind::kMessage, 2, "small", parcel_view("s")}));
    }
    shutdown(pair.ends[0], SHUT_WR);
  });
  ParcelReader reader;
  std::vector<std::size_t> sizes;
  std::uint32_t small = 0;
  Outcome outcome = Outcome::kOpen;
  while (outcome == Outcome::kOpen) {
    outcome = reader.read(pair.ends[1], [&](const Parcel& parcel) {
      if (parcel.number == 1) sizes.push_back(parcel.bytes.size);
      if (parcel.number == 2 && text_of(parcel.bytes) == "s" && parcel.type == "small") ++small;
    });
  }
  sends.join();
  EXPECT_EQ(outcome, Outcome::kClosed);
  EXPECT_EQ(sizes, (std::vector<std::size_t>{large.size(), larger.size(), large.size()}));
  EXPECT_EQ(small, 3U);
}

TEST(Parcels, WhoSendsToNobodyIsTold) {
  ParcelPair pair;
  pair.hang_up();
  EXPECT_FALSE(send_parcel(pair.ends[1], {ParcelKind::kStart, 0, {}, {}}));
  ParcelQueue queue(2);
  queue.push({ParcelKind::kStart, 0, {}, {}});
  EXPECT_FALSE(queue.send(pair.ends[1]));
}

TEST(Parcels, OfATopicTheNewestWaitAndWhatHasBegunEnds) {
  const ParcelPair pair;
  ParcelQueue queue(2);
  const std::string large(4'000'000, 'l');  // more than a socket holds
  EXPECT_TRUE(queue.push({ParcelKind::kStart, 0, {}, {}}));
  EXPECT_TRUE(queue.push({ParcelKind::kMessage, 0, {}, parcel_view(large)}));
  ASSERT_TRUE(queue.send(pair.ends[0]));
  EXPECT_FALSE(queue.is_empty());
  std::vector<bool> kept;
  for (const char* text : {"1", "2", "3", "4"}) {
    kept.push_back(queue.push({ParcelKind::kMessage, 0, {}, parcel_view(text)}));
  }
  EXPECT_EQ(kept, (std::vector<bool>{true, true, false, false}));
  EXPECT_TRUE(queue.push({ParcelKind::kMessage, 1, {}, parcel_view("of another topic")}));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(queue.push({ParcelKind::kSubscribe, 0, {}, parcel_view("t")}));
  ParcelReader reader;
  std::vector<TakenParcel> taken;
  while (!queue.is_empty()) {
    ASSERT_TRUE(queue.send(pair.ends[0]));
    ASSERT_EQ(pair.hear(&reader, &taken), Outcome::kOpen);
  }
  std::vector<std::string> texts;
  for (const TakenParcel& parcel : taken) texts.push_back(std::get<3>(parcel));
  EXPECT_EQ(texts, (std::vector<std::string>{"", large, "3", "4", "of another topic", "t", "t", "t"}));
}

TEST(Parcels, WordsOfTheNodeComeBackAndAreChecked) {
  const NodeStatus status{true, false, 3, 5'000'000'000, {0, 7}};
  const std::string bytes = status_bytes(status);
  const std::optional<NodeStatus> read = read_status(parcel_view(bytes));
  ASSERT_TRUE(read.has_value());
  EXPECT_TRUE(read->has_master);
  EXPECT_FALSE(read->was_ended_by_ros);
  EXPECT_EQ(read->publishers, 3U);
  EXPECT_EQ(read->masters_seen, 5'000'000'000U);
  EXPECT_EQ(read->subscribers, status.subscribers);
  EXPECT_FALSE(read_status(parcel_view(bytes.substr(0, 13))).has_value());
  EXPECT_FALSE(read_status(parcel_view(bytes + "x")).has_value());
  EXPECT_FALSE(read_status({}).has_value());

  const std::string topic = advertised_bytes("/topic", kBoolType);
  const std::optional<AdvertisedTopic> advertised = read_advertised(parcel_view(topic));
  ASSERT_TRUE(advertised.has_value());
  EXPECT_EQ(advertised->topic, "/topic");
  EXPECT_EQ(advertised->type, "std_msgs/Bool");
  EXPECT_EQ(advertised->md5, kBoolType.md5);
  EXPECT_EQ(advertised->definition, kBoolType.definition);
  for (std::size_t length = 0; length < topic.size(); ++length) {
    EXPECT_FALSE(read_advertised(parcel_view(topic.substr(0, length))).has_value()) << length;
  }
}

}  // namespace
}  // namespace pose_wall::tools::live

#endif
