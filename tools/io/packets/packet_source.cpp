// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/packet_source.hpp"

#include <string>
#include <utility>

#include "io/frames/file_content.hpp"
#include "io/language/language.hpp"
#include "io/packets/ouster_metadata.hpp"
#include "io/packets/packet_frames.hpp"
#include "io/packets/udp_capture.hpp"

namespace pose_wall::tools {
bool is_packet_capture(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  const FileContent content = content_of(beginning_of(file));
  if (content == FileContent::kCapture) return true;
  return ending_decides(content) && (file.extension() == ".pcap" || file.extension() == ".pcapng");
}

std::unique_ptr<FrameSource> open_packet_capture(const std::filesystem::path& file, const SensorOptions& options) {
  std::error_code unknown;
  if (std::filesystem::file_size(file, unknown) == 0) throw FrameError(tr("the file is empty"));
  SensorOptions described = options;
  const std::filesystem::path beside = ouster_metadata_beside(file);
  const bool may_be_ouster = options.sensor.empty() || options.sensor == known_sensor(SensorKind::kAutomatic).name ||
                             options.sensor == known_sensor(SensorKind::kOuster).name;
  PacketRecording recording;
  std::error_code ignored;
  if (options.metadata.empty() && may_be_ouster) {
    if (std::filesystem::exists(beside, ignored)) {
      described.metadata = beside.string();
    } else {
      recording.ouster_hint =
          "its metadata would be " + beside.string() + ", which is not there, or what --metadata names";
    }
  }
  recording.name = file.string();
  recording.open = [path = file.string()] { return open_udp_capture(path); };
  return std::make_unique<PacketFrames>(std::move(recording), choose_sensor(described));
}

}  // namespace pose_wall::tools
