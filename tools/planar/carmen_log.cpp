// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/carmen_log.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "angles.hpp"
#include "frames/frame.hpp"
#include "frames/text_cursor.hpp"
#include "language/language.hpp"
#include "planar/gzip_text.hpp"

namespace pose_wall::tools {
namespace {

// The SICK scanner's codes for "no range" in its mode of 1 cm: 8183 to 8191.
constexpr double kSickCodes_m = 81.83;
constexpr double kSickCodesEnd_m = 82.0;
// As many beams with exactly the log's largest range are no coincidence.
constexpr std::size_t kSameRangeBeams = 10;
constexpr double kHalfTurn_rad = 180.0 * kRadPerDeg;
// A microsecond: stamps are written with six digits.
constexpr std::int64_t kLeastStep_ns = 1000;
constexpr std::size_t kBeamsMax = POSE_WALL_PLANAR_BEAMS_MAX;

// What is wrong with a line of a kind that is read.
struct LineFault {
  CarmenSkip reason;
  std::string words;
};

// The words of one line, in turn. Throws LineFault.
class Words {
 public:
  explicit Words(std::string_view line) : left_(line) {}

  std::string_view word(const char* what) {
    const std::string_view word = take_word(left_);
    if (word.empty()) throw LineFault{CarmenSkip::kBadLine, say("it ends before {}", what)};
    return word;
  }

  double number(const char* what) {
    const std::string_view text = word(what);
    const std::optional<double> number = parse_number<double>(text);
    if (!number) throw LineFault{CarmenSkip::kBadLine, say("{} is no number: '{}'", what, std::string(text))};
    return *number;
  }

  double finite(const char* what) {
    const double value = number(what);
    if (!std::isfinite(value)) throw LineFault{CarmenSkip::kNotFinite, say("{} is not finite", what)};
    return value;
  }

  std::size_t count(const char* what, std::size_t least) {
    const std::string_view text = word(what);
    const std::optional<std::size_t> count = parse_number<std::size_t>(text);
    if (!count || *count < least || *count > kBeamsMax) {
      throw LineFault{CarmenSkip::kBadLine,
                      say("{} must be from {} to {}: '{}'", what, least, kBeamsMax, std::string(text))};
    }
    return *count;
  }

  pose_wall_planar_pose pose(const char* what) {
    pose_wall_planar_pose pose{};
    pose.x_m = finite(what);
    pose.y_m = finite(what);
    pose.yaw_rad = finite(what);
    return pose;
  }

  std::vector<float> ranges(std::size_t count) {
    std::vector<float> ranges(count);
    for (float& range : ranges) range = static_cast<float>(number("range_readings"));
    return ranges;
  }

  void end() {
    if (!take_word(left_).empty()) throw LineFault{CarmenSkip::kBadLine, tr("more words than num_readings allows")};
  }

 private:
  std::string_view left_;
};

void read_stamps(Words* words, CarmenScan* scan) {
  const std::string_view stamp = words->word("ipc_timestamp");
  if (!parse_stamp_ns(stamp, &scan->stamp_ns)) {
    throw LineFault{CarmenSkip::kBadLine, say("{} is no number: '{}'", "ipc_timestamp", std::string(stamp))};
  }
  words->word("host");
  scan->logger_s = words->finite("logger_timestamp");
  words->end();
}

CarmenScan front_laser(Words words) {
  CarmenScan scan;
  const std::size_t beams = words.count("num_readings", 2);
  scan.range_m = words.ranges(beams);
  scan.laser = words.pose("x y theta");
  scan.odometry = words.pose("odom_x odom_y odom_theta");
  read_stamps(&words, &scan);
  scan.angle_min_rad = -0.5 * kHalfTurn_rad;
  scan.angle_step_rad = kHalfTurn_rad / static_cast<double>(beams % 2 == 1 ? beams - 1 : beams);
  return scan;
}

CarmenScan robot_laser(Words words) {
  CarmenScan scan;
  words.finite("laser_type");
  scan.angle_min_rad = words.finite("start_angle");
  words.finite("field_of_view");
  scan.angle_step_rad = words.finite("angular_resolution");
  scan.range_max_m = words.finite("maximum_range");
  words.finite("accuracy");
  words.finite("remission_mode");
  const std::size_t beams = words.count("num_readings", 2);
  scan.range_m = words.ranges(beams);
  const std::size_t remissions = words.count("num_remissions", 0);
  for (std::size_t i = 0; i < remissions; ++i) words.number("remission");
  scan.laser = words.pose("x y theta");
  scan.odometry = words.pose("odom_x odom_y odom_theta");
  for (const char* what : {"laser_tv", "laser_rv", "forward_safety_dist", "side_safety_dist", "turn_axis"}) {
    words.number(what);
  }
  read_stamps(&words, &scan);
  const double turn_rad = scan.angle_step_rad * static_cast<double>(beams - 1);
  if (!(scan.angle_step_rad > 0.0 && turn_rad <= 2.0 * kHalfTurn_rad && scan.range_max_m > 0.0)) {
    throw LineFault{CarmenSkip::kBadLine, tr("its angles or its largest range are impossible")};
  }
  if (scan.range_max_m < kSickCodesEnd_m) scan.range_max_m = std::min(scan.range_max_m, kSickCodes_m);
  return scan;
}

class LogParser {
 public:
  void line(std::string_view line, std::size_t number) {
    log_.lines = number;
    try {
      message(line, number);
    } catch (const LineFault& fault) {
      skip(fault.reason, number, fault.words);
    }
  }

  CarmenLog take() {
    set_range_max();
    return std::move(log_);
  }

 private:
  void skip(CarmenSkip reason, std::size_t number, const std::string& fault = "") {
    CarmenSkipped& skipped = log_.skipped[static_cast<std::size_t>(reason)];
    if (skipped.lines++ == 0) {
      skipped.first_line = number;
      skipped.first_fault = fault;
    }
  }

  void message(std::string_view line, std::size_t number) {
    const std::string_view kind = take_word(line);
    if (kind.empty()) return skip(CarmenSkip::kEmpty, number);
    if (kind.front() == '#') return skip(CarmenSkip::kComment, number);
    if (kind == "FLASER") return keep(front_laser(Words(line)), number);
    if (kind == "ROBOTLASER1") return keep(robot_laser(Words(line)), number);
    if (kind == "PARAM") return param(line, number);
    ++log_.other_messages[std::string(kind)];
    skip(CarmenSkip::kOtherMessage, number);
  }

  void param(std::string_view line, std::size_t number) {
    const std::string_view name = take_word(line);
    const std::string_view value = take_word(line);
    if (value.empty()) throw LineFault{CarmenSkip::kBadLine, tr("a parameter without a value")};
    log_.params[std::string(name)] = {std::string(value), number};
    skip(CarmenSkip::kParam, number);
  }

  void keep(CarmenScan scan, std::size_t number) {
    scan.line = number;
    scan.rising_ns = scan.stamp_ns;
    if (!log_.scans.empty()) {
      const CarmenScan& last = log_.scans.back();
      log_.stamps_back += scan.stamp_ns <= last.stamp_ns ? 1U : 0U;
      scan.rising_ns = std::max(scan.stamp_ns, last.rising_ns + kLeastStep_ns);
    }
    log_.scans.push_back(std::move(scan));
  }

  // Of the scans that do not say it.
  void set_range_max() {
    float largest = 0.0F;
    std::size_t beams = 0;
    for (const CarmenScan& scan : log_.scans) {
      if (scan.range_max_m > 0.0) continue;
      for (const float range : scan.range_m) {
        if (range > largest && std::isfinite(range)) {
          largest = range;
          beams = 0;
        }
        beams += range == largest ? 1U : 0U;
      }
    }
    const double told = beams >= kSameRangeBeams ? std::min(static_cast<double>(largest), kSickCodes_m) : kSickCodes_m;
    for (CarmenScan& scan : log_.scans) {
      if (!(scan.range_max_m > 0.0)) scan.range_max_m = told;
    }
  }

  CarmenLog log_;
};

}  // namespace

const char* carmen_skip_name(CarmenSkip reason) {
  constexpr const char* kNames[] = {"empty", "comment", "param", "other_message", "bad_line", "not_finite"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(CarmenSkip::kCount));
  return kNames[static_cast<std::size_t>(reason)];
}

bool parse_stamp_ns(std::string_view word, std::int64_t* stamp_ns) {
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  const std::size_t point = std::min(word.find('.'), word.size());
  const bool is_negative = !word.empty() && word.front() == '-';
  const std::string_view seconds = word.substr(is_negative ? 1 : 0, point - (is_negative ? 1 : 0));
  const std::string_view digits = point < word.size() ? word.substr(point + 1) : std::string_view();
  const auto is_digit = [](char sign) { return sign >= '0' && sign <= '9'; };
  if (seconds.size() + digits.size() == 0 || !std::all_of(seconds.begin(), seconds.end(), is_digit) ||
      !std::all_of(digits.begin(), digits.end(), is_digit)) {
    return false;
  }
  const std::optional<std::int64_t> whole = seconds.empty() ? 0 : parse_number<std::int64_t>(seconds);
  if (!whole || *whole >= std::numeric_limits<std::int64_t>::max() / kNsPerS) return false;
  std::int64_t part = 0;
  for (std::size_t i = 0; i < 9; ++i) part = part * 10 + (i < digits.size() ? digits[i] - '0' : 0);
  *stamp_ns = (*whole * kNsPerS + part) * (is_negative ? -1 : 1);
  return true;
}

CarmenLog parse_carmen_log(std::string_view text) {
  LogParser parser;
  TextCursor cursor(text);
  while (const std::optional<std::string_view> line = cursor.next_line()) parser.line(*line, cursor.line());
  CarmenLog log = parser.take();
  if (!log.scans.empty()) return log;
  for (const CarmenSkip reason : {CarmenSkip::kBadLine, CarmenSkip::kNotFinite}) {
    const CarmenSkipped& bad = log.skip(reason);
    if (bad.lines > 0) {
      throw CarmenError(say("no scan can be read; the first fault is in line {}: {}", bad.first_line, bad.first_fault));
    }
  }
  throw CarmenError(say("no line is a scan: of {} lines none begins with FLASER or ROBOTLASER1", log.lines));
}

CarmenLog read_carmen_log(const std::filesystem::path& file) {
  try {
    return parse_carmen_log(read_text_or_gzip(file));
  } catch (const std::runtime_error& error) {
    throw CarmenError(file.string() + ": " + error.what());
  }
}

pose_wall_planar_scan planar_scan_of(const CarmenScan& scan, const pose_wall_planar_pose& sensor, double sigma_m,
                                     std::vector<float>* range_m) {
  range_m->resize(scan.range_m.size());
  const auto far_m = static_cast<float>(scan.range_max_m);
  std::transform(scan.range_m.begin(), scan.range_m.end(), range_m->begin(), [far_m](float range) {
    return range > 0.0F && range < far_m ? range : std::numeric_limits<float>::quiet_NaN();
  });
  pose_wall_planar_scan result{};
  result.struct_size = sizeof result;
  result.beams = static_cast<std::uint32_t>(range_m->size());
  result.stamp_ns = scan.rising_ns;
  result.sensor = sensor;
  result.angle_min_rad = scan.angle_min_rad;
  result.angle_step_rad = scan.angle_step_rad;
  result.range_min_m = 0.0;
  result.range_max_m = scan.range_max_m;
  result.sigma_m = sigma_m;
  result.range_m = range_m->data();
  return result;
}

pose_wall_planar_pose carmen_sensor_pose(const CarmenLog& log) {
  const auto offset = log.params.find("robot_frontlaser_offset");
  if (offset == log.params.end()) return {0.0, 0.0, 0.0};
  const std::optional<double> x_m = parse_number<double>(offset->second.value);
  return {x_m && std::isfinite(*x_m) ? *x_m : 0.0, 0.0, 0.0};
}

}  // namespace pose_wall::tools
