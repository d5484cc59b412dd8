// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/options/frame_arguments.hpp"

#include <optional>
#include <string>

#include "apps/options/one_of.hpp"
#include "io/config_file/config_place.hpp"
#include "io/frames/bare_points.hpp"
#include "io/frames/length_unit.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// Accepts what is inside, so that "nan" is refused.
std::string rate_fault(const std::string& word) {
  const std::optional<double> rate_hz = parse_number<double>(word);
  if (rate_hz && *rate_hz >= 0.001 && *rate_hz <= 1e3) return "";
  return say("'{}' is refused; a number from 0.001 to 1000 is allowed", word);
}

std::string layout_fault(const std::string& word) {
  return parse_bare_layout(word) ? "" : say("'{}' is refused; allowed: {}", word, bare_layout_rule());
}

}  // namespace

void add_input_options(CLI::App* verb, InputOptions* options) {
  verb->add_option("-t,--topic", options->topic, tr("Topic of a bag, where it has several with clouds"))
      ->type_name("TOPIC");
  verb->add_option("--source", options->source,
                   tr("The one sender that is read, where several sensors stand in a topic or a capture: its frame_id, "
                      "lidar_id, address or serial number, as `info` names it. Default: the first"))
      ->type_name("NAME");
  verb->add_option("--sensor", options->packets.sensor, tr("Sensor of packets, where they do not name it themselves"))
      ->check(one_of(sensor_names()))
      ->type_name("NAME");
  verb->add_option(
          "--metadata", options->packets.metadata,
          tr("File that describes the sensor of packets: JSON of an Ouster (default: the capture's name, .json), "
             "angles of a Hesai (CSV)"))
      ->check(existing_file());
  verb->add_option(
          "--layout", options->layout,
          tr("Values of a point in files without a header, one letter each: xyz, xyzi, xyz_i, ... (i intensity, "
             "t time, r ring, _ passed over); xyz64: float64. Default: by the values"))
      ->check(CLI::Validator(layout_fault, "", ""))
      ->type_name("LETTERS");
  verb->add_option("--unit", options->unit, tr("Unit of the coordinates; default: m"))
      ->check(one_of(length_unit_names()));
}

void add_frame_options(CLI::App* verb, FrameOptions* options, const char* input_help) {
  verb->add_option("INPUT", options->inputs, tr(input_help))->required();
  add_input_options(verb, &options->input);
  verb->add_option("-c,--config", options->config_file,
                   config_help(tr("Settings: a file, or the name of a config that comes with pose_wall, as vlp16; "
                                  "several with commas between, as vlp16,hand_held, each over the ones before; "
                                  "default: the defaults")));
  verb->add_option("-s,--set", options->settings, tr("KEY=VALUE over the config; may be repeated"))
      ->allow_extra_args(false);
  verb->add_option("-r,--rate", options->rate_hz, tr("Frames per second, for frames without stamps"))
      ->capture_default_str()
      ->check(rate_fault, tr("0.001 to 1000"));
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors"));
}

}  // namespace pose_wall::tools
