// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Telemetry by MQTT, for people and dashboards, never for control: results once a second and when a state changes, the
// health of all parts.

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/mqtt/last_value.hpp"
#include "apps/live/mqtt/mqtt_link.hpp"
#include "apps/live/result_json.hpp"
#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kResultEvery = std::chrono::seconds(1), kLastEvery = std::chrono::seconds(1),
               kHealthEvery = std::chrono::seconds(10);
constexpr auto kLook = std::chrono::milliseconds(100);

// What of a result is told at once when it changes.
std::vector<std::uint32_t> states_of(const LiveResult& result) {
  std::vector<std::uint32_t> states = {result.publication.cause};
  for (const pose_wall_value& value : result.publication.result.quantity) states.push_back(value.state);
  return states;
}

std::string summaries_of(const std::vector<PartHealth>& parts) {
  std::string text;
  for (const PartHealth& part : parts)
    text += fmt::format("{}:{}:{}\n", part.part, grade_name(part.grade), part.summary);
  return text;
}

// Something that is told when it changes, now and then besides, and anew to each connection.
template <typename Gist>
class Told {
 public:
  explicit Told(Clock::duration every) : every_(every) {}

  bool is_due(const Gist& gist, std::uint64_t connection) const {
    return connection != connection_ || gist != gist_ || Clock::now() - last_ >= every_;
  }
  void note(Gist gist, std::uint64_t connection) {
    gist_ = std::move(gist);
    connection_ = connection;
    last_ = Clock::now();
  }

 private:
  Clock::duration every_;
  Gist gist_{};
  std::uint64_t connection_ = 0;
  Clock::time_point last_;
};

class MqttSink final : public Sink {
 public:
  MqttSink(const LiveSettings& live, const HealthBoard& board)
      : part_("sink mqtt " + live.mqtt),
        board_(board),
        access_(mqtt_access(live)),
        link_(access_, live.mqtt_topic, {"status", "online", "offline"}),
        last_link_(access_, live.mqtt_topic, {kLast, "", no_last_value()}) {}
  ~MqttSink() override { stop(); }

  // A broker that is not there yet is no fault.
  void start() override {
    log_line(Grade::kGood, part_, access_text(access_));
    ending_ = false;
    thread_ = std::thread([this] { run(); });
  }

  void take(const LiveResult& result) override {
    const std::uint64_t connection = link_.connections();
    std::vector<std::uint32_t> states = states_of(result);
    if (!results_.is_due(states, connection)) return;
    if (tell(&link_, "result", with_end(result_json(result), wall_ns()))) results_.note(std::move(states), connection);
  }

  void stop() override {
    ending_ = true;
    if (!thread_.joinable()) return;
    thread_.join();
    std::thread other([this] { last_link_.leave(); });  // a broker may hang: both within the time of one
    link_.leave();
    other.join();
  }

  PartHealth health() const override {
    PartHealth health;
    health.part = part_;
    const std::string trouble = link_.is_connected() ? last_link_.trouble() : link_.trouble();
    const bool is_connected = link_.is_connected() && last_link_.is_connected();
    health.grade = is_connected ? Grade::kGood : Grade::kWarning;
    health.summary = is_connected      ? "connected"
                     : trouble.empty() ? "seeks the broker"
                                       : "no broker: " + trouble + "; tries again";
    health.add("connections", link_.connections());
    health.add("messages acknowledged", link_.acknowledged() + last_link_.acknowledged());
    health.add("messages not sent", link_.not_sent() + last_link_.not_sent());
    return health;
  }

 private:
  void run() {
    name_this_thread("mqtt-links");
    while (!ending_) {
      link_.look();
      last_link_.look();
      tell_health();
      tell_last();
      std::this_thread::sleep_for(kLook);
    }
  }

  // Whether it is done with. What falls due without a broker is lost and counted by the link; the next connection is
  // told all anew. Behind a slow broker it is tried again.
  static bool tell(MqttLink* link, const char* name, const std::string& message, bool retained = false) {
    const bool is_apart = !link->is_connected();
    if (is_apart && link->connections() == 0 && link->trouble().empty()) return false;  // the first try is under way
    return link->publish(name, message, retained) || is_apart;
  }

  void tell_health() {
    const std::uint64_t connection = link_.connections();
    const std::vector<PartHealth> parts = board_.all();
    std::string summaries = summaries_of(parts);
    if (!health_.is_due(summaries, connection)) return;
    if (tell(&link_, "health", health_json(parts))) health_.note(std::move(summaries), connection);
  }

  // By our own thread, for a worker that hangs publishes nothing.
  void tell_last() {
    const std::uint64_t connection = last_link_.connections();
    LastValue last = last_value(board_.newest(), monotonic_ns(), wall_ns());
    if (!last_.is_due(last.gist, connection)) return;
    if (tell(&last_link_, kLast, last.json, true)) last_.note(std::move(last.gist), connection);
  }

  static constexpr const char* kLast = "last";

  std::string part_;
  const HealthBoard& board_;
  MqttAccess access_;
  MqttLink link_;
  MqttLink last_link_;  // a connection of its own: a broker tells one message alone when it is gone
  std::thread thread_;
  std::atomic<bool> ending_{false};
  Told<std::vector<std::uint32_t>> results_{kResultEvery};     // of the thread that takes
  Told<std::string> health_{kHealthEvery}, last_{kLastEvery};  // of our own thread
};

}  // namespace

std::unique_ptr<Sink> make_mqtt_sink(const LoadedConfig& loaded, const HealthBoard& health) {
  return std::make_unique<MqttSink>(loaded.live, health);
}

}  // namespace pose_wall::tools::live
