// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/planar_files/carmen_log.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "io/frames/frame.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/planar_files/gzip_text.hpp"

namespace pose_wall::tools {
namespace {

// The SICK scanner's codes for "no range" in its mode of 1 cm: 8183 to 8191.
constexpr double kSickCodes_m = 81.83;
constexpr double kSickCodesEnd_m = 82.0;
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
class LineWords {
 public:
  explicit LineWords(std::string_view line) : left_(line) {}

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

void read_stamps(LineWords* words, CarmenScan* scan) {
  const std::string_view stamp = words->word("ipc_timestamp");
  if (!parse_stamp_ns(stamp, &scan->stamp_ns)) {
    throw LineFault{CarmenSkip::kBadLine, say("{} is no number: '{}'", "ipc_timestamp", std::string(stamp))};
  }
  scan->stamp = std::string(stamp);
  words->word("host");
  scan->logger_s = words->finite("logger_timestamp");
  words->end();
}

// What the log's parameters say of the front scanner, in degrees; 0: nothing.
struct FrontView {
  double field_deg = 0.0, step_deg = 0.0;
};

// The drivers' counts over half a turn: a beam for each degree or half a degree, with and without the last.
bool is_half_turn_count(std::size_t beams) {
  return beams == 180 || beams == 181 || beams == 360 || beams == 361;
}

// Throws LineFault where the log does not tell.
double front_field_deg(std::size_t beams, double steps, const FrontView& view) {
  constexpr double kSameShare = 0.02;  // parameters are written with few digits
  const double told_deg = view.field_deg > 0.0 ? view.field_deg : view.step_deg * steps;
  if (told_deg == 0.0) {
    if (is_half_turn_count(beams)) return 180.0;
    throw LineFault{CarmenSkip::kBadLine,
                    say("{} beams: 180, 181, 360 and 361 are taken for 180°, of others the log must tell the field of "
                        "view, in a line before: PARAM laser_front_laser_fov DEGREES",
                        beams)};
  }
  const double step_deg = told_deg / steps;
  // Logs of half a turn tell the scanner's own resolution, of which programs took every second beam.
  const bool is_half_turn = told_deg == 180.0 && is_half_turn_count(beams);
  const bool is_same =
      view.step_deg == 0.0 || is_half_turn || std::abs(step_deg - view.step_deg) <= kSameShare * view.step_deg;
  if (!is_same || told_deg > 360.0) {
    throw LineFault{CarmenSkip::kBadLine,
                    say("{} beams do not fit the log's parameters: a field of view of {:g}° and a resolution of {:g}°",
                        beams, view.field_deg, view.step_deg)};
  }
  return told_deg;
}

CarmenScan front_laser(LineWords words, const FrontView& view) {
  CarmenScan scan;
  const std::size_t beams = words.count("num_readings", 2);
  scan.range_m = words.ranges(beams);
  scan.laser = words.pose("x y theta");
  scan.odometry = words.pose("odom_x odom_y odom_theta");
  read_stamps(&words, &scan);
  const auto steps = static_cast<double>(beams % 2 == 1 ? beams - 1 : beams);
  const double field_rad = front_field_deg(beams, steps, view) * kRadPerDeg;
  scan.angle_min_rad = -0.5 * field_rad;
  scan.angle_step_rad = field_rad / steps;
  return scan;
}

CarmenScan robot_laser(LineWords words) {
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

// Where ranges of a log without a told range pile up at their far end.
class RangeCounts {
 public:
  RangeCounts() : beams_(kCells) {}

  void add(const std::vector<float>& ranges_m) {
    for (const float range_m : ranges_m) {
      const double cell = std::floor(static_cast<double>(range_m) / kCell_m + 0.5);
      if (cell > 0.0 && cell < static_cast<double>(kCells)) ++beams_[static_cast<std::size_t>(cell)];
    }
  }

  // The lower edge; 0 where there is no pile.
  double pile_m() const {
    std::size_t top = kCells - 1;
    while (top > 0 && beams_[top] == 0) --top;
    const std::size_t pile = top - std::min(top, kPileCells);
    const std::size_t below = pile - std::min(pile, kBelowCells);
    const std::size_t in_pile = sum(pile, top + 1);
    if (in_pile < kPileBeams || in_pile < sum(below, pile)) return 0.0;
    const std::size_t highest = *std::max_element(at(pile), at(top + 1));
    std::size_t edge = pile;
    while (beams_[edge] == 0 || beams_[edge] < highest / kPileToItsEdge) ++edge;
    return static_cast<double>(edge) * kCell_m - 0.5 * kCell_m;
  }

 private:
  static constexpr double kCell_m = 0.01;  // the scanners' resolution
  static constexpr std::size_t kCells = 20'000;
  // A pile is 0.25 m wide and as dense as ten times the 2.5 m below it, and no coincidence of a few beams.
  static constexpr std::size_t kPileCells = 25;
  static constexpr std::size_t kBelowCells = 250;
  static constexpr std::size_t kPileBeams = 10;
  static constexpr std::size_t kPileToItsEdge = 1000;

  std::vector<std::size_t>::const_iterator at(std::size_t cell) const {
    return beams_.begin() + static_cast<std::ptrdiff_t>(cell);
  }
  std::size_t sum(std::size_t from, std::size_t to) const { return std::accumulate(at(from), at(to), std::size_t{0}); }

  std::vector<std::size_t> beams_;
};

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
    if (kind == "FLASER") return keep(front_laser(LineWords(line), front_view()), number);
    if (kind == "ROBOTLASER1") return keep(robot_laser(LineWords(line)), number);
    if (kind == "PARAM") return param(line, number);
    ++log_.other_messages[std::string(kind)];
    skip(CarmenSkip::kOtherMessage, number);
  }

  // CARMEN names the parameter of its module laser; a table of one module leaves that out.
  FrontView front_view() const {
    return {degrees_of({"laser_front_laser_fov", "front_laser_fov"}),
            degrees_of({"laser_front_laser_resolution", "front_laser_resolution"})};
  }

  double degrees_of(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      const auto found = log_.params.find(name);
      if (found == log_.params.end()) continue;
      const std::optional<double> degrees = parse_number<double>(found->second.value);
      if (degrees && std::isfinite(*degrees) && *degrees > 0.0) return *degrees;
    }
    return 0.0;
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

  void set_range_max() {
    RangeCounts counts;
    for (const CarmenScan& scan : log_.scans) {
      if (!(scan.range_max_m > 0.0)) counts.add(scan.range_m);
    }
    const double pile_m = counts.pile_m();
    const double range_max_m =
        pile_m > 0.0 && reached_on_the_way(pile_m) ? std::min(pile_m, kSickCodes_m) : kSickCodes_m;
    for (CarmenScan& scan : log_.scans) {
      if (!(scan.range_max_m > 0.0)) scan.range_max_m = range_max_m;
    }
  }

  // Of a wall the ranges change as the machine drives; where nothing comes back they do not.
  bool reached_on_the_way(double pile_m) const {
    constexpr double kDriven_m = 2.0;  // several times the width of a pile
    const CarmenScan* first = nullptr;
    for (const CarmenScan& scan : log_.scans) {
      const auto reaches = [pile_m](float range_m) { return static_cast<double>(range_m) >= pile_m; };
      if (scan.range_max_m > 0.0 || std::none_of(scan.range_m.begin(), scan.range_m.end(), reaches)) continue;
      if (first == nullptr) first = &scan;
      const double dx_m = scan.odometry.x_m - first->odometry.x_m;
      const double dy_m = scan.odometry.y_m - first->odometry.y_m;
      if (dx_m * dx_m + dy_m * dy_m >= kDriven_m * kDriven_m) return true;
    }
    return false;
  }

  CarmenLog log_;
};

// Of the scanner in the frame of the robot.
pose_wall_planar_pose place_in_scan(const CarmenScan& scan) {
  const double dx_m = scan.laser.x_m - scan.odometry.x_m;
  const double dy_m = scan.laser.y_m - scan.odometry.y_m;
  const double c = std::cos(scan.odometry.yaw_rad);
  const double s = std::sin(scan.odometry.yaw_rad);
  return {c * dx_m + s * dy_m, c * dy_m - s * dx_m,
          std::remainder(scan.laser.yaw_rad - scan.odometry.yaw_rad, 2.0 * kHalfTurn_rad)};
}

std::optional<pose_wall_planar_pose> place_in_all_scans(const CarmenLog& log) {
  // Logs write six digits; the place of a scanner is told in millimetres.
  constexpr double kSame_m = 1e-3;
  constexpr double kSame_rad = 1e-3;
  if (log.scans.empty()) return std::nullopt;
  const pose_wall_planar_pose first = place_in_scan(log.scans.front());
  for (const CarmenScan& scan : log.scans) {
    const pose_wall_planar_pose place = place_in_scan(scan);
    const bool is_same = std::abs(place.x_m - first.x_m) <= kSame_m && std::abs(place.y_m - first.y_m) <= kSame_m &&
                         std::abs(std::remainder(place.yaw_rad - first.yaw_rad, 2.0 * kHalfTurn_rad)) <= kSame_rad;
    if (!is_same) return std::nullopt;
  }
  // Digits that the log's rounding left are no place.
  const auto rounded = [](double value) { return std::round(value * 1e4) * 1e-4 + 0.0; };
  return pose_wall_planar_pose{rounded(first.x_m), rounded(first.y_m), rounded(first.yaw_rad)};
}

}  // namespace

const char* carmen_skip_name(CarmenSkip reason) {
  constexpr const char* kLineKinds[] = {"empty", "comment", "param", "other_message", "bad_line", "not_finite"};
  static_assert(std::size(kLineKinds) == static_cast<std::size_t>(CarmenSkip::kCount));
  return kLineKinds[static_cast<std::size_t>(reason)];
}

bool parse_stamp_ns(std::string_view word, std::int64_t* stamp_ns) {
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  constexpr double kSecondsMax = 9.0e9;  // below what 64 bits of nanoseconds hold
  const std::optional<double> rough_s = parse_number<double>(word);
  if (!rough_s || !(std::abs(*rough_s) < kSecondsMax)) return false;
  if (word.find_first_of("eE") != std::string_view::npos) {  // written with few digits: no more are to be had
    *stamp_ns = static_cast<std::int64_t>(*rough_s * static_cast<double>(kNsPerS));
    return true;
  }
  const std::size_t sign = word.front() == '-' || word.front() == '+' ? 1 : 0;
  const std::size_t point = std::min(word.find('.'), word.size());
  std::int64_t stamp = 0;
  for (std::size_t i = sign; i < point; ++i) {
    if (word[i] < '0' || word[i] > '9') return false;
    stamp = stamp * 10 + (word[i] - '0');
  }
  for (std::size_t i = 1; i <= 9; ++i) stamp = stamp * 10 + (point + i < word.size() ? word[point + i] - '0' : 0);
  *stamp_ns = word.front() == '-' ? -stamp : stamp;
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
  const std::optional<pose_wall_planar_pose> place = place_in_all_scans(log);
  // At 0 the log may have copied one pose into both.
  if (place && (place->x_m != 0.0 || place->y_m != 0.0 || place->yaw_rad != 0.0)) return *place;
  const auto offset = log.params.find("robot_frontlaser_offset");
  if (offset == log.params.end()) return {0.0, 0.0, 0.0};
  const std::optional<double> x_m = parse_number<double>(offset->second.value);
  return {x_m && std::isfinite(*x_m) ? *x_m : 0.0, 0.0, 0.0};
}

}  // namespace pose_wall::tools
