// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/stop_prospect.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "io/config_file/resolved_frames.hpp"
#include "io/config_file/sensor_mount.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/packets/sensors.hpp"
#include "lab/sim/random.hpp"
#include "study/planar/part_block.hpp"
#include "study/planar/stop_reasons.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kProspectFrame_s = 0.1;
constexpr double kProspectAcceleration_m_s2 = 1.0;
constexpr double kAboutTo_m_s = 0.01;  // what a machine that stands is about to do
constexpr double kClear_m = 2.0;       // from the machine's side to each wall: a wide road
constexpr double kHeadroom_m = 1.0;

Eigen::Vector3d vector_of(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

// A road that looks the same wherever the machine is on it, in base.
class FlatRoad {
 public:
  FlatRoad(const api::Config& config, const pose_wall_planar_stop_settings& settings)
      : left_base_(vector_of(resolve_frames(config).left_base)),
        floor_m_(settings.floor_z_m),
        roof_m_(settings.floor_z_m + settings.top_m + kHeadroom_m) {
    for (std::uint32_t k = 0; k < settings.corners; ++k) {
      const double across_m = left_base_.x() * settings.corner_m[k][0] + left_base_.y() * settings.corner_m[k][1];
      half_m_ = std::max(half_m_, std::fabs(across_m) + kClear_m);
    }
  }

  // Infinite along the road.
  double range_m(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    double range_m = std::numeric_limits<double>::infinity();
    const double rise = direction.z(), aside = left_base_.dot(direction), across_m = left_base_.dot(from);
    if (rise < 0.0) range_m = (floor_m_ - from.z()) / rise;
    if (rise > 0.0) range_m = (roof_m_ - from.z()) / rise;
    if (aside != 0.0) range_m = std::min(range_m, (std::copysign(half_m_, aside) - across_m) / aside);
    return range_m;
  }

 private:
  Eigen::Vector3d left_base_;
  double floor_m_, roof_m_, half_m_ = 0.0;
};

using BodyBox = std::array<double, 6>;

std::vector<BodyBox> body_boxes_of(const api::Config& config) {
  std::vector<BodyBox> boxes;
  for (const char* key : {"body_box_1", "body_box_2", "body_box_3", "body_box_4"}) {
    BodyBox box{};
    require_ok(pose_wall_config_get_box(config.get(), key, box.data()), key);
    if (box[1] > box[0]) boxes.push_back(box);
  }
  return boxes;
}

// Whether the machine's body stands in the way of a ray.
bool shades(const BodyBox& box, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  double enters_m = 0.0, leaves_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t edge = 2 * static_cast<std::size_t>(axis);
    const double low_m = box[edge] - from[axis], high_m = box[edge + 1] - from[axis];
    if (direction[axis] == 0.0) {
      if (low_m > 0.0 || high_m < 0.0) return false;
      continue;
    }
    const double at_low_m = low_m / direction[axis], at_high_m = high_m / direction[axis];
    enters_m = std::max(enters_m, std::min(at_low_m, at_high_m));
    leaves_m = std::min(leaves_m, std::max(at_low_m, at_high_m));
  }
  return enters_m < leaves_m;
}

// Frames of a machine on a flat road. They differ by noise alone, or by a pattern's beams.
class FlatFrames {
 public:
  FlatFrames(const api::Config& config, const pose_wall_planar_stop_settings& settings, const sim::Sensor& sensor)
      : sensor_(sensor), mount_(config), road_(config, settings), bodies_(body_boxes_of(config)), random_(1) {
    constexpr double kColumnsMost = 600.0;  // some more than the stop has steps of azimuth
    sensor_.columns = std::min(sensor_.columns, kColumnsMost);
  }

  const std::vector<float>& next() {
    if (beams_.empty() || sensor_.rings == 0.0) cast();
    points_.clear();
    for (std::size_t k = 0; k < beams_.size(); ++k) {
      if (!(ranges_m_[k] <= sensor_.range_ceiling_m)) continue;
      const sim::Vector p = sim::point_of(beams_[k], ranges_m_[k] + sensor_.range_noise_m * random_.gaussian());
      for (int axis = 0; axis < 3; ++axis) points_.push_back(static_cast<float>(p[axis]));
    }
    return points_;
  }

 private:
  void cast() {
    beams_ = sim::beams_of(sensor_, frame_++);
    ranges_m_.clear();
    for (const sim::Beam& beam : beams_) {
      const Eigen::Vector3d from = mount_.to_base(beam.origin), direction = mount_.R_base_lidar() * beam.direction;
      const bool is_shaded =
          std::any_of(bodies_.begin(), bodies_.end(), [&](const BodyBox& box) { return shades(box, from, direction); });
      ranges_m_.push_back(is_shaded ? std::numeric_limits<double>::infinity() : road_.range_m(from, direction));
    }
  }

  sim::Sensor sensor_;
  SensorMount mount_;
  FlatRoad road_;
  std::vector<BodyBox> bodies_;
  sim::Random random_;
  std::uint32_t frame_ = 0;
  std::vector<sim::Beam> beams_;
  std::vector<double> ranges_m_;
  std::vector<float> points_;
};

pose_wall_planar_stop_motion straight_on(double speed_m_s, double next_m_s, bool is_known) {
  pose_wall_planar_stop_motion motion{};
  motion.struct_size = sizeof motion;
  if (!is_known) return motion;
  motion.given = POSE_WALL_PLANAR_STOP_MEASURED | POSE_WALL_PLANAR_STOP_COMMANDED;
  motion.speed_m_s = speed_m_s;
  motion.command_speed_m_s = std::max(next_m_s, kAboutTo_m_s);
  return motion;
}

}  // namespace

StopProspect stop_prospect(const api::Config& config, const pose_wall_planar_stop_settings& settings,
                           const sim::Sensor& sensor, bool is_motion_known) {
  PartBlock block(POSE_WALL_PLANAR_STOP_BLOCK_MOST);
  pose_wall_planar_stop* stop = nullptr;
  require_ok(pose_wall_planar_stop_open(config.get(), &settings, block.data(), block.bytes(), &stop), "the stop");
  require_ok(pose_wall_planar_stop_confirm(stop), "the stop");
  FlatFrames frames(config, settings, sensor);
  pose_wall_planar_stop_result result{};
  result.struct_size = sizeof result;
  const double on_m = settings.confirm_m + 1.5;  // further than what is confirmed, by the slack of the first metres
  const double starts_s = settings.settle_s + settings.restart_s + 2.0;
  StopProspect prospect;
  double speed_m_s = 0.0, way_m = 0.0, stood_s = 0.0;
  constexpr int kFramesMost = 600;  // a machine that creeps on
  for (int frame = 1; frame <= kFramesMost && way_m < on_m && stood_s < starts_s; ++frame) {
    const std::vector<float>& points = frames.next();
    const auto now_ns = static_cast<std::int64_t>(frame * kProspectFrame_s * 1e9);
    pose_wall_cloud cloud{};
    require_ok(pose_wall_cloud_xyz32(&cloud, points.data(), static_cast<std::uint32_t>(points.size() / 3),
                                     3 * sizeof(float), now_ns),
               "the cloud");
    const double next_m_s =
        std::min(result.allowed_speed_m_s, speed_m_s + kProspectAcceleration_m_s2 * kProspectFrame_s);
    const pose_wall_planar_stop_motion motion = straight_on(speed_m_s, next_m_s, is_motion_known);
    require_ok(pose_wall_planar_stop_process(stop, &cloud, &motion, now_ns, &result), "the stop");
    speed_m_s = std::min(next_m_s, result.allowed_speed_m_s);
    way_m += speed_m_s * kProspectFrame_s;
    stood_s = speed_m_s > 0.0 ? 0.0 : stood_s + kProspectFrame_s;
    if (result.state == POSE_WALL_PLANAR_STOP_STOP) prospect.reasons = result.reasons;
  }
  prospect.drives = way_m >= on_m;
  return prospect;
}

namespace {

constexpr double kLower_m = 0.3;
constexpr double kBehindEdge_m = 0.25;  // a sensor's foot

// What may be changed about a mount.
struct MountChange {
  bool knows_motion = false, is_at_edge = false, is_lower = false;
  int tilt_deg = 0;

  int count() const {
    return (knows_motion ? 1 : 0) + (is_at_edge ? 1 : 0) + (is_lower ? 1 : 0) + (tilt_deg > 0 ? 1 : 0);
  }
};

// The simplest first.
std::vector<MountChange> mount_changes(bool is_motion_known) {
  std::vector<MountChange> changes;
  for (const bool knows_motion : {false, true}) {
    if (knows_motion && is_motion_known) continue;
    for (const bool is_at_edge : {false, true}) {
      for (const bool is_lower : {false, true}) {
        for (const int tilt_deg : {0, 10, 15, 20, 30}) {
          changes.push_back({knows_motion, is_at_edge, is_lower, tilt_deg});
        }
      }
    }
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const MountChange& a, const MountChange& b) { return a.count() < b.count(); });
  changes.erase(changes.begin());  // none
  return changes;
}

api::Config changed(const api::Config& config, const pose_wall_planar_stop_settings& settings,
                    const MountChange& change) {
  api::Config other = config;
  const ResolvedFrames frames = resolve_frames(config);
  const SensorMount mount(config);
  const Eigen::Vector3d forward = vector_of(frames.forward_base);
  Eigen::Vector3d at_m = mount.position_base_m();
  if (change.is_lower) at_m.z() -= kLower_m;
  if (change.is_at_edge) {
    double edge_m = 0.0;
    for (std::uint32_t k = 0; k < settings.corners; ++k) {
      edge_m = std::max(edge_m, forward.x() * settings.corner_m[k][0] + forward.y() * settings.corner_m[k][1]);
    }
    at_m += (edge_m - kBehindEdge_m - forward.dot(at_m)) * forward;
  }
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(change.tilt_deg * kRadPerDeg, vector_of(frames.left_base)) * mount.R_base_lidar();
  const std::pair<const char*, double> keys[] = {{"extrinsic_x", at_m.x()},
                                                 {"extrinsic_y", at_m.y()},
                                                 {"extrinsic_z", at_m.z()},
                                                 {"extrinsic_roll", std::atan2(R(2, 1), R(2, 2))},
                                                 {"extrinsic_pitch", std::asin(std::clamp(-R(2, 0), -1.0, 1.0))},
                                                 {"extrinsic_yaw", std::atan2(R(1, 0), R(0, 0))}};
  for (const auto& [key, value] : keys) require_ok(other.set(key, value), key);
  return other;
}

std::string words_of(const MountChange& change) {
  std::string words;
  const auto add = [&words](const std::string& more) { words += (words.empty() ? "" : tr(", ")) + more; };
  if (change.tilt_deg > 0) add(say("the sensor {} deg further nose down", change.tilt_deg));
  if (change.is_at_edge) add(say("the sensor {:.2f} m behind the machine's front edge", kBehindEdge_m));
  if (change.is_lower) add(say("the sensor {:.1f} m lower", kLower_m));
  if (change.knows_motion) add(tr("a motion that is known instead of assumed (planar_motion)"));
  return words;
}

// As the simulator names the sensor that a config names; nullptr for one whose beams are in no table.
const sim::SensorModel* model_of(const std::string& sensor) {
  std::string word = sensor;
  std::replace(word.begin(), word.end(), '_', '-');
  const sim::SensorModel* const velodyne = sim::find_sensor("velodyne-" + word);
  return velodyne != nullptr ? velodyne : sim::find_sensor(word);
}

std::string what_helps(const LoadedConfig& loaded, const pose_wall_planar_stop_settings& settings,
                       const sim::Sensor& sensor, bool is_motion_known) {
  for (const MountChange& change : mount_changes(is_motion_known)) {
    const api::Config other = changed(loaded.config, settings, change);
    if (stop_prospect(other, settings, sensor, is_motion_known || change.knows_motion).drives) {
      return say("There it would drive with: {}.", words_of(change));
    }
  }
  return tr(
      "No tilt of up to 30 deg, no place at the front edge and no lower place mends that: take a sensor that sees "
      "further down, or a second one with a stop of its own.");
}

}  // namespace

std::string stop_prospect_text(const LoadedConfig& loaded) {
  const sim::SensorModel* const model = model_of(loaded.live.sensor);
  if (!loaded.planar.is_on() || model == nullptr) return "";
  const pose_wall_planar_stop_settings settings = stop_settings_of(loaded.planar);
  const bool is_motion_known = loaded.planar.motion != "assumed";
  const StopProspect prospect = stop_prospect(loaded.config, settings, model->sensor, is_motion_known);
  if (prospect.drives) return "";
  return say(
      "warning: with this mount the obstacle stop never permits driving, not even on a flat, straight and empty road: "
      "{}. {}",
      stop_reasons_text(prospect.reasons), what_helps(loaded, settings, model->sensor, is_motion_known));
}

}  // namespace pose_wall::tools
