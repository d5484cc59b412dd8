// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as datagrams of a sensor, as they come from the network. The first byte chooses the sensor, the
// second how long frames without turns are; then come datagrams behind their length (two bytes) and the time since the
// one before (one byte, signed, ms).

#include <algorithm>

#include "fuzz/files/reader_target.hpp"
#include "packets/sensors.hpp"

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
    datagram.source_address = 1;
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

}  // namespace
}  // namespace pose_wall::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pose_wall;
  if (size < 2) return 0;
  tools::SensorChoice choice;
  choice.kind = tools::known_sensors()[data[0] % tools::known_sensors().size()].kind;
  choice.frame_ns = (data[1] + 1) * std::int64_t{1'000'000};
  try {
    test::feed(*tools::make_assembler(choice), data + 2, size - 2);
  } catch (const tools::FrameError& error) {
    test::require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
