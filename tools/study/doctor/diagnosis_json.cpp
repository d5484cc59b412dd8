// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <nlohmann/json.hpp>

#include "io/json/json_words.hpp"
#include "io/numbers/angles.hpp"
#include "study/doctor/diagnosis_output.hpp"

namespace pose_wall::tools::doctor {
namespace {

Json seen(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json boxes(const std::vector<Box>& list) {
  Json all = Json::array();
  for (const Box& b : list) {
    all.push_back({b.low_m.x(), b.high_m.x(), b.low_m.y(), b.high_m.y(), b.low_m.z(), b.high_m.z()});
  }
  return all;
}

Json sensor(const SensorFacts& s) {
  return {{"class", s.model},
          {"config", s.config.empty() ? Json(nullptr) : Json(s.config)},
          {"returns_per_frame", s.returns},
          {"rings", s.rings},
          {"rings_certain", s.rings_are_told},
          {"elevation_min_deg", s.elevation_min_deg},
          {"elevation_max_deg", s.elevation_max_deg},
          {"azimuth_share", s.azimuth_span_deg / 360.0},
          {"range_median_m", s.ranges.median_m}};
}

Json stamps(const StampHealth& h) {
  return {{"frames", h.frames},
          {"unreadable", h.unreadable},
          {"empty", h.empty},
          {"cut", h.cut},
          {"repeated", h.repeated},
          {"has_stamps", h.has_stamps()},
          {"duration_s", h.duration_s},
          {"rate_hz", h.rate_hz},
          {"jitter_s", h.jitter_s},
          {"gaps", h.gaps},
          {"gap_max_s", h.longest_s},
          {"still", h.still},
          {"back", h.back}};
}

Json floor_json(const MountChoice& mount) {
  const FloorSeen& f = mount.likely.floor;
  Json json = {{"found", f.is_found()}, {"measured", f.measured}, {"valid", f.valid}};
  if (!f.is_found()) return json;
  const api::Config& c = mount.likely.config;
  json.update({{"upside_down", mount.likely.is_flipped},
               {"certain", mount.is_sure},
               {"reason", mount.reason},
               {"height_m", f.height_m},
               {"tilt_deg", mount.likely.tilt_rad * kDegPerRad},
               {"roll_deg", c.number("extrinsic_roll") * kDegPerRad},
               {"pitch_deg", c.number("extrinsic_pitch") * kDegPerRad},
               {"tilt_spread_deg", f.tilt_spread_rad * kDegPerRad},
               {"tilt_protection_deg", f.tilt_level_rad * kDegPerRad},
               {"other_height_m", mount.other ? Json(mount.other->floor.height_m) : Json(nullptr)}});
  return json;
}

Json road(const Diagnosis& d) {
  const SupposedMount& supposed = d.mount->likely;
  Json json = {{"found", supposed.road.is_found}};
  if (!supposed.road.is_found) return json;
  const bool minus = d.ahead.axis[0] == '-';
  json.update({{"line", std::string(1, supposed.road.line)},
               {"ambiguous", supposed.road.is_ambiguous},
               {"off_line_deg", supposed.road.off_line_rad * kDegPerRad},
               {"off_line_spread_deg", supposed.road.azimuth_spread_rad * kDegPerRad},
               {"score", supposed.road.score},
               {"score_across", supposed.road.rival_score},
               {"forward_axis", d.ahead.axis},
               {"ahead_known", d.ahead.is_known},
               {"ahead_reason", d.ahead.reason},
               {"left_m", minus ? supposed.road.right_m : supposed.road.left_m},
               {"right_m", minus ? supposed.road.left_m : supposed.road.right_m},
               {"roof_m", supposed.ends.roof_m},
               {"face_plus_m", seen(supposed.ends.face_plus_m)},
               {"face_minus_m", seen(supposed.ends.face_minus_m)}});
  return json;
}

Json near(const SupposedMount& supposed) {
  std::vector<Box> left_out;
  std::vector<std::string> because;
  for (const LeftOut& one : supposed.body.left_out) {
    left_out.push_back(one.box_base);
    because.emplace_back(one.why);
  }
  return {{"boxes_m", boxes(supposed.body.boxes_base)},
          {"unexplained_m", boxes(left_out)},
          {"unexplained_because", because},
          {"in_boxes_share", supposed.body.in_boxes_share},
          {"moved_share", supposed.body.passing_share}};
}

Json preview(const Preview& seen) {
  Json json = {{"frames", seen.frames}, {"travel_m", seen.travel_m}};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    json[pose_wall_quantity_name(q)] = {{"measured", seen.valid[q] + seen.degraded[q]},
                                        {"valid", seen.valid[q]},
                                        {"degraded", seen.degraded[q]},
                                        {"held", seen.held[q]},
                                        {"protection_level", seen.level[q]}};
  }
  return json;
}

Json changes(const Proposal& proposal) {
  Json all = Json::array();
  for (const Change& c : proposal.changes()) {
    all.push_back({{"key", c.key}, {"before", c.before}, {"value", c.value}, {"reason", c.reason}});
  }
  return all;
}

}  // namespace

std::string diagnosis_json(const Diagnosis& d) {
  const RecordingVerdict& v = d.verdict;
  Json json = {{"usable", v.is_usable()},
               {"grade", grade_name(v.grade)},
               {"verdict", v.line()},
               {"because", v.reason},
               {"but", v.buts},
               {"confirm", v.confirm},
               {"sensor", sensor(d.sensor)},
               {"frames", stamps(d.stamps)}};
  if (d.times.scans > 0) {
    json["times"] = {{"scans", d.times.scans},
                     {"spread_s", d.times.spread_s},
                     {"turn_s", d.times.turn_s},
                     {"fault", time_fault_name(d.times.fault)},
                     {"faulty", d.times.faulty}};
  }
  if (d.mount) {
    json["floor"] = floor_json(*d.mount);
    if (d.mount->likely.floor.is_found()) {
      json["road"] = road(d);
      json["body"] = near(d.mount->likely);
      json["range_noise"] = {{"m", d.mount->likely.noise.best_m()},
                             {"repeated_m", d.mount->likely.noise.repeated_m},
                             {"plane_m", d.mount->likely.noise.plane_m}};
    }
  }
  if (d.preview) json["check"] = preview(*d.preview);
  json["changes"] = changes(d.proposal);
  return json_text(json, 2) + "\n";
}

}  // namespace pose_wall::tools::doctor
