// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_walld_ros1: the node of ROS 1 in a process of its own, started by pose_walld, which it serves and with which it
// ends. roscpp is linked here and nowhere else.

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <deque>
#include <exception>
#include <fstream>
#include <mutex>
#include <string>

#include "apps/live/ros1/node_process.hpp"
#include "apps/live/ros1/node_words.hpp"
#include "apps/live/ros1/parcels.hpp"
#include "apps/live/ros1/ros1_node.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kExitDone = 0, kExitFailed = 1, kExitUsage = 2;  // as pose_walld
// Ros1Proxy misses it after two seconds.
constexpr auto kStatusEvery = std::chrono::milliseconds(200);
constexpr int kLook_ms = 100;  // half of it: no status is late by more
// proc(5), oom_score_adj: half of the memory is added to what it takes.
constexpr int kGoesFirst = 500;

class NodeServer {
 public:
  explicit NodeServer(const std::string& name) : node_(name) {}

  // Until the daemon hangs up. False where it said what is no parcel.
  bool serve() {
    ParcelReader reader;
    Clock::time_point told_at{};
    while (true) {
      pollfd file{kNodeSocket, POLLIN, 0};
      poll(&file, 1, kLook_ms);
      if (file.revents != 0) {
        const auto outcome = reader.read(kNodeSocket, [this](const Parcel& parcel) { take(parcel); });
        if (outcome != ParcelReader::Outcome::kOpen) return outcome == ParcelReader::Outcome::kClosed;
      }
      if (!is_started_ || Clock::now() - told_at < kStatusEvery) continue;
      told_at = Clock::now();
      const std::string bytes = status_bytes(status());
      send({ParcelKind::kStatus, 0, {}, {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}});
    }
  }

 private:
  void take(const Parcel& parcel) {
    switch (parcel.kind) {
      case ParcelKind::kSubscribe: {
        const std::uint32_t number = subscribed_++;
        return node_.subscribe(std::string(text_of(parcel.bytes)), parcel.number,
                               [this, number](const std::string& type, ByteView message) {
                                 const std::string_view known = std::string_view(type).substr(0, kParcelTypeMost);
                                 send({ParcelKind::kMessage, number, known, message});
                               });
      }
      case ParcelKind::kAdvertise:
        return advertise(parcel);
      case ParcelKind::kStart:
        is_started_ = true;
        return node_.start();
      case ParcelKind::kMessage:
        if (parcel.number < types_.size()) node_.publish(parcel.number, std::string(text_of(parcel.bytes)));
        return;
      case ParcelKind::kStatus:
        return;
    }
  }

  void advertise(const Parcel& parcel) {
    const std::optional<AdvertisedTopic> topic = read_advertised(parcel.bytes);
    if (!topic) throw std::runtime_error("a topic that cannot be read");
    texts_.push_back(*topic);
    const AdvertisedTopic& kept = texts_.back();
    types_.push_back({kept.type.c_str(), kept.md5.c_str(), "", kept.definition.c_str(), ""});
    node_.advertise(kept.topic, types_.back(), parcel.number != 0);
  }

  NodeStatus status() const {
    NodeStatus status{node_.has_master(), node_.was_ended_by_ros(), node_.publishers(), node_.masters_seen(), {}};
    for (std::size_t i = 0; i < types_.size(); ++i) status.subscribers.push_back(node_.subscribers(i));
    return status;
  }

  // Waits for a daemon that is slow: roscpp drops the oldest messages meanwhile.
  void send(const Parcel& parcel) {
    const std::lock_guard<std::mutex> locked(sends_);
    send_parcel(kNodeSocket, parcel);
  }

  std::mutex sends_;
  std::deque<AdvertisedTopic> texts_;
  std::deque<RosType> types_;
  std::uint32_t subscribed_ = 0;
  bool is_started_ = false;
  Ros1Node node_;  // ends before what its threads use
};

// A signal to the whole group or service is the daemon's business, which then hangs up. It may also end without a word.
void live_and_die_with_daemon() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGPIPE}) std::signal(signal, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Where memory is short, this one goes before the daemon.
  std::ofstream("/proc/self/oom_score_adj") << kGoesFirst;
}

bool has_socket() {
  struct stat about {};
  return fstat(kNodeSocket, &about) == 0 && S_ISSOCK(about.st_mode);
}

int main_of(int argc, char** argv) {
  if (argc != 2 || !has_socket()) {
    fmt::print(stderr, "pose_walld_ros1 is started by pose_walld alone, with ros1: 1 or source: ros1\n");
    return kExitUsage;
  }
  live_and_die_with_daemon();
  try {
    NodeServer server(argv[1]);
    return server.serve() ? kExitDone : kExitFailed;
  } catch (const std::exception& fault) {
    fmt::print(stderr, "pose_walld_ros1: {}\n", fault.what());
    return kExitFailed;
  }
}

}  // namespace
}  // namespace pose_wall::tools::live

int main(int argc, char** argv) {
  return pose_wall::tools::live::main_of(argc, argv);
}
