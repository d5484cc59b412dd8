// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/live_runtime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "apps/live/clocks.hpp"
#include "apps/live/log.hpp"
#include "apps/live/thread_name.hpp"
#include "io/config_file/key_table.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"

namespace pose_wall::tools::live {
namespace {

// A result comes at most this many pushes after its frame: those that wait, the one in work, the one being copied.
constexpr std::uint64_t kFramesKept = 8;
// x, y, z as doubles, intensity, time and ring: whatever a driver writes.
constexpr std::uint32_t kPointBytes = 48;
// A transform that moved less is the same mount: a thirtieth of range_bias_max, and as much at five metres. Reopening
// costs what the engine remembers, so it is done at most so often; meanwhile nothing is measured.
constexpr double kSamePlace_m = 1e-3, kSameAngle_rad = 2e-4;
constexpr std::int64_t kReopenEvery_ns = 2'000'000'000;

void require(std::int32_t status, const char* what) {
  if (status == POSE_WALL_OK) return;
  throw std::runtime_error(fmt::format("{}: {}", what, pose_wall_runtime_status_text(status)));
}

bool is_same(const Extrinsic& a, const Extrinsic& b) {
  const auto near = [](double p, double q, double within) { return std::abs(p - q) <= within; };
  return near(a.x_m, b.x_m, kSamePlace_m) && near(a.y_m, b.y_m, kSamePlace_m) && near(a.z_m, b.z_m, kSamePlace_m) &&
         near(a.roll_rad, b.roll_rad, kSameAngle_rad) && near(a.pitch_rad, b.pitch_rad, kSameAngle_rad) &&
         near(a.yaw_rad, b.yaw_rad, kSameAngle_rad);
}

std::string milliseconds(std::int64_t ns) {
  return fmt::format("{:.1f}", static_cast<double>(ns) * 1e-6);
}

}  // namespace

LiveRuntime::LiveRuntime(const LoadedConfig& loaded, std::function<BlackBox()> open_box, Post post,
                         std::function<bool()> wants_points)
    : config_(loaded.config),
      open_box_(std::move(open_box)),
      post_(std::move(post)),
      wants_points_(std::move(wants_points)) {
  settings_.lidar_frame = config_text(*config_.get(), "lidar_frame");
  settings_.extrinsic_by_tf = loaded.live.extrinsic_from == "tf";
  settings_.has_box = !loaded.live.black_box.empty();
  settings_.motion = loaded.motion;
  settings_.worker_priority = static_cast<std::int32_t>(loaded.live.worker_priority);
  settings_.frame_points_max = static_cast<std::uint32_t>(loaded.live.frame_points_max);
  prepare_box();
  open();
}

LiveRuntime::~LiveRuntime() {
  stop();
  close();
}

void LiveRuntime::open() {
  box_ = std::exchange(spare_box_, {});  // the one before is closed: its runtime is
  pose_wall_runtime_options options{};
  require(pose_wall_runtime_options_init(&options), "the runtime's options");
  options.cloud_points_max = settings_.frame_points_max;
  options.worker_priority = settings_.worker_priority;
  options.callback = called_back;
  options.callback_user = this;
  options.sink = box_.write;
  options.sink_user = box_.user;
  options.box_bytes = box_.bytes;
  options.point_bytes_max = kPointBytes;
  options.motion = pose_wall_motion_functions_get();  // where the key `motion` is on
  options.motion_settings = &settings_.motion;
  // Clouds are in the box only where one fits beside the rest; without them nothing can be computed again.
  const std::uint64_t needed = 2 * std::uint64_t{options.cloud_points_max} * options.point_bytes_max;
  options.box_clouds = box_.bytes > needed ? 1 : 0;
  if (box_.write != nullptr && options.box_clouds == 0) {
    log_line(Grade::kWarning, "black box",
             fmt::format("holds digests alone, for a file of {} bytes has no room for clouds of frame_points_max {}: "
                         "black_box_mb above {} gives it",
                         box_.bytes, options.cloud_points_max, 4 * needed / 1'000'000 + 1));
  }
  std::uint64_t bytes = 0;
  require(pose_wall_runtime_memory_needed(config_.get(), &options, &bytes), "the runtime's memory");
  block_.resize(static_cast<std::size_t>((bytes + sizeof(Line) - 1) / sizeof(Line)));
  require(pose_wall_runtime_open(config_.get(), &options, block_.data(), block_.size() * sizeof(Line), &runtime_),
          "opening the runtime");
  if (!counts_) counts_.emplace(options.watchdog_ns, monotonic_ns());
  ++opened_;
}

// At the start a folder that cannot be written is a fault of the settings; later the machine goes on without a box.
void LiveRuntime::prepare_box() {
  try {
    spare_box_ = {};
    spare_box_ = open_box_();
  } catch (const std::exception& fault) {
    if (opened_ == 0) throw;
    log_line(Grade::kBad, "black box", fault.what());
  }
}

void LiveRuntime::close() {
  if (runtime_ == nullptr) return;
  const std::int32_t status = pose_wall_runtime_close(runtime_);
  if (status != POSE_WALL_OK) log_line(Grade::kBad, "runtime", pose_wall_runtime_status_text(status));
  runtime_ = nullptr;
}

void LiveRuntime::start() {
  const std::unique_lock<std::shared_mutex> locked(handle_lock_);
  require(pose_wall_runtime_start(runtime_), "starting the runtime");
  started_ = true;
}

void LiveRuntime::stop() {
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  if (runtime_ == nullptr) return;
  const std::int32_t status = pose_wall_runtime_stop(runtime_);
  if (status != POSE_WALL_OK) log_line(Grade::kBad, "runtime", pose_wall_runtime_status_text(status));
}

void LiveRuntime::take(LiveFrame frame) {
  const std::lock_guard<std::mutex> in_row(take_lock_);
  if (settings_.extrinsic_by_tf && !extrinsic_) {
    ++without_extrinsic_;
    return;
  }
  if (frame.frame_id.empty()) frame.frame_id = settings_.lidar_frame;
  const auto shared = std::make_shared<const LiveFrame>(std::move(frame));
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  if (watch_) watch_(shared, *config_.get());
  {
    const std::lock_guard<std::mutex> frames_locked(frames_lock_);
    frames_[next_number_] = shared;
    while (frames_.begin()->first + kFramesKept < next_number_) frames_.erase(frames_.begin());
  }
  const std::int32_t status = pose_wall_runtime_push(runtime_, &shared->frame.cloud);
  // What is not running counts no push (pose_wall_runtime_push).
  if (status != POSE_WALL_RUNTIME_E_STATE) ++next_number_;
  if (status != POSE_WALL_OK) last_refusal_ = status;
}

void LiveRuntime::set_extrinsic(const std::optional<Extrinsic>& extrinsic) {
  const std::lock_guard<std::mutex> in_row(take_lock_);
  take_extrinsic(extrinsic);
  has_extrinsic_ = extrinsic_.has_value();
}

void LiveRuntime::take_extrinsic(const std::optional<Extrinsic>& extrinsic) {
  if (!settings_.extrinsic_by_tf) return;
  if (!extrinsic) {
    if (extrinsic_) log_line(Grade::kWarning, "tf", "the transform is gone; nothing is measured");
    extrinsic_.reset();
    return;
  }
  const bool is_known = extrinsic_ && is_same(*extrinsic_, *extrinsic);
  const bool is_refused = refused_extrinsic_ && is_same(*refused_extrinsic_, *extrinsic);
  if (is_known || is_refused) return;
  extrinsic_.reset();
  // The source tells it again with the next cloud.
  if (reopened_ns_ != 0 && monotonic_ns() - reopened_ns_ < kReopenEvery_ns) return;
  reopened_ns_ = monotonic_ns();
  const std::optional<api::Config> config = with_extrinsic(*extrinsic);
  if (!config) {
    refused_extrinsic_ = extrinsic;
    log_line(Grade::kBad, "tf",
             "the transform is out of the range of extrinsic_x to extrinsic_yaw; nothing is measured");
    return;
  }
  refused_extrinsic_.reset();
  try {
    reopen(*config);
    extrinsic_ = extrinsic;
  } catch (const std::exception& fault) {
    log_line(Grade::kBad, "runtime", fmt::format("{}; nothing is measured", fault.what()));
    return;
  }
  log_line(
      Grade::kGood, "tf",
      fmt::format("sensor in base: x {:.3f}, y {:.3f}, z {:.3f} m, roll {:.3f}, pitch {:.3f}, yaw {:.3f} deg; {}",
                  extrinsic->x_m, extrinsic->y_m, extrinsic->z_m, extrinsic->roll_rad * kDegPerRad,
                  extrinsic->pitch_rad * kDegPerRad, extrinsic->yaw_rad * kDegPerRad, config_crc_text(*config->get())));
}

// The settings with this mount; nothing where it is out of their range.
std::optional<api::Config> LiveRuntime::with_extrinsic(const Extrinsic& extrinsic) const {
  api::Config config = config_;
  const std::pair<const char*, double> values[] = {
      {"extrinsic_x", extrinsic.x_m},           {"extrinsic_y", extrinsic.y_m},
      {"extrinsic_z", extrinsic.z_m},           {"extrinsic_roll", extrinsic.roll_rad},
      {"extrinsic_pitch", extrinsic.pitch_rad}, {"extrinsic_yaw", extrinsic.yaw_rad}};
  for (const auto& [key, value] : values) {
    if (config.set(key, value) != POSE_WALL_OK) return std::nullopt;
  }
  return config;
}

// Who asks for images waits for neither the frame in work nor the disk of the black box.
void LiveRuntime::reopen(const api::Config& config) {
  stop();
  prepare_box();
  const std::unique_lock<std::shared_mutex> locked(handle_lock_);
  close();
  config_ = config;
  {
    const std::lock_guard<std::mutex> frames_locked(frames_lock_);
    frames_.clear();
    last_.publication = {};
    next_number_ = 0;
  }
  open();
  if (started_) require(pose_wall_runtime_start(runtime_), "starting the runtime");
}

void LiveRuntime::wait_idle() {
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  (void)pose_wall_runtime_wait_idle(runtime_);
}

void LiveRuntime::called_back(void* user, const pose_wall_publication* publication) {
  static_cast<LiveRuntime*>(user)->publish(*publication);
}

void LiveRuntime::publish(const pose_wall_publication& publication) {
  thread_local bool is_named = false;
  if (!std::exchange(is_named, true)) name_this_thread("worker");
  auto result = std::make_shared<LiveResult>();
  result->publication = publication;
  result->config = *config_.get();
  result->frame = note_publication(result.get());
  counts_->note(*result);
  if (publication.cause == POSE_WALL_RUNTIME_FRAME) {
    if (result->frame) times_.note(result->frame->frame, publication);
    if (wants_points_()) result->points = points();
  }
  post_(result);
}

// Takes its frame from those that wait, and adds what the header of the frame says.
std::shared_ptr<const LiveFrame> LiveRuntime::note_publication(LiveResult* result) {
  const std::lock_guard<std::mutex> locked(frames_lock_);
  std::shared_ptr<const LiveFrame> frame;
  result->header_stamp_ns = last_.header_stamp_ns;
  const auto found =
      result->publication.cause == POSE_WALL_RUNTIME_FRAME ? frames_.find(result->publication.frame) : frames_.end();
  if (found != frames_.end()) {
    frame = found->second;
    frames_.erase(frames_.begin(), std::next(found));
    result->header_stamp_ns = frame->stamp_ns;
    result->frame_id = frame->frame_id;
  }
  last_ = *result;
  return frame;
}

// What the runtime publishes is there a moment before it is noted here, with the frame still among those that wait.
Newest LiveRuntime::newest() const {
  Newest newest;
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  pose_wall_publication& publication = newest.result.publication;
  while (true) {
    publication = {};
    publication.struct_size = sizeof publication;
    newest.status = pose_wall_runtime_latest(runtime_, &publication);
    newest.result.config = *config_.get();
    const std::lock_guard<std::mutex> frames_locked(frames_lock_);
    if (newest.is_there() && last_.publication.index > publication.index) continue;
    newest.result.header_stamp_ns = last_.header_stamp_ns;
    if (!newest.is_there() || publication.cause != POSE_WALL_RUNTIME_FRAME) return newest;
    const auto waits = frames_.find(publication.frame);
    if (waits != frames_.end()) {
      newest.result.header_stamp_ns = waits->second->stamp_ns;
      newest.result.frame_id = waits->second->frame_id;
    } else if (last_.publication.index == publication.index) {
      newest.result.frame_id = last_.frame_id;
    }
    return newest;
  }
}

std::shared_ptr<const LabelledPoints> LiveRuntime::points() const {
  pose_wall_points points{};
  if (pose_wall_runtime_last_points(runtime_, &points) != POSE_WALL_OK) return nullptr;
  auto copy = std::make_shared<LabelledPoints>();
  copy->x_base_m.assign(points.x_base_m, points.x_base_m + points.count);
  copy->y_base_m.assign(points.y_base_m, points.y_base_m + points.count);
  copy->z_base_m.assign(points.z_base_m, points.z_base_m + points.count);
  copy->label.assign(points.label, points.label + points.count);
  return copy;
}

pose_wall_image LiveRuntime::image() const {
  pose_wall_image image = api::make_image();
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  // Written whatever the status: what is stale or missing is invalid in it.
  static_cast<void>(pose_wall_runtime_image(runtime_, &image));
  return image;
}

pose_wall_image2 LiveRuntime::image2() const {
  pose_wall_image2 image = api::make_image2();
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  static_cast<void>(pose_wall_runtime_image2(runtime_, &image));
  return image;
}

std::optional<pose_wall_motion_image> LiveRuntime::motion_image() const {
  pose_wall_motion_image image{};
  image.struct_size = sizeof image;
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  if (pose_wall_runtime_motion_image(runtime_, &image) == POSE_WALL_RUNTIME_E_MOTION) return std::nullopt;
  return image;
}

ResultSums LiveRuntime::sums() const {
  return counts_->until(monotonic_ns());
}

std::int32_t LiveRuntime::latest(pose_wall_publication* newest) const {
  pose_wall_publication& publication = *newest;
  publication = {};
  publication.struct_size = sizeof publication;
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  return pose_wall_runtime_latest(runtime_, &publication);
}

pose_wall_runtime_statistics LiveRuntime::statistics() const {
  pose_wall_runtime_statistics statistics{};
  statistics.struct_size = sizeof statistics;
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  (void)pose_wall_runtime_statistics_now(runtime_, &statistics);
  return statistics;
}

bool LiveRuntime::is_alive() const {
  const pose_wall_runtime_statistics now = statistics();
  if (now.activity == POSE_WALL_RUNTIME_AT_NOTHING || now.activity == POSE_WALL_RUNTIME_AT_WAIT) return true;
  return monotonic_ns() - now.activity_since_ns < kHangs_ns;
}

PartHealth LiveRuntime::health() const {
  pose_wall_publication publication{};
  const bool is_stale = latest(&publication) == POSE_WALL_RUNTIME_E_STALE;
  PartHealth health;
  health.part = "runtime";
  std::uint32_t usable = 0;
  for (const pose_wall_value& value : publication.result.quantity) usable += value.state >= POSE_WALL_DEGRADED ? 1 : 0;
  const bool is_fresh = publication.cause == POSE_WALL_RUNTIME_FRAME;
  if (settings_.extrinsic_by_tf && !has_extrinsic_ && without_extrinsic_ > 0 && !is_fresh) {
    health.grade = Grade::kBad;
    health.summary = "waits for the transform from " + settings_.lidar_frame + "; nothing is measured";
  } else if (is_stale) {
    // Silence is published ten times a second: who does not even tell that, hangs or is kept from its work.
    health.grade = Grade::kBad;
    health.summary = is_alive() ? "results are late, and all values invalid: other work takes the processors; "
                                  "worker_priority goes before it"
                                : "the worker hangs: results are old, and all values invalid";
  } else if (!is_fresh) {
    health.grade = Grade::kBad;
    health.summary = publication.cause == 0 ? "no frame yet" : "no frame comes";
  } else {
    health.grade = usable == POSE_WALL_QUANTITIES ? Grade::kGood : Grade::kWarning;
    health.summary = usable == 0 ? "frames come, nothing is measured" : "measures";
  }
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    health.add(pose_wall_quantity_name(q), pose_wall_state_name(publication.result.quantity[q].state));
  }
  if (is_fresh) times_.tell(&health);
  add_runtime_facts(&health);
  add_box_facts(&health);
  return health;
}

void LiveRuntime::add_runtime_facts(PartHealth* health) const {
  const pose_wall_runtime_statistics now = statistics();
  health->add("frames pushed", now.pushed);
  health->add("frames measured", now.processed);
  for (std::uint32_t why = 0; why < POSE_WALL_RUNTIME_DROPS; ++why) {
    if (now.dropped[why] > 0)
      health->add(fmt::format("dropped, {}", pose_wall_runtime_drop_name(why)), now.dropped[why]);
  }
  if (without_extrinsic_ > 0) health->add("dropped, no transform yet", without_extrinsic_.load());
  if (last_refusal_ != POSE_WALL_OK) health->add("last refusal", pose_wall_runtime_status_text(last_refusal_));
  health->add("silences", now.silences);
  health->add("age ms", now.newest_age_ns < 0 ? "-" : milliseconds(now.newest_age_ns));
  health->add("latency p50 ms", milliseconds(now.latency.p50_ns));
  health->add("latency p99 ms", milliseconds(now.latency.p99_ns));
  health->add("latency worst ms", milliseconds(now.latency.worst_ns));
  if (now.motion.count > 0) {
    health->add("motion p99 ms", milliseconds(now.motion.p99_ns));
    health->add("frames without motion", now.motion_refused);
  }
  if (now.priority_error != 0) health->add("worker_priority refused", std::strerror(now.priority_error));
  health->add("activity", pose_wall_runtime_activity_name(now.activity));
  health->add("opened", opened_.load());
}

void LiveRuntime::add_box_facts(PartHealth* health) const {
  if (!settings_.has_box) return;
  const pose_wall_runtime_statistics now = statistics();
  const std::shared_lock<std::shared_mutex> locked(handle_lock_);
  box_watch_.tell(box_, now, monotonic_ns(), health);
}

}  // namespace pose_wall::tools::live
