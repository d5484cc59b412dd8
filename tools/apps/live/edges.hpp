// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The edges of the daemon by name. Each is made by a folder of its own; one that needs a library which the build did
// not find throws EdgeMissing, which says what to install.

#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/live/images.hpp"
#include "apps/live/planar/command_board.hpp"
#include "apps/live/planar/planar_news.hpp"
#include "apps/live/sink.hpp"
#include "apps/live/source.hpp"
#include "apps/live/web/web_part.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

class EdgeMissing : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One program on the network that reads clouds, publishes results, or both: a node of ROS.
struct RosEdge {
  std::unique_ptr<Source> source;  // none unless it subscribes
  std::unique_ptr<Sink> sink;      // none unless it publishes
  std::unique_ptr<Sink> commands;  // a part of its own that reads commands; none where the node does it by itself
};

struct ReplayPlan {
  std::vector<std::string> inputs;
  std::string topic, source, metadata;  // as those of the command `pose_wall run`
  double speed = 1.0;                   // times real time; 0: as fast as frames are worked, none dropped
  bool step = false;                    // one frame for each line of standard input
  bool repeat = false;                  // from the start again at the end
};

std::unique_ptr<Source> make_udp_source(const LoadedConfig& loaded);
std::unique_ptr<Source> make_replay_source(const ReplayPlan& plan);

// commands: where commands of the drive go, by planar_command_ros; none: none are read.
RosEdge make_ros1_edge(const LoadedConfig& loaded, const HealthBoard& health, bool subscribes, bool publishes,
                       CommandBoard* commands);
RosEdge make_ros2_edge(const LoadedConfig& loaded, const HealthBoard& health, bool subscribes, bool publishes,
                       CommandBoard* commands);

// stop: none where the planar part is off; its registers are then 0. commands: likewise, by planar_command_modbus.
std::unique_ptr<Sink> make_modbus_sink(const LoadedConfig& loaded, const Images& images, const StopBoard* stop,
                                       CommandBoard* commands);
// stop: none where the planar part is off; it then has no frames.
std::unique_ptr<Sink> make_can_sink(const LoadedConfig& loaded, const Images& images, const StopBoard* stop);
// Reads commands of the drive from planar_command_can.
std::unique_ptr<Sink> make_can_commands(const LoadedConfig& loaded, CommandBoard& commands);
std::unique_ptr<Sink> make_mqtt_sink(const LoadedConfig& loaded, const HealthBoard& health);
// stop: as above. more: what else the server answers; none: nothing.
std::unique_ptr<Sink> make_page_sink(const LoadedConfig& loaded, const HealthBoard& health, const StopBoard* stop,
                                     WebPart* more);
// restart: called once the page asks for a start with the settings that it has saved. From any thread.
class Commissioning : public Sink, public WebPart {};
std::unique_ptr<Commissioning> make_commissioning(const LoadedConfig& loaded, const HealthBoard& health,
                                                  std::function<void()> restart);
// Viewers by the protocol of Foxglove.
std::unique_ptr<Sink> make_foxglove_sink(const LoadedConfig& loaded, const HealthBoard& health);
std::unique_ptr<Sink> make_recorder(const LoadedConfig& loaded, const HealthBoard& health);

// What the runtime writes its black box with: a ring file for each start, in a folder of bounded size.
struct BlackBox {
  // From any thread.
  struct State {
    std::atomic<int> fault{0};                 // errno of the last write; 0: it was written
    std::atomic<std::uint64_t> free_bytes{0};  // of its disk, for others than root
  };
  pose_wall_runtime_sink write = nullptr;
  void* user = nullptr;
  std::uint64_t bytes = 0;
  std::shared_ptr<const State> state;
  std::shared_ptr<void> keeper;  // the file stays open as long as this lives
};
BlackBox open_black_box(const LoadedConfig& loaded);

}  // namespace pose_wall::tools::live
