// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: whatever the process of ROS 1 does, the daemon's side goes on. It may abort, hang, say garbage, or end in the
// middle of a word. It is replaced no faster than it may be, is told everything anew, and its end is named. Shell
// scripts stand in for it; the real one is tried by ros1_peer.py.

#ifdef POSE_WALL_LIVE_HAS_ROS1

#include "apps/live/ros1/ros1_proxy.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "live/frame_catcher.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::becomes_true;
using std::chrono::milliseconds;

class Ros1ProxyTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "ros1_proxy_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Each start leaves a file named by its process, beside what the script does.
  std::string script(const std::string& words) const {
    const std::filesystem::path program = folder_ / "node";
    std::ofstream(program) << "#!/bin/sh\ncd '" << folder_.string() << "'\n: > $$.pid\n" << words << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return program;
  }
  std::vector<pid_t> processes() const {
    std::vector<pid_t> found;
    for (const auto& file : std::filesystem::directory_iterator(folder_)) {
      if (file.path().extension() == ".pid") found.push_back(std::stoi(file.path().stem()));
    }
    return found;
  }
  bool starts(std::size_t count) const {
    return becomes_true([&] { return processes().size() >= count; });
  }

  std::filesystem::path folder_;
};

// Quick, so that the test is; rest and quiet as long as a look of the test may take.
Ros1Proxy::Times quick_times() {
  return {milliseconds(300), milliseconds(200), milliseconds(300), milliseconds(1500), milliseconds(100)};
}

std::string fact_of(const Ros1Proxy& proxy, const std::string& name) {
  PartHealth health;
  proxy.add_facts(&health);
  return pose_wall::test::fact(health, name);
}

bool tells(const Ros1Proxy& proxy, const std::string& needle) {
  return becomes_true([&] { return proxy.trouble().find(needle) != std::string::npos; });
}

bool is_gone(pid_t process) {
  return becomes_true([&] { return kill(process, 0) != 0; });
}

TEST_F(Ros1ProxyTest, NamesEachEndAndStartsAnewNoFasterThanItMay) {
  for (const auto& [words, told] :
       {std::pair<const char*, const char*>{"kill -ABRT $$", "ended by signal 6"},
        {"kill -SEGV $$", "ended by signal 11"},
        {"exit 7", "ended with status 7"},
        {"printf 'PWP1\\004\\000\\000\\000' >&3; kill -KILL $$", "ended by signal 9"},
        {"echo garbage garbage garbage >&3; exec sleep 100", "said what it must not say"}}) {
    for (const pid_t process : processes()) std::filesystem::remove(folder_ / (std::to_string(process) + ".pid"));
    Ros1Proxy proxy("node", script(words), quick_times());
    const auto begin = std::chrono::steady_clock::now();
    proxy.start();
    EXPECT_TRUE(tells(proxy, told)) << proxy.trouble();
    EXPECT_NE(proxy.trouble().find("it is started anew"), std::string::npos);
    EXPECT_TRUE(starts(3)) << words;
    EXPECT_GE(std::chrono::steady_clock::now() - begin, 2 * quick_times().between_starts);
    EXPECT_NE(fact_of(proxy, "process ended last").find(told), std::string::npos);
    EXPECT_GE(std::stoi(fact_of(proxy, "process started anew")), 2);
    proxy.stop();
    for (const pid_t process : processes()) EXPECT_TRUE(is_gone(process));
  }
}

TEST_F(Ros1ProxyTest, AProgramThatIsNotThereIsNamedAndTriedAgain) {
  Ros1Proxy proxy("node", folder_ / "none", quick_times());
  proxy.start();
  EXPECT_TRUE(tells(proxy, "cannot be started")) << proxy.trouble();
  EXPECT_TRUE(becomes_true([&] { return std::stoi(fact_of(proxy, "process started anew")) >= 2; }));
}

TEST_F(Ros1ProxyTest, WhoHangsLosesMessagesIsToldAndIsEnded) {
  Ros1Proxy proxy("node", script("exec sleep 100"), quick_times());
  const std::size_t topic = proxy.advertise("/topic", kBoolType, false);
  proxy.start();
  ASSERT_TRUE(starts(1));
  const std::string message(1'000'000, 'm');
  for (int i = 0; i < 100; ++i) proxy.publish(topic, message);
  EXPECT_GE(std::stoi(fact_of(proxy, "messages lost to a slow process")), 50);
  EXPECT_TRUE(tells(proxy, "has not answered for 0.3 s; after 1.5 s it is started anew")) << proxy.trouble();
  EXPECT_TRUE(tells(proxy, "did not answer for 1.5 s; it is started anew")) << proxy.trouble();
  const std::vector<pid_t> first = processes();
  ASSERT_TRUE(starts(2));
  EXPECT_TRUE(is_gone(first.front()));
  const auto begin = std::chrono::steady_clock::now();
  proxy.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, pose_wall::test::kPatience) << "by force where it must";
  for (const pid_t process : processes()) EXPECT_TRUE(is_gone(process));
}

// What a process was told, from a file.
std::vector<std::string> told_in(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file).rdbuf();
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return {};
  const std::string all = bytes.str();
  if (send(ends[0], all.data(), all.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(all.size())) return {};
  close(ends[0]);
  std::vector<std::string> told;
  ParcelReader reader;
  while (reader.read(ends[1], [&](const Parcel& parcel) {
    std::string text = std::to_string(static_cast<int>(parcel.kind)) + " " + std::to_string(parcel.number) + " ";
    const auto advertised = parcel.kind == ParcelKind::kAdvertise ? read_advertised(parcel.bytes) : std::nullopt;
    told.push_back(text + (advertised ? advertised->topic : std::string(text_of(parcel.bytes))));
  }) == ParcelReader::Outcome::kOpen) {
  }
  close(ends[1]);
  return told;
}

TEST_F(Ros1ProxyTest, EachProcessIsToldTopicsAndTheNewestLatchedMessage) {
  Ros1Proxy proxy("node", script("echo $1 > name; timeout 0.5 cat <&3 > $$.told; : > $$.done; kill -ABRT $$"),
                  quick_times());
  proxy.subscribe("/clouds", 2, [](const std::string&, ByteView) {});
  const std::size_t passing = proxy.advertise("passing", kBoolType, false);
  const std::size_t latched = proxy.advertise("/latched", kBoolType, true);
  proxy.publish(passing, "before the start: lost");
  proxy.publish(latched, "old");
  proxy.publish(latched, "new");
  proxy.start();
  const auto ended = [&] {
    std::size_t count = 0;
    for (const pid_t process : processes())
      count += std::filesystem::exists(folder_ / (std::to_string(process) + ".done"));
    return count;
  };
  ASSERT_TRUE(becomes_true([&] { return ended() >= 2; }));
  proxy.stop();
  std::size_t looked = 0;
  for (const pid_t process : processes()) {
    if (!std::filesystem::exists(folder_ / (std::to_string(process) + ".done"))) continue;
    ++looked;
    EXPECT_EQ(told_in(folder_ / (std::to_string(process) + ".told")),
              (std::vector<std::string>{"1 2 /clouds", "2 0 passing", "2 1 /latched", "3 0 ", "4 1 new"}));
  }
  EXPECT_GE(looked, 2U);
  std::string name;
  std::ifstream(folder_ / "name") >> name;
  EXPECT_EQ(name, "node");
}

TEST_F(Ros1ProxyTest, MessagesAndStatusArriveAndNumbersOfNoTopicAreOfNoUse) {
  const auto add = [&](const Parcel& parcel) {
    std::ofstream(folder_ / "words", std::ios::app) << parcel_head(parcel) << text_of(parcel.bytes);
  };
  const auto view = [](const std::string& text) {
    return ByteView{reinterpret_cast<const std::byte*>(text.data()), text.size()};
  };
  const std::string status = status_bytes({true, false, 4, 2, {6}}), message = "message";
  add({ParcelKind::kMessage, 1, "none", view(message)});
  add({ParcelKind::kStatus, 0, {}, view("no status")});
  add({ParcelKind::kMessage, 0, "some_msgs/Type", view(message)});
  add({ParcelKind::kStatus, 0, {}, view(status)});
  Ros1Proxy proxy("node", script("while cat words >&3; do sleep 0.1; done"), quick_times());
  std::atomic<int> taken{0}, others{0};
  proxy.subscribe("/clouds", 2, [&](const std::string& type, ByteView bytes) {
    const bool is_it = type == "some_msgs/Type" && text_of(bytes) == "message";
    ++(is_it ? taken : others);
  });
  const std::size_t topic = proxy.advertise("/topic", kBoolType, false);
  EXPECT_NE(proxy.trouble().find("waits for the master at"), std::string::npos);
  proxy.start();
  EXPECT_TRUE(becomes_true([&] { return taken >= 2 && proxy.trouble().empty(); })) << proxy.trouble();
  EXPECT_EQ(others, 0);
  EXPECT_EQ(proxy.publishers(), 4U);
  EXPECT_EQ(proxy.subscribers(topic), 6U);
  EXPECT_EQ(proxy.subscribers(topic + 1), 0U);
  EXPECT_EQ(fact_of(proxy, "masters seen"), "2");
  proxy.stop();
  EXPECT_EQ(proxy.subscribers(topic), 0U);
}

TEST_F(Ros1ProxyTest, WhatROSEndedStaysEnded) {
  const std::string status = status_bytes({false, true, 0, 1, {}});
  std::ofstream(folder_ / "words") << parcel_head({ParcelKind::kStatus, 0, {}, {nullptr, status.size()}}) << status;
  Ros1Proxy proxy("node", script("cat words >&3"), quick_times());
  proxy.start();
  EXPECT_TRUE(tells(proxy, "was ended by rosnode kill or by another node of its name"));
  ASSERT_TRUE(becomes_true([&] { return fact_of(proxy, "process ended last") == "ended with status 0"; }));
  std::this_thread::sleep_for(3 * quick_times().between_starts);
  EXPECT_EQ(processes().size(), 1U);
  EXPECT_TRUE(tells(proxy, "was ended by rosnode kill"));
}

TEST_F(Ros1ProxyTest, NamesThatRosRefusesAreRefused) {
  Ros1Proxy proxy("node", "none", quick_times());
  for (const char* topic : {"", "two words", "1st", "a-b", "_hidden", "a\xC3\xA4"}) {
    EXPECT_THROW(proxy.subscribe(topic, 1, [](const std::string&, ByteView) {}), std::runtime_error) << topic;
  }
  for (const char* topic : {"/lidar/points", "points_2", "/"}) {
    EXPECT_NO_THROW(proxy.subscribe(topic, 1, [](const std::string&, ByteView) {})) << topic;
  }
}

}  // namespace
}  // namespace pose_wall::tools::live

#endif
