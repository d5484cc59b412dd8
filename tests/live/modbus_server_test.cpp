// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, byte for byte: registers are the words of the image of that moment, low word of a number first. Each wrong
// request has its exception. Requests that come in parts, in rows or beside garbage get the answers they would have got
// alone. A client that is turned away makes room. The port is free after a stop. One address alone may write commands
// of the drive, and nobody without its key. A command counts when its counter changes, and is never half of two. The
// age of the stop's answers is told.
//
// Does not prove: what clients of others make of it, modbus_peer.py.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "live/frame_catcher.hpp"
#include "live/loopback.hpp"
#include "live/said_stop.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;
using Text = std::string;

// Images whose every byte tells which image it is of.
class CountingImages final : public Images {
 public:
  pose_wall_image image() const override { return filled<pose_wall_image>(0); }
  pose_wall_image2 image2() const override { return filled<pose_wall_image2>(0x80); }
  std::optional<pose_wall_motion_image> motion_image() const override {
    if (!has_motion) return std::nullopt;
    return filled<pose_wall_motion_image>(0x40);
  }
  std::atomic<bool> has_motion{true};

 private:
  template <typename Image>
  Image filled(unsigned first) const {
    Image image{};
    std::memset(&image, static_cast<int>(first + asked_++ % 100), sizeof image);
    const unsigned char known[] = {0x11, 0x22, 0x33, 0x44};  // 0x44332211
    std::memcpy(&image, known, sizeof known);
    return image;
  }
  mutable std::atomic<unsigned> asked_{0};
};

class Client {
 public:
  // from: 127.0.0.2 is another machine to who looks at addresses.
  explicit Client(std::uint16_t port, const char* from = "127.0.0.1")
      : file_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    inet_pton(AF_INET, from, &own.sin_addr);
    EXPECT_EQ(bind(file_, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
    const timeval patience{kPatience.count(), 0};
    setsockopt(file_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_there_ = connect(file_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { close(file_); }

  bool is_there() const { return is_there_; }
  bool send(const Text& bytes) const {
    return ::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  // Fewer where the server closes.
  Text take(std::size_t count) const {
    Text bytes(count, '\0');
    std::size_t got = 0;
    while (got < count) {
      const ssize_t part = recv(file_, bytes.data() + got, count - got, 0);
      if (part <= 0) break;
      got += static_cast<std::size_t>(part);
    }
    return bytes.substr(0, got);
  }
  Text ask(const Text& request, std::size_t answer_bytes) const { return send(request) ? take(answer_bytes) : Text(); }

 private:
  int file_;
  bool is_there_ = false;
};

Text word(unsigned number) {
  return {static_cast<char>(number >> 8U), static_cast<char>(number & 0xFFU)};
}

// An ADU: transaction, protocol 0, length, unit, the rest.
Text adu(unsigned transaction, const Text& pdu, char unit = 1) {
  return word(transaction) + word(0) + word(static_cast<unsigned>(pdu.size()) + 1) + unit + pdu;
}
Text read_request(unsigned transaction, unsigned first, unsigned count) {
  return adu(transaction, Text("\x04") + word(first) + word(count));
}
Text exception(unsigned transaction, unsigned function, char code) {
  return adu(transaction, Text{static_cast<char>(function | 0x80U), code});
}
// Header of seven bytes, function, and what follows: the code of the exception, or a count of bytes and the registers
// (Modbus Application Protocol V1.1b3, 6.4 and 7).
constexpr std::size_t kExceptionBytes = 9;
constexpr std::size_t answer_bytes(std::size_t registers) {
  return 9 + 2 * registers;
}

class ModbusServerTest : public ::testing::Test {
 protected:
  explicit ModbusServerTest(std::vector<std::string> settings = {}) : settings_(std::move(settings)) {}
  void SetUp() override {
    try {
      server_ = make(port_);
    } catch (const EdgeMissing& missing) {
      GTEST_SKIP() << missing.what();
    }
    server_->start();
  }
  void TearDown() override {
    if (server_) server_->stop();
  }
  std::unique_ptr<Sink> make(std::uint16_t port) const {
    std::vector<std::string> settings = settings_;
    settings.push_back("modbus=127.0.0.1:" + std::to_string(port));
    return make_modbus_sink(load_config("", settings), images_, &stop_, &commands_);
  }
  Text alone(const Text& request, std::size_t bytes) const { return Client(port_).ask(request, bytes); }

  const std::vector<std::string> settings_;
  const std::uint16_t port_ = pose_wall::test::free_tcp_port();
  CountingImages images_;
  SaidStop stop_;
  mutable CommandBoard commands_{"modbus", 10.0};
  std::unique_ptr<Sink> server_;
};

TEST_F(ModbusServerTest, ARegisterIsAWordOfTheImageTheLowOneFirst) {
  // 0x44332211 lies in memory as 11 22 33 44: register 0 is 0x2211, register 1 is 0x4433; on the wire high byte first.
  EXPECT_EQ(alone(read_request(7, 0, 2), answer_bytes(2)), adu(7, Text("\x04\x04\x22\x11\x44\x33")));
  EXPECT_EQ(alone(read_request(0xABCD, 1000, 2), answer_bytes(2)), adu(0xABCD, Text("\x04\x04\x22\x11\x44\x33")));
  EXPECT_EQ(alone(read_request(9, 2000, 2), answer_bytes(2)), adu(9, Text("\x04\x04\x22\x11\x44\x33")));
  EXPECT_EQ(alone(read_request(8, 1, 1), answer_bytes(1)), adu(8, Text("\x04\x02\x44\x33")));
}

TEST_F(ModbusServerTest, OneReadIsOneImageAndEachIsNew) {
  const Client client(port_);
  std::set<char> seen;
  for (unsigned i = 0; i < 50; ++i) {
    const unsigned first = i % 3 * 1000;
    const std::size_t registers = std::array<std::size_t, 3>{120, 124, 66}[i % 3];
    const Text answer = client.ask(read_request(i, first, static_cast<unsigned>(registers)), answer_bytes(registers));
    ASSERT_EQ(answer.size(), answer_bytes(registers));
    const Text rest = answer.substr(13);
    EXPECT_EQ(rest, Text(rest.size(), rest[0])) << "of one image";
    seen.insert(rest[0]);
  }
  EXPECT_EQ(seen.size(), 50U) << "asked for at every request";
}

TEST_F(ModbusServerTest, WithoutMotionItsRegistersAreNotThere) {
  images_.has_motion = false;
  constexpr char kAddress = 2;
  EXPECT_EQ(alone(read_request(3, 2000, 66), kExceptionBytes), exception(3, 4, kAddress));
  EXPECT_EQ(alone(read_request(3, 1000, 124), answer_bytes(124)).size(), answer_bytes(124));
}

TEST_F(ModbusServerTest, TheStopIsAnImageOfItsNewestAnswer) {
  StopNews news = opened_news();
  news.result.state = POSE_WALL_PLANAR_STOP_SLOW;
  news.result.allowed_speed_m_s = 0.4567;
  news.result.heartbeat = 0x12345678;
  stop_.say(news);
  pose_wall_planar_stop_image image{};
  image.struct_size = sizeof image;
  ASSERT_EQ(pose_wall_planar_stop_image_fill(&news.result, &image), POSE_WALL_OK);
  Text registers(sizeof image, '\0');
  std::memcpy(registers.data(), &image, sizeof image);
  for (std::size_t i = 0; i + 1 < registers.size(); i += 2) std::swap(registers[i], registers[i + 1]);
  const Text whole = Text("\x04") + static_cast<char>(sizeof image) + registers;
  EXPECT_EQ(alone(read_request(1, 3000, 26), answer_bytes(26)), adu(1, whole));
  EXPECT_EQ(alone(read_request(2, 3006, 2), answer_bytes(2)), adu(2, Text("\x04\x04") + word(0x5678) + word(0x1234)));
  // For a controller that was built for the one register of before: state stop, in a word that it refuses.
  EXPECT_EQ(image.struct_size & 3U, 0U);
  EXPECT_NE(image.struct_size & 0xFCU, 0U);
  news.result.state = POSE_WALL_PLANAR_STOP_STOP;
  stop_.say(news);
  EXPECT_EQ(alone(read_request(3, 3016, 4), answer_bytes(4)), adu(3, Text("\x04\x08") + Text(8, '\0')));
  constexpr char kAddress = 2;
  for (const auto& [first, count] : {std::pair(3000U, 27U), {3025U, 2U}, {3026U, 1U}, {2999U, 2U}}) {
    EXPECT_EQ(alone(read_request(5, first, count), kExceptionBytes), exception(5, 4, kAddress)) << first;
  }
}

TEST_F(ModbusServerTest, TheAgeOfAnAnswerWhenItIsReadIsTold) {
  EXPECT_EQ(fact(server_->health(), "stop's age when read, worst ms"), "0.0");
  StopNews news = opened_news();
  news.answered_ns = monotonic_ns() - 5'000'000'000;
  stop_.say(news);
  EXPECT_EQ(alone(read_request(1, 3000, 26), answer_bytes(26)).size(), answer_bytes(26));
  EXPECT_GE(std::stod(fact(server_->health(), "stop's age when read, worst ms")), 5000.0);
  EXPECT_GE(std::stod(fact(server_->health(), "stop's age when read, mean ms")), 5000.0);
}

TEST_F(ModbusServerTest, WithoutAnAnswerOrAStopAllRegistersAreZero) {
  EXPECT_EQ(alone(read_request(1, 3000, 26), answer_bytes(26)), adu(1, Text("\x04\x34") + Text(52, '\0')));
  const std::uint16_t port = pose_wall::test::free_tcp_port();
  const auto server =
      make_modbus_sink(load_config("", {"modbus=127.0.0.1:" + std::to_string(port)}), images_, nullptr, nullptr);
  server->start();
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(Client(port).ask(read_request(1, 3000, 26), answer_bytes(26)), adu(1, Text("\x04\x34") + Text(52, '\0')));
  }
  server->stop();
}

TEST_F(ModbusServerTest, EachWrongRequestHasItsException) {
  // Illegal function, data address and data value (Modbus Application Protocol V1.1b3, 7).
  constexpr char kFunction = 1, kAddress = 2, kValue = 3;
  for (const auto& [first, count] : {std::pair(1U, 120U),
                                     {120U, 1U},
                                     {119U, 2U},
                                     {999U, 1U},
                                     {999U, 2U},
                                     {1000U, 125U},
                                     {1124U, 1U},
                                     {1123U, 2U},
                                     {1999U, 2U},
                                     {2000U, 67U},
                                     {2066U, 1U},
                                     {65535U, 1U},
                                     {65535U, 125U}}) {
    EXPECT_EQ(alone(read_request(3, first, count), kExceptionBytes), exception(3, 4, kAddress))
        << first << " " << count;
  }
  for (const unsigned count : {0U, 126U, 256U, 65535U}) {
    EXPECT_EQ(alone(read_request(3, 0, count), kExceptionBytes), exception(3, 4, kValue)) << count;
    EXPECT_EQ(alone(read_request(3, 1000, count), kExceptionBytes), exception(3, 4, kValue)) << count;
  }
  for (unsigned function = 1; function < 128; ++function) {
    if (function == 4) continue;
    const Text pdu = Text(1, static_cast<char>(function)) + word(0) + word(1);
    EXPECT_EQ(alone(adu(9, pdu), kExceptionBytes), exception(9, function, kFunction)) << function;
  }
  EXPECT_EQ(alone(adu(5, Text("\x04")), kExceptionBytes), exception(5, 4, kValue)) << "no address";
  EXPECT_EQ(alone(adu(5, Text("\x04") + word(0) + word(1) + "x"), kExceptionBytes), exception(5, 4, kValue)) << "more";
}

// Function 6 or 16 with so many registers.
Text write_request(unsigned transaction, unsigned first, const std::vector<unsigned>& values) {
  Text pdu =
      Text("\x10") + word(first) + word(static_cast<unsigned>(values.size())) + static_cast<char>(2 * values.size());
  for (const unsigned value : values) pdu += word(value);
  return adu(transaction, pdu);
}
Text write_one(unsigned transaction, unsigned at, unsigned value) {
  return adu(transaction, Text("\x06") + word(at) + word(value));
}

class ModbusWriterTest : public ModbusServerTest {
 protected:
  ModbusWriterTest() : ModbusServerTest({"planar=map", "planar_command_modbus=127.0.0.2"}) {}

  Text by_writer(const Text& request, std::size_t bytes) const {
    return Client(port_, "127.0.0.2").ask(request, bytes);
  }
  // The command under way, in mm/s and mrad/s; nothing: none is known.
  std::optional<std::pair<long, long>> command() const {
    const std::optional<DriveMotion> known = commands_.newest(monotonic_ns());
    if (!known) return std::nullopt;
    return std::pair(std::lround(known->speed_m_s * 1e3), std::lround(known->turn_rad_s * 1e3));
  }
  static constexpr std::size_t kWritten = 12;  // bytes of an answer to a write
};

TEST_F(ModbusWriterTest, TheCounterMakesOneCommandOfWhatWasWritten) {
  using Command = std::pair<long, long>;
  const Text all = write_request(7, 4000, {400, 0xFF38, 1});
  EXPECT_EQ(by_writer(all, kWritten), adu(7, Text("\x10") + word(4000) + word(3)));
  EXPECT_EQ(command(), Command(400, -200));
  EXPECT_EQ(by_writer(write_one(8, 4000, 0xFE70), kWritten), write_one(8, 4000, 0xFE70)) << "an echo";
  EXPECT_EQ(by_writer(write_request(9, 4000, {0xFE70, 100}), kWritten).size(), kWritten);
  EXPECT_EQ(command(), Command(400, -200)) << "the counter has not changed";
  EXPECT_EQ(by_writer(write_one(8, 4002, 0xFFFF), kWritten).size(), kWritten);
  EXPECT_EQ(command(), Command(-400, 100));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(by_writer(all, kWritten).size(), kWritten);
  EXPECT_EQ(fact(commands_.health(monotonic_ns()), "commands"), "3") << "a gateway that repeats itself commands once";
}

TEST_F(ModbusWriterTest, WrongWritesHaveTheirExceptionsAndChangeNothing) {
  constexpr char kAddress = 2, kValue = 3;
  for (const auto& [first, count] : {std::pair(3999U, 3U), {4000U, 4U}, {4003U, 1U}, {0U, 3U}, {65535U, 2U}}) {
    EXPECT_EQ(by_writer(write_request(1, first, std::vector<unsigned>(count, 9)), kExceptionBytes),
              exception(1, 16, kAddress))
        << first;
  }
  EXPECT_EQ(by_writer(write_one(2, 4003, 1), kExceptionBytes), exception(2, 6, kAddress));
  EXPECT_EQ(by_writer(write_request(3, 4000, {}), kExceptionBytes), exception(3, 16, kValue));
  const Text three = Text("\x10") + word(4000) + word(3);
  for (const Text& pdu :
       {three, three + "\x06" + word(1) + word(2), three + "\x04" + word(1) + word(2) + word(3),
        three + "\x06" + word(1) + word(2) + word(3) + "x", Text("\x10"), Text("\x10") + word(4000)}) {
    EXPECT_EQ(by_writer(adu(4, pdu), kExceptionBytes), exception(4, 16, kValue));
  }
  EXPECT_EQ(by_writer(adu(4, Text("\x06") + word(4000)), kExceptionBytes), exception(4, 6, kValue));
  EXPECT_FALSE(command());
  EXPECT_EQ(by_writer(write_request(5, 4000, {3001, 0, 1}), kExceptionBytes), exception(5, 16, kValue)) << "absurd";
  EXPECT_EQ(fact(commands_.health(monotonic_ns()), "refused"), "1");
  EXPECT_EQ(by_writer(write_one(6, 4002, 1), kWritten).size(), kWritten);
  EXPECT_EQ(command(), std::pair(0L, 0L)) << "nothing of what was refused is left";
}

TEST_F(ModbusWriterTest, NobodyElseWrites) {
  constexpr char kFunction = 1;
  for (const Text& request : {write_request(1, 4000, {400, 0, 1}), write_one(1, 4002, 1)}) {
    const unsigned function = static_cast<unsigned char>(request[7]);
    EXPECT_EQ(alone(request, kExceptionBytes), exception(1, function, kFunction));
  }
  EXPECT_FALSE(command());
  EXPECT_EQ(by_writer(adu(2, Text("\x03") + word(4000) + word(3)), kExceptionBytes), exception(2, 3, kFunction));
  EXPECT_EQ(alone(read_request(7, 0, 2), answer_bytes(2)).size(), answer_bytes(2)) << "all may read";
}

TEST_F(ModbusServerTest, RequestsByTheByteAndInARowAreAnsweredAsAlone) {
  const Client by_byte(port_);
  for (const char byte : read_request(1, 0, 2)) ASSERT_TRUE(by_byte.send(Text(1, byte)));
  EXPECT_EQ(by_byte.take(answer_bytes(2)), adu(1, Text("\x04\x04\x22\x11\x44\x33")));

  Text row, expected;
  for (unsigned i = 0; i < 200; ++i) {
    const bool is_wrong = i % 3 == 0;
    row += read_request(i, 0, is_wrong ? 126 : 2);
    expected += is_wrong ? exception(i, 4, 3) : adu(i, Text("\x04\x04\x22\x11\x44\x33"));
  }
  EXPECT_EQ(Client(port_).ask(row, expected.size()), expected) << "a wrong one costs those behind it nothing";
}

TEST_F(ModbusServerTest, WhatIsNoModbusIsClosed) {
  const std::string wrong[] = {"GET / HTTP/1.1\r\n\r\n",
                               word(1) + word(1) + word(6) + "\x01\x04" + word(0) + word(2),  // another protocol
                               word(1) + word(0) + word(0) + "\x01",                          // no unit
                               word(1) + word(0) + word(1) + "\x01\x04",                      // no function
                               word(1) + word(0) + word(255) + Text(255, '\x04'),             // longer than an ADU
                               word(1) + word(0) + word(65535) + Text(300, '\x04')};
  for (const std::string& bytes : wrong) {
    Client client(port_);
    ASSERT_TRUE(client.send(bytes));
    EXPECT_EQ(client.take(1), "") << ::testing::PrintToString(bytes.substr(0, 8));
  }
  EXPECT_EQ(fact(server_->health(), "connections of no Modbus"), std::to_string(std::size(wrong)));
  EXPECT_EQ(fact(server_->health(), "requests"), "0");
}

TEST_F(ModbusServerTest, RandomBytesLeaveItServing) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    Text bytes = round % 2 == 0 ? Text() : word(1) + word(0) + word(static_cast<unsigned>(random() % 300));
    while (bytes.size() < 40 + random() % 300) bytes += static_cast<char>(random());
    static_cast<void>(Client(port_).send(bytes));
  }
  EXPECT_EQ(alone(read_request(7, 0, 2), answer_bytes(2)), adu(7, Text("\x04\x04\x22\x11\x44\x33")));
}

TEST_F(ModbusServerTest, HalfARequestHoldsUpNobody) {
  const Client half(port_), other(port_);
  const Text request = read_request(1, 0, 2);
  ASSERT_TRUE(half.send(request.substr(0, 9)));
  for (unsigned i = 0; i < 20; ++i)
    EXPECT_EQ(other.ask(read_request(i, 0, 2), answer_bytes(2)).size(), answer_bytes(2));
  EXPECT_EQ(half.ask(request.substr(9), answer_bytes(2)), adu(1, Text("\x04\x04\x22\x11\x44\x33")));
}

TEST_F(ModbusServerTest, OneThatTakesNoAnswersIsClosedAndHoldsUpNobody) {
  const Client greedy(port_), other(port_);
  Text row;
  for (unsigned i = 0; i < 2000; ++i) row += read_request(i, 0, 120);
  // As many as it takes until its answers, which nobody reads, fill both ends.
  int rounds = 0;
  while (greedy.send(row) && ++rounds < 200) {
    EXPECT_EQ(other.ask(read_request(1, 0, 2), answer_bytes(2)).size(), answer_bytes(2));
  }
  EXPECT_LT(rounds, 200) << "it was closed";
  EXPECT_EQ(other.ask(read_request(1, 0, 2), answer_bytes(2)).size(), answer_bytes(2));
}

TEST_F(ModbusServerTest, TheOneThatIsSilentLongestMakesRoom) {
  const Client silent(port_);
  ASSERT_EQ(silent.ask(read_request(1, 0, 2), answer_bytes(2)).size(), answer_bytes(2));
  std::vector<std::unique_ptr<Client>> others;
  for (int i = 0; i < 32; ++i) {
    others.push_back(std::make_unique<Client>(port_));
    ASSERT_EQ(others.back()->ask(read_request(1, 0, 2), answer_bytes(2)).size(), answer_bytes(2));
  }
  EXPECT_EQ(silent.take(1), "");
  for (const auto& other : others) {
    EXPECT_EQ(other->ask(read_request(1, 0, 2), answer_bytes(2)).size(), answer_bytes(2));
  }
}

TEST_F(ModbusServerTest, ThePortIsNamedWhileTakenAndFreeAfterAStop) {
  const auto second = make(port_);
  const std::string said = test::said_by<std::runtime_error>([&] { second->start(); });
  EXPECT_NE(said.find("127.0.0.1:" + std::to_string(port_)), std::string::npos) << said;
  const Client open(port_);
  server_->stop();
  EXPECT_FALSE(Client(port_).is_there());
  second->start();
  EXPECT_EQ(alone(read_request(7, 0, 2), answer_bytes(2)).size(), answer_bytes(2));
  second->stop();
}

}  // namespace
}  // namespace pose_wall::tools::live
