// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A node of ROS 1 that waits for its master, and registers anew where the master was started anew; clouds and results
// go on meanwhile. Messages go in and out as bytes: what they mean is said elsewhere (ros_messages). It lives in a
// process of its own (node_main), which the daemon sees as a Ros1Proxy.

#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/live/ros1/master_line.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"
#include "io/bags/byte_cursor.hpp"

namespace ros {
class CallbackQueue;
}

namespace pose_wall::tools::live {

class Ros1Node {
 public:
  // type: "sensor_msgs/PointCloud2", as the publisher says. In the node's thread, one message after the other.
  using Take = std::function<void(const std::string& type, ByteView message)>;

  // Reads ROS_MASTER_URI. Throws std::runtime_error that says what is allowed.
  explicit Ros1Node(std::string name);
  ~Ros1Node();
  Ros1Node(const Ros1Node&) = delete;
  Ros1Node& operator=(const Ros1Node&) = delete;

  // Before start; a topic without a leading slash is one of the node's namespace. queue: older messages are lost.
  void subscribe(const std::string& topic, std::uint32_t queue, Take take);
  // The number to publish by. is_latched: the last message goes to who comes later.
  std::size_t advertise(const std::string& topic, const RosType& type, bool is_latched);

  // May be called twice. Waits for nobody: the master may come later.
  void start();
  // Ends the threads within a second, whatever the master does; no message is taken after it.
  void stop();

  // From any thread. Lost while there is no master, but for the newest one of a latched topic; a slow subscriber loses
  // what it has not taken.
  void publish(std::size_t number, const std::string& message);

  bool has_master() const { return has_master_; }
  // By `rosnode kill`, or because another node of this name came: it stays so.
  bool was_ended_by_ros() const { return ended_by_ros_; }
  // Of an advertised topic, as of the last second.
  std::uint32_t subscribers(std::size_t number) const;
  // Of the subscribed topics, all together, as of the last second.
  std::uint32_t publishers() const { return publishers_; }
  std::uint64_t masters_seen() const { return masters_seen_; }

 private:
  struct Ros;
  struct Subscription {
    std::string topic;
    std::uint32_t queue;
    Take take;
  };
  struct Advertised {
    std::string topic;
    const RosType* type;
    bool is_latched;
    std::string before_master;  // the newest of a latched topic
  };

  void attend_master();
  void take_messages();
  void open();
  void register_what_is_missing();
  void count_peers();
  void send(std::size_t number, const std::string& message);  // under the lock, with ros_

  std::string name_;
  MasterAddress master_;
  std::vector<Subscription> subscriptions_;
  std::vector<Advertised> advertised_;
  std::unique_ptr<ros::CallbackQueue> queue_;
  std::unique_ptr<Ros> ros_;
  mutable std::mutex lock_;
  std::condition_variable changed_;
  bool ending_ = false;
  bool was_missing_ = false;  // something was, when the master was looked at last; of its thread
  std::unique_ptr<MasterLine> line_;
  std::thread master_thread_, message_thread_;  // a master that hangs must hold up no cloud
  std::vector<std::uint32_t> subscribers_;
  std::atomic<bool> has_master_{false}, ended_by_ros_{false};
  std::atomic<std::uint32_t> publishers_{0};
  std::atomic<std::uint64_t> masters_seen_{0};
};

}  // namespace pose_wall::tools::live
