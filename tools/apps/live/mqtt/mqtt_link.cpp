// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/mqtt/mqtt_link.hpp"

#include <MQTTAsync.h>
#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

// At least once: a repeated result harms nobody, a lost last one does.
constexpr int kQos = 1;
// A connection that died without a word is noticed after one and a half of them (MQTT 3.1.1, 3.1.2.10).
constexpr int kKeepAlive_s = 10, kConnect_s = 5;
constexpr auto kWaitFirst = std::chrono::seconds(1), kWaitMost = std::chrono::seconds(30);
// Telemetry of a few seconds; a broker that is further behind gets the next newer one instead.
constexpr std::uint64_t kUnacknowledgedMost = 8;
constexpr std::size_t kTopicBytesMost = 60000;  // a string of MQTT has 65,535, and the names come behind it

void require_topic(const std::string& topic) {
  const auto refuse = [&](const char* why) {
    throw std::runtime_error(fmt::format("mqtt_topic: '{}' is refused: {}", topic, why));
  };
  if (topic.empty()) refuse("it is empty");
  if (topic.size() > kTopicBytesMost) refuse("it is too long");
  if (topic.find_first_of("+#") != std::string::npos) refuse("+ and # are for those who subscribe");
  if (topic.front() == '$') refuse("what begins with $ is the broker's own");
  if (std::any_of(topic.begin(), topic.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; })) {
    refuse("it holds characters that nobody sees");
  }
  try {
    static_cast<void>(nlohmann::json(topic).dump());
  } catch (const nlohmann::json::exception&) {
    refuse("it is no UTF-8");
  }
}

// Two clients of one name throw each other out for ever.
std::string client_name() {
  std::random_device random;
  return fmt::format("pose_walld-{:08x}", random());
}

std::string address_of(const MqttAccess& access) {
  const bool is_six = access.broker.host.find(':') != std::string::npos;
  return fmt::format("{}://{}{}{}:{}", access.tls ? "ssl" : "tcp", is_six ? "[" : "", access.broker.host,
                     is_six ? "]" : "", access.broker.port);
}

// Of CONNACK (MQTT 3.1.1, 3.2.2.3); the library says no more than that there is one.
std::string refusal_text(int code) {
  switch (code) {
    case 3:
      return "the broker is not available";
    case 4:
      return "the broker refuses user or password";
    case 5:
      return "the broker refuses this user";
    default:
      return "";
  }
}

const char* text_or_none(const std::string& text) {
  return text.empty() ? nullptr : text.c_str();
}

}  // namespace

// What the library's threads and ours share. It outlives the client.
struct MqttLink::State {
  enum class Phase { kApart, kSeeks, kConnected };

  mutable std::mutex lock;
  std::condition_variable changed;
  MQTTAsync client = nullptr;
  MqttAccess access;
  MqttPresence presence;
  std::string topic, presence_topic;
  Phase phase = Phase::kApart;
  bool greets = false;  // it is connected and has not said so yet
  Clock::time_point next_try;
  Clock::duration wait = kWaitFirst;
  std::string trouble, tls_trouble;
  std::uint64_t unacknowledged = 0, connections = 0, acknowledged = 0, not_sent = 0;
  bool has_left = false;

  void fall_apart(const std::string& why) {
    const std::lock_guard<std::mutex> locked(lock);
    phase = Phase::kApart;
    trouble = tls_trouble.empty() ? why : std::exchange(tls_trouble, "");
    next_try = Clock::now() + wait;
    wait = std::min<Clock::duration>(2 * wait, kWaitMost);
    changed.notify_all();
  }
  void connect();
  // is_last: whatever waits for the broker's word already.
  bool send(const std::string& where, const std::string& message, bool retained, bool is_last = false);
};

// In the library's threads.
struct MqttLink::Events {
  static State* of(void* context) { return static_cast<State*>(context); }

  static void connected(void* context, MQTTAsync_successData*) {
    State* state = of(context);
    const std::lock_guard<std::mutex> locked(state->lock);
    state->phase = State::Phase::kConnected;
    state->greets = true;
    state->wait = kWaitFirst;
    state->trouble.clear();
    state->tls_trouble.clear();
    state->unacknowledged = 0;  // what the last connection owed is lost with it
    ++state->connections;
  }
  static void refused(void* context, MQTTAsync_failureData* why) {
    std::string trouble = why != nullptr ? refusal_text(why->code) : "";
    // Without a code no broker was reached.
    if (trouble.empty()) trouble = connect_fault(of(context)->access.broker);
    if (trouble.empty()) trouble = why != nullptr && why->message != nullptr ? why->message : "no answer";
    of(context)->fall_apart(trouble);
  }
  // A line of OpenSSL's for each cause, the deepest first.
  static int tls_failed(const char* line, std::size_t bytes, void* context) {
    State* state = of(context);
    const std::lock_guard<std::mutex> locked(state->lock);
    if (state->tls_trouble.empty()) state->tls_trouble = "TLS: " + tls_reason(std::string(line, bytes));
    return 1;
  }
  static void lost(void* context, char*) { of(context)->fall_apart("the connection was lost"); }
  static void left(void* context, MQTTAsync_successData*) {
    State* state = of(context);
    const std::lock_guard<std::mutex> locked(state->lock);
    state->has_left = true;
    state->changed.notify_all();
  }
  static void delivered(void* context, MQTTAsync_successData*) {
    State* state = of(context);
    const std::lock_guard<std::mutex> locked(state->lock);
    ++state->acknowledged;
    if (state->unacknowledged > 0) --state->unacknowledged;
  }
  static void not_delivered(void* context, MQTTAsync_failureData*) {
    State* state = of(context);
    const std::lock_guard<std::mutex> locked(state->lock);
    ++state->not_sent;
    if (state->unacknowledged > 0) --state->unacknowledged;
  }
  static int arrived(void*, char* topic, int, MQTTAsync_message* message) {  // nothing is subscribed to
    MQTTAsync_freeMessage(&message);
    MQTTAsync_free(topic);
    return 1;
  }
};

void MqttLink::State::connect() {
  std::string password;
  try {
    password = password_of(access);
  } catch (const std::exception& fault) {
    return fall_apart(fault.what());
  }
  MQTTAsync_willOptions will = MQTTAsync_willOptions_initializer;
  will.topicName = presence_topic.c_str();
  will.message = presence.offline.c_str();
  will.retained = 1;
  will.qos = kQos;
  MQTTAsync_connectOptions options = MQTTAsync_connectOptions_initializer;
  options.MQTTVersion = MQTTVERSION_3_1_1;
  options.cleansession = 1;
  options.keepAliveInterval = kKeepAlive_s;
  options.connectTimeout = kConnect_s;
  options.will = &will;
  options.username = text_or_none(access.user);
  options.password = text_or_none(password);
  MQTTAsync_SSLOptions tls = MQTTAsync_SSLOptions_initializer;
  tls.trustStore = text_or_none(access.ca_file);
  tls.keyStore = text_or_none(access.cert_file);
  tls.privateKey = text_or_none(access.key_file);
  tls.enableServerCertAuth = 1;
  tls.verify = 1;  // the name or address in the certificate, too
  tls.ssl_error_cb = Events::tls_failed;
  tls.ssl_error_context = this;
  if (access.tls) options.ssl = &tls;
  options.onSuccess = Events::connected;
  options.onFailure = Events::refused;
  options.context = this;
  const int status = MQTTAsync_connect(client, &options);
  if (status != MQTTASYNC_SUCCESS) fall_apart(MQTTAsync_strerror(status));
}

bool MqttLink::State::send(const std::string& where, const std::string& message, bool retained, bool is_last) {
  {
    const std::lock_guard<std::mutex> locked(lock);
    if (phase != Phase::kConnected || (unacknowledged >= kUnacknowledgedMost && !is_last)) {
      ++not_sent;
      return false;
    }
    ++unacknowledged;
  }
  MQTTAsync_responseOptions response = MQTTAsync_responseOptions_initializer;
  response.onSuccess = Events::delivered;
  response.onFailure = Events::not_delivered;
  response.context = this;
  const int status = MQTTAsync_send(client, where.c_str(), static_cast<int>(message.size()), message.data(), kQos,
                                    retained ? 1 : 0, &response);
  if (status != MQTTASYNC_SUCCESS) Events::not_delivered(this, nullptr);
  return status == MQTTASYNC_SUCCESS;
}

MqttLink::MqttLink(MqttAccess access, std::string topic, MqttPresence presence) : state_(std::make_shared<State>()) {
  require_topic(topic);
  state_->access = std::move(access);
  state_->presence = std::move(presence);
  state_->presence_topic = topic + "/" + state_->presence.name;
  state_->topic = std::move(topic);
  MQTTAsync_createOptions options = MQTTAsync_createOptions_initializer;
  options.sendWhileDisconnected = 0;
  options.maxBufferedMessages = static_cast<int>(2 * kUnacknowledgedMost);  // beside our own bound
  const int status = MQTTAsync_createWithOptions(&state_->client, address_of(state_->access).c_str(),
                                                 client_name().c_str(), MQTTCLIENT_PERSISTENCE_NONE, nullptr, &options);
  if (status != MQTTASYNC_SUCCESS) throw std::runtime_error(fmt::format("mqtt: {}", MQTTAsync_strerror(status)));
  MQTTAsync_setCallbacks(state_->client, state_.get(), Events::lost, Events::arrived, nullptr);
}

// The library takes up to a second to end its threads, and calls back until then: nobody waits for it.
MqttLink::~MqttLink() {
  std::thread([state = std::move(state_)] { MQTTAsync_destroy(&state->client); }).detach();
}

void MqttLink::look() {
  bool greets = false;
  {
    const std::lock_guard<std::mutex> locked(state_->lock);
    if (state_->phase == State::Phase::kConnected) {
      greets = std::exchange(state_->greets, false);
      if (!greets) return;
    } else if (state_->phase == State::Phase::kSeeks || Clock::now() < state_->next_try) {
      return;
    } else {
      state_->phase = State::Phase::kSeeks;
    }
  }
  if (!greets) {
    state_->connect();
  } else if (!state_->presence.online.empty()) {
    state_->send(state_->presence_topic, state_->presence.online, true);
  }
}

bool MqttLink::publish(const char* name, const std::string& message, bool retained) {
  return state_->send(state_->topic + "/" + name, message, retained);
}

void MqttLink::leave() {
  const auto until = Clock::now() + kLeaveMost;
  if (!is_connected()) return;
  state_->send(state_->presence_topic, state_->presence.offline, true, true);
  MQTTAsync_disconnectOptions options = MQTTAsync_disconnectOptions_initializer;
  options.timeout = static_cast<int>(kLeaveMost.count());  // for what is under way
  options.onSuccess = Events::left;
  options.context = state_.get();
  if (MQTTAsync_disconnect(state_->client, &options) != MQTTASYNC_SUCCESS) return;
  std::unique_lock<std::mutex> locked(state_->lock);
  state_->changed.wait_until(locked, until, [&] { return state_->has_left; });
}

bool MqttLink::is_connected() const {
  const std::lock_guard<std::mutex> locked(state_->lock);
  return state_->phase == State::Phase::kConnected;
}

std::uint64_t MqttLink::connections() const {
  const std::lock_guard<std::mutex> locked(state_->lock);
  return state_->connections;
}

std::string MqttLink::trouble() const {
  const std::lock_guard<std::mutex> locked(state_->lock);
  return state_->trouble;
}

std::uint64_t MqttLink::acknowledged() const {
  const std::lock_guard<std::mutex> locked(state_->lock);
  return state_->acknowledged;
}

std::uint64_t MqttLink::not_sent() const {
  const std::lock_guard<std::mutex> locked(state_->lock);
  return state_->not_sent;
}

}  // namespace pose_wall::tools::live
