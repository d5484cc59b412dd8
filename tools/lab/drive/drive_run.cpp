// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/drive_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/language/language.hpp"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kStorySpeed_m_s = 0.5;
constexpr double kHalfFrame_s = 0.05;
constexpr double kPeopleFree_m = 10.0;  // nobody stands nearer to the machine when it sets out
constexpr double kStands_m_s = 1e-4;    // of the tracks: their counters show no more
constexpr std::size_t kWayEach = 10;    // frames between two places of a person's way
constexpr double kWrong_m = 0.5, kWrong_rad = 0.1;

pose_wall_planar_pose pose_of(const sim::PlanePose& pose) {
  return {pose.x_m, pose.y_m, pose.yaw_rad};
}

// Somewhere on a road, with room for the machine, and not near where the map began.
sim::PlanePose draw_start(const sim::Network& network, const TaughtRoads& roads, std::uint64_t seed) {
  constexpr int kTries = 2000;
  constexpr double kRoom_m = 1.5, kFarStart_m = 25.0;
  sim::Random random(seed, 0x57a2);
  for (int k = 0; k < kTries; ++k) {
    const auto mark = static_cast<std::size_t>(random.uniform() * static_cast<double>(roads.marks.size()));
    const pose_wall_planar_pose& at = roads.marks.at(mark).truth;
    const double yaw_rad = at.yaw_rad + (random.chance(0.5) ? M_PI : 0.0) + random.uniform(-0.1, 0.1);
    const sim::PlanePose pose{at.x_m, at.y_m, std::remainder(yaw_rad, 2.0 * M_PI)};
    const sim::Place ahead(std::cos(yaw_rad), std::sin(yaw_rad));
    bool has_room = (pose.place() - sim::Place(roads.marks.front().truth.x_m, roads.marks.front().truth.y_m)).norm() >
                    (k < kTries / 2 ? kFarStart_m : 0.0);
    for (double along_m = -kRear_m; along_m <= kFront_m && has_room; along_m += 0.3) {
      const sim::Place p = pose.place() + along_m * ahead;
      has_room = network.is_open(p) && network.clearance_m(p, 2.0 * kRoom_m) > kRoom_m;
    }
    if (has_room) return pose;
  }
  throw PlanarError(tr("no place of the roads has room for the machine"));
}

MapLocaliser localiser_in(const std::string& trail) {
  KnownMap map;
  map.file = "trail";
  map.trail = std::make_unique<SavedTrail>(map.file, trail);
  pose_wall_planar_localise_settings settings{};
  require_ok(pose_wall_planar_localise_settings_init(&settings), translatable("the settings of localisation"));
  return MapLocaliser(map, settings);
}

// Of the machine's middle.
sim::PlanePose start_of(const sim::Network& network, const TaughtRoads& roads, const DriveRunSettings& settings) {
  if (!settings.start) return draw_start(network, roads, settings.seed);
  const pose_wall_planar_pose middle = combined(*settings.start, {-kTurnAhead_m, 0.0, 0.0});
  return {middle.x_m, middle.y_m, middle.yaw_rad};
}

// The first place of the map, from its beginning, where the machine fits.
pose_wall_planar_pose first_room(const TaughtRoads& roads) {
  const pose_wall_planar_grid grid = roads.map.grid();
  const pose_wall_planar_plan_settings settings = drive_plan_settings(grid, kMargin_m);
  for (const TaughtRoads::Mark& mark : roads.marks) {
    if (!blocking_cell(grid, settings, mark.map)) return mark.map;
  }
  return {};
}

std::vector<pose_wall_planar_pose> goals_of(const pose_wall_planar_pose& goal, bool either_way) {
  if (!either_way) return {goal};
  return {goal, combined(goal, {0.0, 0.0, M_PI})};
}

double off_route_m(const PlannedRoute& route, const pose_wall_planar_pose& at) {
  double best_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < route.poses.size(); ++k) {
    const sim::Place a(route.poses[k].pose.x_m, route.poses[k].pose.y_m);
    const sim::Place b(route.poses[k + 1].pose.x_m, route.poses[k + 1].pose.y_m), way = b - a, p(at.x_m, at.y_m);
    const double share = std::clamp((p - a).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
    best_m = std::min(best_m, (a + share * way - p).norm());
  }
  return std::isfinite(best_m) ? best_m : kNone;
}

}  // namespace

DriveRun::DriveRun(const sim::Network& network, const sim::SensorModel& model, const TaughtRoads& roads,
                   const DriveRunSettings& settings)
    : network_(network),
      model_(model),
      roads_(roads),
      settings_(settings),
      goal_(settings.goal ? *settings.goal : first_room(roads)),
      machine_(drive_tracks(), &network, start_of(network, roads, settings), sim::mix(settings.seed ^ 0xd2u)),
      scanner_(model),
      finder_(localiser_in(roads.trail)),
      guard_(model, /*has_looked=*/true),
      pilot_(roads.map, goals_of(goal_, !settings.goal), kStorySpeed_m_s, settings.patience_s),
      odometry_before_(pose_of(machine_.odometry())) {}

// When the machine has its first route, people stand along it, and what will be lost is drawn.
void DriveRun::begin_trouble() {
  first_route_ = pilot_.route();
  followed_from_m_ = machine_.driven_m();
  std::vector<sim::Place> way;
  for (const pose_wall_planar_path_pose& at : first_route_.poses) {
    const pose_wall_planar_pose truth = roads_.in_truth(at.pose);
    way.emplace_back(truth.x_m, truth.y_m);
  }
  people_ = sim::draw_people(network_, way, settings_.people, kPeopleFree_m, settings_.people_stay,
                             sim::mix(settings_.seed ^ 0x9e0u));
  people_ways_.resize(people_.size());
  for (std::size_t k = 0; k < people_.size(); ++k) {
    const pose_wall_planar_pose in_map = roads_.in_map({people_[k].at().x(), people_[k].at().y(), 0.0});
    people_ways_[k].push_back({in_map.x_m, in_map.y_m});
  }
  if (settings_.loses_walls) loss_ = sim::draw_loss(network_, way, sim::mix(settings_.seed ^ 0x105u));
}

sim::CloudScene DriveRun::scene() {
  sim::CloudScene scene;
  for (const sim::Person& person : people_) scene.pillars.push_back(person.pillar());
  if (!loss_) return scene;
  if (loss_began_s_ < 0.0 && machine_.driven_m() - followed_from_m_ > loss_->from_m) loss_began_s_ = machine_.time_s();
  if (loss_began_s_ < 0.0 || machine_.time_s() - loss_began_s_ > loss_->lasts_s) return scene;
  scene.dark_at = loss_->at;
  scene.dark_radius_m = loss_->radius_m;
  scene.dropout = loss_->share;
  return scene;
}

sim::Footprint DriveRun::footprint() const {
  const pose_wall_planar_pose base = true_base(machine_);
  return {{base.x_m, base.y_m, base.yaw_rad}, kFront_m, kRear_m, kHalfWidth_m};
}

// The footprint meets a person, or one of its edges the rock.
bool DriveRun::touches() const {
  const pose_wall_planar_pose base = true_base(machine_);
  for (const sim::Person& person : people_) {
    if (footprint().distance_m(person.at()) < person.pillar().radius_m) return true;
  }
  constexpr int kParts = 15;  // of an edge
  for (int k = 0; k <= kParts; ++k) {
    const double share = static_cast<double>(k) / kParts;
    const double along_m = -kRear_m + share * (kFront_m + kRear_m), across_m = kHalfWidth_m * (2.0 * share - 1.0);
    for (const double side : {-1.0, 1.0}) {
      const pose_wall_planar_pose flank = combined(base, {along_m, side * kHalfWidth_m, 0.0});
      const pose_wall_planar_pose end = combined(base, {side > 0.0 ? kFront_m : -kRear_m, across_m, 0.0});
      if (!network_.is_open({flank.x_m, flank.y_m}) || !network_.is_open({end.x_m, end.y_m})) return true;
    }
  }
  return false;
}

// Half of the frame's time the old command holds.
void DriveRun::move(const Motion& before, const Motion& after) {
  constexpr double kTouches_m_s = 0.01;  // slower it does not touch, it is touched
  for (const Motion& motion : {before, after}) {
    machine_.step(track_speeds(motion), kHalfFrame_s);
    for (sim::Person& person : people_) person.step(footprint(), kHalfFrame_s);
    const double speed_m_s = std::abs(machine_.tracks().left_mps) + std::abs(machine_.tracks().right_mps);
    const bool is_touching = touches();
    if (is_touching && !was_touching_ && speed_m_s > 2.0 * kTouches_m_s) ++contacts_;
    was_touching_ = is_touching;
  }
}

// By the tracks' counters and the gyroscope. Tracks that stand say so; the gyroscope's noise does not.
Motion DriveRun::measured_motion() {
  const pose_wall_planar_pose odometry = pose_of(machine_.odometry());
  const pose_wall_planar_pose step = seen_from(odometry_before_, odometry);
  odometry_before_ = odometry;
  const sim::TrackSpeeds& tracks = machine_.tracks();
  if (std::max(std::abs(tracks.left_mps), std::abs(tracks.right_mps)) < kStands_m_s) return {};
  return {step.x_m / kFrame_s, step.yaw_rad / kFrame_s};
}

DriveFrame DriveRun::take_frame() {
  DriveFrame row;
  row.time_s = machine_.time_s();
  const auto stamp_ns = static_cast<std::int64_t>(1e9 * row.time_s + 0.5);
  const sim::CloudScene seen = scene();
  if (seen.dropout > 0.0 || seen.dark_radius_m > 0.0) row.loss = sim::loss_name(loss_->kind);
  const sim::Frame frame =
      sim::network_cloud(network_, model_.sensor, true_sensor(machine_, model_),
                         static_cast<std::uint32_t>(frames_.size()), sim::mix(settings_.seed ^ 0xf2au), seen);
  const pose_wall_cloud cloud = cloud_of(frame, stamp_ns);
  DrivePilot::View view;
  view.stamp_ns = stamp_ns;
  view.now_ns = stamp_ns + static_cast<std::int64_t>(1e9 * kResult_s);
  view.scan = &scanner_.scan(cloud);
  const pose_wall_planar_pose odometry = pose_of(machine_.odometry());
  view.where = &finder_.process(*view.scan, &odometry);
  view.measured = measured_motion();
  row.wished = pilot_.wish(view);
  row.command = guard_.limit(cloud, view.now_ns, view.measured, row.wished);
  pilot_.obeyed(row.command, guard_.last());
  report(&row);
  return row;
}

// What is true, and what the parts said.
void DriveRun::report(DriveFrame* row) {
  const pose_wall_planar_localise_result& where = finder_.last();
  const pose_wall_planar_stop_result& stop = guard_.last();
  row->truth = roads_.in_map(true_base(machine_));
  row->phase = pilot_.phase();
  row->believed = where.pose;
  row->place_state = where.state;
  row->place_sigma_m = position_sigma_m(where);
  row->stop_state = stop.state;
  row->stop_reasons = stop.reasons;
  row->allowed_m_s = stop.allowed_speed_m_s;
  row->limit_x_m = stop.nearest_m[0];
  row->limit_y_m = stop.nearest_m[1];
  row->off_route_m = off_route_m(pilot_.route(), row->truth);
  row->nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < people_.size(); ++k) {
    const sim::Place& at = people_[k].at();
    row->nearest_m = std::min(row->nearest_m, footprint().distance_m(at) - people_[k].pillar().radius_m);
    const pose_wall_planar_pose in_map = roads_.in_map({at.x(), at.y(), row->truth.yaw_rad});
    if (frames_.size() % kWayEach == 0) people_ways_.at(k).push_back({in_map.x_m, in_map.y_m});
  }
}

void DriveRun::judge(const DriveFrame& row, DriveEnd* end) {
  if (first_route_.poses.empty() && row.phase == PilotPhase::kFollowing) begin_trouble();
  if (row.place_state == POSE_WALL_PLANAR_LOCALISE_UNIQUE) {
    if (!(end->unique_after_s > 0.0) && row.phase != PilotPhase::kLocating) {
      end->unique_after_s = row.time_s;
      end->crept_m = machine_.driven_m();
    }
    const double error_m = distance_m(row.truth, row.believed);
    const double error_rad = std::abs(std::remainder(row.truth.yaw_rad - row.believed.yaw_rad, 2.0 * M_PI));
    ++unique_frames_;
    end->error_mean_m += (error_m - end->error_mean_m) / static_cast<double>(unique_frames_);
    end->error_worst_m = std::max(end->error_worst_m, error_m);
    if (!(error_m < kWrong_m && error_rad < kWrong_rad)) ++end->wrong_places;
  }
  if (row.phase == PilotPhase::kFollowing && std::isfinite(row.off_route_m)) {
    end->off_route_worst_m = std::max(end->off_route_worst_m, row.off_route_m);
  }
  if (!row.loss.empty()) {
    end->loss = row.loss;
    end->loss_s += kFrame_s;
  }
}

DriveEnd DriveRun::run(const std::function<bool(const DriveFrame&)>& notice) {
  DriveEnd end;
  bool goes_on = true;
  while (goes_on && machine_.time_s() < settings_.time_most_s) {
    const Motion before = command_;
    const DriveFrame row = take_frame();
    frames_.push_back(row);
    command_ = row.command;
    judge(row, &end);
    goes_on = notice(row) && row.phase != PilotPhase::kArrived && row.phase != PilotPhase::kGivenUp;
    move(before, command_);
    frames_.back().is_contact = was_touching_;
  }
  end.has_arrived = pilot_.phase() == PilotPhase::kArrived;
  if (!end.has_arrived) end.reason = pilot_.phase() == PilotPhase::kGivenUp ? pilot_.reason() : tr("time is up");
  end.driven_m = machine_.driven_m();
  end.time_s = machine_.time_s();
  end.contacts = contacts_;
  end.plans = pilot_.plans();
  end.floors = scanner_.floors();
  end.own_planes = scanner_.own_planes();
  return end;
}

}  // namespace pose_wall::tools
