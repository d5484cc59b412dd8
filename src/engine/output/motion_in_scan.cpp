// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/output/motion_in_scan.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/math/finite.hpp"
#include "engine/output/standing_surfaces.hpp"

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
// Of a sensor that sees all around, whose points have half of the scan behind them in the mean.
constexpr double kShareAllAround = 0.5 + kLater;
// A way across acts for the whole scan where the wall is seen last.
constexpr double kOfWay = 1.0 / kShareAllAround;

double acts_for_s(std::uint32_t quantity, const ScanTime& scan, bool by_both_walls) {
  const bool by_one = quantity == POSE_WALL_YAW && !by_both_walls;
  return scan.mean_s + (by_one ? kLaterByOneWall : kLater) * scan.whole_s;
}

// Errors that do not depend on each other add up as variances do.
double together(double a, double b) {
  return std::sqrt(a * a + b * b);
}

double added_to(double random, double level) {
  return together(random, level) - random;
}

bool is_distance(std::uint32_t quantity) {
  return quantity >= POSE_WALL_D_LF;
}

// The distance to the same wall at the machine's other end.
std::uint32_t other_end_of(std::uint32_t quantity) {
  return POSE_WALL_D_LF + ((quantity - POSE_WALL_D_LF) ^ 1U);
}

// What is left of the motion in two scans shows in the change between their values, and no noise comes on top. Let R be
// that part of the change which the motion that was taken out of the first scan does not explain. Let r and r' be what
// is left in this scan and the last one, as changes of the value in the time P between them, and c the share of P for
// which they act. From stamp to stamp the machine moved by the motion in the first scan. So
//   R = c r + (1 - c) r' + noise now - noise then,
// and the error is c r + noise now.
// - A steady motion has the error c R, (1 - c) of this noise and c of the last one.
// - A motion that began with this scan has the error R and the last noise.
// - One that turns round hides from a single change, so the larger of the last two counts. That holds for periods of
//   four scans and more. A faster one is no motion of a frame but a bend within it.
// - If the motion that was taken out changes by M while the machine moves steadily, c (1 - c) M is hidden.
// Without an odometry a standing machine would pay for the noise of its changes. There motion counts that is steady,
// and what began beyond all noise.
class ByChange {
 public:
  ByChange(const Measurements& measured, const ScanInTime& time, const Settings& settings, const OwnChanges& last)
      : measured_(measured), settings_(settings), scan_s_(time.scan.whole_s), since_s_(time.step.s), last_(last) {
    // A change over less than a scan shows a part of the motion. If more than half a scan is between both, another
    // motion may be, too. By the derivation above.
    constexpr double kLeast = 0.9, kMost = 1.5;  // scans
    later_ = scan_s_ > 0.0 && since_s_ >= kLeast * scan_s_;
    one_later_ = later_ && time.step.is_told && since_s_ <= kMost * scan_s_;
  }

  bool is_known(std::uint32_t quantity) const { return one_later_ && shows(quantity); }
  // Whether the last scan's value stands beside this one's.
  bool compares(std::uint32_t quantity) const { return later_ && shows(quantity); }
  double change_of(std::uint32_t quantity) const {
    return measured_.quantity[quantity].raw - last_.raw[quantity] - since_s_ * last_.taken_out[quantity];
  }

  // Two changes are needed, since motion that begins or turns round hides from a single one. Of a distance, those of
  // both ends tell a turn from a way.
  bool tells(std::uint32_t quantity) const {
    return has_two(quantity) && (!is_distance(quantity) || has_two(other_end_of(quantity)));
  }
  // What was changed beyond all noise was moved, whoever says otherwise.
  double least(std::uint32_t quantity) const {
    if (!is_known(quantity)) return 0.0;
    const double random = measured_.quantity[quantity].protection[POSE_WALL_PART_RANDOM];
    const double noise = together(random, last_.random[quantity]);
    return larger(0.0, std::fabs(change_of(quantity)) - noise);
  }

  // Where nothing of the motion was taken out: of a steady one, or of one that began beyond all noise.
  double without_taking_out(std::uint32_t quantity, double seconds, double lever_m) const {
    return larger(steady(quantity, seconds, lever_m), began(quantity, seconds));
  }

  // seconds: for which an unknown motion acts; taken_out: the value's rate by what was taken out of this scan.
  double added(std::uint32_t quantity, double seconds, double taken_out, double lever_m) const {
    const Measurement& m = measured_.quantity[quantity];
    const double acts_s = (is_distance(quantity) ? kBentByTurn : 1.0) * seconds;
    // The last value may have been of another surface, as far off as its level says.
    const double wider_before = larger(0.0, last_.level[quantity] - m.protection.sum());
    const double noise = larger(m.protection[POSE_WALL_PART_RANDOM], last_.random[quantity]);
    return wider_before + left_of_noise(acts_s) * noise +
           hidden_s(acts_s) * std::fabs(taken_out - last_.taken_out[quantity]) +
           larger(reach(quantity, lever_m, seconds, 1.0, [this](std::uint32_t q) { return change_of(q); }),
                  reach(quantity, lever_m, seconds, 1.0, [this](std::uint32_t q) { return last_.change[q]; }));
  }

 private:
  bool shows(std::uint32_t quantity) const {
    const Measurement& m = measured_.quantity[quantity];
    return m.measured && !m.stale && last_.level[quantity] < kNobodyKnows;
  }
  bool has_two(std::uint32_t quantity) const { return is_known(quantity) && is_finite(last_.change[quantity]); }

  // At the mean rate between the frames, however far apart.
  double steady(std::uint32_t quantity, double seconds, double lever_m) const {
    if (!compares(quantity)) return 0.0;
    const double random = measured_.quantity[quantity].protection[POSE_WALL_PART_RANDOM];
    const bool by_ends = !is_distance(quantity) || shows(other_end_of(quantity));
    const double moved = by_ends
                             ? reach(quantity, lever_m, seconds, 0.0, [this](std::uint32_t q) { return change_of(q); })
                             : kBentByTurn * std::fabs(change_of(quantity));
    const double c = seconds / since_s_;
    // This noise is in the change, too.
    const double noise = together((1.0 - c) * random, c * last_.random[quantity]);
    return larger(0.0, moved + noise - random);
  }

  // c r = R - (1 - c) r', where r' is the change before: of a motion that was slower before that, r' is more, and the
  // error less. It is not more than R, unless the motion turned round. Below its noise this shows nothing that a steady
  // motion of R does not have, too.
  double began(std::uint32_t quantity, double seconds) const {
    if (!is_known(quantity)) return 0.0;
    const double random = measured_.quantity[quantity].protection[POSE_WALL_PART_RANDOM], R = change_of(quantity);
    const double before = has_two(quantity) ? larger(0.0, 1.0 - seconds / since_s_) : 0.0;
    const double left = std::fabs(R - (before > 0.0 ? before * last_.change[quantity] : 0.0));
    const double moved = left < std::fabs(R) ? left : std::fabs(R);
    const double noise_before = together(1.0 + before, before) * last_.random[quantity];
    const bool is_beyond_noise = moved > together(random, noise_before);
    return is_beyond_noise ? larger(0.0, moved + noise_before - random) : 0.0;
  }

  // How large an error may be that a change shows; least: 1 of a motion that may begin with this scan, 0 of a steady
  // one.
  template <typename ChangeOf>
  double reach(std::uint32_t quantity, double lever_m, double seconds, double least, const ChangeOf& change) const {
    const auto times = [&](double acts_s) { return larger(least, acts_s / since_s_); };
    if (!is_distance(quantity)) return times(seconds) * std::fabs(change(quantity));
    const bool front = quantity == POSE_WALL_D_LF || quantity == POSE_WALL_D_RF;
    const double at_m = front ? settings_.s_front : settings_.s_back;
    const double other_m = front ? settings_.s_back : settings_.s_front;
    const double turned_rad = (change(quantity) - change(other_end_of(quantity))) / (at_m - other_m);
    const double way_m = change(quantity) - at_m * turned_rad;
    return times(kOfWay * seconds) * std::fabs(way_m) + times(kBentByTurn * seconds) * lever_m * std::fabs(turned_rad);
  }

  // Of noise in both values, beside that of one.
  double left_of_noise(double acts_s) const {
    const double c = acts_s / since_s_;
    return larger(0.0, together(1.0 - c, c) - 1.0);
  }

  // The largest c (1 - c) P for all shares up to what acts_s gives.
  double hidden_s(double acts_s) const {
    const double c = acts_s / since_s_, most = c < 0.5 ? c * (1.0 - c) : 0.25;
    return since_s_ * larger(most, c * (c - 1.0));
  }

  const Measurements& measured_;
  const Settings& settings_;
  double scan_s_, since_s_;
  const OwnChanges& last_;
  bool later_ = false, one_later_ = false;
};

OwnChanges kept_of(const Measurements& measured, const ByChange& by_change, const OwnChanges& surfaces,
                   const double (&taken_out)[POSE_WALL_QUANTITIES]) {
  OwnChanges kept = surfaces;
  kept.forget();
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const Measurement& m = measured.quantity[q];
    if (!m.measured || m.stale) continue;
    kept.raw[q] = m.raw;
    kept.level[q] = m.protection.sum();
    kept.random[q] = m.protection[POSE_WALL_PART_RANDOM];
    kept.taken_out[q] = taken_out[q];
    if (by_change.is_known(q)) kept.change[q] = by_change.change_of(q);
  }
  return kept;
}

}  // namespace

ScanInTime scan_in_time(const ScanTime& scan, const ScanStep& step, const Settings& settings) {
  if (scan.whole_s > 0.0) return {scan, step, true};
  const bool is_shorter = step.s > 0.0 && step.s < settings.scan_max;
  const double whole_s = is_shorter ? step.s : settings.scan_max;
  return {{whole_s, 0.5 * whole_s}, step, false};
}

void OwnChanges::forget() {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    level[q] = kNobodyKnows;
    random[q] = 0.0;
    change[q] = not_a_number();
  }
}

MotionInScan::MotionInScan(const pose_wall_odometry* odometry, const Settings& s, const Axes& axes)
    : settings_(s), axes_(axes), is_told_(odometry != nullptr) {
  if (!is_told_) return;
  const pose_wall_odometry& o = *odometry;
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
}

// How fast a value changes by the told motion.
double MotionInScan::rate_of(std::uint32_t quantity, const OwnChanges& surfaces) const {
  constexpr double kMoment_s = 1e-3;  // a turn is a line over it
  const Eigen::Vector3d half_turn = 0.5 * kMoment_s * turn_base_rad_s_;
  const Place then = {kMoment_s * velocity_base_m_s_,
                      Eigen::Quaterniond(1.0, half_turn.x(), half_turn.y(), half_turn.z()).normalized().matrix()};
  const Eigen::Vector3d& wall = surfaces.wall_base[side_of(quantity)];
  return change_between(quantity, Place{}, then, surfaces.up_base, wall, settings_, axes_) / kMoment_s;
}

double MotionInScan::lever_m(std::uint32_t quantity) const {
  return std::sqrt(sample_base(quantity, settings_, axes_).squaredNorm());
}

// How fast a value moves by the told motion, as that shows in a scan.
double MotionInScan::moves(std::uint32_t quantity, const OwnChanges& surfaces) const {
  if (!is_distance(quantity)) return std::fabs(rate_of(quantity, surfaces));
  const Eigen::Vector3d& n = surfaces.wall_base[side_of(quantity)];
  return kOfWay * std::fabs(n.dot(velocity_base_m_s_)) +
         kBentByTurn * lever_m(quantity) * std::fabs(surfaces.up_base.dot(turn_base_rad_s_));
}

// What the odometry's levels add in so many seconds.
double MotionInScan::by_odometry(std::uint32_t quantity, double seconds, double random,
                                 const OwnChanges& surfaces) const {
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
  const Eigen::Vector3d& n = surfaces.wall_base[side_of(quantity)];
  for (int k = 0; k < 3; ++k) {
    squares += square(kOfWay * reach(std::fabs(n.dot(direction_base_[k])), rate_level_[k]));
  }
  squares += square(kBentByTurn * reach(lever_m(quantity), turn[2]));
  return added_to(random, seconds * std::sqrt(squares));
}

bool MotionInScan::improves(const OwnChanges& last) const {
  if (!is_told_) return false;
  constexpr double kChangeByNoise = 0.33;  // mean of the larger of two changes by noise alone, of 4.89 deviations
  constexpr double kHardly = 0.1;          // of its noise moves a value hardly: it adds 0.5 % to its level
  double out = 0.0, in = 0.0;              // worst shares of an alert limit, with the motion out of the scan and in it
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const double random = last.random[q], moved = last.scan_s * moves(q, last), alert = alert_limit(q, settings_);
    if (moved <= kHardly * random) continue;
    out = larger(out, by_odometry(q, kShareAllAround * last.scan_s, random, last) / alert);
    in = larger(in, (moved + kChangeByNoise * random) / alert);
  }
  return !(out > in);
}

void MotionInScan::widen(bool taken_out, const ScanInTime& time, const Levelling& levelling,
                         const JudgedWall (&walls)[2], OwnChanges* last, Measurements* measured) const {
  last->up_base = levelling.R_level_base.transpose().col(2);
  for (int side = 0; side < 2; ++side) {
    if (walls[side].fit.refused || !walls[side].fit.found) continue;
    last->wall_base[side] = levelling.R_level_base.transpose() * walls[side].fit.plane.n;
  }
  const ByChange by_change(*measured, time, settings_, *last);
  double added[POSE_WALL_QUANTITIES] = {}, taken_out_rate[POSE_WALL_QUANTITIES] = {};
  const auto random_of = [&](std::uint32_t q) { return measured->quantity[q].protection[POSE_WALL_PART_RANDOM]; };
  const auto left_by_odometry = [&](std::uint32_t q, double seconds) {
    const double left_in = taken_out ? 0.0 : seconds * moves(q, *last);
    const double by_rates = by_odometry(q, seconds, random_of(q), *last) + left_in;
    const double by_values =
        by_change.tells(q) ? by_change.added(q, seconds, taken_out_rate[q], lever_m(q)) : kNobodyKnows;
    return by_values < by_rates ? by_values : by_rates;
  };
  const auto shown = [&](std::uint32_t q, double seconds) {
    const double by_values = by_change.without_taking_out(q, seconds, lever_m(q));
    if (!is_told_) return by_values;
    const double moved = seconds * moves(q, *last);
    // Where no value stands beside this one the odometry is the only witness: what it leaves open counts.
    if (!by_change.compares(q)) return moved + by_odometry(q, seconds, random_of(q), *last);
    return larger(by_values, moved - by_odometry(q, seconds, 0.0, *last));
  };
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    Measurement& m = measured->quantity[q];
    if (!m.measured || !(time.scan.whole_s > 0.0)) continue;
    if (taken_out) taken_out_rate[q] = rate_of(q, *last);
    const double seconds = acts_for_s(q, time.scan, measured->has_yaw_difference);
    if (is_told_ && time.has_times) {
      added[q] = larger(left_by_odometry(q, seconds), by_change.least(q));
    } else {
      m.shown_motion = shown(q, seconds);
    }
  }
  *last = kept_of(*measured, by_change, *last, taken_out_rate);
  last->scan_s = time.scan.whole_s;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    measured->quantity[q].protection[POSE_WALL_PART_AGE] += added[q];
  }
}

}  // namespace pose_wall
