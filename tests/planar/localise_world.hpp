// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Networks of roads with a map of a part of them, and machines that are restarted somewhere.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "lab/sim/drive_route.hpp"
#include "lab/sim/network.hpp"
#include "lab/sim/network_scan.hpp"
#include "lab/sim/random.hpp"
#include "planar/localise/localiser.hpp"
#include "planar/slam/slam.hpp"

namespace pose_wall::planar::test {

namespace sim = pose_wall::tools::sim;

constexpr int kKinds = 6;
inline const char* kind_name(int kind) {
  constexpr const char* kNames[kKinds] = {"rock", "alike", "smooth", "steel", "alike smooth", "twin rock"};
  return kNames[kind];
}

inline sim::NetworkPlan plan_of(int kind, double length_m) {
  sim::NetworkPlan plan;
  plan.length_m = length_m;
  plan.prop_pitch_m = kind % 2 == 1 ? 7.0 : 0.0;
  plan.alike = kind == 1 || kind == 4 || kind == 5;
  plan.twin_rock = kind == 5;
  plan.lining = kind == 2 || kind == 4 ? sim::Lining::kSmooth : sim::Lining::kRock;
  plan.steel_pitch_m = kind == 3 ? 1.2 : 0.0;
  if (kind == 5) plan.spacing_m = 24.0;
  if (plan.alike) plan.roads = 2;
  return plan;
}

// Someone or something round that the map does not know.
struct Round {
  sim::Place at;
  double radius_m;
};

inline void hide_behind(const std::vector<Round>& things, const sim::PlanarSensor& sensor, const sim::PlanePose& at,
                        float* ranges) {
  for (int k = 0; k < sensor.beams; ++k) {
    const double angle = at.yaw_rad + sensor.angle_min_rad() + k * sensor.angle_step_rad();
    const sim::Place d(std::cos(angle), std::sin(angle));
    for (const Round& thing : things) {
      const sim::Place to = thing.at - at.place();
      const double along = to.dot(d), off2 = to.squaredNorm() - along * along;
      if (along < 0.0 || off2 > thing.radius_m * thing.radius_m) continue;
      const double range = along - std::sqrt(thing.radius_m * thing.radius_m - off2);
      if (range > sensor.range_min_m && !(ranges[k] < range)) ranges[k] = static_cast<float>(range);
    }
  }
}

inline LocaliseSettings localise_settings() {
  LocaliseSettings settings;
  if (pose_wall_planar_localise_settings_init(&settings) != POSE_WALL_OK) std::abort();  // fails for NULL alone
  return settings;
}
inline LocaliseSettings localise_settings(std::uint32_t tiles_most, std::uint32_t work, bool is_whole) {
  LocaliseSettings settings = localise_settings();
  settings.tiles_most = tiles_most;
  settings.work = work;
  settings.map_is_whole = is_whole ? 1 : 0;
  return settings;
}

class OpenedLocaliser {
 public:
  explicit OpenedLocaliser(const LocaliseSettings& settings) : settings_(settings) {
    Arena measure(nullptr);
    Localiser measured;
    measured.lay_out(measure, settings);
    bytes_ = measure.bytes();
    block_.reset(static_cast<unsigned char*>(std::aligned_alloc(64, (bytes_ + 63) / 64 * 64)));
    std::memset(block_.get(), 0xA5, bytes_);
    Arena arena(block_.get());
    own_.lay_out(arena, settings);
    own_.open(settings);
  }
  Localiser& operator*() { return own_; }
  Localiser* operator->() { return &own_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(unsigned char* p) const { std::free(p); }
  };
  LocaliseSettings settings_;
  std::uint64_t bytes_ = 0;
  std::unique_ptr<unsigned char, Free> block_;
  Localiser own_;
};

struct Restart {
  std::uint32_t edge = 0;
  double along_m = 0.0, aside_m = 0.0, yaw_rad = 0.0;  // of the road, at the beginning
  double direction = 1.0;
  bool is_mapped = true, has_odometry = true;
  std::vector<Round> things;
  std::uint64_t seed = 0;
};

struct Outcome {
  Where standing = Where::searching, after_2m = Where::searching, after_5m = Where::searching;
  bool wrong = false;
  double error_m = 0.0, error_rad = 0.0, wrong_at_m = 0.0, fits = 0.0, rival = 0.0;
  int tracked = 0, beyond = 0;  // scans with a pose; those whose error is beyond three of its standard deviations
  double squares = 0.0, normal = 0.0;
};

struct Counts {
  int places = 0, wrong = 0, standing = 0, after_2m = 0, after_5m = 0, unique_right = 0;
  int end[5] = {};
  double error_m = 0.0, squares = 0.0, normal = 0.0;
  long tracked = 0, beyond = 0;

  void add(const Outcome& outcome) {
    ++places;
    tracked += outcome.tracked;
    beyond += outcome.beyond;
    squares += outcome.squares;
    normal += outcome.normal;
    wrong += outcome.wrong ? 1 : 0;
    standing += outcome.standing == Where::unique ? 1 : 0;
    after_2m += outcome.after_2m == Where::unique ? 1 : 0;
    after_5m += outcome.after_5m == Where::unique ? 1 : 0;
    ++end[static_cast<int>(outcome.after_5m)];
    if (outcome.after_5m == Where::unique) error_m += outcome.error_m;
  }
  void print(const char* name) const {
    if (places == 0) return;
    const auto percent = [&](int n) { return 100.0 * n / places; };
    std::printf(
        "%-14s %7d %7d | %7.1f%% %7.1f%% %7.1f%% | %7.1f%% %7.1f%% %7.1f%% %7.1f%% | %.3f | %ld %.4f %.2f %ld\n", name,
        places, wrong, percent(standing), percent(after_2m), percent(after_5m), percent(end[3] + end[4]),
        percent(end[2]), percent(end[1]), percent(end[0]), after_5m > 0 ? error_m / after_5m : 0.0, tracked,
        tracked > 0 ? std::sqrt(squares / static_cast<double>(tracked)) : 0.0,
        tracked > 0 ? std::sqrt(normal / static_cast<double>(tracked)) : 0.0, beyond);
  }
};

constexpr std::uint32_t kWholeSearch = 1U << 30;  // steps of work: a search ends in the call that begins it

class World {
 public:
  World(int kind, std::uint64_t seed) : World(kind, seed, lengths(seed), 768) {}
  World(int kind, std::uint64_t seed, double length_m, std::uint32_t tiles_most, bool by_slam = false,
        bool is_whole = false, std::uint32_t work = kWholeSearch)
      : random_seed_(seed),
        network_(plan_of(kind, length_m), seed),
        localiser_(localise_settings(tiles_most, work, is_whole)) {
    sensor_.noise_m = 0.015;
    // In half of the networks one of the roads is not in the map.
    const sim::NetworkGraph& graph = network_.graph();
    sim::Random random(seed, 77);
    is_hidden_.assign(graph.edges.size(), false);
    if (random.chance(0.5) && kind != 5 &&
        !is_whole) {  // the twin of a place that is not in the map is that place to any scanner
      for (std::size_t e = 0; e < graph.edges.size(); ++e)
        is_hidden_[e] = graph.edges[e].road == 0 || random.chance(0.15);
    }
    by_slam ? draw_map_by_slam() : draw_map();
  }

  static double lengths(std::uint64_t seed) { return 120.0 + static_cast<double>(seed % 7) * 40.0; }

  const sim::Network& network() const { return network_; }
  Localiser& localiser() const { return *localiser_; }
  std::uint64_t bytes() const { return localiser_.bytes(); }

  sim::PlanePose pose_at(const Restart& restart, double driven_m) const {
    const sim::NetworkEdge& edge = network_.graph().edges[restart.edge];
    double left = restart.along_m + restart.direction * driven_m;
    std::size_t k = 0;
    double step = 0.0;
    for (; k + 2 < edge.line.size(); ++k) {
      step = (edge.line[k + 1] - edge.line[k]).norm();
      if (left <= step) break;
      left -= step;
    }
    const sim::Place d = (edge.line[k + 1] - edge.line[k]).normalized(), n(-d.y(), d.x());
    const sim::Place p = edge.line[k] + left * d + restart.aside_m * n;
    return {p.x(), p.y(), std::atan2(d.y(), d.x()) + restart.yaw_rad};
  }

  std::vector<Round> draw_things(sim::Random* random, const sim::Place& about) const {
    std::vector<Round> out;
    const int people = static_cast<int>(random->uniform(0.0, 3.99));
    for (int k = 0; k < people; ++k) {
      const double angle = random->uniform(0.0, 2 * M_PI), range = random->uniform(1.0, 8.0);
      out.push_back({about + range * sim::Place(std::cos(angle), std::sin(angle)), 0.25});
    }
    if (random->chance(0.3)) {
      const double angle = random->uniform(0.0, 2 * M_PI), range = random->uniform(2.5, 10.0);
      out.push_back({about + range * sim::Place(std::cos(angle), std::sin(angle)), random->uniform(0.4, 1.0)});
    }
    return out;
  }

  Restart draw_restart(std::uint64_t number) const {
    sim::Random random(random_seed_ * 1000 + number, 5);
    const bool wants_mapped =
        random.chance(0.5) || std::none_of(is_hidden_.begin(), is_hidden_.end(), [](bool h) { return h; });
    const sim::NetworkGraph& graph = network_.graph();
    Restart out;
    out.seed = random_seed_ * 1000 + number;
    for (int tries = 0; tries < 10000; ++tries) {
      out.edge = static_cast<std::uint32_t>(random.uniform() * static_cast<double>(graph.edges.size()));
      const sim::NetworkEdge& edge = graph.edges[out.edge];
      if (edge.length_m < 9.0) continue;
      out.along_m = random.uniform(1.0, edge.length_m - 1.0);
      out.direction = out.along_m > 0.5 * edge.length_m ? -1.0 : 1.0;
      out.aside_m = random.uniform(-1.0, 1.0);
      out.yaw_rad = random.uniform(-M_PI, M_PI);
      bool is_open = true;
      bool mapped = true, unmapped = true;
      for (double s = 0.0; s < 5.6; s += 0.25) {
        const sim::PlanePose p = pose_at(out, s);
        is_open = is_open && network_.is_open(p.place()) && network_.clearance_m(p.place(), 1.0) > 0.5;
        const double apart_m = from_map_m(p.place());
        mapped = mapped && apart_m < 2.5;
        unmapped = unmapped && apart_m > 12.0;
      }
      if (!is_open || (!mapped && !unmapped) || (tries < 500 && mapped != wants_mapped)) continue;
      out.is_mapped = mapped;
      break;
    }
    out.has_odometry = random.chance(0.5);
    out.things = draw_things(&random, pose_at(out, 0.0).place());
    return out;
  }

  pose_wall_planar_scan scan_at(const sim::PlanePose& at, const std::vector<Round>& things, std::uint64_t seed,
                                std::vector<float>* ranges) const {
    ranges->resize(static_cast<std::size_t>(sensor_.beams));
    sim::planar_scan(network_, sensor_, at, seed, ranges->data());
    hide_behind(things, sensor_, at, ranges->data());
    pose_wall_planar_scan scan{};
    scan.struct_size = sizeof(scan);
    scan.beams = static_cast<std::uint32_t>(sensor_.beams);
    scan.angle_min_rad = sensor_.angle_min_rad();
    scan.angle_step_rad = sensor_.angle_step_rad();
    scan.range_min_m = sensor_.range_min_m;
    scan.range_max_m = sensor_.range_max_m;
    scan.sigma_m = 0.02;
    scan.range_m = ranges->data();
    return scan;
  }

  // Restarts, stands for three scans, and drives 5 m.
  Outcome run(const Restart& restart, bool verbose) const {
    Localiser& own = *localiser_;
    own.forget();
    Outcome out;
    sim::Random random(restart.seed, 9);
    std::vector<float> ranges;
    Pose2 odometry{random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-3, 3)};
    sim::PlanePose last = pose_at(restart, 0.0);
    for (int k = 0; k < 3 + 20; ++k) {
      const double driven_m = k < 3 ? 0.0 : 0.25 * (k - 2);
      const sim::PlanePose at = pose_at(restart, driven_m);
      const Pose2 step = between({last.x_m, last.y_m, last.yaw_rad}, {at.x_m, at.y_m, at.yaw_rad});
      const double share = 1.0 + 0.05 * random.gaussian();
      odometry =
          compose(odometry, {step.x_m * share, step.y_m * share, step.yaw_rad * share + 0.003 * random.gaussian()});
      last = at;
      const pose_wall_planar_scan scan =
          scan_at(at, restart.things, restart.seed * 64 + static_cast<std::uint64_t>(k), &ranges);
      const Where where = own.process(read_beams(scan, own.beams()), restart.has_odometry ? &odometry : nullptr);
      if (own.is_tracking() && restart.is_mapped) {
        const Pose2 apart = between(in_map({at.x_m, at.y_m, at.yaw_rad}), own.follower().pose());
        const double variance = own.follower().covariance()(0, 0) + own.follower().covariance()(1, 1);
        const double error2 = apart.place().squaredNorm();
        ++out.tracked;
        out.beyond += error2 > 9.0 * variance ? 1 : 0;
        out.squares += error2;
        out.normal += error2 / variance;
      }
      if (where == Where::unique) {
        const Pose2 off = between(in_map({at.x_m, at.y_m, at.yaw_rad}), own.follower().pose());
        out.error_m = off.place().norm();
        out.error_rad = std::abs(off.yaw_rad);
        const bool wrong = !(out.error_m < 0.5 && out.error_rad < 0.1);
        if (wrong && !out.wrong) {
          out.wrong = true;
          out.wrong_at_m = driven_m;
          out.fits = own.verdict().best.fits;
          out.rival = own.verdict().best.rival;
          if (verbose || std::getenv("WHY") != nullptr) break;
        }
      }
      if (verbose && (k == 0 || own.searches() != searches_)) show(own, at, where, driven_m);
      if (verbose && own.is_tracking())
        std::printf("    %.2f m tracked: state %u off %.2f m, sigma %.2f m, slide %.1f fits %.2f\n", driven_m,
                    static_cast<unsigned>(where),
                    between(in_map({at.x_m, at.y_m, at.yaw_rad}), own.follower().pose()).place().norm(),
                    std::sqrt(own.follower().covariance().topLeftCorner<2, 2>().trace()), own.follower().slide_m(),
                    own.follower().verdict().fits);
      searches_ = own.searches();
      if (k == 2) out.standing = where;
      if (k == 2 + 8) out.after_2m = where;
      if (k == 2 + 20) out.after_5m = where;
    }
    return out;
  }

  // Odometry as slipping tracks and late counters make it: it stalls for some scans, and then makes up for them at
  // once, or never; or it leaps.
  class FaultyOdometry {
   public:
    explicit FaultyOdometry(std::uint64_t seed) : random_(seed, 11) {}

    const Pose2& after(const Pose2& step) {
      constexpr double kStalls = 0.08, kMakesUp = 0.5, kLeaps = 0.02;
      constexpr int kScansMost = 8;
      owed_ = compose(owed_, step);
      if (stalled_ == 0 && random_.chance(kStalls)) stalled_ = 1 + static_cast<int>(random_.uniform() * kScansMost);
      if (stalled_ > 0) {
        if (--stalled_ == 0 && !random_.chance(kMakesUp)) owed_ = Pose2();
        return pose_;
      }
      if (random_.chance(kLeaps)) owed_ = compose(owed_, {random_.uniform(-1.0, 1.0), 0.0, random_.uniform(-0.3, 0.3)});
      pose_ = compose(pose_, owed_);
      owed_ = Pose2();
      return pose_;
    }

   private:
    sim::Random random_;
    Pose2 pose_, owed_;
    int stalled_ = 0;
  };

  struct FaultyDrive {
    int scans = 0, unique = 0, wrong = 0;
    long tracked = 0, beyond = 0;  // scans with a pose, and with an error beyond three of its standard deviations
    double worst_m = 0.0;          // of unique scans
    std::uint32_t lost = 0;
  };
  // Drives 5 m from a place that is known, by steps of `step_m`.
  FaultyDrive drive_with_faulty_odometry(const Restart& restart, double step_m) const {
    return drive_from(restart, step_m, {}, true);
  }
  // The same from a place that is off by as much, and perhaps without odometry.
  FaultyDrive drive_from(const Restart& restart, double step_m, const Pose2& off_at_first, bool has_odometry) const {
    Localiser& own = *localiser_;
    FaultyDrive out;
    FaultyOdometry faulty(restart.seed);
    std::vector<float> ranges;
    sim::PlanePose last = pose_at(restart, 0.0);
    own.place(compose(in_map({last.x_m, last.y_m, last.yaw_rad}), off_at_first), 0.2, 0.1);
    const std::uint32_t lost = own.lost();
    for (double driven_m = 0.0; driven_m < 5.0; driven_m += step_m, ++out.scans) {
      const sim::PlanePose at = pose_at(restart, driven_m);
      const Pose2& odometry = faulty.after(between({last.x_m, last.y_m, last.yaw_rad}, {at.x_m, at.y_m, at.yaw_rad}));
      last = at;
      const pose_wall_planar_scan scan =
          scan_at(at, restart.things, restart.seed * 64 + static_cast<std::uint64_t>(out.scans), &ranges);
      const Where where = own.process(read_beams(scan, own.beams()), has_odometry ? &odometry : nullptr);
      if (!own.is_tracking()) continue;
      const Pose2 off = between(in_map({at.x_m, at.y_m, at.yaw_rad}), own.follower().pose());
      const double variance = own.follower().covariance()(0, 0) + own.follower().covariance()(1, 1);
      ++out.tracked;
      if (off.place().squaredNorm() > 9.0 * variance) ++out.beyond;
      if (std::getenv("WHY") != nullptr)
        std::printf("  %.2f m state %u off %.2f m %.3f rad sigma %.2f slide %.1f fits %.2f\n", driven_m,
                    static_cast<unsigned>(where), off.place().norm(), off.yaw_rad, std::sqrt(variance),
                    own.follower().slide_m(), own.follower().verdict().fits);
      if (where != Where::unique) continue;
      ++out.unique;
      out.worst_m = std::max(out.worst_m, off.place().norm());
      if (!(off.place().norm() < 0.5 && std::abs(off.yaw_rad) < 0.1)) ++out.wrong;
    }
    out.lost = own.lost() - lost;
    return out;
  }

  struct Kidnapping {
    bool was_tracked = false, noticed = false, found = false, wrong = false;
    int scans = 0;  // until it was noticed
  };
  // Tracked at one place, then carried to another while nobody looks; there it stands for ten scans and drives 5 m.
  Kidnapping kidnap(const Restart& from, const Restart& to) const {
    Localiser& own = *localiser_;
    Kidnapping out;
    const Outcome before = run(from, false);
    if (before.wrong || before.after_5m != Where::unique) return out;
    out.was_tracked = true;
    std::vector<float> ranges;
    Pose2 odometry;
    sim::PlanePose last = pose_at(to, 0.0);
    for (int k = 0; k < 10 + 20; ++k) {
      const sim::PlanePose at = pose_at(to, k < 10 ? 0.0 : 0.25 * (k - 9));
      odometry = compose(odometry, between({last.x_m, last.y_m, last.yaw_rad}, {at.x_m, at.y_m, at.yaw_rad}));
      last = at;
      const pose_wall_planar_scan scan = scan_at(at, to.things, to.seed * 64 + static_cast<std::uint64_t>(k), &ranges);
      const Where where = own.process(read_beams(scan, own.beams()), to.has_odometry ? &odometry : nullptr);
      const Pose2 off = between(in_map({at.x_m, at.y_m, at.yaw_rad}), own.follower().pose());
      const bool is_right = off.place().norm() < 0.5 && std::abs(off.yaw_rad) < 0.1;
      if (!out.noticed) ++out.scans;
      out.noticed = out.noticed || where != Where::unique || is_right;
      out.found = where == Where::unique && is_right;
      out.wrong = out.wrong || (out.noticed && where == Where::unique && !is_right);
    }
    return out;
  }

  // For people who look for the reason.
  static void show(const Localiser& own, const sim::PlanePose& at, Where where, double driven_m) {
    const Evidence& best = own.verdict().best;
    const Span<const Hypothesis> all = own.search().hypotheses();
    double nearest_m = 1e9, nearest_cost = 0.0, nearest_fits = 0.0;
    for (const Hypothesis& h : all) {
      const Pose2 off = between({at.x_m, at.y_m, at.yaw_rad}, h.pose);
      if (std::abs(off.yaw_rad) > 0.2 || off.place().norm() >= nearest_m) continue;
      nearest_m = off.place().norm();
      nearest_cost = h.verdict.cost / std::max(1U, h.verdict.judged);
      nearest_fits = h.verdict.fits;
    }
    std::printf(
        "  %.2f m: state %u, %u seeds, %u hypotheses, %u candidates; best cost %.2f fits %.2f seen %.2f (%u) expl %.2f "
        "rms %.3f through %.2f slide %.1f rival %.2f rough %u; truth %.2f m cost %.2f fits %.2f whole %d\n",
        driven_m, static_cast<unsigned>(where), own.search().seeds(), all.size(), own.verdict().all,
        all.size() > 0 ? all[0].verdict.cost / std::max(1U, all[0].verdict.judged) : 0.0, best.fits, best.seen,
        best.patches, best.explained, best.rms_m, best.through, best.slide_m, best.rival, best.relief, nearest_m,
        nearest_cost, nearest_fits, own.search().is_whole());
  }

  // Where the map has a true pose: by the nearest keyframe that looked from there.
  Pose2 in_map(const Pose2& truth) const {
    if (in_map_.empty()) return truth;
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < in_map_.size(); ++k) {
      const auto apart = [&](std::size_t i) { return (in_map_[i].first.place() - truth.place()).squaredNorm(); };
      if (apart(k) < apart(nearest)) nearest = k;
    }
    return compose(in_map_[nearest].second, between(in_map_[nearest].first, truth));
  }

 private:
  double from_map_m(const sim::Place& p) const {
    double least2 = 1e18;
    for (const sim::Place& q : mapped_) least2 = std::min(least2, (q - p).squaredNorm());
    return std::sqrt(least2);
  }

  // By keyframes at their true poses but for a centimetre; people stood about while it was made.
  void draw_map() {
    sim::Random random(random_seed_, 3);
    PlaceMap& map = localiser_->map();
    std::vector<float> ranges;
    std::vector<Beam> beams(POSE_WALL_PLANAR_BEAMS_MAX);
    std::vector<ScanPoint> room(kMatchPointsMost);
    bool fits = true;
    const sim::NetworkGraph& graph = network_.graph();
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
      if (is_hidden_[e]) continue;
      Restart way;
      way.edge = e;
      way.aside_m = random.uniform(-0.5, 0.5);
      for (double s = 0.0; s < graph.edges[e].length_m; s += 0.3) {
        way.along_m = s;
        sim::PlanePose at = pose_at(way, 0.0);
        std::vector<Round> things;
        if (random.chance(0.05))
          things.push_back({at.place() + sim::Place(random.uniform(-3, 3), random.uniform(-3, 3)), 0.25});
        const pose_wall_planar_scan scan =
            scan_at(at, things, random_seed_ * 10007 + e * 1000 + static_cast<std::uint64_t>(s * 10), &ranges);
        const BeamScan read = read_beams(scan, Span<Beam>(beams.data(), POSE_WALL_PLANAR_BEAMS_MAX));
        const Span<const ScanPoint> points = even_points(read, 0.05, Span<ScanPoint>(room.data(), kMatchPointsMost));
        fits = map.add(points, {at.x_m + 0.01 * random.gaussian(), at.y_m + 0.01 * random.gaussian(),
                                at.yaw_rad + 0.002 * random.gaussian()}) &&
               fits;
        mapped_.push_back(at.place());
      }
    }
    map.finish();
    if (!fits) std::printf("the map does not hold all of the network: %u tiles\n", map.tiles());
  }

  // By SLAM on a drive through all of the network with odometry that slips.
  void draw_map_by_slam() {
    is_hidden_.assign(is_hidden_.size(), false);
    const sim::Route route = network_.graph().tour(0, 1.3 * network_.graph().length_m, random_seed_);
    sim::RunSettings run_settings;
    run_settings.sensor = sensor_;
    const sim::NetworkRun run = sim::drive(network_, route, run_settings, random_seed_);
    SlamSettings slam_settings;
    if (pose_wall_planar_slam_settings_init(&slam_settings) != POSE_WALL_OK) std::abort();
    slam_settings.keyframes_most = 8192;
    Slam slam;
    Arena measure(nullptr);
    slam.lay_out(measure, slam_settings);
    std::unique_ptr<unsigned char, decltype(&std::free)> block(
        static_cast<unsigned char*>(std::aligned_alloc(64, (measure.bytes() + 63) / 64 * 64)), &std::free);
    Arena arena(block.get());
    slam.lay_out(arena, slam_settings);
    slam.open(slam_settings);
    std::vector<Pose2> truths;
    for (std::size_t i = 0; i < run.scans(); ++i) {
      pose_wall_planar_scan scan{};
      std::vector<float> unused;
      scan = scan_at(run.at_scan(i).truth, {}, 1, &unused);
      scan.range_m = run.ranges_of(i);
      const sim::PlanePose& odometry = run.at_scan(i).odometry;
      const Pose2 given{odometry.x_m, odometry.y_m, odometry.yaw_rad};
      const SlamStep step = slam.process(read_beams(scan, localiser_->beams()), &given);
      const sim::PlanePose& truth = run.at_scan(i).truth;
      if (step.is_keyframe) truths.push_back({truth.x_m, truth.y_m, truth.yaw_rad});
    }
    slam.settle();
    for (std::uint32_t k = 0; k < slam.trail().size(); ++k) {
      localiser_->map().add(slam.trail().points(k), slam.trail().pose(k));
      mapped_.push_back({truths[k].x_m, truths[k].y_m});
      in_map_.push_back({truths[k], slam.trail().pose(k)});
    }
    localiser_->map().finish();
  }

  std::uint64_t random_seed_;
  std::vector<std::pair<Pose2, Pose2>> in_map_;  // of keyframes: true, and as SLAM has them
  sim::Network network_;
  sim::PlanarSensor sensor_;
  mutable OpenedLocaliser localiser_;
  mutable std::uint32_t searches_ = 0;
  std::vector<bool> is_hidden_;
  std::vector<sim::Place> mapped_;
};

}  // namespace pose_wall::planar::test
