// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: topics that a broker would throw us out for are refused with their reason. A broker may be away, or take
// connections and say nothing: then the sink warns, takes results and stops. Brokers of others: mqtt_peer.py.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "apps/live/edges.hpp"
#include "live/frame_catcher.hpp"
#include "live/loopback.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::becomes_true;
using pose_wall::test::fact;

class Nobody final : public HealthBoard {
 public:
  std::vector<PartHealth> all() const override { return {}; }
};

class MqttSinkTest : public ::testing::Test {
 protected:
  std::unique_ptr<Sink> make(const std::string& topic, std::uint16_t port) const {
    return make_mqtt_sink(load_config("", {"mqtt=127.0.0.1:" + std::to_string(port), "mqtt_topic=" + topic}), health_);
  }
  void SetUp() override {
    try {
      make("a", port_);
    } catch (const EdgeMissing& missing) {
      GTEST_SKIP() << missing.what();
    }
  }
  std::string refusal(const std::string& topic) const {
    return test::said_by<std::runtime_error>([&] { make(topic, port_); });
  }

  const std::uint16_t port_ = pose_wall::test::free_tcp_port();
  Nobody health_;
};

TEST_F(MqttSinkTest, TopicsThatNobodyMayPublishUnderAreRefused) {
  for (const char* topic : {"", "#", "a/#", "+", "a/+/b", "$SYS", "a\tb", "a\x7f", "\xff\xfe", "\xc3"}) {
    EXPECT_EQ(refusal(topic).rfind("mqtt_topic: '", 0), 0U) << topic;
  }
  EXPECT_NE(refusal(std::string(70000, 'a')).find("too long"), std::string::npos);
  for (const char* topic : {"a", "mine/north/3", "\xe5\xb7\xb7\xe9\x81\x93"}) EXPECT_EQ(refusal(topic), "") << topic;
}

TEST_F(MqttSinkTest, WithoutABrokerItWarnsTakesResultsAndStops) {
  const auto sink = make("a", port_);
  EXPECT_EQ(sink->health().grade, Grade::kWarning);
  sink->start();
  EXPECT_TRUE(becomes_true([&] { return sink->health().summary.rfind("no broker: ", 0) == 0; }));
  EXPECT_EQ(sink->health().summary, "no broker: Connection refused; tries again");
  const std::uint64_t before = std::stoull(fact(sink->health(), "messages not sent"));
  sink->take(LiveResult{});
  EXPECT_GT(std::stoull(fact(sink->health(), "messages not sent")), before) << "it was due, and nobody took it";
  EXPECT_TRUE(becomes_true([&] { return std::stoull(fact(sink->health(), "messages not sent")) > before + 2; }))
      << "one a second is due";
  EXPECT_EQ(sink->health().grade, Grade::kWarning);
  EXPECT_EQ(fact(sink->health(), "messages acknowledged"), "0");
  sink->stop();
  sink->stop();
}

TEST_F(MqttSinkTest, ABrokerThatSaysNothingIsNoBroker) {
  const int server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_port = htons(port_);
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(server, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
  ASSERT_EQ(listen(server, 8), 0);
  const auto sink = make("a", port_);
  sink->start();
  EXPECT_TRUE(becomes_true([&] { return sink->health().summary.rfind("no broker: ", 0) == 0; }))
      << sink->health().summary;
  EXPECT_EQ(fact(sink->health(), "connections"), "0");
  sink->stop();
  close(server);
}

}  // namespace
}  // namespace pose_wall::tools::live
