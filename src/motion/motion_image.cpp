// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/motion_image.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

#include "base/math/finite.hpp"
#include "motion/pose.hpp"
#include "part/image_words.hpp"

namespace pose_wall::motion {
namespace {

static_assert(sizeof(pose_wall_motion_image) == POSE_WALL_MOTION_IMAGE_BYTES && POSE_WALL_MOTION_IMAGE_BYTES % 4 == 0,
              "image.def and the compiler disagree");

// Half the diagonal of a cube whose edge is one unit: no direction in space is rounded by more.
constexpr double kRoundedInSpace = 0.8661;

// A value with its level, in units of the image.
struct Entry {
  std::int32_t value = POSE_WALL_IMAGE_NO_VALUE;
  std::int32_t level = POSE_WALL_IMAGE_NO_BOUND;
};

Entry entry_of(double value, double level, double scale) {
  Entry e;
  if (!is_finite(value)) return e;
  e.value = nearest_integer(value * scale);
  const bool bound = is_finite(level) && level >= 0.0;
  if (bound) e.level = integer_above(level * scale + std::fabs(value * scale - static_cast<double>(e.value)));
  return e;
}

std::int32_t level_in_space(double level_m) {
  const bool bound = is_finite(level_m) && level_m >= 0.0;
  return bound ? integer_above(level_m * kMillimetresPerMetre + kRoundedInSpace) : POSE_WALL_IMAGE_NO_BOUND;
}

std::int32_t coordinate(double value_m) {
  return is_finite(value_m) ? nearest_integer(value_m * kMillimetresPerMetre) : POSE_WALL_IMAGE_NO_VALUE;
}

Eigen::Vector3d vector_of(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

// The rest of the image if there is a pose: the turns and their rates.
class Turns {
 public:
  explicit Turns(const pose_wall_motion_result& r) : result_(r) {
    const double* const q = r.quaternion;
    R_ = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
    along_ = vector_of(r.road_axis);
    up_ = Eigen::Vector3d::UnitZ() - along_ * along_.z();
    up_ /= std::sqrt(up_.squaredNorm());
    across_ = up_.cross(along_);
    const double level = std::sqrt(R_(0, 0) * R_(0, 0) + R_(1, 0) * R_(1, 0));
    yaw_rad_ = arc_tangent2(R_(1, 0), R_(0, 0));
    pitch_rad_ = arc_tangent2(-R_(2, 0), level);
    roll_rad_ = arc_tangent2(R_(2, 1), R_(2, 2));
    heading_ = Eigen::Vector3d(R_(0, 0), R_(1, 0), 0.0) / level;
    steep_ = -R_(2, 0) / level;
    steeper_ = 1.0 / level;
  }

  // A small turn d of the pose changes roll by d . heading / cos pitch, pitch by d . (heading turned left), and yaw by
  // d . z + tan pitch d . heading.
  Entry roll() const { return entry_of(roll_rad_, level_about(heading_ * steeper_), kMilliDegreesPerRadian); }
  Entry pitch() const {
    return entry_of(pitch_rad_, level_about({-heading_.y(), heading_.x(), 0.0}), kMilliDegreesPerRadian);
  }
  Entry yaw() const {
    return entry_of(yaw_rad_, level_about(Eigen::Vector3d::UnitZ() + steep_ * heading_), kMilliDegreesPerRadian);
  }

  // Directions of start as base stood at the frame before.
  Entry speed() const {
    return entry_of(from_start(along_).dot(vector_of(result_.step_m)) / result_.step_s,
                    result_.step_protection_level[POSE_WALL_MOTION_ALONG] / result_.step_s, kMillimetresPerMetre);
  }
  Entry turn() const {
    return entry_of(from_start(Eigen::Vector3d::UnitZ()).dot(vector_of(result_.step_rad)) / result_.step_s,
                    result_.step_protection_level[POSE_WALL_MOTION_YAW] / result_.step_s, kMilliDegreesPerRadian);
  }

 private:
  double level_about(const Eigen::Vector3d& axis) const {
    const double* const level = result_.protection_level;
    return std::fabs(axis.dot(along_)) * level[POSE_WALL_MOTION_ROLL] +
           std::fabs(axis.dot(across_)) * level[POSE_WALL_MOTION_PITCH] +
           std::fabs(axis.dot(up_)) * level[POSE_WALL_MOTION_YAW];
  }
  Eigen::Vector3d from_start(const Eigen::Vector3d& direction) const {
    return turn_by(vector_of(result_.step_rad)) * (R_.transpose() * direction);
  }

  const pose_wall_motion_result& result_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d along_, across_, up_;
  double roll_rad_ = 0.0, pitch_rad_ = 0.0, yaw_rad_ = 0.0;
  Eigen::Vector3d heading_;             // of base's x axis, horizontal
  double steep_ = 0.0, steeper_ = 1.0;  // tangent of the pitch, and one over its cosine
};

void fill_pose(const pose_wall_motion_result& r, pose_wall_motion_image* image) {
  image->travel_mm = coordinate(r.along_m);
  image->x_mm = coordinate(r.position_m[0]);
  image->y_mm = coordinate(r.position_m[1]);
  image->z_mm = coordinate(r.position_m[2]);
  // Of both, travel and place.
  image->travel_protection_mm = level_in_space(r.protection_level[POSE_WALL_MOTION_ALONG]);
  image->across_protection_mm = level_in_space(r.protection_level[POSE_WALL_MOTION_ACROSS]);
  image->up_protection_mm = level_in_space(r.protection_level[POSE_WALL_MOTION_UP]);
}

void fill_turns(const Entry& roll, const Entry& pitch, const Entry& yaw, const Entry& speed, const Entry& turn,
                pose_wall_motion_image* image) {
  image->roll_mdeg = roll.value;
  image->pitch_mdeg = pitch.value;
  image->yaw_mdeg = yaw.value;
  image->roll_protection_mdeg = roll.level;
  image->pitch_protection_mdeg = pitch.level;
  image->yaw_protection_mdeg = yaw.level;
  image->speed_mm_s = speed.value;
  image->speed_protection_mm_s = speed.level;
  image->turn_mdeg_s = turn.value;
  image->turn_protection_mdeg_s = turn.level;
}

}  // namespace

void fill_image(const pose_wall_motion_result& r, const pose_wall_image_source& source, pose_wall_motion_image* image) {
  const bool has_pose = r.along_state != POSE_WALL_ALONG_LOST && r.along_state <= POSE_WALL_ALONG_MEASURED;
  image->version = POSE_WALL_MOTION_IMAGE_VERSION;
  image->sequence = static_cast<std::uint32_t>(r.frame_index + 1);
  image->publication = static_cast<std::uint32_t>(source.publication);
  image->run = has_pose ? static_cast<std::uint32_t>(r.run) : 0;
  image->config_crc32 = r.config_crc32;
  put_version_and_stamp(r.stamp_ns, image);
  image->source_id = r.source_id;
  image->latency_ms = latency_ms(source.latency_ns);
  image->thinning = source.thinning;
  image->told_by = source.cause;
  image->along_state = has_pose ? r.along_state : std::uint32_t{POSE_WALL_ALONG_LOST};
  image->reasons = r.reasons;
  fill_pose(r, image);
  if (has_pose) {
    const Turns turns(r);
    fill_turns(turns.roll(), turns.pitch(), turns.yaw(), turns.speed(), turns.turn(), image);
  } else {
    fill_turns({}, {}, {}, {}, {}, image);
  }
  image->crc32c = image_crc(*image, &pose_wall_motion_image::crc32c, kCrcCastagnoli);
}

}  // namespace pose_wall::motion
