// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Logs of CARMEN, as the public records of 2D laser scanners have them, one message a line:
//
//   FLASER n r1 ... rn x y theta odom_x odom_y odom_theta ipc_timestamp host logger_timestamp
//   ROBOTLASER1 type start_angle field_of_view angle_step range_max accuracy remission_mode n r1 ... rn
//               m i1 ... im x y theta odom_x odom_y odom_theta tv rv forward side axis ipc_timestamp host
//               logger_timestamp
//   PARAM name value ... ipc_timestamp host logger_timestamp
//
// m and rad. Time is the ipc_timestamp: files of relations name scans by it, and logger_timestamp begins at 0. Scans
// stand in the order of the log. In some logs the ipc_timestamp jumps back by up to a second although the order is
// right (the Intel lab: 631 of 13631 scans; its odometry is 508 m long in the order of the log and 661 m in that of the
// stamps).
//
// FLASER does not say its angles. Beams turn to the left about straight ahead, over the field of view that a line
// before tells (PARAM laser_front_laser_fov, laser_front_laser_resolution; degrees). Where none does, 180, 181, 360 and
// 361 beams are half a turn, and other numbers are refused. The first beam looks to the right, at minus half the field.
// An odd number includes the last beam at its other end, an even number stops one step before.
//
// FLASER does not say its range either. Scanners write a far number where nothing came back (50.00, 51.05
// to 51.12, 81.83 to 81.91): where the ranges of the log pile up at their far end, the lower edge of the pile is the
// range, and it is never more than 81.83 m (the SICK scanner's codes of faults lie above). "Nothing came back" may be
// glass, a dark or slanted wall or open space, so it is unknown, not free.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

struct CarmenScan {
  std::size_t line = 0;
  std::string stamp;           // ipc_timestamp as the log writes it
  std::int64_t stamp_ns = 0;   // the same, all its digits
  std::int64_t rising_ns = 0;  // the same, but at least 1 us after the scan before it
  double logger_s = 0.0;       // since the log began
  std::vector<float> range_m;  // as they stand in the log
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;
  double range_max_m = 0.0;          // at this and beyond: nothing came back
  pose_wall_planar_pose odometry{};  // of the robot
  pose_wall_planar_pose laser{};     // where the log puts the scanner; in a corrected log not by odometry
};

struct CarmenParam {
  std::string value;
  std::size_t line = 0;
};

// Lines without a scan, by reason; each line of the log counts once, here or as a scan.
enum class CarmenSkip {
  kEmpty,
  kComment,
  kParam,         // kept as a parameter
  kOtherMessage,  // of another kind: ODOM, SYNC, RLASER, TRUEPOS ...
  kBadLine,       // cut off, a word that is no number, or a count that does not fit
  kNotFinite,     // a pose or a time that is no finite number
  kCount
};
// "comment", "bad_line": a word for tables.
const char* carmen_skip_name(CarmenSkip reason);

struct CarmenSkipped {
  std::size_t lines = 0;
  std::size_t first_line = 0;  // 0: none
  std::string first_fault;     // in words, for kBadLine
};

struct CarmenLog {
  std::vector<CarmenScan> scans;
  std::size_t stamps_back = 0;  // scans whose stamp is not after the one of the scan before it
  std::map<std::string, CarmenParam, std::less<>> params;
  CarmenSkipped skipped[static_cast<std::size_t>(CarmenSkip::kCount)];
  std::map<std::string, std::size_t, std::less<>> other_messages;  // ODOM: 7375
  std::size_t lines = 0;

  const CarmenSkipped& skip(CarmenSkip reason) const { return skipped[static_cast<std::size_t>(reason)]; }
};

// The message names the file, and the line where there is one.
class CarmenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Plain or gzip. Throws CarmenError for a file that cannot be read, is damaged as gzip, or holds no scan.
CarmenLog read_carmen_log(const std::filesystem::path& file);
// The same of text in memory.
CarmenLog parse_carmen_log(std::string_view text);

// The scan as pose_wall_planar takes it. The scanner's place in base is not in the log for sure: the caller's.
// `range_m` receives the ranges: NaN (unknown) for what is not above 0 or not below the scan's range_max_m. The result
// points into it.
pose_wall_planar_scan planar_scan_of(const CarmenScan& scan, const pose_wall_planar_pose& sensor, double sigma_m,
                                     std::vector<float>* range_m);

// The scanner's place in base: where every scan has the scanner at one place of the robot, that place. Else (the poses
// are the robot's, or corrected) x from the log's parameter robot_frontlaser_offset, or 0.
pose_wall_planar_pose carmen_sensor_pose(const CarmenLog& log);

// Seconds with all digits as nanoseconds: "976052857.436207". False for what is no such number.
bool parse_stamp_ns(std::string_view word, std::int64_t* stamp_ns);

}  // namespace pose_wall::tools
