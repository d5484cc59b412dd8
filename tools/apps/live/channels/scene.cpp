// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/channels/scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "apps/live/ros_messages/ros_messages.hpp"
#include "io/config_file/key_table.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "io/json/json_words.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools::live {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Colour {
  double r, g, b, a;
};
// States as the page has them: green, amber, grey; red where a machine must stand.
constexpr Colour kGreen{0.16, 0.62, 0.36, 0.35}, kAmber{0.90, 0.62, 0.10, 0.35}, kGrey{0.55, 0.55, 0.55, 0.35},
    kRed{0.85, 0.16, 0.16, 0.5};
constexpr double kSteps = 1e4;          // of a length, in a metre: what nobody sees is not written
constexpr double kTextHeight_m = 0.25;  // read across a road of 5 m on a small screen
constexpr double kLine_m = 0.03;        // thickness of a line
constexpr double kThing_m = 0.3;        // across a thing's ball
// Longer than a machine at 1 m/s takes to stand by the default brakes (1.2 s), with a footprint each half metre.
constexpr double kWay_s = 2.0, kWayStep_s = 0.5;
constexpr double kStands_m_s = 0.02;  // below it there is no way to be drawn

double rounded(double value) {
  return std::round(value * kSteps) / kSteps + 0.0;  // -0 is 0
}

Json xyz(const Vector3d& v) {
  return {{"x", rounded(v.x())}, {"y", rounded(v.y())}, {"z", rounded(v.z())}};
}

Json quaternion(const Matrix3d& turn) {
  const Eigen::Quaterniond q(turn);
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

Json pose_json(const Isometry3d& place) {
  return {{"position", xyz(place.translation())}, {"orientation", quaternion(place.linear())}};
}

Json at(const Vector3d& where) {
  return pose_json(Isometry3d(Eigen::Translation3d(where)));
}

Json colour_json(const Colour& colour) {
  return {{"r", colour.r}, {"g", colour.g}, {"b", colour.b}, {"a", colour.a}};
}

// Before 1970 viewers know no time.
Json stamp_json(std::int64_t ns) {
  const std::int64_t from_1970_ns = std::max<std::int64_t>(ns, 0);
  return {{"sec", from_1970_ns / 1'000'000'000}, {"nsec", from_1970_ns % 1'000'000'000}};
}

Json transform(std::int64_t stamp_ns, const std::string& parent, const std::string& child, const Isometry3d& place) {
  return {{"timestamp", stamp_json(stamp_ns)},
          {"parent_frame_id", parent},
          {"child_frame_id", child},
          {"translation", xyz(place.translation())},
          {"rotation", quaternion(place.linear())}};
}

// A newer entity of an id takes the place of the older one: what is empty is gone. Results, and the stop's answers,
// come ten times a second also in silence. A viewer's clock goes on by messages alone: of a daemon that has gone the
// last picture stays, whatever the lifetime.
constexpr int kLifetime_s = 1;

Json entity(std::int64_t stamp_ns, const std::string& frame, const char* id) {
  Json made = {{"timestamp", stamp_json(stamp_ns)},
               {"frame_id", frame},
               {"id", id},
               {"lifetime", {{"sec", kLifetime_s}, {"nsec", 0}}},
               {"frame_locked", true}};
  for (const char* part :
       {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"}) {
    made[part] = Json::array();
  }
  return made;
}

std::string scene_json(const Json& entities) {
  return json_text({{"deletions", Json::array()}, {"entities", entities}});
}

void add_quad(Json* to, const std::array<Vector3d, 4>& corners, const Colour& colour) {
  Json points = Json::array();
  for (const Vector3d& corner : corners) points.push_back(xyz(corner));
  (*to)["triangles"].push_back({{"pose", at(Vector3d::Zero())},
                                {"points", points},
                                {"color", colour_json(colour)},
                                {"colors", Json::array()},
                                {"indices", {0, 1, 2, 0, 2, 3}}});
}

// type: 1 closes the points, 2 takes them by twos. colours: one for all, or one for each point.
void add_lines(Json* to, const std::vector<Vector3d>& points, int type, const std::vector<Colour>& colours) {
  Json list = Json::array(), each = Json::array();
  for (const Vector3d& point : points) list.push_back(xyz(point));
  for (Colour colour : colours) {
    colour.a = 1.0;
    each.push_back(colour_json(colour));
  }
  (*to)["lines"].push_back({{"type", type},
                            {"pose", at(Vector3d::Zero())},
                            {"thickness", kLine_m},
                            {"scale_invariant", false},
                            {"points", list},
                            {"color", each.front()},
                            {"colors", each.size() > 1 ? each : Json::array()},
                            {"indices", Json::array()}});
}

void add_text(Json* to, const Vector3d& where, const std::string& text, Colour colour) {
  colour.a = 1.0;
  (*to)["texts"].push_back({{"pose", at(where)},
                            {"billboard", true},
                            {"font_size", kTextHeight_m},
                            {"scale_invariant", false},
                            {"color", colour_json(colour)},
                            {"text", text}});
}

// A reason of one line lies across the whole picture.
std::string in_lines(std::string text) {
  constexpr std::size_t kLetters = 40;  // 5 m by kTextHeight_m, as a road is wide
  std::size_t began = 0;
  for (std::size_t at = text.find(' '); at != std::string::npos; at = text.find(' ', at + 1)) {
    const std::size_t next = std::min(text.find(' ', at + 1), text.size());
    if (next - began <= kLetters) continue;
    text[at] = '\n';
    began = at + 1;
  }
  return text;
}

Colour colour_of(std::uint32_t state) {
  return state == POSE_WALL_VALID ? kGreen : state == POSE_WALL_DEGRADED ? kAmber : kGrey;
}

Vector3d vector(const Vector3& v) {
  return {v[0], v[1], v[2]};
}
Vector3d vector(const double v[3]) {
  return {v[0], v[1], v[2]};
}

// Of a result: what its planes and values are seen from.
struct Sight {
  explicit Sight(const LiveResult& result) : r(result.publication.result), stamp_ns(result.header_stamp_ns) {
    api::Config config;
    *config.get() = result.config;
    frames = resolve_frames(config);
    for (int i = 0; i < 9; ++i) R_level_base(i / 3, i % 3) = r.R_level_base[i];
    is_level = RosMessages::has_level(result);
    const Vector3d forward = R_level_base * vector(frames.forward_base);
    ahead_level = Vector3d(forward.x(), forward.y(), 0.0).normalized();
  }

  std::uint32_t state(std::uint32_t quantity) const { return r.quantity[quantity].state; }
  Vector3d in_base(const Vector3d& in_level) const { return R_level_base.transpose() * in_level; }

  // Of the road in base; nothing where this frame has not measured all that it takes.
  std::optional<Isometry3d> road_in_base() const {
    if (!is_level || state(POSE_WALL_YAW) < POSE_WALL_DEGRADED) return std::nullopt;
    if (r.left.found == 0 || r.right.found == 0) return std::nullopt;
    const Vector3d up = Vector3d::UnitZ();
    const Vector3d along = Eigen::AngleAxisd(r.quantity[POSE_WALL_YAW].value, up) * ahead_level;
    Matrix3d R_level_road;
    R_level_road << along, up.cross(along), up;
    const double left_of_middle_m = 0.5 * (r.right.d_m - r.left.d_m);
    Isometry3d road = Isometry3d::Identity();
    road.linear() = R_level_base.transpose() * R_level_road;
    road.translation() = road.linear() * Vector3d(0.0, -left_of_middle_m, -r.floor.d_m);
    return road;
  }

  const pose_wall_result& r;
  std::int64_t stamp_ns;
  ResolvedFrames frames;
  Matrix3d R_level_base;
  Vector3d ahead_level;
  bool is_level;
};

void add_floor(Json* to, const Sight& sight) {
  const pose_wall_plane& floor = sight.r.floor;
  const Vector3d up = vector(floor.normal), side = up.cross(vector(sight.frames.forward_base)).normalized();
  const Vector3d ahead = side.cross(up), foot = -floor.d_m * up;
  const double reach_m = floor.extent_max_m;
  const Colour colour = colour_of(std::min(sight.state(POSE_WALL_ROLL), sight.state(POSE_WALL_PITCH)));
  const std::optional<Isometry3d> road = sight.road_in_base();
  if (!road) {
    return add_quad(to,
                    {foot + reach_m * (ahead + side), foot + reach_m * (ahead - side), foot - reach_m * (ahead + side),
                     foot - reach_m * (ahead - side)},
                    colour);
  }
  const double half_m = 0.5 * (sight.r.left.d_m + sight.r.right.d_m);
  const auto corner = [&](double along_m, double left_m) -> Vector3d { return *road * Vector3d(along_m, left_m, 0.0); };
  add_quad(to, {corner(reach_m, half_m), corner(reach_m, -half_m), corner(-reach_m, -half_m), corner(-reach_m, half_m)},
           colour);
}

// Heights are above the floor.
void add_wall(Json* to, const Sight& sight, const pose_wall_plane& wall, const Colour& colour, double bottom_m,
              double top_m) {
  const Vector3d normal = vector(wall.normal);
  const Vector3d flat(normal.x(), normal.y(), 0.0), across = flat.normalized();
  Vector3d along = Vector3d::UnitZ().cross(across);
  if (along.dot(sight.ahead_level) < 0.0) along = -along;
  const auto corner = [&](double along_m, double height_m) {
    const double up_m = height_m - sight.r.floor.d_m;
    const double across_m = -(wall.d_m + normal.z() * up_m) / flat.norm();
    return sight.in_base(along_m * along + across_m * across + up_m * Vector3d::UnitZ());
  };
  add_quad(to,
           {corner(wall.extent_min_m, bottom_m), corner(wall.extent_max_m, bottom_m), corner(wall.extent_max_m, top_m),
            corner(wall.extent_min_m, top_m)},
           colour);
}

void add_distances(Json* to, const Sight& sight) {
  std::vector<Vector3d> ends;
  std::vector<Colour> colours;
  for (std::size_t i = 0; i < sight.frames.sampling_points_base_m.size(); ++i) {
    const auto quantity = static_cast<std::uint32_t>(POSE_WALL_D_LF + i);
    const pose_wall_plane& wall = i < 2 ? sight.r.left : sight.r.right;
    const pose_wall_value& value = sight.r.quantity[quantity];
    if (wall.found == 0 || value.state < POSE_WALL_DEGRADED) continue;
    const Vector3d from = vector(sight.frames.sampling_points_base_m[i]);
    const Vector3d away(-wall.normal[0], -wall.normal[1], 0.0);
    const Vector3d foot = from + sight.in_base(value.value * away.normalized());
    ends.insert(ends.end(), {from, foot});
    colours.insert(colours.end(), 2, colour_of(value.state));
    add_text(to, 0.5 * (from + foot) + Vector3d(0.0, 0.0, kTextHeight_m),
             fmt::format("{} {:.3f} m", pose_wall_quantity_name(quantity), value.value), colours.back());
  }
  if (!ends.empty()) add_lines(to, ends, 2, colours);
}

// The machine's rectangle after each half second by a steady motion.
void add_way(Json* to, const PlanarSettings& planar, const pose_wall_planar_stop_result& stop, const Colour& colour,
             const Vector3d& ahead) {
  if (!std::isfinite(stop.speed_m_s) || !std::isfinite(stop.turn_rad_s)) return;
  if (std::abs(stop.speed_m_s) < kStands_m_s && std::abs(stop.turn_rad_s) < kStands_m_s) return;
  for (double t_s = kWayStep_s; t_s <= kWay_s; t_s += kWayStep_s) {
    const double turned_rad = stop.turn_rad_s * t_s;
    // The chord of the arc, half of the turn to its side.
    const double arc_m = stop.speed_m_s * t_s, half_rad = 0.5 * turned_rad;
    const double chord_m = std::abs(half_rad) > 1e-6 ? arc_m * std::sin(half_rad) / half_rad : arc_m;
    const Vector3d moved = chord_m * (Eigen::AngleAxisd(half_rad, Vector3d::UnitZ()) * ahead);
    std::vector<Vector3d> corners;
    for (const auto& [x_m, y_m] :
         {std::pair(planar.x_min_m, planar.y_min_m), std::pair(planar.x_max_m, planar.y_min_m),
          std::pair(planar.x_max_m, planar.y_max_m), std::pair(planar.x_min_m, planar.y_max_m)}) {
      corners.emplace_back(moved + Eigen::AngleAxisd(turned_rad, Vector3d::UnitZ()) *
                                       Vector3d(x_m, y_m, planar.stop.floor_z_m));
    }
    add_lines(to, corners, 1, {colour});
  }
}

}  // namespace

SceneWriter::SceneWriter(const LoadedConfig& loaded)
    : base_frame_(without_slash(config_text(*loaded.config.get(), "base_frame"))),
      lidar_frame_(without_slash(config_text(*loaded.config.get(), "lidar_frame"))),
      map_frame_(without_slash(loaded.planar.map_frame)),
      planar_(loaded.planar),
      wall_bottom_m_(loaded.config.number("wall_z_min")),
      wall_top_m_(loaded.config.number("wall_z_max")),
      ahead_base_(vector(resolve_frames(loaded.config).forward_base)),
      line_(stop_settings_of(loaded.planar), config_text(*loaded.config.get(), "forward_axis")) {}

std::string SceneWriter::pose(const LiveResult& result) const {
  const Sight sight(result);
  const std::optional<Isometry3d> road = sight.road_in_base();
  if (!road) return "";
  return json_text({{"timestamp", stamp_json(sight.stamp_ns)},
                    {"frame_id", base_frame_ + "_road"},
                    {"pose", pose_json(road->inverse())}});
}

std::string SceneWriter::transforms(const LiveResult& result) const {
  const Sight sight(result);
  const Vector3& turned_deg = sight.frames.extrinsic_roll_pitch_yaw_deg;
  Isometry3d lidar = Isometry3d::Identity();
  lidar.linear() = (Eigen::AngleAxisd(turned_deg[2] * kRadPerDeg, Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(turned_deg[1] * kRadPerDeg, Vector3d::UnitY()) *
                    Eigen::AngleAxisd(turned_deg[0] * kRadPerDeg, Vector3d::UnitX()))
                       .toRotationMatrix();
  lidar.translation() = vector(sight.frames.extrinsic_position_m);
  const std::string lidar_frame = result.frame_id.empty() ? lidar_frame_ : without_slash(result.frame_id);
  Json list = Json::array();
  // Of a cloud that is in base already there is none to itself.
  if (lidar_frame != base_frame_) list.push_back(transform(sight.stamp_ns, base_frame_, lidar_frame, lidar));
  if (sight.is_level) {
    Isometry3d level = Isometry3d::Identity();
    level.linear() = sight.R_level_base.transpose();
    list.push_back(transform(sight.stamp_ns, base_frame_, base_frame_ + "_level", level));
  }
  if (const std::optional<Isometry3d> road = sight.road_in_base()) {
    list.push_back(transform(sight.stamp_ns, base_frame_, base_frame_ + "_road", *road));
  }
  return json_text({{"transforms", list}});
}

std::string SceneWriter::scene(const LiveResult& result) const {
  const Sight sight(result);
  Json road = entity(sight.stamp_ns, base_frame_, "road");
  if (sight.is_level) {
    add_floor(&road, sight);
    const auto add = [&](const pose_wall_plane& wall, std::uint32_t front) {
      const Colour colour = colour_of(std::min(sight.state(front), sight.state(front + 1)));
      if (wall.found != 0) add_wall(&road, sight, wall, colour, wall_bottom_m_, wall_top_m_);
    };
    add(sight.r.left, POSE_WALL_D_LF);
    add(sight.r.right, POSE_WALL_D_RF);
    add_distances(&road, sight);
  }
  return scene_json(Json::array({road}));
}

std::string SceneWriter::scene(const StopNews& news) const {
  const pose_wall_planar_stop_result& stop = news.result;
  const Colour colour = stop.state == POSE_WALL_PLANAR_STOP_GO     ? kGreen
                        : stop.state == POSE_WALL_PLANAR_STOP_SLOW ? kAmber
                                                                   : kRed;
  Json machine = entity(news.header_stamp_ns, base_frame_, "machine");
  const double floor_m = planar_.stop.floor_z_m;
  const Vector3d middle(0.5 * (planar_.x_min_m + planar_.x_max_m), 0.5 * (planar_.y_min_m + planar_.y_max_m),
                        floor_m + 0.5 * planar_.height_m);
  const Vector3d size(planar_.x_max_m - planar_.x_min_m, planar_.y_max_m - planar_.y_min_m, planar_.height_m);
  machine["cubes"].push_back({{"pose", at(middle)}, {"size", xyz(size)}, {"color", colour_json(colour)}});
  if (stop.frames > 0 && std::isfinite(stop.nearest_m[0]) && std::isfinite(stop.nearest_m[1])) {
    const Vector3d thing(stop.nearest_m[0], stop.nearest_m[1], floor_m + 0.5 * kThing_m);
    Colour solid = colour;
    solid.a = 1.0;
    machine["spheres"].push_back(
        {{"pose", at(thing)}, {"size", xyz(Vector3d::Constant(kThing_m))}, {"color", colour_json(solid)}});
  }
  add_way(&machine, planar_, stop, colour, ahead_base_);
  const std::string why = line_.text(Language::kEnglish, stop, news.cause_for_s());
  const std::string text =
      std::string(pose_wall_planar_stop_state_name(stop.state)) + (why.empty() ? "" : ":\n" + in_lines(why));
  add_text(&machine, middle + Vector3d(0.0, 0.0, 0.5 * planar_.height_m + kTextHeight_m), text, colour);
  return scene_json(Json::array({machine}));
}

std::string SceneWriter::transforms(const RoadwayNews& news) const {
  if (!news.pose) return "";
  Isometry3d base = Isometry3d::Identity();
  base.linear() = Eigen::AngleAxisd(news.pose->yaw_rad, Vector3d::UnitZ()).toRotationMatrix();
  // The map lies on the floor.
  base.translation() = Vector3d(news.pose->x_m, news.pose->y_m, -planar_.stop.floor_z_m);
  return json_text({{"transforms", Json::array({transform(news.header_stamp_ns, map_frame_, base_frame_, base)})}});
}

}  // namespace pose_wall::tools::live
