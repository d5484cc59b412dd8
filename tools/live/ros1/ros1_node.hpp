// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A node of ROS 1 that waits for its master, and registers anew where the master was started anew. Messages go in and
// out as bytes: what they mean is said elsewhere (ros_messages).

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

#include "bags/byte_cursor.hpp"
#include "live/ros_messages/ros_messages.hpp"

namespace pose_wall::tools::live {

class Ros1Node {
 public:
  // type: "sensor_msgs/PointCloud2", as the publisher says. In the node's thread, one message after the other.
  using Take = std::function<void(const std::string& type, ByteView message)>;

  explicit Ros1Node(std::string name);
  ~Ros1Node();
  Ros1Node(const Ros1Node&) = delete;
  Ros1Node& operator=(const Ros1Node&) = delete;

  // Before start; a topic without a leading slash is one of the node's namespace. queue: older messages are lost.
  void subscribe(const std::string& topic, std::uint32_t queue, Take take);
  std::size_t advertise(const std::string& topic, const RosType& type);  // the number to publish by

  // May be called twice. Waits for nobody: the master may come later.
  void start();
  // Ends the thread; no message is taken after it.
  void stop();

  // From any thread. Lost while there is no master; a slow subscriber loses what it has not taken.
  void publish(std::size_t number, const std::string& message);

  bool has_master() const { return has_master_; }
  // Of an advertised topic, as of the last second.
  std::uint32_t subscribers(std::size_t number) const;
  // Of the subscribed topics, all together, as of the last second.
  std::uint32_t publishers() const { return publishers_; }
  std::uint64_t masters_seen() const { return masters_seen_; }
  std::string master_uri() const;

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
  };

  void run();
  void attend(std::int64_t master_pid);
  void count_peers();

  std::string name_;
  std::vector<Subscription> subscriptions_;
  std::vector<Advertised> advertised_;
  std::unique_ptr<Ros> ros_;
  mutable std::mutex lock_;
  std::condition_variable changed_;
  bool ending_ = false;
  std::thread thread_;
  std::vector<std::uint32_t> subscribers_;
  std::atomic<bool> has_master_{false};
  std::atomic<std::uint32_t> publishers_{0};
  std::atomic<std::uint64_t> masters_seen_{0};
};

}  // namespace pose_wall::tools::live
