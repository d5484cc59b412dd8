// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A node of ROS 2 by plain DDS: its participant, the readers and writers of its topics, and what it says of itself in
// ROS's graph. Messages go in and out as the bytes of the wire.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/live/ros2/environment.hpp"
#include "apps/live/ros2/graph_message.hpp"
#include "apps/live/ros2/qos_match.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"
#include "io/bags/byte_cursor.hpp"

struct ddsi_sertype;

namespace pose_wall::tools::live {

// Numbers by which DDS knows what it made: dds_entity_t.
using DdsEntity = std::int32_t;

// What ROS names a quality of service.
struct RosQos {
  bool is_reliable = true;
  bool is_latched = false;  // transient local: who comes later still gets the last ones
  std::int32_t depth = 1;
};

class Ros2Node {
 public:
  // A reader or a writer of one topic. Ends with its lifetime, which the node's must outlast.
  class Endpoint {
   public:
    Endpoint(Ros2Node& node, std::string topic, const RosType& type, const RosQos& qos, bool is_writer);
    ~Endpoint();
    Endpoint(const Endpoint&) = delete;
    Endpoint& operator=(const Endpoint&) = delete;

    const std::string& topic() const { return topic_; }
    const RosType& type() const { return type_; }
    DdsEntity entity() const { return entity_; }
    EndpointQos qos() const;
    std::uint32_t matched() const;

    // Of a writer. False where slow subscribers left no room for it within kWriteWait_ms: it is lost then.
    bool write(const std::string& message) const;
    // Of a reader. Until something is there to be taken, or the time is over.
    void wait(std::int64_t at_most_ms) const;
    // Samples that DDS knows of and could not deliver.
    std::uint64_t lost() const;
    // All that came, one after the other.
    void take(const std::function<void(ByteView)>& with) const;

   private:
    friend class Ros2Node;

    Ros2Node& node_;
    std::string topic_;
    RosType type_;
    bool is_writer_;
    DdsEntity topic_entity_ = 0, entity_ = 0, condition_ = 0, waitset_ = 0;
    const ddsi_sertype* sertype_ = nullptr;
    Gid gid_{};
  };

  static constexpr std::int64_t kWriteWait_ms = 10;

  Ros2Node(std::string name, RosEnvironment environment, const CycloneLimits& limits);
  ~Ros2Node();
  Ros2Node(const Ros2Node&) = delete;
  Ros2Node& operator=(const Ros2Node&) = delete;

  // Joins the network; may be called twice. Throws std::runtime_error where DDS cannot: no interface, no free port.
  void start();

  // topic: "/pose_wall/attitude"; a relative one is of the root. Throws std::runtime_error for what is no name of ROS.
  std::unique_ptr<Endpoint> make_reader(const std::string& topic, const RosType& type, const RosQos& qos);
  std::unique_ptr<Endpoint> make_writer(const std::string& topic, const RosType& type, const RosQos& qos);

  DdsEntity participant() const { return participant_; }
  const Gid& gid() const { return gid_; }
  const RosEnvironment& environment() const { return environment_; }
  const std::optional<NetworkInterface>& interface() const { return interface_; }
  // "" where nothing is wrong with it; else why other machines cannot find it.
  std::string trouble() const;
  // Of what was asked for, what the kernel granted.
  std::uint64_t receive_buffer_bytes() const { return receive_buffer_bytes_; }
  std::uint64_t receive_buffer_asked_bytes() const { return limits_.receive_buffer_bytes; }
  std::uint64_t sample_bytes_max() const { return limits_.sample_bytes_max; }

 private:
  void join();
  void tell_graph();
  void add_to_graph(const Endpoint& endpoint);
  void remove_from_graph(const Endpoint& endpoint);

  RosEnvironment environment_;
  CycloneLimits limits_;
  std::optional<NetworkInterface> interface_;
  std::mutex start_lock_, graph_lock_;
  DdsEntity domain_ = 0, participant_ = 0;
  Gid gid_{};
  std::uint64_t receive_buffer_bytes_ = 0;
  GraphNode node_;
  std::unique_ptr<Endpoint> graph_writer_;
};

// "/lidar/points" of ROS is "rt/lidar/points" of DDS. Throws std::runtime_error for what is no name of ROS.
std::string dds_topic(const std::string& topic);

}  // namespace pose_wall::tools::live
