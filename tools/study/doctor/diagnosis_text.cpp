// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"
#include "io/terminal/text_table.hpp"
#include "study/doctor/diagnosis_output.hpp"
#include "study/info/wide_text.hpp"

namespace pose_wall::tools::doctor {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string percent(double share_of_all) {
  return fmt::format("{:.0f} %", 100.0 * share_of_all);
}

std::string metres(double m) {
  return std::isfinite(m) ? fmt::format("{:.2f} m", m) : tr("not seen");
}

std::string millimetres(double m) {
  return std::isfinite(m) ? fmt::format("{:.1f} mm", 1e3 * m) : "-";
}

std::string corners_text(const Box& box) {
  return say("x {:.2f} to {:.2f}, y {:.2f} to {:.2f}, z {:.2f} to {:.2f} m", box.low_m.x(), box.high_m.x(),
             box.low_m.y(), box.high_m.y(), box.low_m.z(), box.high_m.z());
}

void add_sensor(Rows& rows, const SensorFacts& s) {
  if (s.ranges.max_m == 0.0) {
    rows.push_back({tr("sensor"), tr("unknown"), tr("no frame has a return")});
    return;
  }
  rows.push_back({tr("sensor"), s.is_known() ? s.title : tr("unknown"), s.is_known() ? config_text(s) : class_text(s)});
  rows.push_back({tr("rings"), rings_text(s), rings_source_text(s)});
  rows.push_back({tr("view"), say("{:.0f} deg of azimuth", s.azimuth_span_deg),
                  say("elevation {:.1f} to {:.1f} deg; {:.0f} returns per frame", s.elevation_min_deg,
                      s.elevation_max_deg, s.returns)});
  rows.push_back({tr("ranges"), metres(s.ranges.median_m), ranges_text(s.ranges)});
}

void add_frames(Rows& rows, const StampHealth& h) {
  rows.push_back({tr("frames"), std::to_string(h.frames),
                  say("unreadable: {}, empty: {}, cut: {}, repeated: {}", h.unreadable, h.empty, h.cut, h.repeated)});
  const std::string rate = h.rate_hz > 0.0 ? fmt::format("{:.2f} Hz", h.rate_hz) : tr("unknown");
  rows.push_back(
      {tr("rate"), rate, h.has_stamps() ? steps_text(h) : tr("assumed (--rate): the frames carry no stamps")});
}

void add_floor(Rows& rows, const MountChoice& mount) {
  const FloorSeen& f = mount.likely.floor;
  if (!f.is_found()) {
    rows.push_back({tr("floor"), tr("not seen"), say("found in {} of the frames", percent(f.measured))});
    return;
  }
  rows.push_back({tr("floor"), say("in {} of the frames", percent(f.measured)),
                  say("{:.0f} points, {:.1f} m2, rms {}", f.points, f.area_m2, millimetres(f.rms_m))});
  const std::string reason = mount.is_sure ? mount.reason : say("not certain: {}", mount.reason);
  rows.push_back({tr("mounted"), mount.likely.is_flipped ? tr("upside down") : tr("upright"), reason});
  rows.push_back(
      {tr("height"), metres(f.height_m), say("of the sensor above the floor, within {}", metres(f.height_spread_m))});
  const api::Config& c = mount.likely.config;
  rows.push_back({tr("tilt"), fmt::format("{:.2f} deg", mount.likely.tilt_rad * kDegPerRad),
                  say("extrinsic roll {:.2f}, pitch {:.2f} deg; within {:.2f} over the frames, protection level {:.2f}",
                      c.number("extrinsic_roll") * kDegPerRad, c.number("extrinsic_pitch") * kDegPerRad,
                      f.tilt_spread_rad * kDegPerRad, f.tilt_level_rad * kDegPerRad)});
}

void add_road(Rows& rows, const Diagnosis& d) {
  const SupposedMount& supposed = d.mount->likely;
  if (!supposed.road.is_found) {
    rows.push_back({tr("road"), tr("not seen"), tr("no side walls are seen along any axis")});
    return;
  }
  const RoadAxis& r = supposed.road;
  rows.push_back({tr("road"), say("along {}", r.line),
                  say("{:.1f} deg off it, within {:.1f}; score {:.2f}, across {:.2f}", r.off_line_rad * kDegPerRad,
                      r.azimuth_spread_rad * kDegPerRad, r.score, r.rival_score)});
  rows.push_back({tr("ahead"), d.ahead.axis + (d.ahead.is_known ? "" : "?"), d.ahead.reason});
  const bool minus = d.ahead.axis[0] == '-';
  rows.push_back(
      {tr("walls"), say("{} left", metres(minus ? r.right_m : r.left_m)),
       say("{} right of the base origin, with {} ahead", metres(minus ? r.left_m : r.right_m), d.ahead.axis)});
  rows.push_back({tr("roof"), metres(supposed.ends.roof_m), tr("above the floor")});
}

void add_near(Rows& rows, const SupposedMount& supposed) {
  const RangeNoise& n = supposed.noise;
  rows.push_back({tr("range noise"), millimetres(n.best_m()),
                  say("{} in directions that came again ({} of all); {} off floor and walls, rock included",
                      millimetres(n.repeated_m), percent(n.repeated_share), millimetres(n.plane_m))});
  const BodySeen& b = supposed.body;
  if (b.slices < 2) {
    rows.push_back({tr("body"), tr("unknown"), tr("a single frame does not show what stays in place")});
    return;
  }
  rows.push_back(
      {tr("body"), b.boxes_base.empty() ? tr("none seen") : say("boxes: {}", b.boxes_base.size()),
       say("{} of the returns; {} of the near ones moved", percent(b.in_boxes_share), percent(b.passing_share))});
  for (const Box& box : b.boxes_base) rows.push_back({"", "", corners_text(box)});
  for (const LeftOut& one : b.left_out) {
    rows.push_back({"", tr("no box"), fmt::format("{}: {}", corners_text(one.box_base), tr(one.why))});
  }
}

std::string preview_text(const Preview& seen) {
  TextTable table({tr("with the proposed settings"), tr("valid"), tr("degraded"), tr("held"), tr("invalid"),
                   tr("protection level")});
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::string level = !std::isfinite(seen.level[q]) ? "-"
                              : is_angle(q)                 ? fmt::format("{:.2f} deg", seen.level[q] * kDegPerRad)
                                                            : fmt::format("{:.3f} m", seen.level[q]);
    const double rest = std::max(0.0, 1.0 - seen.valid[q] - seen.degraded[q] - seen.held[q]);
    table.add_row({pose_wall_quantity_name(q), percent(seen.valid[q]), percent(seen.degraded[q]), percent(seen.held[q]),
                   seen.frames > 0 ? percent(rest) : "-", level});
  }
  return table.text() + say("All {} readable frames in their order, as `pose_wall run` measures them.\n", seen.frames);
}

std::string list_text(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += hanging("  -", line, 4, kLineWidth);
  return text;
}

std::string changes_text(const Proposal& proposal, bool is_usable) {
  if (proposal.changes().empty()) {
    return fmt::format("\n{}\n", is_usable ? tr("No setting needs to be changed.") : tr("No setting is proposed."));
  }
  Rows rows;
  std::string before;
  for (const Change& c : proposal.changes()) {
    const bool is_same = c.reason == before;
    rows.push_back({c.key, c.before.empty() ? tr("none") : c.before, c.value, is_same ? tr("as above") : c.reason});
    before = c.reason;
  }
  return "\n" + wrapped_table({tr("setting"), tr("now"), tr("proposed"), tr("because")}, rows);
}

}  // namespace

std::string diagnosis_text(const Diagnosis& d) {
  Rows rows;
  add_sensor(rows, d.sensor);
  add_frames(rows, d.stamps);
  if (d.mount) {
    add_floor(rows, *d.mount);
    if (d.mount->likely.floor.is_found()) {
      add_road(rows, d);
      add_near(rows, d.mount->likely);
    }
  }
  std::string text = wrapped_table({tr("what"), tr("found"), tr("how")}, rows);
  if (d.preview) text += "\n" + preview_text(*d.preview);
  text += changes_text(d.proposal, d.verdict.is_usable());
  if (!d.verdict.confirm.empty()) text += fmt::format("\n{}\n", tr("To confirm:")) + list_text(d.verdict.confirm);
  text += fmt::format("\n{}\n", tr("Verdict:")) + wrapped(d.verdict.headline(), 2, kLineWidth - 2);
  return text + list_text(d.verdict.buts) + wrapped(rule_text(), 2, kLineWidth - 2);
}

}  // namespace pose_wall::tools::doctor
