// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/sensors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "language/language.hpp"
#include "language/system_errors.hpp"
#include "packets/hesai.hpp"
#include "packets/ouster.hpp"
#include "packets/velodyne.hpp"
#include "terminal/did_you_mean.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kMetadataBytesMax = 1'000'000;  // of an Ouster it has 10 kB

std::optional<VelodyneModel> velodyne_model(SensorKind kind) {
  switch (kind) {
    case SensorKind::kVlp16:
      return VelodyneModel::kVlp16;
    case SensorKind::kVlp16HiRes:
      return VelodyneModel::kVlp16HiRes;
    case SensorKind::kHdl32e:
      return VelodyneModel::kHdl32e;
    case SensorKind::kVlp32c:
      return VelodyneModel::kVlp32c;
    default:
      return std::nullopt;
  }
}

std::optional<HesaiModel> hesai_model(SensorKind kind) {
  switch (kind) {
    case SensorKind::kHesaiXt32:
      return HesaiModel::kXt32;
    case SensorKind::kHesai40p:
      return HesaiModel::kPandar40p;
    case SensorKind::kHesaiQt64:
      return HesaiModel::kQt64;
    default:
      return std::nullopt;
  }
}

// An assembler for whatever is heard first.
class AutomaticAssembler : public ScanAssembler {
 public:
  explicit AutomaticAssembler(SensorChoice choice) : choice_(std::move(choice)) {}

  bool add(const Datagram& datagram) override {
    if (!inner_ && !begin(datagram.payload)) return false;
    const bool is_data = inner_->add(datagram);
    pass_on();
    return is_data;
  }

  void finish() override {
    if (!inner_) return;
    inner_->finish();
    pass_on();
  }

  const char* kind() const override { return inner_ ? inner_->kind() : "packets of no known sensor"; }
  bool stamps_are_of_arrival() const override { return !inner_ || inner_->stamps_are_of_arrival(); }

 private:
  bool begin(ByteView payload) {
    const bool is_other = is_velodyne_data(payload) || is_mid360_data(payload);
    if (is_other && !choice_.metadata.empty()) {
      throw FrameError(tr("angles of a Hesai are given as metadata, but the packets are of a sensor that has none"));
    }
    if (is_velodyne_data(payload)) {
      inner_ = std::make_unique<VelodyneAssembler>();
    } else if (hesai_model_of(payload)) {
      inner_ = std::make_unique<HesaiAssembler>(std::nullopt, choice_.metadata);
    } else if (is_mid360_data(payload)) {
      inner_ = std::make_unique<Mid360Assembler>(choice_.frame_ns);
    }
    return inner_ != nullptr;
  }

  void pass_on() {
    while (std::optional<Scan> scan = inner_->take()) push(std::move(*scan));
  }

  SensorChoice choice_;
  std::unique_ptr<ScanAssembler> inner_;
};

// Angles for sensors of so many lasers are metadata; anything else is a mistake that is better told at once.
void check_angles(const std::string& text) {
  std::string why;
  for (const HesaiModel model : {HesaiModel::kXt32, HesaiModel::kPandar40p, HesaiModel::kQt64}) {
    try {
      parse_hesai_angles(text, hesai_traits(model).lasers());
      return;
    } catch (const FrameError& fault) {
      why = fault.what();
    }
  }
  throw FrameError(say("it is neither a JSON object, as of an Ouster, nor a table of angles of a Hesai: {}", why));
}

std::string read_metadata(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FrameError(say("metadata {}: cannot be opened for reading: {}", path, system_error_text(errno)));
  std::string text(kMetadataBytesMax + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMetadataBytesMax) {
    throw FrameError(say("metadata {}: more than {} bytes; this is no metadata", path, kMetadataBytesMax));
  }
  if (text.empty()) throw FrameError(say("metadata {}: the file is empty", path));
  return text;
}

void check_metadata(const SensorChoice& choice) {
  const KnownSensor& sensor = known_sensor(choice.kind);
  if (choice.metadata.empty() && sensor.needs_metadata) {
    throw FrameError(say("packets of an {} are read with its metadata, which is missing", sensor.title));
  }
  if (choice.metadata.empty()) return;
  if (choice.kind == SensorKind::kAutomatic) {
    if (!is_ouster_metadata(choice.metadata)) check_angles(choice.metadata);
    return;
  }
  if (sensor.metadata == SensorMetadata::kNone) {
    throw FrameError(say("metadata is given, but a {} ({}) has none", sensor.title, sensor.name));
  }
  if (sensor.metadata == SensorMetadata::kHesaiAngles && is_ouster_metadata(choice.metadata)) {
    throw FrameError(say("the metadata is JSON, as of an Ouster; a {} takes a table of angles", sensor.title));
  }
}

}  // namespace

bool is_ouster_metadata(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string::npos && text[begin] == '{';
}

const std::vector<KnownSensor>& known_sensors() {
  // Ports: the makers' manuals.
  static const std::vector<KnownSensor> sensors = {
      {SensorKind::kAutomatic, "auto", "sensor that its packets name", 0, SensorMetadata::kNone, false},
      {SensorKind::kVlp16, "vlp16", "Velodyne VLP-16", 2368, SensorMetadata::kNone, false},
      {SensorKind::kVlp16HiRes, "vlp16_hires", "Velodyne Puck Hi-Res", 2368, SensorMetadata::kNone, false},
      {SensorKind::kHdl32e, "hdl32e", "Velodyne HDL-32E", 2368, SensorMetadata::kNone, false},
      {SensorKind::kVlp32c, "vlp32c", "Velodyne VLP-32C", 2368, SensorMetadata::kNone, false},
      {SensorKind::kOuster, "ouster", "Ouster", 7502, SensorMetadata::kOusterJson, true},
      {SensorKind::kHesaiXt32, "hesai_xt32", "Hesai PandarXT-32", 2368, SensorMetadata::kHesaiAngles, false},
      {SensorKind::kHesai40p, "hesai_40p", "Hesai Pandar40P", 2368, SensorMetadata::kHesaiAngles, false},
      {SensorKind::kHesaiQt64, "hesai_qt64", "Hesai PandarQT", 2368, SensorMetadata::kHesaiAngles, false},
      {SensorKind::kMid360, "mid360", "Livox Mid-360", 56301, SensorMetadata::kNone, false}};
  return sensors;
}

const KnownSensor& known_sensor(SensorKind kind) {
  return known_sensors()[static_cast<std::size_t>(kind)];
}

std::vector<std::string> sensor_names() {
  std::vector<std::string> names;
  for (const KnownSensor& sensor : known_sensors()) names.emplace_back(sensor.name);
  return names;
}

std::optional<SensorKind> sensor_by_name(std::string_view name) {
  for (const KnownSensor& sensor : known_sensors()) {
    if (sensor.name == name) return sensor.kind;
  }
  return std::nullopt;
}

SensorChoice choose_sensor(const SensorOptions& options) {
  SensorChoice choice;
  if (!options.sensor.empty()) {
    const std::optional<SensorKind> kind = sensor_by_name(options.sensor);
    if (!kind) {
      throw FrameError(say("sensor '{}' is not known{}; known are {}", options.sensor,
                           did_you_mean(options.sensor, sensor_names()), fmt::join(sensor_names(), ", ")));
    }
    choice.kind = *kind;
  }
  if (options.metadata.empty()) return choice;
  choice.metadata = read_metadata(options.metadata);
  try {
    make_assembler(choice);
  } catch (const FrameError& fault) {
    throw FrameError(say("metadata {}: {}", options.metadata, fault.what()));
  }
  return choice;
}

std::unique_ptr<ScanAssembler> make_assembler(const SensorChoice& choice) {
  check_metadata(choice);
  if (const std::optional<VelodyneModel> model = velodyne_model(choice.kind)) {
    return std::make_unique<VelodyneAssembler>(model);
  }
  if (const std::optional<HesaiModel> model = hesai_model(choice.kind)) {
    return std::make_unique<HesaiAssembler>(model, choice.metadata);
  }
  if (choice.kind == SensorKind::kMid360) return std::make_unique<Mid360Assembler>(choice.frame_ns);
  if (choice.kind == SensorKind::kOuster || is_ouster_metadata(choice.metadata)) {
    return std::make_unique<OusterAssembler>(parse_ouster_metadata(choice.metadata));
  }
  return std::make_unique<AutomaticAssembler>(choice);
}

std::optional<SensorKind> recognise_sensor(ByteView payload) {
  if (is_velodyne_data(payload)) {
    for (const KnownSensor& sensor : known_sensors()) {
      const std::optional<VelodyneModel> model = velodyne_model(sensor.kind);
      if (model && velodyne_traits(*model).product == velodyne_product(payload)) return sensor.kind;
    }
  }
  if (const std::optional<HesaiModel> found = hesai_model_of(payload)) {
    for (const KnownSensor& sensor : known_sensors()) {
      if (hesai_model(sensor.kind) == found) return sensor.kind;
    }
  }
  if (is_mid360_data(payload)) return SensorKind::kMid360;
  return std::nullopt;
}

std::string unread_sensor(ByteView payload) {
  // Blocks of the second to the fourth 32 lasers have flags of their own.
  if (payload.size == kVelodyneBytes && little_endian_at(payload, 0, 1) == 0xFF &&
      (little_endian_at(payload, 1, 1) == 0xEE || little_endian_at(payload, 1, 1) == 0xDD) &&
      little_endian_at(payload, kVelodyneBlockBytes, 2) == 0xDDFF) {
    return "a Velodyne of 64 or 128 lasers";
  }
  return unread_hesai(payload);
}

}  // namespace pose_wall::tools
