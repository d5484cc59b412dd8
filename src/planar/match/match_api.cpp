// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The only extern "C" file of the scan match: checks arguments, translates, calls.

#include <Eigen/LU>
#include <algorithm>

#include "base/math/finite.hpp"
#include "part/shell.hpp"
#include "place/slide.hpp"
#include "planar/gates.hpp"
#include "planar/match/matcher.hpp"
#include "pose_wall_planar_match.h"

namespace pose_wall::planar {
namespace {

// What lives in the block.
struct Body {
  Matcher matcher;
  SurfaceMap map;
  Span<Beam> beams;
  Span<ScanPoint> points;
  bool has_begun, is_finished;

  void lay_out(Arena& arena) {
    matcher.lay_out(arena);
    map.lay_out(arena);
    beams = arena.take<Beam>(POSE_WALL_PLANAR_BEAMS_MAX);
    points = arena.take<ScanPoint>(kMatchPointsMost);
  }
};

using Opened = Held<Body, 0x6863746D6E616C70ULL>;

// Symmetric and positive. Its scale may be anything that an inverse can hold.
bool is_covariance(const double (&c)[9]) {
  for (const double value : c) {
    if (!is_within(value, -1e12, 1e12)) return false;
  }
  const double most = std::max({c[0], c[4], c[8]});
  for (const int at : {1, 2, 5}) {
    const int across = at == 5 ? 7 : 3 * at;
    const double off = c[at] - c[across];
    if (!is_within(off, -1e-9 * most, 1e-9 * most)) return false;
  }
  constexpr double kLeast = 1e-12;  // a micrometre, squared: nobody knows a pose better
  const double minor = c[0] * c[4] - c[1] * c[3];
  const double all =
      c[0] * (c[4] * c[8] - c[5] * c[7]) - c[1] * (c[3] * c[8] - c[5] * c[6]) + c[2] * (c[3] * c[7] - c[4] * c[6]);
  return c[0] >= kLeast && c[4] >= kLeast && c[8] >= kLeast && minor > 0.0 && all > 0.0;
}

std::int32_t check_input(const pose_wall_planar_match_input* input) {
  constexpr double kReach_m = 38.0, kReach_rad = 3.14159265358979;  // what Matcher::search looks through
  if (input == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*input); size != POSE_WALL_OK) return size;
  if (input->has_prior > 1) return POSE_WALL_E_VALUE_RANGE;
  if (!is_pose(input->guess)) return POSE_WALL_PLANAR_E_POSE;
  if (!is_within(input->reach_m, 0.0, kReach_m) || !is_within(input->reach_rad, 0.0, kReach_rad)) {
    return POSE_WALL_E_VALUE_RANGE;
  }
  return ok_if(input->has_prior == 0 || is_covariance(input->covariance), POSE_WALL_PLANAR_E_POSE);
}

Prior prior_of(const pose_wall_planar_match_input& input) {
  Prior prior{pose_of(input.guess), Eigen::Matrix3d::Zero()};
  if (input.has_prior == 0) return prior;
  Eigen::Matrix3d covariance;
  for (int k = 0; k < 9; ++k) covariance(k / 3, k % 3) = input.covariance[k];
  prior.information = covariance.inverse();
  return prior;
}

// What scan and prior hold together. Where neither holds anything, the reach does.
Eigen::Matrix3d covariance_of(const Fit& fit, const Slide& slide, const Prior& prior,
                              const pose_wall_planar_match_input& input) {
  const double place_m = std::max(kSlideMost_m, input.reach_m), turn_rad = std::max(0.1, input.reach_rad);
  const Slide open{slide.direction, slide.reach_m >= kSlideMost_m ? place_m : slide.reach_m};
  Eigen::Matrix3d information = told_by(fit, open) + prior.information;
  information.diagonal() +=
      Eigen::Vector3d(1.0 / (place_m * place_m), 1.0 / (place_m * place_m), 1.0 / (turn_rad * turn_rad));
  return information.inverse();
}

pose_wall_planar_match_result no_match() {
  const double none = not_a_number();
  pose_wall_planar_match_result out{};
  out.struct_size = sizeof(out);
  out.state = POSE_WALL_PLANAR_MATCH_NONE;
  out.pose = out.second = {none, none, none};
  for (double& value : out.covariance) value = none;
  out.misfit_m = out.slide_m = out.slide_rad = out.score = none;
  return out;
}

pose_wall_planar_match_result match(Body& body, const BeamScan& scan, const pose_wall_planar_match_input& input) {
  pose_wall_planar_match_result out = no_match();
  const auto points = even_points(scan, kMatchSpacing_m, body.points);
  const Prior prior = prior_of(input);
  Pose2 start = prior.pose;
  if ((input.reach_m > 0.0 || input.reach_rad > 0.0) && points.size() > 0) {
    const Found found =
        body.matcher.search(points, body.map, {start, input.reach_m, input.reach_rad, kSearchNodesMost});
    start = found.pose;
    out.score = found.score;
    out.second_score = found.second_score;
    if (found.second_score > 0.0) out.second = pose_for_caller(found.second);
    out.is_whole = found.is_whole ? 1 : 0;
  }
  const Fit fit = fit_pose(body.map, points, start, {scan.sigma_m, prior});
  out.explained = fit.explained;
  out.points = fit.points;
  if (!fit.is_valid) return out;
  const Slide slide = slide_of(body.map, body.matcher.sort(points, scan.sigma_m), fit,
                               pose_wall::limit_of<pose_wall::planar::gate::EXCLUDED>(), kRefit);
  const Eigen::Matrix3d covariance = covariance_of(fit, slide, prior, input);
  out.state = POSE_WALL_PLANAR_MATCH_FOUND;
  out.pose = pose_for_caller(fit.pose);
  for (int k = 0; k < 9; ++k) out.covariance[k] = covariance(k / 3, k % 3);
  out.misfit_m = fit.rms_m;
  out.slide_m = slide.reach_m;
  out.slide_rad = arc_tangent2(slide.direction.y(), slide.direction.x());
  return out;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT int32_t pose_wall_planar_match_memory_needed(uint64_t* bytes) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  *bytes = Opened::bytes();
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_match_open(void* block, uint64_t block_bytes,
                                                     pose_wall_planar_matcher** matcher) {
  if (block == nullptr || matcher == nullptr) return POSE_WALL_E_NULL;
  Opened* placed = nullptr;
  const std::int32_t status = Opened::place(block, block_bytes, &placed);
  if (status != POSE_WALL_OK) return status;
  placed->body().map.open();
  placed->body().has_begun = placed->body().is_finished = false;
  *matcher = reinterpret_cast<pose_wall_planar_matcher*>(placed);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_match_begin(pose_wall_planar_matcher* matcher, double x_m, double y_m) {
  if (!is_place(x_m, y_m)) return POSE_WALL_PLANAR_E_POSE;
  return with_part<Opened>(matcher, [&](Body& body) {
    body.map.begin({x_m, y_m});
    body.has_begun = true;
    body.is_finished = false;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_match_add(pose_wall_planar_matcher* matcher,
                                                    const pose_wall_planar_scan* scan,
                                                    const pose_wall_planar_pose* base) {
  if (base == nullptr) return POSE_WALL_E_NULL;
  const std::int32_t status = check_scan(scan);
  if (status != POSE_WALL_OK) return status;
  if (!is_pose(*base)) return POSE_WALL_PLANAR_E_POSE;
  return with_part<Opened>(matcher, [&](Body& body) -> std::int32_t {
    if (!body.has_begun || body.is_finished) return POSE_WALL_PLANAR_E_ORDER;
    body.map.add(even_points(read_beams(*scan, body.beams), kMatchSpacing_m, body.points), pose_of(*base), true);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_match_input_init(pose_wall_planar_match_input* input) {
  if (input == nullptr) return POSE_WALL_E_NULL;
  *input = {};
  input->struct_size = sizeof(*input);
  input->reach_m = 0.3;
  input->reach_rad = 0.1;
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_match_scan(pose_wall_planar_matcher* matcher,
                                                     const pose_wall_planar_scan* scan,
                                                     const pose_wall_planar_match_input* input,
                                                     pose_wall_planar_match_result* result) {
  if (result == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*result); size != POSE_WALL_OK) return size;
  std::int32_t status = check_scan(scan);
  if (status == POSE_WALL_OK) status = check_input(input);
  if (status != POSE_WALL_OK) return status;
  return with_part<Opened>(matcher, [&](Body& body) -> std::int32_t {
    if (!body.has_begun) return POSE_WALL_PLANAR_E_ORDER;
    if (!body.is_finished) body.map.finish();
    body.is_finished = true;
    *result = match(body, read_beams(*scan, body.beams), *input);
    return POSE_WALL_OK;
  });
}

}  // extern "C"

}  // namespace pose_wall::planar
