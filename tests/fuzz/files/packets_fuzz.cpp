// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as datagrams of a sensor, as they come from the network. The first byte chooses the sensor, the
// second how long frames without turns are, or what an Ouster's metadata tells. Then come datagrams behind their length
// (two bytes) and the time since the one before (one byte, signed, ms).

#include <algorithm>
#include <string>

#include "fuzz/files/reader_target.hpp"
#include "io/packets/ouster_profiles.hpp"
#include "io/packets/sensors.hpp"

namespace pose_wall::test {
namespace {

// The engine takes milliseconds a scan, the reader microseconds a datagram. All scans are looked at, some are measured.
constexpr std::size_t kScansToProcess = 8;

void take_scans(tools::ScanAssembler& assembler, std::size_t& taken) {
  while (const std::optional<tools::Scan> scan = assembler.take()) {
    require(scan->rings > 0 && !scan->points.empty() && scan->points.size() % scan->rings == 0, "rows of one length");
    if (taken++ < kScansToProcess) take_frame(tools::frame_of(*scan));
  }
}

void feed(tools::ScanAssembler& assembler, const std::uint8_t* data, std::size_t size) {
  std::int64_t captured_ns = 1'700'000'000'000'000'000;
  std::size_t taken = 0;
  while (size > 3) {
    const std::size_t length = std::min<std::size_t>(data[0] + 256U * data[1], size - 3);
    captured_ns += std::int64_t{1'000'000} * static_cast<std::int8_t>(data[2]);
    // Bytes of its own, so that a step beyond them is seen.
    const tools::Bytes payload(reinterpret_cast<const std::byte*>(data + 3),
                               reinterpret_cast<const std::byte*>(data + 3 + length));
    tools::Datagram datagram;
    datagram.captured_ns = captured_ns;
    datagram.from.address = 1;
    datagram.payload = {payload.data(), payload.size()};
    assembler.add(datagram);
    tools::recognise_sensor(datagram.payload);
    tools::unread_sensor(datagram.payload);
    take_scans(assembler, taken);
    data += 3 + length;
    size -= 3 + length;
  }
  assembler.finish();
  take_scans(assembler, taken);
  require(assembler.kind()[0] != '\0', "a name");
}

// Two rings, 64 columns a turn, four a packet. The byte chooses the profile, the head and a window.
std::string ouster_metadata(std::uint8_t choice) {
  const auto& profiles = tools::ouster_profiles();
  std::string text =
      R"({"prod_sn":"122201000111","beam_altitude_angles":[10,-10],"beam_azimuth_angles":[0,1],)"
      R"("lidar_origin_to_beam_origin_mm":15.8,"lidar_to_sensor_transform":[1,0,0,0,0,1,0,0,0,0,1,36,0,0,0,1],)"
      R"("data_format":{"pixels_per_column":2,"columns_per_frame":64,"columns_per_packet":4,"udp_profile_lidar":")";
  text += profiles[choice % 16U % profiles.size()].name;
  text += (choice & 16U) != 0 ? R"(","header_type":"FUSA)" : R"(","header_type":"STANDARD)";
  text += (choice & 32U) != 0 ? R"(","column_window":[56,9]}})" : R"("}})";
  return text;
}

}  // namespace
}  // namespace pose_wall::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pose_wall;
  if (size < 2) return 0;
  tools::SensorChoice choice;
  choice.kind = tools::known_sensors()[data[0] % tools::known_sensors().size()].kind;
  if (choice.kind == tools::SensorKind::kOuster) choice.metadata = test::ouster_metadata(data[1]);
  choice.frame_ns = (data[1] + 1) * std::int64_t{1'000'000};
  try {
    test::feed(*tools::make_assembler(choice), data + 2, size - 2);
  } catch (const tools::FrameError& error) {
    test::require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
