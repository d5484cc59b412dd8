// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "output/motion_in_scan.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/math/finite.hpp"
#include "base/math/larger.hpp"

namespace pose_wall {
namespace {

constexpr double kNobodyKnows = std::numeric_limits<double>::infinity();  // a level without bound

// For how long an unknown steady motion acts on a value: the mean time of the points, and more where a sensor that
// spins comes to the surface late. Measured on scans of 10 degrees a second that nobody freed of it, with the seam at
// eight azimuths: of the turn in a scan, roll and pitch had 0.34 to 0.60, yaw 0.35 to 0.62 and by one wall 0.21 to
// 0.71.
constexpr double kLater = 0.125, kLaterByOneWall = 0.25;  // measured, see above
// A distance was off by up to 1.26 of turn and lever, since the wall was bent as well as turned: twice as much.
constexpr double kBentByTurn = 2.0;  // measured, see above
// A way across acts for the whole scan where the wall is seen last. Geometry: 1 / 0.625.
constexpr double kOfWay = 1.6;

double acts_for_s(std::uint32_t quantity, const ScanTime& scan, bool by_both_walls) {
  const bool by_one = quantity == POSE_WALL_YAW && !by_both_walls;
  return scan.mean_s + (by_one ? kLaterByOneWall : kLater) * scan.whole_s;
}

// Errors that do not depend on each other add up as variances do.
double added_to(double random, double level) {
  return std::sqrt(random * random + level * level) - random;
}

bool is_distance(std::uint32_t quantity) {
  return quantity >= POSE_WALL_D_LF;
}

// Whether what was taken out of a scan hardly touched a value: a tenth of its noise adds 0.5 % to it.
bool is_untouched(double taken_out, double random) {
  return taken_out <= 0.1 * random;
}

// What is left of the motion in two scans shows in the change between their values, and no noise comes on top. Let R be
// the change beyond what the first scan's motion that was taken out explains, r and r' what is left in this scan and
// the last one, as changes of the value in a scan's time, and c the share of the scan for which they act. The machine
// moved from one stamp to the next by the motion in the first scan, so
//   R = c r + (1 - c) r' + noise now - noise then.
// The error c r + noise now is then R - (1 - c) r' + noise then. A motion that began with this scan gives all of R,
// and a steady one less. One that alternates hides from a single change, so the larger of the last two counts. What is
// taken out may change by M from scan to scan and r' - r with it, which hides (1 - c) M. With c above 1, as distances
// may have it, 0.3 of the noise is left.
class ByChange {
 public:
  ByChange(const Measurements& measured, double since_last_s, const OwnChanges& last)
      : measured_(measured), since_last_s_(since_last_s), last_(last) {}

  bool is_known(std::uint32_t quantity) const {
    const Measurement& m = measured_.quantity[quantity];
    return m.measured && !m.stale && last_.level[quantity] < kNobodyKnows;
  }
  double change_of(std::uint32_t quantity) const {
    return measured_.quantity[quantity].raw - last_.raw[quantity] - since_last_s_ * last_.taken_out[quantity];
  }

  // Two changes are needed, since motion that begins or turns round hides from a single one.
  bool tells(std::uint32_t quantity) const { return is_known(quantity) && is_finite(last_.change[quantity]); }
  // What was changed beyond all noise was moved, whoever says otherwise.
  double least(std::uint32_t quantity) const {
    if (!is_known(quantity)) return 0.0;
    const double random = measured_.quantity[quantity].protection[POSE_WALL_PART_RANDOM];
    const double noise = std::sqrt(random * random + last_.random[quantity] * last_.random[quantity]);
    return larger(0.0, std::fabs(change_of(quantity)) - noise);
  }

  // taken_out: how fast the value changes by the motion that was taken out of this scan.
  double added(std::uint32_t quantity, double c, double taken_out) const {
    constexpr double kNoiseOfDistance = 0.3;  // derived, see above
    const Measurement& m = measured_.quantity[quantity];
    // The last value may have been of another surface, as far off as its level says.
    const double wider_before = larger(0.0, last_.level[quantity] - m.protection.sum());
    const double hidden = std::fabs(1.0 - c) * since_last_s_ * std::fabs(taken_out - last_.taken_out[quantity]);
    if (!is_distance(quantity)) return wider_before + hidden + larger(1.0, c) * larger_change(quantity);
    // Front and back of a wall tell a turn from a way.
    const std::uint32_t other = POSE_WALL_D_LF + ((quantity - POSE_WALL_D_LF) ^ 1U);
    const double largest = larger_change(quantity);
    const double of_other = is_known(other) ? change_of(other) : -change_of(quantity);
    const double turn = 0.5 * std::fabs(change_of(quantity) - of_other);
    const double noise = larger(m.protection[POSE_WALL_PART_RANDOM], last_.random[quantity]);
    return wider_before + hidden + largest + larger(0.0, kBentByTurn * c - 1.0) * turn + kNoiseOfDistance * noise;
  }

 private:
  double larger_change(std::uint32_t quantity) const {
    return larger(std::fabs(change_of(quantity)), std::fabs(last_.change[quantity]));
  }

  const Measurements& measured_;
  double since_last_s_;
  const OwnChanges& last_;
};

}  // namespace

void OwnChanges::forget() {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    level[q] = kNobodyKnows;
    change[q] = not_a_number();
  }
}

MotionInScan::MotionInScan(const pose_wall_odometry& o, const Settings& s, const Axes& axes) : settings_(s) {
  const Eigen::Matrix3d R_base_run =
      Eigen::Quaterniond(o.quaternion[3], o.quaternion[0], o.quaternion[1], o.quaternion[2])
          .toRotationMatrix()
          .transpose();
  const Eigen::Vector3d along(o.along[0], o.along[1], o.along[2]), across(o.across[0], o.across[1], o.across[2]);
  direction_base_[0] = R_base_run * along;
  direction_base_[1] = R_base_run * across;
  direction_base_[2] = R_base_run * along.cross(across);
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) rate_level_[k] = o.rate_level[k];
  velocity_base_m_s_ = {o.velocity_m_s[0], o.velocity_m_s[1], o.velocity_m_s[2]};
  turn_base_rad_s_ = {o.turn_rate_rad_s[0], o.turn_rate_rad_s[1], o.turn_rate_rad_s[2]};
  for (std::uint32_t q = POSE_WALL_D_LF; q <= POSE_WALL_D_RB; ++q) {
    const bool front = q == POSE_WALL_D_LF || q == POSE_WALL_D_RF;
    const double ahead_m = front ? s.s_front : s.s_back;
    const double aside_m = side_of(q) == 0 ? s.lateral_offset_left : s.lateral_offset_right;
    sample_base_m_[q] = ahead_m * axes.forward_base + aside_m * axes.left_base;
  }
}

// How fast a value changes by the told motion, as it shows in a scan.
double MotionInScan::told(std::uint32_t quantity, const OwnChanges& walls) const {
  if (quantity == POSE_WALL_ROLL) return std::fabs(turn_base_rad_s_.x());
  if (quantity == POSE_WALL_PITCH) return std::fabs(turn_base_rad_s_.y());
  if (quantity == POSE_WALL_YAW) return std::fabs(turn_base_rad_s_.z());
  const Eigen::Vector3d& n = walls.wall_base[side_of(quantity)];
  return kOfWay * std::fabs(n.dot(velocity_base_m_s_)) +
         kBentByTurn * sample_base_m_[quantity].norm() * std::fabs(turn_base_rad_s_.z());
}

// How fast a value changes by the told motion, with its sign. What stands still moves against the machine.
double MotionInScan::rate_of(std::uint32_t quantity, const Levelling& levelling, const OwnChanges& walls) const {
  const Eigen::Vector3d up = levelling.R_level_base.transpose().col(2);
  if (quantity == POSE_WALL_YAW) return -up.dot(turn_base_rad_s_);
  if (quantity < POSE_WALL_YAW) {  // of roll_pitch_of_up()
    const Eigen::Vector3d moves = up.cross(turn_base_rad_s_);
    const double level2 = up.y() * up.y() + up.z() * up.z();
    return quantity == POSE_WALL_ROLL ? (up.z() * moves.y() - up.y() * moves.z()) / level2
                                      : -moves.x() / std::sqrt(level2);
  }
  const Eigen::Vector3d& n = walls.wall_base[side_of(quantity)];
  return n.dot(velocity_base_m_s_ + turn_base_rad_s_.cross(sample_base_m_[quantity]));
}

// What the odometry's levels add in so many seconds.
double MotionInScan::by_odometry(std::uint32_t quantity, double seconds, double random, const OwnChanges& walls) const {
  const auto square = [](double x) { return x > 0.0 ? x * x : 0.0; };
  const auto reach = [](double response, double level) { return response > 0.0 ? response * level : 0.0; };
  const double* const turn = rate_level_ + 3;
  if (quantity == POSE_WALL_YAW) return added_to(random, seconds * turn[2]);
  double squares = 0.0;
  if (quantity < POSE_WALL_YAW) {
    const int axis = quantity == POSE_WALL_ROLL ? 0 : 1;
    for (int k = 0; k < 3; ++k) squares += square(reach(std::fabs(direction_base_[k][axis]), turn[k]));
    return added_to(random, seconds * std::sqrt(squares));
  }
  const Eigen::Vector3d& n = walls.wall_base[side_of(quantity)];
  const bool seen = n.squaredNorm() > 0.0;
  const auto towards = [&](int k) { return seen ? std::fabs(n.dot(direction_base_[k])) : 1.0; };
  for (int k = 0; k < 3; ++k) squares += square(kOfWay * reach(towards(k), rate_level_[k]));
  squares += square(kBentByTurn * reach(sample_base_m_[quantity].norm(), turn[2]));
  return added_to(random, seconds * std::sqrt(squares));
}

bool MotionInScan::improves(double scan_s, const OwnChanges& last) const {
  constexpr double kC = 0.625;             // of a sensor that sees all around, see acts_for_s()
  constexpr double kChangeByNoise = 0.33;  // mean of the larger of two changes by noise alone, of 4.89 deviations
  double out = 0.0, in = 0.0;              // worst shares of an alert limit, with the motion out of the scan and in it
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (!(last.level[q] < kNobodyKnows)) continue;
    const double random = last.random[q], moves = scan_s * told(q, last), alert = alert_limit(q, settings_);
    if (is_untouched(moves, random)) continue;
    out = larger(out, by_odometry(q, kC * scan_s, random, last) / alert);
    in = larger(in, (moves + kChangeByNoise * random) / alert);
  }
  return !(out > in);
}

// What the motion adds to the level of a value that was measured, c: the share of the scan for which it acts.
double MotionInScan::added_to_level(std::uint32_t quantity, double taken_out_rate, bool taken_out,
                                    const ScanInTime& time, const Measurements& measured,
                                    const OwnChanges& last) const {
  // A change over less than a scan shows a part of the motion, and one over several scans no motion within one.
  constexpr double kLeast = 0.9, kMost = 2.5;  // scans
  const double scan_s = time.scan.whole_s, since_s = time.since_last_s;
  const double random = measured.quantity[quantity].protection[POSE_WALL_PART_RANDOM];
  const double seconds = acts_for_s(quantity, time.scan, measured.has_yaw_difference), c = seconds / scan_s;
  const double left_in = taken_out ? 0.0 : seconds * told(quantity, last);
  const double by_rates = by_odometry(quantity, seconds, random, last) + left_in;
  if (since_s < kLeast * scan_s || since_s > kMost * scan_s) return by_rates;
  const ByChange by_change(measured, since_s, last);
  const double by_values = by_change.tells(quantity) ? by_change.added(quantity, c, taken_out_rate) : kNobodyKnows;
  return larger(by_values < by_rates ? by_values : by_rates, by_change.least(quantity));
}

void MotionInScan::keep(const double (&taken_out)[POSE_WALL_QUANTITIES], const Measurements& measured,
                        double since_last_s, OwnChanges* last) {
  const ByChange by_change(measured, since_last_s, *last);
  double change[POSE_WALL_QUANTITIES];
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    change[q] = by_change.is_known(q) ? by_change.change_of(q) : not_a_number();
  }
  last->forget();
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const Measurement& m = measured.quantity[q];
    if (!m.measured || m.stale) continue;
    last->raw[q] = m.raw;
    last->level[q] = m.protection.sum();
    last->random[q] = m.protection[POSE_WALL_PART_RANDOM];
    last->taken_out[q] = taken_out[q];
    last->change[q] = change[q];
  }
}

void MotionInScan::widen(bool taken_out, const ScanInTime& time, const Levelling& levelling,
                         const JudgedWall (&walls)[2], OwnChanges* last, Measurements* measured) const {
  for (int side = 0; side < 2; ++side) {
    if (walls[side].fit.refused || !walls[side].fit.found) continue;
    last->wall_base[side] = levelling.R_level_base.transpose() * walls[side].fit.plane.n;
  }
  double added[POSE_WALL_QUANTITIES] = {}, rate[POSE_WALL_QUANTITIES] = {};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (taken_out) rate[q] = rate_of(q, levelling, *last);
    if (!measured->quantity[q].measured || !(time.scan.whole_s > 0.0)) continue;
    added[q] = added_to_level(q, rate[q], taken_out, time, *measured, *last);
  }
  keep(rate, *measured, time.since_last_s, last);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    measured->quantity[q].protection[POSE_WALL_PART_AGE] += added[q];
  }
}

}  // namespace pose_wall
