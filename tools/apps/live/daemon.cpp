// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/daemon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "apps/live/clocks.hpp"
#include "apps/live/health_words.hpp"
#include "apps/live/planar/roadway_sink.hpp"
#include "io/config_file/all_settings.hpp"
#include "io/config_file/key_table.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kLook = std::chrono::milliseconds(50);
// A replay that waits for a disk looks so often whether it is to stop: a stop within a second must not wait for that.
constexpr auto kDiskStall = std::chrono::milliseconds(500);

void log_lines(const std::string& part, const std::string& text, Grade grade = Grade::kGood) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) log_line(grade, part, line);
}

// What one wants to see of a part every minute: its counters.
std::string facts_text(const PartHealth& part) {
  std::string text = part.summary;
  for (const auto& [name, value] : part.facts) text += fmt::format("{}{} {}", tr("; "), name, value);
  return text;
}

}  // namespace

// What the source hands its frames to. Who waits for the worker waits for those who keep its results as well, or a
// recording that is replayed without a pace would be kept with holes.
class Daemon::Taker final : public FrameTaker {
 public:
  explicit Taker(Daemon& daemon) : daemon_(daemon) {}
  void take(LiveFrame frame) override { daemon_.runtime_.take(std::move(frame)); }
  void set_extrinsic(const std::optional<Extrinsic>& extrinsic) override { daemon_.runtime_.set_extrinsic(extrinsic); }
  void wait_idle() override { daemon_.runtime_.wait_idle(); }
  bool wait_for_room() override {
    return std::all_of(daemon_.sinks_.begin(), daemon_.sinks_.end(),
                       [](const auto& sink) { return sink->wait_for_room(kDiskStall); });
  }

 private:
  Daemon& daemon_;
};

Daemon::Daemon(const LoadedConfig& loaded, const std::optional<ReplayPlan>& replay)
    : loaded_(loaded),
      runtime_(
          loaded_, [this] { return open_black_box(loaded_); },
          [this](const std::shared_ptr<const LiveResult>& result) { post(result); },
          [this] {
            for (const auto& sink : sinks_) {
              if (sink->wants_points()) return true;
            }
            return false;
          }),
      taker_(std::make_unique<Taker>(*this)) {
  make_planar();
  make_edges(replay);
}

// The stop stands beside the runtime, not behind it.
void Daemon::make_planar() {
  if (!loaded_.planar.is_on()) return;
  const std::string place = command_place(loaded_.planar);
  if (!place.empty()) commands_ = std::make_unique<CommandBoard>(place, loaded_.planar.command_age_s);
  const StopGuard::Tell tell = [this](const std::shared_ptr<const StopNews>& news) {
    for (const auto& sink : sinks_) sink->post(news);
  };
  guard_ = std::make_unique<StopGuard>(loaded_, tell, commands_.get());
  runtime_.watch_frames([this](const std::shared_ptr<const LiveFrame>& frame, const pose_wall_config& config) {
    guard_->take(frame, config);
  });
  roadway_ =
      std::make_unique<SinkThread>(make_roadway_sink(loaded_, [this](const std::shared_ptr<const RoadwayNews>& news) {
        for (const auto& sink : sinks_) sink->post(news);
      }));
}

void Daemon::make_edges(const std::optional<ReplayPlan>& replay) {
  const LiveSettings& live = loaded_.live;
  // First, for sinks end in this order: what is kept is on the disk before a network can hold anything up.
  if (!live.recording.empty()) add(make_recorder(loaded_, *this));
  if (replay) {
    source_ = make_replay_source(*replay);
  } else if (live.source == "udp") {
    source_ = make_udp_source(loaded_);
  }
  const bool reads_ros1 = !replay && live.source == "ros1", reads_ros2 = !replay && live.source == "ros2";
  if (live.ros1 || reads_ros1) add(make_ros1_edge(loaded_, *this, reads_ros1, live.ros1, commands_.get()));
  if (live.ros2 || reads_ros2) add(make_ros2_edge(loaded_, *this, reads_ros2, live.ros2, commands_.get()));
  if (!live.modbus.empty()) add(make_modbus_sink(loaded_, runtime_, guard_.get(), commands_.get()));
  if (!live.can.empty()) add(make_can_sink(loaded_, runtime_, guard_.get()));
  if (commands_ && loaded_.planar.command_can != 0.0) add(make_can_commands(loaded_, *commands_));
  if (!live.mqtt.empty()) add(make_mqtt_sink(loaded_, *this));
  if (!live.foxglove.empty()) add(make_foxglove_sink(loaded_, *this));
  if (live.http.empty()) return;
  std::unique_ptr<Commissioning> commissioning;
  if (live.commissioning) commissioning = make_commissioning(loaded_, *this, [this] { restarts_ = true; });
  WebPart* const more = commissioning.get();
  add(make_page_sink(loaded_, *this, guard_.get(), more));  // before what it answers for: sinks end in this order
  if (commissioning) add(std::move(commissioning));
}

void Daemon::add(std::unique_ptr<Sink> sink) {
  sinks_.push_back(std::make_unique<SinkThread>(std::move(sink)));
}

void Daemon::add(RosEdge edge) {
  if (edge.source) source_ = std::move(edge.source);
  if (edge.sink) add(std::move(edge.sink));
  if (edge.commands) add(std::move(edge.commands));
}

void Daemon::post(const std::shared_ptr<const LiveResult>& result) {
  if (guard_) guard_->note_motion(*result);
  if (roadway_) roadway_->post(result);
  for (const auto& sink : sinks_) sink->post(result);
}

void Daemon::log_start() const {
  log_line(Grade::kGood, "pose_walld", fmt::format("version {}", pose_wall_version()));
  log_lines("axes", resolved_frames_text(resolve_frames(loaded_.config), ""));
  for (const SettingText& setting : all_settings(loaded_)) {
    if (loaded_.origins.count(setting.key) == 0) continue;
    // An empty name is told as nothing is, and not in quotes.
    const bool is_engine = setting.reader == SettingText::Reader::kEngine;
    log_line(Grade::kGood, "config",
             fmt::format("{}: {} ({})", setting.key, is_engine ? setting.written() : setting.value,
                         loaded_.origin(setting.key)));
  }
  const bool moves = config_text(*loaded_.config.get(), "motion") == "on";
  log_line(Grade::kGood, "motion",
           moves ? "on: held values move with the machine, and its way along the road is told (key motion)"
                 : "off (key motion)");
  log_line(Grade::kGood, "config", config_crc_text(*loaded_.config.get()) + " (dwConfigCrc of FB_PoseWall)");
  if (guard_) {
    log_line(Grade::kGood, "planar stop",
             fmt::format("settings' CRC: 16#{:08X} (dwSettingsCrc of FB_PoseWallStop)",
                         guard_->stop_now().result.settings_crc32));
  }
  log_line(Grade::kGood, "config", "all other keys have their defaults; `pose_wall check-config` lists them");
}

void Daemon::log_status() const {
  for (const PartHealth& part : all()) log_line(part.grade, part.part, facts_text(in_language(language(), part)));
}

// The map first: a wrong one is named before anybody is served.
void Daemon::start() {
  if (roadway_) roadway_->start();
  for (const auto& sink : sinks_) sink->start();
  if (guard_) guard_->start();
  runtime_.start();
  source_->start(*taker_);
}

void Daemon::stop() {
  source_->stop();
  if (guard_) guard_->stop();
  runtime_.stop();
  if (roadway_) roadway_->stop();
  // Before the others: what is kept is on the disk before a network can hold anything up.
  for (const auto& sink : sinks_) sink->stop();
}

std::vector<PartHealth> Daemon::all() const {
  std::vector<PartHealth> parts = {runtime_.health(), source_->health(), host_clock_.health(), readings_.health()};
  if (guard_) parts.push_back(guard_->health());
  if (commands_) parts.push_back(commands_->health(monotonic_ns()));
  if (roadway_) parts.push_back(roadway_->health());
  for (const auto& sink : sinks_) parts.push_back(sink->health());
  return parts;
}

std::vector<std::string> Daemon::hung() const {
  std::vector<std::string> hung;
  if (!runtime_.is_alive()) hung.emplace_back("the runtime's worker hangs");
  if (guard_ && !guard_->is_alive()) hung.emplace_back("the obstacle stop hangs");
  const std::int64_t looked_ns = looked_ns_;
  if (looked_ns != 0 && monotonic_ns() - looked_ns > kHangs_ns) hung.emplace_back("the daemon's own loop hangs");
  return hung;
}

void Daemon::take_settings(const std::function<LoadedConfig()>& read) {
  LoadedConfig fresh;
  try {
    fresh = read();
  } catch (const std::exception& fault) {
    readings_.note_refused(fault.what(), wall_ns());
    log_lines("settings", fault.what(), Grade::kBad);
    log_line(Grade::kBad, "settings", "read again and refused: nothing is changed");
    return;
  }
  const std::vector<SettingChange> changes = setting_changes(loaded_, fresh);
  take_changes(changes, fresh, &loaded_);
  set_log_level(log_level_of(loaded_.live.log_level));
  std::size_t taken = 0;
  for (const SettingChange& change : changes) {
    taken += change.is_taken ? 1 : 0;
    log_anyway(change.is_taken ? Grade::kGood : Grade::kWarning, "settings", change_text(change));
  }
  readings_.note_taken(changes.size() - taken, wall_ns());
  log_anyway(Grade::kGood, "settings",
             fmt::format("read again: {} changed, {} wait for a restart", taken, changes.size() - taken));
}

void Daemon::look_around(const Wishes& wishes) {
  looked_ns_ = monotonic_ns();
  health_log_.note(all());
  if (wishes.reload.exchange(false)) take_settings(wishes.read_settings);
  if (wishes.looked.exchange(false)) {
    log_line(guard_ ? Grade::kGood : Grade::kWarning, "planar stop",
             guard_ ? "somebody has looked: nothing is close around the machine"
                    : "somebody has looked, but the key `planar` is off");
    if (guard_) guard_->confirm();
  }
  // What hangs is a reason to be started anew.
  if (hung().empty()) service_.alive();
}

void Daemon::run(const Wishes& wishes) {
  log_start();
  start();
  service_.ready();
  set_log_level(log_level_of(loaded_.live.log_level));
  Clock::time_point status_last = Clock::now();
  while (!wishes.stop && !restarts_ && !source_->is_finished()) {
    look_around(wishes);
    if (Clock::now() - status_last >= std::chrono::duration<double>(loaded_.live.status_every_s)) {
      status_last = Clock::now();
      log_status();
    }
    std::this_thread::sleep_for(kLook);
  }
  // Who asks for an end is not overruled by who asks for a new start.
  if (wishes.stop) restarts_ = false;
  if (!restarts_) service_.stopping();
  const bool was_asked = wishes.stop || restarts_;
  if (!wishes.stop) wishes.is_through();
  const std::string failure = was_asked ? "" : source_->failure();
  // What failed stands in the source's line of status.
  if (failure.empty()) {
    log_line(Grade::kGood, "pose_walld",
             restarts_   ? "ends, to start with the settings that were saved"
             : was_asked ? "stops, as asked"
                         : "the recording is through");
  }
  log_status();
  stop();
  if (!failure.empty()) throw std::runtime_error(failure);
}

}  // namespace pose_wall::tools::live
