// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/sensors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"
#include "io/packets/hesai.hpp"
#include "io/packets/lslidar.hpp"
#include "io/packets/lslidar_hybrid.hpp"
#include "io/packets/ouster.hpp"
#include "io/packets/robosense.hpp"
#include "io/packets/robosense_evidence.hpp"
#include "io/packets/robosense_m1.hpp"
#include "io/packets/velodyne.hpp"
#include "io/terminal/did_you_mean.hpp"

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
    case SensorKind::kHesaiXt16:
      return HesaiModel::kXt16;
    case SensorKind::kHesaiXt32m:
      return HesaiModel::kXt32m;
    case SensorKind::kHesaiQt128:
      return HesaiModel::kQt128;
    case SensorKind::kHesaiPandar64:
      return HesaiModel::kPandar64;
    default:
      return std::nullopt;
  }
}

std::optional<LivoxModel> livox_model(SensorKind kind) {
  switch (kind) {
    case SensorKind::kMid360:
      return LivoxModel::kMid360;
    case SensorKind::kMid360s:
      return LivoxModel::kMid360s;
    case SensorKind::kLivoxHap:
      return LivoxModel::kHap;
    case SensorKind::kAvia2:
      return LivoxModel::kAvia2;
    default:
      return std::nullopt;
  }
}

// Of what is named the models that it may be; none for another maker's.
std::vector<LslidarModel> lslidar_models(SensorKind kind) {
  using Model = LslidarModel;
  switch (kind) {
    case SensorKind::kLslidarC16:
      return {Model::kC16V3, Model::kC16V4, Model::kC16V4B, Model::kC16V5};
    case SensorKind::kLslidarC16Of15:
    case SensorKind::kLslidarC16Of10:
      return {Model::kC16V3};
    case SensorKind::kLslidarC32:
      return {Model::kC32V3, Model::kC32V4, Model::kC32V5};
    case SensorKind::kLslidarC32w:
      return {Model::kC32W45, Model::kC32W46, Model::kC32W47, Model::kC32W48};
    case SensorKind::kLslidarCh32r:
      return {Model::kCh32r5a, Model::kCh32r5d};
    case SensorKind::kLslidarC8:
      return {Model::kC8, Model::kC8f, Model::kCkm8};
    default:
      return {};
  }
}

LslidarChoice lslidar_choice(SensorKind kind) {
  LslidarChoice choice;
  choice.models = lslidar_models(kind);
  if (kind == SensorKind::kLslidarC16Of15) choice.of_first_kind = &lslidar_traits(LslidarModel::kC16V3).beams;
  if (kind == SensorKind::kLslidarC16Of10) choice.of_first_kind = &beam_table("lslidar-c16-v3-narrow");
  choice.title = known_sensor(kind).title;
  choice.word = known_sensor(kind).name;
  return choice;
}

std::optional<RoboSenseModel> robosense_model(SensorKind kind) {
  for (const RoboSenseTraits& traits : robosense_sensors()) {
    if (known_sensor(kind).name == std::string_view(traits.word)) return traits.model;
  }
  return std::nullopt;
}

bool is_robosense_metadata(const std::string& metadata) {
  return is_robosense_device({reinterpret_cast<const std::byte*>(metadata.data()), metadata.size()});
}

// An assembler for whatever data is heard first. What an LSLidar says of itself before that, OneSender keeps: it is of
// no one model.
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
  std::string hint() const override { return inner_ ? inner_->hint() : ""; }

 private:
  bool begin(ByteView payload) {
    const bool is_lslidar = lslidar_model_of(payload).has_value();
    const bool is_robosense = robosense_layout_of(payload) || is_robosense_device(payload);
    const bool is_other =
        is_velodyne_data(payload) || is_livox_data(payload) || is_robosense_m1_data(payload) || is_lslidar;
    const bool has_device = is_robosense_metadata(choice_.metadata);
    if (has_device && (is_other || hesai_model_of(payload))) {
      throw FrameError(
          tr("a device packet of a RoboSense is given as metadata, but the packets are of another sensor"));
    }
    if (is_robosense && !has_device && !choice_.metadata.empty()) {
      throw FrameError(tr("angles of a Hesai are given as metadata, but the packets are of a RoboSense"));
    }
    if (is_other && !choice_.metadata.empty()) {
      throw FrameError(tr("angles of a Hesai are given as metadata, but the packets are of a sensor that has none"));
    }
    // Of firmware 2 and 3 they are laid out as a Velodyne's.
    if (is_lslidar) {
      inner_ = std::make_unique<LslidarAssembler>();
    } else if (is_velodyne_data(payload)) {
      inner_ = std::make_unique<VelodyneAssembler>();
    } else if (hesai_model_of(payload)) {
      inner_ = std::make_unique<HesaiAssembler>(std::nullopt, choice_.metadata);
    } else if (is_livox_data(payload)) {
      inner_ = std::make_unique<LivoxAssembler>(std::nullopt, choice_.frame_ns);
    } else if (is_robosense) {
      inner_ = std::make_unique<RoboSenseAssembler>(std::nullopt, choice_.metadata);
    } else if (is_robosense_m1_data(payload)) {
      inner_ = std::make_unique<RoboSenseM1Assembler>();
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
  for (const HesaiModel model : kHesaiModels) {
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
    if (!is_ouster_metadata(choice.metadata) && !is_robosense_metadata(choice.metadata)) check_angles(choice.metadata);
    return;
  }
  if (sensor.metadata == SensorMetadata::kNone) {
    throw FrameError(say("metadata is given, but a {} ({}) has none", sensor.title, sensor.name));
  }
  if (sensor.metadata == SensorMetadata::kHesaiAngles && is_ouster_metadata(choice.metadata)) {
    throw FrameError(say("the metadata is JSON, as of an Ouster; a {} takes a table of angles", sensor.title));
  }
  if (sensor.metadata == SensorMetadata::kRoboSenseDevice && !is_robosense_metadata(choice.metadata)) {
    throw FrameError(
        say("the metadata of a {} is one of its device packets: {} bytes that begin with a5 ff 00 5a 11 11 "
            "55 55; this is none",
            sensor.title, kRoboSenseBytes));
  }
}

KnownSensor lslidar_sensor(SensorKind kind, const char* name, const char* title) {
  return {kind, name, title, 2368, SensorMetadata::kNone, false, 2369};
}

KnownSensor robosense_sensor(SensorKind kind, const char* name, const char* title) {
  return {kind, name, title, kRoboSensePort, SensorMetadata::kRoboSenseDevice, false, kRoboSenseDevicePort};
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
      {SensorKind::kMid360, "mid360", "Livox Mid-360", kLivoxHostPort, SensorMetadata::kNone, false},
      lslidar_sensor(SensorKind::kLslidarC16, "lslidar_c16", "LSLidar C16"),
      lslidar_sensor(SensorKind::kLslidarC16Of15, "lslidar_c16_15deg",
                     "LSLidar C16 of firmware 2 or 3, -15 to 15 degrees"),
      lslidar_sensor(SensorKind::kLslidarC16Of10, "lslidar_c16_10deg",
                     "LSLidar C16 of firmware 2 or 3, -10 to 10 degrees"),
      lslidar_sensor(SensorKind::kLslidarC32, "lslidar_c32", "LSLidar C32"),
      lslidar_sensor(SensorKind::kLslidarC32w, "lslidar_c32w", "LSLidar C32W"),
      lslidar_sensor(SensorKind::kLslidarCh32r, "lslidar_ch32r", "LSLidar CH32R"),
      lslidar_sensor(SensorKind::kLslidarC8, "lslidar_c8", "LSLidar C8"),
      lslidar_sensor(SensorKind::kLslidarCh128x1, "lslidar_ch128x1", "LSLidar CH128X1"),
      robosense_sensor(SensorKind::kRoboSense16, "robosense_rs16", "RoboSense RS-LiDAR-16"),
      robosense_sensor(SensorKind::kRoboSense32, "robosense_rs32", "RoboSense RS-LiDAR-32"),
      robosense_sensor(SensorKind::kRoboSenseHelios32, "robosense_helios32", "RoboSense RS-Helios"),
      robosense_sensor(SensorKind::kRoboSenseHelios16p, "robosense_helios16p", "RoboSense RS-Helios-16P"),
      robosense_sensor(SensorKind::kRoboSenseBpearl, "robosense_bpearl", "RoboSense RS-Bpearl"),
      robosense_sensor(SensorKind::kRoboSenseBpearl4, "robosense_bpearl4", "RoboSense RS-Bpearl 4"),
      robosense_sensor(SensorKind::kRoboSenseAiry, "robosense_airy", "RoboSense Airy"),
      {SensorKind::kRoboSenseM1, "robosense_m1", "RoboSense M1", kRoboSensePort, SensorMetadata::kNone, false},
      {SensorKind::kHesaiXt16, "hesai_xt16", "Hesai PandarXT-16", 2368, SensorMetadata::kHesaiAngles, false},
      {SensorKind::kMid360s, "mid360s", "Livox Mid-360S", kLivoxHostPort, SensorMetadata::kNone, false},
      {SensorKind::kLivoxHap, "hap", "Livox HAP", kLivoxHapPort, SensorMetadata::kNone, false},
      {SensorKind::kAvia2, "avia2", "Livox Avia 2", kLivoxHostPort, SensorMetadata::kNone, false},
      {SensorKind::kHesaiXt32m, "hesai_xt32m", "Hesai PandarXT-32M2X", 2368, SensorMetadata::kHesaiAngles, false},
      {SensorKind::kHesaiQt128, "hesai_qt128", "Hesai QT128C2X", 2368, SensorMetadata::kHesaiAngles, false},
      {SensorKind::kHesaiPandar64, "hesai_pandar64", "Hesai Pandar64", 2368, SensorMetadata::kHesaiAngles, false}};
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
  choice.source = options.source;
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
  if (const std::optional<RoboSenseModel> model = robosense_model(choice.kind)) {
    return std::make_unique<RoboSenseAssembler>(model, choice.metadata);
  }
  if (choice.kind == SensorKind::kRoboSenseM1) return std::make_unique<RoboSenseM1Assembler>();
  if (const std::optional<LivoxModel> model = livox_model(choice.kind)) {
    return std::make_unique<LivoxAssembler>(model, choice.frame_ns);
  }
  if (!lslidar_models(choice.kind).empty()) return std::make_unique<LslidarAssembler>(lslidar_choice(choice.kind));
  if (choice.kind == SensorKind::kLslidarCh128x1) return std::make_unique<LslidarHybridAssembler>();
  if (choice.kind == SensorKind::kOuster || is_ouster_metadata(choice.metadata)) {
    return std::make_unique<OusterAssembler>(parse_ouster_metadata(choice.metadata));
  }
  return std::make_unique<AutomaticAssembler>(choice);
}

namespace {

template <typename IsIt>
std::optional<SensorKind> kind_where(const IsIt& is_it) {
  const std::vector<KnownSensor>& all = known_sensors();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const KnownSensor& sensor) { return is_it(sensor.kind); });
  return found != all.end() ? std::optional(found->kind) : std::nullopt;
}

std::optional<SensorKind> recognise_velodyne(ByteView payload) {
  return kind_where([&](SensorKind kind) {
    const std::optional<VelodyneModel> model = velodyne_model(kind);
    return model && velodyne_traits(*model).product == velodyne_product(payload);
  });
}

std::optional<SensorKind> recognise_robosense(ByteView payload, RoboSenseLayout layout) {
  const std::vector<RoboSenseModel> models = robosense_models_of_head(payload, layout);
  return kind_where([&](SensorKind kind) { return models.size() == 1 && robosense_model(kind) == models.front(); });
}

std::optional<SensorKind> recognise_lslidar(LslidarModel model) {
  return kind_where([&](SensorKind kind) {
    const std::vector<LslidarModel> models = lslidar_models(kind);
    return std::find(models.begin(), models.end(), model) != models.end();
  });
}

}  // namespace

std::optional<SensorKind> recognise_sensor(ByteView payload) {
  std::optional<SensorKind> kind;
  if (is_velodyne_data(payload)) kind = recognise_velodyne(payload);
  if (kind) return kind;
  if (const std::optional<HesaiModel> model = hesai_model_of(payload)) {
    return kind_where([&](SensorKind other) { return hesai_model(other) == model; });
  }
  if (const std::optional<RoboSenseLayout> layout = robosense_layout_of(payload)) {
    return recognise_robosense(payload, *layout);
  }
  if (is_robosense_m1_data(payload)) return SensorKind::kRoboSenseM1;
  if (const std::optional<LslidarModel> model = lslidar_model_of(payload)) return recognise_lslidar(*model);
  return std::nullopt;
}

const char* recognised_title(const Datagram& datagram) {
  if (const std::optional<SensorKind> kind = recognise_sensor(datagram.payload)) return known_sensor(*kind).title;
  return is_livox_data(datagram.payload) ? livox_title(datagram.from) : nullptr;
}

std::string unread_sensor(ByteView payload) {
  // Blocks of the second to the fourth 32 lasers have flags of their own.
  if (payload.size == kVelodyneBytes && little_endian_at(payload, 0, 1) == 0xFF &&
      (little_endian_at(payload, 1, 1) == 0xEE || little_endian_at(payload, 1, 1) == 0xDD) &&
      little_endian_at(payload, kVelodyneBlockBytes, 2) == 0xDDFF) {
    return "a Velodyne of 64 or 128 lasers";
  }
  for (const std::string& other :
       {unread_lslidar(payload), unread_lslidar_hybrid(payload), unread_robosense(payload), unread_livox(payload)}) {
    if (!other.empty()) return other;
  }
  return unread_hesai(payload);
}

}  // namespace pose_wall::tools
