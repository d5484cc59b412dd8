// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which sensor packets are of: chosen by name, or told by the packets; for captures, bags and live reception alike.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/packets/livox.hpp"
#include "io/packets/scan.hpp"

namespace pose_wall::tools {

enum class SensorKind {
  kAutomatic,
  kVlp16,
  kVlp16HiRes,
  kHdl32e,
  kVlp32c,
  kOuster,
  kHesaiXt32,
  kHesai40p,
  kHesaiQt64,
  kMid360,
  kLslidarC16,
  kLslidarC16Of15,
  kLslidarC16Of10,
  kLslidarC32,
  kLslidarC32w,
  kLslidarCh32r,
  kLslidarC8,
  kLslidarCh128x1,
  kRoboSense16,
  kRoboSense32,
  kRoboSenseHelios32,
  kRoboSenseHelios16p,
  kRoboSenseBpearl,
  kRoboSenseBpearl4,
  kRoboSenseAiry,
  kRoboSenseM1,
  kHesaiXt16,
  kMid360s,
  kLivoxHap,
  kAvia2,
  kHesaiXt32m,
  kHesaiQt128,
  kHesaiPandar64
};

enum class SensorMetadata { kNone, kOusterJson, kHesaiAngles, kRoboSenseDevice };

struct KnownSensor {
  SensorKind kind;
  const char* name;    // as options name it: "hesai_xt32"
  const char* title;   // "Hesai PandarXT-32"
  std::uint16_t port;  // of data, as it leaves the factory; 0: none of its own
  SensorMetadata metadata;
  bool needs_metadata;
  std::uint16_t device_port = 0;  // of what a sensor says of itself, where that comes by a port of its own
};

// All, kAutomatic ("auto") first.
const std::vector<KnownSensor>& known_sensors();
const KnownSensor& known_sensor(SensorKind kind);
std::vector<std::string> sensor_names();
std::optional<SensorKind> sensor_by_name(std::string_view name);

// Whether this metadata is JSON, as an Ouster has it, and no table of angles of a Hesai.
bool is_ouster_metadata(const std::string& text);

struct SensorChoice {
  SensorKind kind = SensorKind::kAutomatic;
  std::string metadata;  // JSON of an Ouster, table of angles of a Hesai, device packet of a RoboSense; "": none
  std::int64_t frame_ns = kLivoxFrame_ns;  // of sensors without a turn
  std::string source;                      // the sender to read; "": the first whose turn is whole
};

// The same as people write it, in options and settings.
struct SensorOptions {
  std::string sensor;       // a name of known_sensors(); "": automatic
  std::string metadata;     // a file; "": none
  std::string source = {};  // a sender, as SourceIdentity::is_named takes it; "": the first whose turn is whole
};

// Reads the metadata. Throws FrameError for a name that is not known, with the one that was meant, and for a file that
// cannot be read or is no metadata of such a sensor.
SensorChoice choose_sensor(const SensorOptions& options);

// For one sensor; the datagrams of all ports may be handed to it. Automatic: told by the first data packets; an Ouster
// has to be described by its metadata, for its packets do not say what they are. Throws FrameError for metadata that is
// missing, wrong, or of another kind of sensor. Its add() and finish() throw FrameError where packets contradict
// themselves or what was chosen: which then stands for all packets of this sensor.
std::unique_ptr<ScanAssembler> make_assembler(const SensorChoice& choice);

// Whose data packet this is, where a packet alone tells; nothing for an Ouster's and a Livox'. Of Velodyne's the
// product byte counts, which first VLP-16s had as an HDL-32E: make_assembler looks at more than one.
std::optional<SensorKind> recognise_sensor(ByteView payload);

// The same in words, by its ports as well: "Livox HAP", "Livox Mid-360, Mid-360S or Avia 2"; nullptr for no data.
const char* recognised_title(const Datagram& datagram);

// What these bytes are data of, where it is known and not read: "a Hesai of 128 lasers in 2 blocks"; else "".
std::string unread_sensor(ByteView payload);

}  // namespace pose_wall::tools
