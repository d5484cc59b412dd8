// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/packet_source.hpp"

#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "packets/packet_frames.hpp"
#include "packets/udp_capture.hpp"

namespace pose_wall::tools {
namespace {

using namespace std::string_view_literals;

constexpr std::array<std::string_view, 5> kMagics = {"\xD4\xC3\xB2\xA1"sv, "\xA1\xB2\xC3\xD4"sv, "\x4D\x3C\xB2\xA1"sv,
                                                     "\xA1\xB2\x3C\x4D"sv, "\x0A\x0D\x0D\x0A"sv};

}  // namespace

bool is_packet_capture(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 4> beginning{};
  stream.read(beginning.data(), beginning.size());
  const std::string_view found(beginning.data(), static_cast<std::size_t>(stream.gcount()));
  for (const std::string_view magic : kMagics) {
    if (found == magic) return true;
  }
  return file.extension() == ".pcap" || file.extension() == ".pcapng";
}

std::unique_ptr<FrameSource> open_packet_capture(const std::filesystem::path& file, const SensorOptions& options) {
  SensorOptions described = options;
  const std::filesystem::path beside = std::filesystem::path(file).replace_extension(".json");
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
