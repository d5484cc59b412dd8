// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros1/ros1_proxy.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <utility>

#include "apps/live/log.hpp"
#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

// As many as roscpp keeps for a subscriber that is slow (Ros1Node).
constexpr std::size_t kMessagesWaiting = 2;
// How often it looks whether the process has been silent for too long.
constexpr std::chrono::milliseconds kLook{100};

bool is_letter(char one) {
  return (one >= 'a' && one <= 'z') || (one >= 'A' && one <= 'Z');
}

// https://wiki.ros.org/Names, "Valid Names": what roscpp's names::validate takes, less the empty one, and less private
// ones (~), which its node handle refuses.
void require_topic_name(const std::string& topic) {
  std::string why = topic.empty() ? "it is empty" : "";
  if (!topic.empty() && !is_letter(topic[0]) && topic[0] != '/') {
    why = "it begins with neither a letter nor /";
  }
  for (std::size_t i = 1; i < topic.size(); ++i) {
    const char one = topic[i];
    if (is_letter(one) || (one >= '0' && one <= '9') || one == '_' || one == '/') continue;
    why = fmt::format("'{}' is no letter, digit, / or _", one);
  }
  if (!why.empty()) throw std::runtime_error(fmt::format("'{}' is no topic of ROS: {}", topic, why));
}

double seconds(std::chrono::milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

Ros1Proxy::Ros1Proxy(std::string name, std::string program, Times times)
    : name_(std::move(name)),
      program_(std::move(program)),
      times_(times),
      master_(master_of_environment()),
      wakes_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      queue_(kMessagesWaiting) {}

Ros1Proxy::~Ros1Proxy() {
  stop();
  if (wakes_ >= 0) ::close(wakes_);
}

void Ros1Proxy::subscribe(const std::string& topic, std::uint32_t queue, Take take) {
  require_topic_name(topic);
  subscriptions_.push_back({topic, queue, std::move(take)});
}

std::size_t Ros1Proxy::advertise(const std::string& topic, const RosType& type, bool is_latched) {
  advertised_.push_back({topic, &type, is_latched, ""});
  return advertised_.size() - 1;
}

// With the master on this machine, nobody else is expected until ROS_IP or ROS_HOSTNAME names an address. roscpp then
// takes results and clouds on loopback alone, but lets itself be called on all addresses, whatever it is told.
void Ros1Proxy::listen_where_allowed() const {
  const bool names_address = is_told("ROS_IP") || is_told("ROS_HOSTNAME");
  const bool is_local = is_loopback(master_.place.host);
  if (!names_address && is_local) {
    setenv("ROS_IP", "127.0.0.1", 1);
    log_line(Grade::kGood, "ros1", "sends on loopback, for the master is there; ROS_IP=ADDRESS lets other machines in");
  }
  log_line(Grade::kWarning, "ros1",
           "roscpp lets itself be called (XML-RPC) on all addresses and asks nobody who he is: whoever reaches this "
           "machine can name another publisher of clouds, or end the node. Keep others off by a firewall");
}

void Ros1Proxy::start() {
  if (thread_.joinable()) return;
  listen_where_allowed();
  ending_ = false;
  thread_ = std::thread([this] { attend(); });
}

void Ros1Proxy::stop() {
  {
    const std::lock_guard<std::mutex> locked(lock_);
    ending_ = true;
  }
  changed_.notify_all();
  eventfd_write(wakes_, 1);
  if (thread_.joinable()) thread_.join();
}

// True where the end is asked for.
bool Ros1Proxy::waits(Clock::time_point until) {
  std::unique_lock<std::mutex> locked(lock_);
  return changed_.wait_until(locked, until, [this] { return ending_; });
}

void Ros1Proxy::attend() {
  name_this_thread("ros1-process");
  while (true) {
    const Clock::time_point began = Clock::now();
    finish(begin() ? serve() : "");
    // By the rule of ROS it stays ended.
    if (was_ended_by_ros_) break;
    if (waits(std::max(began + times_.between_starts, Clock::now() + times_.rest))) return;
    const std::lock_guard<std::mutex> locked(lock_);
    ++starts_anew_;
  }
}

bool Ros1Proxy::begin() {
  try {
    auto process = std::make_unique<NodeProcess>(program_, name_);
    const std::lock_guard<std::mutex> locked(lock_);
    process_ = std::move(process);
    fill_queue();
    looked_at_ = Clock::now();
    silence_ = {};
    return true;
  } catch (const std::exception& fault) {
    const std::lock_guard<std::mutex> locked(lock_);
    last_end_ = fmt::format("cannot be started ({})", fault.what());
    return false;
  }
}

void Ros1Proxy::fill_queue() {
  const auto view = [](const std::string& text) {
    return ByteView{reinterpret_cast<const std::byte*>(text.data()), text.size()};
  };
  queue_.clear();
  for (const Subscription& one : subscriptions_) {
    queue_.push({ParcelKind::kSubscribe, one.queue, {}, view(one.topic)});
  }
  for (const Advertised& one : advertised_) {
    queue_.push({ParcelKind::kAdvertise, one.is_latched ? 1U : 0U, {}, view(advertised_bytes(one.topic, *one.type))});
  }
  queue_.push({ParcelKind::kStart, 0, {}, {}});
  for (std::size_t i = 0; i < advertised_.size(); ++i) {
    if (advertised_[i].latched.empty()) continue;
    queue_.push({ParcelKind::kMessage, static_cast<std::uint32_t>(i), {}, view(advertised_[i].latched)});
  }
}

// Until the process has to be ended, or has ended by itself; why, empty where its end tells it.
std::string Ros1Proxy::serve() {
  ParcelReader reader;
  while (true) {
    if (!send_waiting()) return "";
    bool has_waiting = false;
    {
      const std::lock_guard<std::mutex> locked(lock_);
      if (ending_) return "";
      has_waiting = !queue_.is_empty();
    }
    pollfd files[] = {{process_->socket(), static_cast<short>(has_waiting ? POLLIN | POLLOUT : POLLIN), 0},
                      {wakes_, POLLIN, 0}};
    poll(files, 2, static_cast<int>(kLook.count()));
    eventfd_t count = 0;
    if (files[1].revents != 0) eventfd_read(wakes_, &count);
    if ((files[0].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      if (const std::optional<std::string> why = hear(&reader)) return *why;
    }
    if (is_silent()) return fmt::format("did not answer for {} s", seconds(times_.silent));
  }
}

// Why it has to be ended, as serve says it; nothing where it goes on.
std::optional<std::string> Ros1Proxy::hear(ParcelReader* reader) {
  try {
    switch (reader->read(process_->socket(), [this](const Parcel& parcel) { take(parcel); })) {
      case ParcelReader::Outcome::kOpen:
        return std::nullopt;
      case ParcelReader::Outcome::kClosed:
        return "";
      case ParcelReader::Outcome::kBroken:
        break;
    }
    return "said what it must not say";
  } catch (const std::bad_alloc&) {
    return "sent more than there is memory for";
  }
}

// Of a daemon that itself was held up, little counts: the status may wait in the socket.
bool Ros1Proxy::is_silent() {
  const Clock::time_point now = Clock::now();
  silence_ += std::min<Clock::duration>(now - std::exchange(looked_at_, now), 2 * kLook);
  const std::lock_guard<std::mutex> locked(lock_);
  is_quiet_ = silence_ >= times_.quiet;
  return silence_ >= times_.silent;
}

bool Ros1Proxy::send_waiting() {
  const std::lock_guard<std::mutex> locked(lock_);
  return queue_.send(process_->socket());
}

void Ros1Proxy::take(const Parcel& parcel) {
  if (parcel.kind == ParcelKind::kMessage && parcel.number < subscriptions_.size()) {
    return subscriptions_[parcel.number].take(std::string(parcel.type), parcel.bytes);
  }
  if (parcel.kind != ParcelKind::kStatus) return;
  std::optional<NodeStatus> status = read_status(parcel.bytes);
  if (!status) return;
  silence_ = {};
  const std::lock_guard<std::mutex> locked(lock_);
  status_ = std::move(*status);
  was_ended_by_ros_ = was_ended_by_ros_ || status_.was_ended_by_ros;
  down_because_.clear();
}

// why: where it is ended for something.
void Ros1Proxy::finish(const std::string& why) {
  std::unique_ptr<NodeProcess> last;
  bool is_asked = false;
  {
    const std::lock_guard<std::mutex> locked(lock_);
    last = std::move(process_);
    is_asked = ending_;
    queue_.clear();
    status_ = {};
    is_quiet_ = false;
  }
  std::string end;
  if (last) end = last->end(why.empty() ? times_.farewell : std::chrono::milliseconds(0));
  const std::lock_guard<std::mutex> locked(lock_);
  if (is_asked) return;
  if (last) last_end_ = why.empty() ? end : why;
  down_because_ = last_end_;
}

void Ros1Proxy::publish(std::size_t number, const std::string& message) {
  const std::lock_guard<std::mutex> locked(lock_);
  if (advertised_[number].is_latched) advertised_[number].latched = message;
  if (!process_) return;
  const ByteView bytes{reinterpret_cast<const std::byte*>(message.data()), message.size()};
  if (!queue_.push({ParcelKind::kMessage, static_cast<std::uint32_t>(number), {}, bytes})) ++lost_;
  // Where the other side is gone, the thread finds out by itself.
  if (!queue_.send(process_->socket()) || !queue_.is_empty()) eventfd_write(wakes_, 1);
}

std::uint32_t Ros1Proxy::subscribers(std::size_t number) const {
  const std::lock_guard<std::mutex> locked(lock_);
  return number < status_.subscribers.size() ? status_.subscribers[number] : 0;
}

std::uint32_t Ros1Proxy::publishers() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return status_.publishers;
}

std::string Ros1Proxy::trouble() const {
  const std::lock_guard<std::mutex> locked(lock_);
  if (was_ended_by_ros_) {
    return "was ended by rosnode kill or by another node of its name; pose_walld must be started anew to come back";
  }
  if (!down_because_.empty()) return fmt::format("its process {}; it is started anew", down_because_);
  if (is_quiet_) {
    return fmt::format("its process has not answered for {} s; after {} s it is started anew", seconds(times_.quiet),
                       seconds(times_.silent));
  }
  return status_.has_master ? "" : "waits for the master at " + master_.uri;
}

void Ros1Proxy::add_facts(PartHealth* health) const {
  const std::lock_guard<std::mutex> locked(lock_);
  health->add("masters seen", status_.masters_seen);
  health->add("process started anew", starts_anew_);
  health->add("process ended last", last_end_.empty() ? "-" : last_end_);
  health->add("messages lost to a slow process", lost_);
}

}  // namespace pose_wall::tools::live
