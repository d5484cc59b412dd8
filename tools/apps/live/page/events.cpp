// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/page/events.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/live/result_json.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "study/report/page.hpp"
#include "study/report/page_data.hpp"

namespace pose_wall::tools::live {
namespace {

// Of a frame; more cannot be told apart on a screen.
constexpr std::size_t kPointsMost = 6000;

// JSON text has no line breaks, so one line of data is enough.
std::string event(const char* name, const std::string& data) {
  return fmt::format("event: {}\ndata: {}\n\n", name, data);
}

}  // namespace

std::string hello_event(const LoadedConfig& loaded) {
  report::PageHead head;
  head.title = fmt::format("pose_walld {}", pose_wall_version());
  const ResolvedFrames frames = resolve_frames(loaded.config);
  const Json mount = {{"position_m", frames.extrinsic_position_m},
                      {"roll_pitch_yaw_deg", frames.extrinsic_roll_pitch_yaw_deg},
                      {"sampling_points_m", frames.sampling_points_base_m}};
  const PlanarSettings& planar = loaded.planar;
  const pose_wall_planar_stop_settings stop = stop_settings_of(planar);
  const Json roadway = {
      {"mode", planar.mode},         {"outline_m", {planar.x_min_m, planar.x_max_m, planar.y_min_m, planar.y_max_m}},
      {"floor_z_m", stop.floor_z_m}, {"top_m", stop.top_m},
      {"latency_s", stop.latency_s}, {"deceleration_m_s2", stop.deceleration_m_s2}};
  return event("hello", json_text({{"head", report::head_json(head, loaded)},
                                   {"words", report::words_json()},
                                   {"mount", mount},
                                   {"commissioning", loaded.live.commissioning},
                                   {"planar", planar.is_on() ? roadway : Json(nullptr)}}));
}

std::string frame_event(const LiveResult& result) {
  api::Config config;
  *config.get() = result.config;
  report::PageData data(config, 1, kPointsMost);
  if (result.frame && result.points) {
    const LabelledPoints& points = *result.points;
    pose_wall_points view{};
    view.x_base_m = points.x_base_m.data();
    view.y_base_m = points.y_base_m.data();
    view.z_base_m = points.z_base_m.data();
    view.label = points.label.data();
    view.count = static_cast<std::uint32_t>(points.label.size());
    data.look(result.frame->frame.cloud, view, result.publication.result);
  }
  FrameOutcome outcome;
  outcome.frame = result.publication.frame;
  outcome.stamp_ns = result.header_stamp_ns;
  outcome.result = result.publication.result;
  data.add(outcome);
  data.add_truth({nullptr});
  const bool is_frame = result.publication.cause == POSE_WALL_RUNTIME_FRAME;
  return event("frame", json_text({{"told_by", is_frame ? "frame" : "silence"},
                                   {"frame", result.publication.frame},
                                   {"age_ms", static_cast<double>(result.publication.age_ns) * 1e-6},
                                   {"data", data.json()}}));
}

std::string health_event(const std::vector<PartHealth>& parts) {
  return event("health", health_in_both_json(parts));
}

}  // namespace pose_wall::tools::live
