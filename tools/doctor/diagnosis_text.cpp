// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <cmath>

#include "angles.hpp"
#include "doctor/diagnosis_output.hpp"
#include "quantities.hpp"
#include "terminal/counted.hpp"
#include "terminal/text_table.hpp"

namespace pose_wall::tools::doctor {
namespace {

std::string percent(double share_of_all) {
  return fmt::format("{:.0f} %", 100.0 * share_of_all);
}

std::string metres(double m) {
  return std::isfinite(m) ? fmt::format("{:.2f} m", m) : "not seen";
}

std::string millimetres(double m) {
  return std::isfinite(m) ? fmt::format("{:.1f} mm", 1e3 * m) : "-";
}

std::string corners_text(const Box& box) {
  return fmt::format("x {:.2f} to {:.2f}, y {:.2f} to {:.2f}, z {:.2f} to {:.2f} m", box.low_m.x(), box.high_m.x(),
                     box.low_m.y(), box.high_m.y(), box.low_m.z(), box.high_m.z());
}

void add_sensor(TextTable& table, const Diagnosis& d) {
  const SensorSeen& s = d.sensor;
  table.add_row({"sensor", s.title,
                 fmt::format("{:.0f} returns a frame, {}, {:.1f} to {:.1f} deg, {} of the circle", s.returns,
                             s.rings > 0 ? counted(s.rings, "ring") : "no rings", s.elevation_min_deg,
                             s.elevation_max_deg, percent(s.azimuth_share))});
  table.add_row({"ranges", metres(s.range_median_m),
                 fmt::format("the median; 1 % below {:.2f}, 1 % beyond {:.1f} m", s.range_near_m, s.range_far_m)});
}

void add_frames(TextTable& table, const StampHealth& h) {
  table.add_row(
      {"frames", std::to_string(h.frames),
       fmt::format("{} unreadable, {} empty, {} cut, {} repeated", h.unreadable, h.empty, h.cut, h.repeated)});
  if (!h.has_stamps()) {
    table.add_row({"rate", h.rate_hz > 0.0 ? fmt::format("{:.1f} Hz", h.rate_hz) : "unknown",
                   "assumed (--rate): the frames carry no stamps"});
    return;
  }
  table.add_row({"rate", fmt::format("{:.2f} Hz", h.rate_hz),
                 fmt::format("{:.1f} s; steps within {:.1f} ms; {} (longest step {:.2f} s), {} still, {} back",
                             h.duration_s, 1e3 * h.jitter_s, counted(h.gaps, "gap"), h.gap_max_s, h.still, h.back)});
}

void add_floor(TextTable& table, const MountChoice& mount) {
  const FloorSeen& f = mount.story.floor;
  if (!f.is_found()) {
    table.add_row({"floor", "not seen", fmt::format("in {} of the frames", percent(f.measured))});
    return;
  }
  table.add_row({"floor", "seen in " + percent(f.measured),
                 fmt::format("valid in {}; {:.0f} points, {:.1f} m2, rms {}", percent(f.valid), f.points, f.area_m2,
                             millimetres(f.rms_m))});
  table.add_row({"mounted", mount.story.is_flipped ? "upside down" : "upright",
                 (mount.is_sure ? "" : "not certain: ") + mount.reason});
  table.add_row({"height", metres(f.height_m), "of the sensor above the floor, within " + metres(f.height_spread_m)});
  const api::Config& c = mount.story.config;
  table.add_row({"tilt", fmt::format("{:.2f} deg", mount.story.tilt_rad * kDegPerRad),
                 fmt::format("roll {:.2f}, pitch {:.2f} deg; within {:.2f} over the frames, protection level {:.2f}",
                             c.number("extrinsic_roll") * kDegPerRad, c.number("extrinsic_pitch") * kDegPerRad,
                             f.tilt_spread_rad * kDegPerRad, f.tilt_level_rad * kDegPerRad)});
}

void add_road(TextTable& table, const Diagnosis& d) {
  const MountStory& story = d.mount->story;
  if (!story.road.is_found) {
    table.add_row({"road", "not seen", "no side walls along any axis"});
    return;
  }
  const RoadAxis& r = story.road;
  table.add_row({"road", fmt::format("along {}", r.line),
                 fmt::format("{:.1f} deg off it, within {:.1f}; score {:.2f}, across {:.2f}",
                             r.off_line_rad * kDegPerRad, r.azimuth_spread_rad * kDegPerRad, r.score, r.rival_score)});
  table.add_row({"ahead", d.ahead.axis + (d.ahead.is_known ? "" : "?"), d.ahead.reason});
  const bool minus = d.ahead.axis[0] == '-';
  table.add_row({"walls", metres(minus ? r.right_m : r.left_m) + " left",
                 metres(minus ? r.left_m : r.right_m) + " right of the base origin, with " + d.ahead.axis + " ahead"});
  table.add_row({"roof", metres(story.ends.roof_m), "above the floor"});
}

void add_near(TextTable& table, const MountStory& story) {
  const RangeNoise& n = story.noise;
  table.add_row({"range noise", millimetres(n.best_m()),
                 fmt::format("{} from directions that came again ({} of them), {} off floor and walls, rock included",
                             millimetres(n.repeated_m), percent(n.repeated_share), millimetres(n.plane_m))});
  const BodySeen& b = story.body;
  if (b.slices < 2) {
    table.add_row({"body", "unknown", "one frame does not show what stays"});
    return;
  }
  table.add_row({"body", b.boxes_base.empty() ? "none seen" : counted(b.boxes_base.size(), "box", "boxes"),
                 fmt::format("{} of the returns; {} of the near ones moved", percent(b.in_boxes_share),
                             percent(b.passing_share))});
  for (const Box& box : b.boxes_base) table.add_row({"", "", corners_text(box)});
  for (const Box& box : b.unexplained) table.add_row({"", "no body?", corners_text(box)});
}

std::string check_text(const Check& check) {
  TextTable table({"by the proposed settings", "measured", "valid", "protection level"});
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::string level = !std::isfinite(check.level[q]) ? "-"
                              : is_angle(q)                  ? fmt::format("{:.2f} deg", check.level[q] * kDegPerRad)
                                                             : fmt::format("{:.3f} m", check.level[q]);
    table.add_row({pose_wall_quantity_name(q), percent(check.measured[q]), percent(check.valid[q]), level});
  }
  return table.text();
}

std::string list_text(const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = fmt::format("\n{}\n", title);
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

std::string changes_text(const Proposal& proposal, bool is_usable) {
  const char* const of_none = is_usable ? "\nno setting needs to be changed\n" : "\nno setting is proposed\n";
  if (proposal.changes().empty()) return of_none;
  TextTable table({"change", "from", "to", "because"});
  for (const Change& c : proposal.changes()) {
    table.add_row({c.key, c.before.empty() ? "none" : c.before, c.value, c.reason});
  }
  return "\n" + table.text(4);
}

}  // namespace

std::string diagnosis_text(const Diagnosis& d) {
  TextTable table({"what", "found", "how"});
  add_sensor(table, d);
  add_frames(table, d.stamps);
  if (d.mount) {
    add_floor(table, *d.mount);
    if (d.mount->story.floor.is_found()) {
      add_road(table, d);
      add_near(table, d.mount->story);
    }
  }
  std::string text = table.text(3);
  if (d.check) text += "\n" + check_text(*d.check);
  text += changes_text(d.proposal, d.verdict.is_usable());
  text += list_text("To confirm:", d.verdict.confirm);
  return text + "\n" + d.verdict.line() + "\n";
}

}  // namespace pose_wall::tools::doctor
