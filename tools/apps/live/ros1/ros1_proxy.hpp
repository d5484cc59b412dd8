// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The node of ROS 1 as the daemon sees it: bytes in, bytes out. The node itself (Ros1Node) is in a process of its own,
// so that nothing in roscpp can end the daemon. A process that ended or hangs is replaced, and tells the master anew
// all that the last one did.

#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "apps/live/health.hpp"
#include "apps/live/ros1/master_line.hpp"
#include "apps/live/ros1/node_process.hpp"
#include "apps/live/ros1/node_words.hpp"
#include "apps/live/ros1/parcels.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"
#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {

class Ros1Proxy {
 public:
  // type: "sensor_msgs/PointCloud2", as the publisher says. In the proxy's thread, one message after the other.
  using Take = std::function<void(const std::string& type, ByteView message)>;

  struct Times {
    std::chrono::milliseconds between_starts{1000};  // a call that ends the process must not keep the machine busy
    std::chrono::milliseconds rest{200};  // after an end, so that the health, which is looked at every 50 ms, tells it
    std::chrono::milliseconds quiet{2000};    // the node tells its status five times a second
    std::chrono::milliseconds silent{5000};   // then it is ended; no call to a master takes longer than 2 s
    std::chrono::milliseconds farewell{400};  // a clean end takes 250 ms at most; the daemon's takes a second
  };

  // Reads ROS_MASTER_URI. Throws std::runtime_error that says what is allowed. program: what runs the node.
  Ros1Proxy(std::string name, std::string program, Times times);
  explicit Ros1Proxy(std::string name) : Ros1Proxy(std::move(name), node_program(), Times{}) {}
  ~Ros1Proxy();
  Ros1Proxy(const Ros1Proxy&) = delete;
  Ros1Proxy& operator=(const Ros1Proxy&) = delete;

  // Before start; a topic without a leading slash is one of the node's namespace. queue: older messages are lost.
  // Throws std::runtime_error for what ROS allows no topic to be called.
  void subscribe(const std::string& topic, std::uint32_t queue, Take take);
  // The number to publish by. is_latched: the last message goes to who comes later, of every process.
  std::size_t advertise(const std::string& topic, const RosType& type, bool is_latched);

  // May be called twice. Waits for nobody: the master may come later.
  void start();
  // Ends process and thread within a second; no message is taken after it.
  void stop();

  // From any thread, which waits for nobody. Lost while there is no process or no master, but for the newest one of a
  // latched topic. Of a topic the newest two wait for a process that is slow.
  void publish(std::size_t number, const std::string& message);

  // Of an advertised topic, as of the last second; 0 while there is no process.
  std::uint32_t subscribers(std::size_t number) const;
  // Of the subscribed topics, all together.
  std::uint32_t publishers() const;
  // Why nobody new can find the node; empty when all is well.
  std::string trouble() const;
  // Masters that the present process has seen, starts of a new one, how the last one ended, and what was lost.
  void add_facts(PartHealth* health) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Subscription {
    std::string topic;
    std::uint32_t queue;
    Take take;
  };
  struct Advertised {
    std::string topic;
    const RosType* type;
    bool is_latched;
    std::string latched;  // the newest message
  };

  void listen_where_allowed() const;
  void attend();
  bool begin();
  std::string serve();
  std::optional<std::string> hear(ParcelReader* reader);
  void take(const Parcel& parcel);
  void finish(const std::string& why);
  void fill_queue();  // under the lock
  bool waits(Clock::time_point until);
  bool send_waiting();
  bool is_silent();

  std::string name_, program_;
  Times times_;
  MasterAddress master_;
  std::vector<Subscription> subscriptions_;
  std::vector<Advertised> advertised_;
  std::thread thread_;
  int wakes_ = -1;  // an eventfd: something waits to be sent, or the end was asked for
  Clock::time_point looked_at_{};
  Clock::duration silence_{};  // since the last status

  mutable std::mutex lock_;
  std::condition_variable changed_;
  bool ending_ = false;
  std::unique_ptr<NodeProcess> process_;  // written by the thread alone
  ParcelQueue queue_;
  NodeStatus status_;
  bool was_ended_by_ros_ = false, is_quiet_ = false;
  std::string down_because_;  // empty while the process answers, or where none was started yet
  std::string last_end_;
  std::uint64_t starts_anew_ = 0, lost_ = 0;
};

}  // namespace pose_wall::tools::live
