// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "recorded_frames.hpp"

#include <Eigen/Core>
#include <deque>
#include <stdexcept>

#include "io/config_file/load_config.hpp"
#include "io/frames/input_list.hpp"
#include "io/frames/load_frame.hpp"
#include "io/frames/point_position.hpp"

namespace pose_wall::bench {
namespace {

struct RecordedFrame {
  tools::Frame file;
  tools::sim::Frame packed;
};

tools::sim::Frame packed(const pose_wall_cloud& cloud) {
  tools::sim::Frame out;
  out.labels.resize(static_cast<std::size_t>(cloud.width) * cloud.height);
  out.xyz_intensity.reserve(4 * out.labels.size());
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const Eigen::Vector3f p = tools::point_position(cloud, row, column).cast<float>();
      out.xyz_intensity.insert(out.xyz_intensity.end(), {p.x(), p.y(), p.z(), 1.0F});
    }
  }
  return out;
}

Recording negative(const std::string& stem, const std::string& ending, const std::string& config_file) {
  return {"not_a_road_" + stem, "negative/" + stem + ending, config_file, {}, false};
}

}  // namespace

// Settings as in tests/real.
const std::vector<Recording>& recordings() {
  static const std::vector<Recording> all = {
      {"corridor_vlp16", "corridor_vlp16", "vlp16.yaml", {"forward_axis=+Y"}, true},
      {"hall_rotating", "hall_rotating", "vlp16.yaml", {"body_box_1=-0.6 0.6 -0.6 0.6 -0.6 0.4"}, false},
      {"corridor_sick", "corridor_sick", "", {"range_min=0.5"}, false},
      {"hall_tilted_os0", "hall_tilted_os0", "", {}, false},
      {"room_dense", "room_dense", "", {}, false},
      negative("odd_6281_points", ".pcd", "vlp16.yaml"),
      negative("lab_no_floor_vlp16", ".pcd", "vlp16.yaml"),
      negative("street_one_wall_os0_32", ".pcd", ""),
      negative("lab_cluttered_qt64", ".pcd", ""),
      negative("street_kitti", ".bin", ""),
  };
  return all;
}

FrameInput recorded_input(const std::filesystem::path& data, const Recording& recording) {
  const std::filesystem::path config_folder = POSE_WALL_CONFIG_FOLDER;
  const std::string config_file = recording.config_file.empty() ? "" : (config_folder / recording.config_file).string();
  FrameInput input;
  input.config = tools::load_config(config_file, recording.settings).config;
  input.in_sequence = recording.in_sequence;
  const tools::FrameInputs found = tools::collect_inputs({(data / recording.path).string()});
  if (!found.errors.empty()) throw std::runtime_error(found.errors.front());
  const auto kept = std::make_shared<std::deque<RecordedFrame>>();  // grows without moving what is pointed into
  for (const std::filesystem::path& path : found.files) {
    RecordedFrame& frame = kept->emplace_back();
    frame.file = tools::load_frame(path);
    frame.packed = packed(frame.file.cloud);
    input.frames.push_back({frame.file.cloud, &frame.packed});
  }
  input.storage = kept;
  return input;
}

}  // namespace pose_wall::bench
