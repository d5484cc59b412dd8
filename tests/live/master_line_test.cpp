// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the line to the master of ROS 1 passes on what both sides say. It hangs up where nobody answers and where
// nobody is. It ends every call when it is told to. It takes no more calls than it has room for.

#ifdef POSE_WALL_LIVE_HAS_ROS1

#include "apps/live/ros1/master_line.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "live/frame_catcher.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::becomes_true;

// As poll takes it.
constexpr int kPatience_ms = static_cast<int>(std::chrono::milliseconds(pose_wall::test::kPatience).count());

class Socket {
 public:
  explicit Socket(int number = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) : number_(number) {}
  Socket(Socket&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() {
    if (number_ >= 0) close(number_);
  }
  int number() const { return number_; }

  bool say(const std::string& text) const {
    return send(number_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }
  // As many bytes, or fewer where the other side hung up.
  std::string hear(std::size_t count) const {
    std::string heard;
    char bytes[4096];
    while (heard.size() < count && has_news()) {
      const ssize_t got = recv(number_, bytes, std::min(sizeof bytes, count - heard.size()), 0);
      if (got <= 0) break;
      heard.append(bytes, static_cast<std::size_t>(got));
    }
    return heard;
  }
  bool was_hung_up_on() const {
    char byte = 0;
    return has_news() && recv(number_, &byte, 1, 0) <= 0;
  }
  bool has_news(int wait_ms = kPatience_ms) const {
    pollfd file{number_, POLLIN, 0};
    return poll(&file, 1, wait_ms) > 0;
  }

 private:
  int number_;
};

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

// Listens; whether it answers is the test's business.
class FakeMaster {
 public:
  FakeMaster() {
    sockaddr_in own = loopback(0);
    socklen_t size = sizeof own;
    auto* address = reinterpret_cast<sockaddr*>(&own);
    if (bind(socket_.number(), address, size) != 0 || listen(socket_.number(), 64) != 0) return;
    if (getsockname(socket_.number(), address, &size) == 0) port_ = ntohs(own.sin_port);
  }
  HostPort where() const { return {"127.0.0.1", port_}; }
  Socket accepted() const {
    return socket_.has_news() ? Socket(accept(socket_.number(), nullptr, nullptr)) : Socket(-1);
  }

 private:
  Socket socket_;
  std::uint16_t port_ = 0;
};

Socket called(const MasterLine& line) {
  const sockaddr_in address = loopback(static_cast<std::uint16_t>(parse_master_uri(line.uri())->port));
  Socket caller;
  EXPECT_EQ(connect(caller.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  return caller;
}

TEST(MasterLine, AddressesOfMasters) {
  const std::optional<HostPort> found = parse_master_uri("http://machine-7.mine:11311/");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->host, "machine-7.mine");
  EXPECT_EQ(found->port, 11311);
  EXPECT_TRUE(parse_master_uri("http://10.0.0.1:1").has_value());
  for (const char* none :
       {"", "http://", "http://host", "http://host:", "http://host:0", "http://host:65536", "host:11311",
        "https://host:11311", "http://:11311", "http://host:11311/path", "http://host:11311//"}) {
    EXPECT_FALSE(parse_master_uri(none).has_value()) << none;
  }
}

TEST(MasterLine, PassesOnWhatBothSay) {
  const FakeMaster master;
  const MasterLine line(master.where());
  const Socket caller = called(line);
  const Socket answerer = master.accepted();
  // More than one read of the line takes, and again on the same connection, as roscpp does.
  for (const std::size_t size : {std::size_t{5}, std::size_t{200'000}, std::size_t{1}}) {
    const std::string question(size, 'q'), answer(2 * size, 'a');
    std::thread asks([&] { EXPECT_TRUE(caller.say(question)); });
    EXPECT_EQ(answerer.hear(size), question);
    asks.join();
    std::thread answers([&] { EXPECT_TRUE(answerer.say(answer)); });
    EXPECT_EQ(caller.hear(2 * size), answer);
    answers.join();
  }
}

TEST(MasterLine, TheLastWordsOfAMasterThatHangsUpArrive) {
  const FakeMaster master;
  const MasterLine line(master.where());
  const Socket caller = called(line);
  {
    const Socket answerer = master.accepted();
    EXPECT_TRUE(caller.say("ask"));
    EXPECT_EQ(answerer.hear(3), "ask");
    EXPECT_TRUE(answerer.say("bye"));
  }
  EXPECT_EQ(caller.hear(3), "bye");
  EXPECT_TRUE(caller.was_hung_up_on());
}

TEST(MasterLine, HangsUpWhereNobodyAnswers) {
  const FakeMaster master;
  const MasterLine line(master.where());
  const Socket caller = called(line);
  const Socket silent = master.accepted();
  EXPECT_TRUE(caller.say("ask"));
  EXPECT_TRUE(caller.was_hung_up_on());
  EXPECT_EQ(silent.hear(4), "ask") << "and the master is told so";
}

TEST(MasterLine, HangsUpWhereNobodyIsAndWhereTheNameIsUnknown) {
  std::uint16_t nobody = 0;
  {
    const FakeMaster gone;
    nobody = static_cast<std::uint16_t>(gone.where().port);
  }
  for (const HostPort& where : {HostPort{"127.0.0.1", nobody}, HostPort{"no-such-machine.invalid", 11311}}) {
    const MasterLine line(where);
    EXPECT_TRUE(called(line).was_hung_up_on()) << where.host;
  }
}

TEST(MasterLine, ACallerWhoHungUpDoesNotDisturbTheNext) {
  const FakeMaster master;
  const MasterLine line(master.where());
  { const Socket caller = called(line); }
  const Socket caller = called(line);
  EXPECT_TRUE(caller.say("ask"));
  // The first one may have hung up before the master was called for it.
  EXPECT_TRUE(becomes_true([&] {
    const Socket answerer = master.accepted();
    return answerer.hear(3) == "ask" && answerer.say("yes");
  }));
  EXPECT_EQ(caller.hear(3), "yes");
}

TEST(MasterLine, EndsCallsAndTakesNoNewOnes) {
  const FakeMaster master;
  MasterLine line(master.where());
  const Socket caller = called(line);
  const Socket silent = master.accepted();
  EXPECT_TRUE(caller.say("ask"));
  line.end_within(std::chrono::milliseconds(1));
  EXPECT_TRUE(caller.was_hung_up_on());
  EXPECT_TRUE(called(line).was_hung_up_on());
}

TEST(MasterLine, TakesNoMoreCallsThanItHasRoomFor) {
  const FakeMaster master;
  const MasterLine line(master.where());
  std::vector<Socket> callers, answerers;
  for (std::size_t i = 0; i < MasterLine::kCallsMost; ++i) {
    callers.push_back(called(line));
    answerers.push_back(master.accepted());
  }
  EXPECT_TRUE(called(line).was_hung_up_on());
  EXPECT_TRUE(callers.front().say("ask"));
  EXPECT_EQ(answerers.front().hear(3), "ask");
}

}  // namespace
}  // namespace pose_wall::tools::live

#endif
