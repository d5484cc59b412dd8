// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/planar/stop_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "apps/live/clocks.hpp"
#include "apps/live/thread_name.hpp"
#include "io/config_file/key_table.hpp"
#include "io/language/language.hpp"
#include "study/planar/stop_reasons.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::int64_t kTellEvery_ns = 100'000'000;
constexpr double kNsPerS = 1e9;
// Longer than motion takes for a frame, and half of what the stop knows.
constexpr std::size_t kFramesKept = 16;
// Without a measurement the drive is trusted to follow its commands to a fifth, for tracks slip, and to turn by no more
// than this beside them.
constexpr double kSlip = 0.2, kTurnError_rad_s = 0.03;
// A frame or two may be lost; what is slow for longer is the sensor, or this machine.
constexpr int kSlowFrames = 5;

// Along forward_axis, of a step in base.
double along_forward(const pose_wall_config& config, const double* step_m) {
  const std::string axis = config_text(config, "forward_axis");
  const double along_m = step_m[axis.back() == 'Y' ? 1 : 0];
  return axis.front() == '-' ? -along_m : along_m;
}

// load_config has named the keys of what people can set wrongly.
std::string refusal_of(const pose_wall_planar_stop_settings& settings) {
  pose_wall_planar_fault fault{};
  static_cast<void>(pose_wall_planar_stop_settings_check(&settings, &fault));
  return say("planar stop: {}", fault.rule != nullptr ? fault.rule : tr("it cannot be opened"));
}

}  // namespace

std::string stop_reasons_text(std::uint32_t reasons) {
  return fmt::format("{}", fmt::join(stop_reason_names(reasons), ", "));
}

pose_wall_planar_stop_image image_of(const StopNews& news) {
  pose_wall_planar_stop_image image{};
  image.struct_size = sizeof image;
  const bool is_filled = pose_wall_planar_stop_image_fill(&news.result, &image) == POSE_WALL_OK;
  return is_filled ? image : pose_wall_planar_stop_image{};
}

StopGuard::StopGuard(const LoadedConfig& loaded, Tell tell, CommandBoard* commands)
    : settings_(stop_settings_of(loaded.planar)),
      takes_motion_(loaded.planar.takes_measured()),
      takes_command_(loaded.planar.takes_command()),
      commands_(commands),
      line_(settings_, config_text(*loaded.config.get(), "forward_axis")),
      tell_(std::move(tell)),
      block_(POSE_WALL_PLANAR_STOP_BLOCK_MOST),
      times_(POSE_WALL_PLANAR_STOP_GO + 1, POSE_WALL_PLANAR_STOP_STOP, monotonic_ns()) {
  if (takes_command_ && !takes_motion_) {
    settings_.speed_error_ratio = kSlip;
    settings_.turn_error_rad_s = kTurnError_rad_s;
  }
  open(*loaded.config.get());
  if (stop_ == nullptr) throw std::runtime_error(refusal_of(settings_));
  begin_answers();
}

// A controller counts no heartbeat that lies behind one that it saw. So that of a daemon that was started again begins
// ahead: by a clock, and faster than answers come, of which there are 100 a second at most.
void StopGuard::begin_answers() {
  constexpr std::int64_t kBeat_ns = kTick_ns / 2;
  first_beat_ = static_cast<std::uint32_t>(static_cast<std::uint64_t>(wall_ns()) / kBeat_ns);
  newest_.result.struct_size = sizeof newest_.result;
  static_cast<void>(pose_wall_planar_stop_tick(stop_, monotonic_ns(), &newest_.result));
  newest_.result.heartbeat = first_beat_;
  refuse(&newest_, POSE_WALL_PLANAR_STOP_R_STALE);
  cause_ = stop_cause(newest_.result);
  newest_.cause_since_ns = monotonic_ns();
}

// Without a handle every answer is a stop.
void StopGuard::open(const pose_wall_config& config) {
  config_ = config;
  stop_ = nullptr;
  stamps_ = StampClock();
  frames_.clear();
  slow_frames_ = 0;
  const std::int32_t status = pose_wall_planar_stop_open(&config_, &settings_, block_.data(), block_.bytes(), &stop_);
  if (status != POSE_WALL_OK) stop_ = nullptr;
}

void StopGuard::start() {
  if (thread_.joinable()) return;
  ending_ = false;
  thread_ = std::thread([this] { run(); });
}

void StopGuard::stop() {
  {
    const std::lock_guard<std::mutex> locked(lock_);
    ending_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void StopGuard::take(const std::shared_ptr<const LiveFrame>& frame, const pose_wall_config& config) {
  std::optional<Job> job = Job{frame, config, monotonic_ns()};  // what is lost is freed outside of the lock
  {
    const std::lock_guard<std::mutex> locked(lock_);
    if (waiting_) ++lost_;
    waiting_.swap(job);
  }
  changed_.notify_one();
}

void StopGuard::confirm() {
  const std::lock_guard<std::mutex> locked(lock_);
  confirmed_ = true;
}

void StopGuard::note_motion(const LiveResult& result) {
  const pose_wall_publication& told = result.publication;
  const pose_wall_motion_result& moved = told.motion;
  // For the comparison with commands a step is enough.
  if (commands_ != nullptr && told.has_motion != 0 && moved.along_state == POSE_WALL_ALONG_MEASURED) {
    const double* const level = moved.step_protection_level;
    commands_->note_measured(
        {along_forward(result.config, moved.step_m) / moved.step_s, moved.step_rad[2] / moved.step_s},
        {level[POSE_WALL_MOTION_ALONG] / moved.step_s, level[POSE_WALL_MOTION_YAW] / moved.step_s}, monotonic_ns());
  }
  if (!takes_motion_ || told.has_motion == 0 || told.odometry.run == 0) return;
  const std::lock_guard<std::mutex> locked(lock_);
  seen_.push_back({told.odometry, told.motion.stamp_ns});
  if (seen_.size() > kFramesKept) seen_.pop_front();
}

// An odometry comes later than its frame, and the stop waits for none.
void StopGuard::note_seen() {
  std::deque<Seen> seen;
  {
    const std::lock_guard<std::mutex> locked(lock_);
    seen.swap(seen_);
  }
  for (const Seen& one : seen) {
    for (const Stamp& frame : frames_) {
      if (frame.of_sensor_ns != one.stamp_ns || stop_ == nullptr) continue;
      static_cast<void>(pose_wall_planar_stop_note_odometry(stop_, &one.odometry, frame.placed_ns));
    }
  }
}

// The measured motion is that of the odometry. Where both are asked for, neither is trusted alone: a command that is no
// number tells the stop that it is missing.
pose_wall_planar_stop_motion StopGuard::motion_now(bool is_measured) const {
  pose_wall_planar_stop_motion motion{};
  motion.struct_size = sizeof motion;
  if (!takes_command_) return motion;
  const std::optional<DriveMotion> command = commands_ != nullptr ? commands_->newest(monotonic_ns()) : std::nullopt;
  if (command && takes_motion_ && !is_measured) return motion;
  motion.given = POSE_WALL_PLANAR_STOP_COMMANDED;
  motion.command_speed_m_s = command ? command->speed_m_s : NAN;
  motion.command_turn_rad_s = command ? command->turn_rad_s : NAN;
  return motion;
}

// Of three frames in which dust is told from things the last must come within delay_s.
bool StopGuard::comes_too_slowly(std::int64_t stamp_ns) {
  const bool is_apart =
      2.0 * (static_cast<double>(stamp_ns) - static_cast<double>(stamp_ns_)) > settings_.delay_s * kNsPerS;
  stamp_ns_ = stamp_ns;
  slow_frames_ = is_apart ? slow_frames_ + 1 : 0;
  return slow_frames_ >= kSlowFrames;
}

void StopGuard::refuse(StopNews* news, std::uint32_t reason) const {
  news->result.state = POSE_WALL_PLANAR_STOP_STOP;
  news->result.reasons |= reason;
  news->result.allowed_speed_m_s = news->result.allowed_turn_rad_s = news->result.stop_speed_m_s = 0.0;
}

void StopGuard::answer_frame(const Job& job, StopNews* news) {
  if (std::memcmp(&job.config, &config_, sizeof config_) != 0) open(job.config);
  header_stamp_ns_ = job.frame->stamp_ns;
  pose_wall_cloud cloud = job.frame->frame.cloud;
  const StampClock::Placed placed = stamps_.place(cloud.stamp_ns, job.received_ns);
  const bool is_slow = comes_too_slowly(cloud.stamp_ns != 0 ? cloud.stamp_ns : job.received_ns);
  // A clock that went back: nothing that was seen before is as old as it seems.
  if (!placed.is_later && stop_ != nullptr) static_cast<void>(pose_wall_planar_stop_reset(stop_));
  cloud.stamp_ns = placed.ns;
  // Frames without stamps cannot be told apart.
  if (!placed.is_later) frames_.clear();
  if (job.frame->frame.cloud.stamp_ns != 0) frames_.push_back({job.frame->frame.cloud.stamp_ns, placed.ns});
  if (frames_.size() > kFramesKept) frames_.pop_front();
  note_seen();
  const pose_wall_planar_stop_motion motion = motion_now(std::isfinite(news->result.speed_m_s));
  const std::int32_t status =
      stop_ == nullptr ? POSE_WALL_E_ENGINE
                       : pose_wall_planar_stop_process(stop_, &cloud, &motion, monotonic_ns(), &news->result);
  frame_refused_ = status != POSE_WALL_OK || is_slow;
  if (!frame_refused_ && placed.is_later) return;
  refuse(news, POSE_WALL_PLANAR_STOP_R_INVALID);
  const std::lock_guard<std::mutex> locked(lock_);
  ++refused_;
}

void StopGuard::answer_silence(StopNews* news) {
  if (stop_ == nullptr || pose_wall_planar_stop_tick(stop_, monotonic_ns(), &news->result) != POSE_WALL_OK) {
    refuse(news, POSE_WALL_PLANAR_STOP_R_STALE);
  } else if (frame_refused_) {
    // The library goes by the frame before it; that one is no permission any more.
    refuse(news, POSE_WALL_PLANAR_STOP_R_INVALID);
  }
}

void StopGuard::run() {
  name_this_thread("planar-stop");
  StopNews news = newest();
  while (true) {
    std::optional<Job> job;
    bool is_confirmed = false;
    {
      std::unique_lock<std::mutex> locked(lock_);
      changed_.wait_for(locked, std::chrono::nanoseconds(kTick_ns), [this] { return ending_ || waiting_; });
      if (ending_) break;
      job.swap(waiting_);
      is_confirmed = std::exchange(confirmed_, false);
    }
    if (is_confirmed) heed_look(news);
    if (job) {
      answer_frame(*job, &news);
    } else {
      answer_silence(&news);
    }
    ++news.rounds;
    news.result.heartbeat = first_beat_ + static_cast<std::uint32_t>(news.rounds);
    news.answered_ns = monotonic_ns();
    news.header_stamp_ns = header_stamp_ns_;
    note_cause(&news);
    put(news, job ? &*job : nullptr);
  }
  refuse(&news, POSE_WALL_PLANAR_STOP_R_STALE);  // the last word of an end in order
  note_cause(&news);
  put(news, nullptr);
}

// Who looks while no frame comes vouches for a moment that the stop cannot date.
void StopGuard::heed_look(const StopNews& news) {
  constexpr std::uint32_t kNoFrame =
      POSE_WALL_PLANAR_STOP_R_STALE | POSE_WALL_PLANAR_STOP_R_INVALID | POSE_WALL_PLANAR_STOP_R_FROZEN;
  const bool sees = stop_ != nullptr && news.result.frames > 0 && (news.result.reasons & kNoFrame) == 0;
  if (sees && pose_wall_planar_stop_confirm(stop_) == POSE_WALL_OK) {
    const std::lock_guard<std::mutex> locked(lock_);
    ++looks_;
  }
}

void StopGuard::note_cause(StopNews* news) {
  const StopCause cause = stop_cause(news->result);
  if (cause != cause_) news->cause_since_ns = news->answered_ns;
  // A frame that came meanwhile ended the silence before it.
  if (cause == StopCause::kStale) news->cause_since_ns = std::max(news->cause_since_ns, news->result.stamp_ns);
  cause_ = cause;
}

void StopGuard::put(const StopNews& news, const Job* job) {
  bool is_change = false;
  {
    const std::lock_guard<std::mutex> locked(lock_);
    is_change = news.result.state != newest_.result.state;
    if (is_change && news.result.state == POSE_WALL_PLANAR_STOP_STOP) ++stops_;
    if (job != nullptr) {
      ++answered_;
      received_ns_ = job->received_ns;
      is_slow_ = slow_frames_ >= kSlowFrames;
      latency_.note(news.answered_ns - job->received_ns);
    }
    newest_ = news;
    times_.note(news.result.state, news.answered_ns, news.answered_ns + kSilent_ns);
  }
  if (job == nullptr && !is_change && news.answered_ns - told_ns_ < kTellEvery_ns) return;
  told_ns_ = news.answered_ns;
  if (tell_) tell_(std::make_shared<const StopNews>(news));
}

StopNews StopGuard::newest() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return newest_;
}

StopNews StopGuard::stop_now() const {
  StopNews news = newest();
  if (monotonic_ns() - news.answered_ns <= kSilent_ns) return news;
  refuse(&news, POSE_WALL_PLANAR_STOP_R_STALE);
  news.cause_since_ns = news.answered_ns;
  return news;
}

std::vector<std::int64_t> StopGuard::state_ns() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return times_.until(monotonic_ns());
}

bool StopGuard::is_alive() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return newest_.answered_ns == 0 || monotonic_ns() - newest_.answered_ns <= kHangs_ns;
}

PartHealth StopGuard::health() const {
  const StopNews news = stop_now();
  PartHealth health;
  health.part = "planar stop";
  const bool is_stop = news.result.state == POSE_WALL_PLANAR_STOP_STOP;
  const bool is_stale = (news.result.reasons & POSE_WALL_PLANAR_STOP_R_STALE) != 0;
  health.grade = !is_stop ? Grade::kGood : is_stale ? Grade::kBad : Grade::kWarning;
  health.add("state", pose_wall_planar_stop_state_name(news.result.state));
  health.add("reasons", stop_reasons_text(news.result.reasons));
  health.add("why", line_.text(Language::kEnglish, news.result, news.cause_for_s()));
  health.chinese_facts["why"] = line_.text(Language::kChinese, news.result, news.cause_for_s());
  health.add("allowed mm/s", fmt::format("{}", news.allowed_mm_s()));
  health.add("heartbeat", news.rounds);
  health.add("settings' CRC", fmt::format("16#{:08X}", news.result.settings_crc32));
  const std::lock_guard<std::mutex> locked(lock_);
  const bool comes = static_cast<double>(monotonic_ns() - received_ns_) <= settings_.stale_s * kNsPerS;
  health.summary = !is_stop             ? "permits driving"
                   : is_stale && !comes ? "stops the machine: no frame comes"
                   : is_stale           ? "stops the machine: frames come late, by their stamps"
                   : is_slow_           ? "stops the machine: frames come slower than planar_period"
                                        : "stops the machine";
  if (takes_motion_) {
    health.add("speed m/s", fmt::format("{:.2f}", news.result.speed_m_s));
    health.add("speed errs by m/s", fmt::format("{:.2f}", news.result.speed_error_m_s));
  }
  health.add("frames answered", answered_);
  health.add("frames lost to slowness", lost_);
  health.add("frames refused", refused_);
  health.add("stops", stops_);
  health.add("looks heeded", looks_);
  health.add("latency mean ms", latency_.mean_ms_text());
  health.add("latency worst ms", latency_.worst_ms_text());
  return health;
}

}  // namespace pose_wall::tools::live
