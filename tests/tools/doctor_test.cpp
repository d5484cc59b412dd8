// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: on simulated mounts the doctor finds sensor, height, tilt, axis and body within the tolerances below, and the
// settings it proposes measure the same frames within their protection levels; no gate is ever loosened; what cannot be
// used or must not be overwritten is refused. Does not prove: anything about machines that move, or rooms that are
// none.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/sensors.hpp"
#include "lab/sim/simulator.hpp"
#include "study/doctor/diagnosis.hpp"
#include "study/doctor/diagnosis_output.hpp"
#include "study/doctor/preview.hpp"
#include "study/doctor/trial.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::contains;

struct Mount {
  const char* name;
  const char* sensor;
  std::vector<const char*> settings;  // of the simulator
  double roll_deg, pitch_deg, height_m;
  const char* forward_axis;
  double tilt_tolerance_deg, height_tolerance_m;
};

void PrintTo(const Mount& mount, std::ostream* out) {
  *out << mount.name;
}

sim::SceneSetup setup_of(const char* sensor, const std::vector<const char*>& settings) {
  sim::SceneSetup setup;
  setup.sensor = sim::find_sensor(sensor)->sensor;
  for (const char* setting : settings) sim::set_parameter(setup, setting);
  return setup;
}

struct Simulated {
  doctor::Recording recording;
  std::vector<TruthRow> truth;
  std::vector<sim::Frame> frames;
};

// `count` frames with stamps 0.1 s apart, as if their files were named by them.
Simulated simulate(const sim::SceneSetup& setup, std::uint32_t count) {
  const sim::Simulator simulator(setup, 7);
  Simulated out;
  for (std::uint32_t i = 0; i < count; ++i) {
    sim::Frame frame = simulator.render(i);
    pose_wall_cloud cloud{};
    pose_wall_cloud_xyz32(&cloud, frame.xyz_intensity.data(), static_cast<std::uint32_t>(frame.count()), 16, 0);
    doctor::KeptFrame kept;
    doctor::FrameNote note = doctor::note_of(cloud, kept);
    note.stamp_ns = 1'700'000'000'000'000'000 + i * 100'000'000LL;
    note.has_own_stamp = true;
    out.recording.add(note, std::move(kept));
    out.truth.push_back(simulator.truth(i));
    out.frames.push_back(std::move(frame));
  }
  return out;
}

LoadedConfig told(const std::vector<std::string>& settings = {}) {
  return load_config("", settings);
}

// The frames as a file would give them.
doctor::NextFrame frames_of(const Simulated& simulated) {
  return [&simulated, next = std::size_t{0}]() mutable -> std::optional<SourcedFrame> {
    if (next == simulated.frames.size()) return std::nullopt;
    const sim::Frame& rendered = simulated.frames[next];
    SourcedFrame sourced;
    sourced.stamp_ns = simulated.recording.notes[next].stamp_ns;
    sourced.frame.emplace();
    sourced.frame->bytes.resize(rendered.xyz_intensity.size() * sizeof(float));
    std::memcpy(sourced.frame->bytes.data(), rendered.xyz_intensity.data(), sourced.frame->bytes.size());
    pose_wall_cloud_xyz32(&sourced.frame->cloud, sourced.frame->bytes.data(),
                          static_cast<std::uint32_t>(rendered.count()), 16, 0);
    ++next;
    return sourced;
  };
}

doctor::Diagnosis diagnosis_of(const Simulated& simulated, const LoadedConfig& settings = told(),
                               std::optional<double> height_m = std::nullopt) {
  return doctor::diagnose(simulated.recording, settings, height_m, [&simulated](const LoadedConfig& proposed) {
    return doctor::preview(proposed, 10.0, frames_of(simulated));
  });
}

class Mounts : public ::testing::TestWithParam<Mount> {};

TEST_P(Mounts, AreFoundAndTheProposalMeasures) {
  const Mount& mount = GetParam();
  const Simulated simulated = simulate(setup_of(mount.sensor, mount.settings), 6);
  const doctor::Diagnosis d = diagnosis_of(simulated);
  ASSERT_TRUE(d.verdict.is_usable()) << d.verdict.line();
  EXPECT_EQ(d.sensor.model, mount.sensor);
  EXPECT_NEAR(d.mount->likely.floor.height_m, mount.height_m, mount.height_tolerance_m);
  const api::Config& config = d.proposal.config();
  const auto off_deg = [&config](const char* key, double truth_deg) {
    return std::fabs(std::remainder(config.number(key) * kDegPerRad - truth_deg, 360.0));
  };
  EXPECT_LE(off_deg("extrinsic_roll", mount.roll_deg), mount.tilt_tolerance_deg);
  EXPECT_LE(off_deg("extrinsic_pitch", mount.pitch_deg), mount.tilt_tolerance_deg);
  EXPECT_EQ(d.ahead.axis, mount.forward_axis) << d.ahead.reason;
  EXPECT_TRUE(d.ahead.is_known);

  const doctor::Trial trial(config, simulated.recording.kept, doctor::kAllKept);
  ASSERT_EQ(trial.results().size(), simulated.truth.size());
  std::size_t valid = 0;
  for (std::size_t i = 0; i < simulated.truth.size(); ++i) {
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const pose_wall_value& v = trial.results()[i].quantity[q];
      if (!doctor::is_measured(v)) continue;
      EXPECT_NEAR(v.raw, simulated.truth[i].value[q], v.protection_level) << pose_wall_quantity_name(q);
      valid += v.state == POSE_WALL_VALID ? 1 : 0;
    }
  }
  EXPECT_GT(valid, simulated.truth.size() * POSE_WALL_QUANTITIES / 2);
}

INSTANTIATE_TEST_SUITE_P(
    Simulated, Mounts,
    ::testing::Values(
        Mount{"Upright", "os1-64", {"face_distance_m=9", "base_height_m=1.4"}, 0, 0, 1.4, "+X", 0.3, 0.02},
        Mount{"Backwards",
              "os1-64",
              {"face_distance_m=9", "forward_axis=-X", "mount_roll_deg=-3", "mount_pitch_deg=6", "base_height_m=1.2"},
              -3,
              6,
              1.2,
              "-X",
              0.3,
              0.02},
        Mount{"Leftwards",
              "os1-64",
              {"face_distance_m=9", "forward_axis=+Y", "turned_left_deg=4", "base_height_m=1.7", "lateral_m=0.6"},
              0,
              0,
              1.7,
              "+Y",
              0.3,
              0.02},
        Mount{"RightwardsOfManyRings",
              "os0-128",
              {"face_distance_m=9", "forward_axis=-Y", "mount_roll_deg=8", "base_height_m=1.5"},
              8,
              0,
              1.5,
              "-Y",
              0.3,
              0.02},
        Mount{"FewRings",
              "vlp16",
              {"face_distance_m=9", "mount_pitch_deg=-4", "base_height_m=1.5"},
              0,
              -4,
              1.5,
              "+X",
              1.0,
              0.05},
        Mount{"UpsideDownOverABody",
              "os0-128",
              {"face_distance_m=9", "mount_roll_deg=180", "body=yes", "base_height_m=1.6"},
              180,
              0,
              1.6,
              "+X",
              0.3,
              0.02},
        Mount{"UpsideDownNonRepetitive",
              "mid360",
              {"face_distance_m=9", "mount_roll_deg=176", "mount_pitch_deg=3", "body=yes", "base_height_m=1.5"},
              176,
              3,
              1.5,
              "+X",
              0.6,
              0.03}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Doctor, BoxesHoldTheBodyAndLittleElse) {
  const Simulated simulated =
      simulate(setup_of("os0-128", {"body=yes", "boom=yes", "base_height_m=1.6", "body_top_m=-0.5"}), 6);
  const doctor::Diagnosis d = diagnosis_of(simulated);
  ASSERT_TRUE(d.mount.has_value());
  ASSERT_FALSE(d.mount->likely.body.boxes_base.empty());
  EXPECT_TRUE(d.mount->is_sure) << "the body tells floor from roof";
  std::size_t body = 0, body_inside = 0, others = 0, others_inside = 0;
  for (const sim::Frame& frame : simulated.frames) {
    for (std::size_t i = 0; i < frame.count(); ++i) {
      const float* p = &frame.xyz_intensity[4 * i];
      const Eigen::Vector3d point = Eigen::Vector3f(p[0], p[1], p[2]).cast<double>();
      bool inside = false;
      for (const doctor::Box& box : d.mount->likely.body.boxes_base) inside = inside || box.holds(point);
      const bool is_body = frame.labels[i] == sim::Label::kBody;
      (is_body ? body : others) += 1;
      (is_body ? body_inside : others_inside) += inside ? 1 : 0;
    }
  }
  ASSERT_GT(body, 1000U);
  EXPECT_GT(static_cast<double>(body_inside), 0.98 * static_cast<double>(body));
  EXPECT_LT(static_cast<double>(others_inside), 0.005 * static_cast<double>(others));
}

sim::SceneSetup setup_of_scene(const char* scene, const char* sensor, const std::vector<const char*>& settings) {
  sim::SceneSetup setup = sim::make_setup(scene, sensor, false, 1);
  for (const char* setting : settings) sim::set_parameter(setup, setting);
  return setup;
}

// Shares of the points of a label, and of all others, that lie in the proposed boxes.
struct Boxed {
  std::size_t of_body = 0, body_inside = 0, others = 0, others_inside = 0;

  Boxed(const Simulated& simulated, const doctor::BodySeen& body) {
    for (const sim::Frame& frame : simulated.frames) {
      for (std::size_t i = 0; i < frame.count(); ++i) {
        const float* p = &frame.xyz_intensity[4 * i];
        const Eigen::Vector3d point = Eigen::Vector3f(p[0], p[1], p[2]).cast<double>();
        const bool is_inside = std::any_of(body.boxes_base.begin(), body.boxes_base.end(),
                                           [&point](const doctor::Box& box) { return box.holds(point); });
        const bool is_body = frame.labels[i] == sim::Label::kBody;
        (is_body ? of_body : others) += 1;
        if (is_inside) (is_body ? body_inside : others_inside) += 1;
      }
    }
  }
};

TEST(Doctor, WhatStandsBesideTheMachineGetsNoBox) {
  struct {
    const char* scene;
    const char* sensor;
    std::vector<const char*> settings;
    const char* why;
  } const cases[] = {
      {"conveyor", "os1-64", {}, "runs on along the road"},
      {"conveyor", "vlp16", {"conveyor_side=both"}, "runs on along the road"},
      {"conveyor", "vlp16", {"turned_left_deg=4"}, "runs on along the road"},
      {"vehicle", "vlp16", {}, "stands beside"},
      {"curtain", "vlp16", {}, "stands beside"},
  };
  for (const auto& [scene, sensor, settings, why] : cases) {
    const doctor::Diagnosis d = diagnosis_of(simulate(setup_of_scene(scene, sensor, settings), 6));
    ASSERT_TRUE(d.mount.has_value()) << scene;
    const doctor::BodySeen& body = d.mount->likely.body;
    EXPECT_TRUE(body.boxes_base.empty()) << scene << ": a box would hide it from engine and stop";
    ASSERT_FALSE(body.left_out.empty()) << scene;
    EXPECT_TRUE(contains(body.left_out.front().why, why)) << scene << ": " << body.left_out.front().why;
    EXPECT_TRUE(contains(doctor::diagnosis_text(d), why)) << doctor::diagnosis_text(d);
    for (const doctor::Change& change : d.proposal.changes()) EXPECT_NE(change.key, "body_box_1") << scene;
  }
}

TEST(Doctor, TheBodyHasItsBoxesWithThingsBesideIt) {
  const auto boxed_with = [](const std::vector<const char*>& settings, bool is_anything_left_out) {
    const Simulated simulated = simulate(setup_of_scene("body", "vlp16", settings), 6);
    const doctor::Diagnosis d = diagnosis_of(simulated);
    EXPECT_EQ(!d.mount->likely.body.left_out.empty(), is_anything_left_out) << settings.front();
    const Boxed boxed(simulated, d.mount->likely.body);
    EXPECT_GT(boxed.of_body, 1000U);
    EXPECT_LT(static_cast<double>(boxed.others_inside), 0.005 * static_cast<double>(boxed.others)) << settings.front();
    return static_cast<double>(boxed.body_inside) / static_cast<double>(boxed.of_body);
  };
  const double without_boom = boxed_with({"boom=no"}, false);
  EXPECT_GT(boxed_with({"boom=yes"}, false), 0.98);
  EXPECT_GT(boxed_with({"conveyor_side=left", "vehicle_side=right"}, true), 0.93);
  EXPECT_NEAR(boxed_with({"vehicle_side=left", "boom=no"}, true), without_boom, 0.01);
}

bool asks_for_a_drive(const doctor::Diagnosis& d) {
  return std::any_of(d.verdict.confirm.begin(), d.verdict.confirm.end(),
                     [](const std::string& line) { return contains(line, "examine a drive of 10 m"); });
}

TEST(Doctor, AStandingMachineIsAskedForADriveAndADriveShowsTheBodyAlone) {
  const doctor::Diagnosis standing = diagnosis_of(simulate(setup_of_scene("rough", "vlp16", {"body=yes"}), 6));
  ASSERT_FALSE(standing.mount->likely.body.boxes_base.empty()) << "or there is nothing to ask about";
  EXPECT_LT(standing.preview->travel_m, 0.1);
  EXPECT_TRUE(asks_for_a_drive(standing));

  const std::vector<const char*> away = {"body=yes",    "vehicle_side=right", "vehicle_at_m=4", "conveyor_side=left",
                                         "speed_mps=2", "rate_hz=10",         "rock_repeats=no"};
  const Simulated drive = simulate(setup_of_scene("rough", "vlp16", away), 60);
  const doctor::Diagnosis driven = diagnosis_of(drive);
  EXPECT_GT(driven.preview->travel_m, 10.0);
  EXPECT_FALSE(asks_for_a_drive(driven));
  const Boxed boxed(drive, driven.mount->likely.body);
  EXPECT_GT(static_cast<double>(boxed.body_inside), 0.97 * static_cast<double>(boxed.of_body));
  EXPECT_LT(static_cast<double>(boxed.others_inside), 0.005 * static_cast<double>(boxed.others));
}

TEST(Doctor, SaysWhatCannotBeKnown) {
  const Simulated simulated = simulate(setup_of("os1-64", {"forward_axis=-Y", "base_height_m=1.4"}), 4);
  const doctor::Diagnosis d = diagnosis_of(simulated);
  EXPECT_TRUE(d.verdict.is_usable()) << d.verdict.line();
  EXPECT_EQ(d.mount->likely.road.line, 'Y');
  EXPECT_FALSE(d.ahead.is_known);
  EXPECT_TRUE(contains(d.verdict.line(), "is a guess")) << d.verdict.line();
  const doctor::Diagnosis with_axis = diagnosis_of(simulated, told({"forward_axis=-Y"}), 1.4);
  EXPECT_EQ(with_axis.ahead.axis, "-Y");
  EXPECT_TRUE(with_axis.ahead.is_known);
  EXPECT_TRUE(with_axis.mount->is_sure) << with_axis.mount->reason;
  EXPECT_FALSE(contains(with_axis.verdict.line(), "is a guess")) << with_axis.verdict.line();
}

TEST(Doctor, ProposesUpsideDownOnlyWhereSomethingTellsIt) {
  const Simulated simulated = simulate(setup_of("mid360", {"mount_roll_deg=180", "base_height_m=1.4"}), 4);
  const doctor::Diagnosis alone = diagnosis_of(simulated);
  if (alone.mount->likely.is_flipped) {
    EXPECT_FALSE(alone.verdict.is_usable()) << "nothing but the view speaks for it";
  } else {
    EXPECT_FALSE(alone.mount->is_sure);
  }
  for (const doctor::Diagnosis& d :
       {diagnosis_of(simulated, told(), 1.4), diagnosis_of(simulated, told({"extrinsic_roll=3.1416"}))}) {
    EXPECT_TRUE(d.verdict.is_usable()) << d.verdict.line();
    EXPECT_TRUE(d.mount->is_sure);
    EXPECT_NEAR(std::fabs(d.proposal.config().number("extrinsic_roll")), 3.1416, 0.01);
    EXPECT_NEAR(d.mount->likely.floor.height_m, 1.4, 0.03);
  }
}

TEST(Doctor, RangeNoiseIsThatOfTheSensor) {
  for (const char* sensor : {"os1-64", "mid360"}) {
    const sim::SceneSetup setup = setup_of(sensor, {"range_noise_m=0.02", "base_height_m=1.4"});
    const doctor::Diagnosis d = diagnosis_of(simulate(setup, 4));
    const doctor::RangeNoise& noise = d.mount->likely.noise;
    EXPECT_NEAR(std::isfinite(noise.repeated_m) ? noise.repeated_m : noise.plane_m, 0.02, 0.005) << sensor;
  }
}

TEST(Doctor, NoGateIsEverLoosened) {
  const Simulated simulated = simulate(setup_of("vlp16", {"body=yes", "mount_pitch_deg=5", "base_height_m=1.5"}), 4);
  const std::vector<std::string> strict = {"ground_inlier_min=500", "ground_height_max=1.9"};
  const doctor::Diagnosis d = diagnosis_of(simulated, told(strict));
  for (const doctor::Change& change : d.proposal.changes()) {
    EXPECT_NE(change.key, "ground_inlier_min") << "told by --set";
  }
  const api::Config defaults;
  const api::Config& config = d.proposal.config();
  for (const char* key :
       {"alert_limit_angle_deg", "alert_limit_distance", "range_bias_max", "integrity_risk", "ground_tilt_max_deg",
        "ground_ransac_thresh", "wall_ransac_thresh", "wall_length_min", "wall_alone_length_min", "wall_lean_max_deg",
        "wall_parallel_cos", "yaw_max_deg", "hold_max", "range_min", "range_max", "frozen_frames"}) {
    EXPECT_EQ(config.number(key), defaults.number(key)) << key;
  }
  EXPECT_GE(config.number("ground_height_min"), defaults.number("ground_height_min"));
  EXPECT_LE(config.number("ground_height_max"), 1.9);
}

TEST(Doctor, ASensorThatItDoesNotKnowHasABiasThatNobodyRead) {
  const auto file_of = [](const std::vector<std::string>& settings) {
    const Simulated simulated = simulate(setup_of("vlp16", {"rings=24", "base_height_m=1.5"}), 2);
    const doctor::Diagnosis d = diagnosis_of(simulated, told(settings));
    EXPECT_FALSE(d.sensor.is_known());
    return d.proposal.yaml({});
  };
  const std::string advice = "Set this to the accuracy of its data sheet.";
  EXPECT_TRUE(contains(file_of({}), advice + "\nrange_bias_max: 0.03\n"));
  const std::string as_told = file_of({"range_bias_max=0.05"});
  EXPECT_FALSE(contains(as_told, advice)) << as_told;
  EXPECT_TRUE(contains(as_told, "\nrange_bias_max: 0.05\n")) << as_told;
}

TEST(Doctor, OfNothingItDoesNotSayThatAllIsWell) {
  doctor::Recording recording;
  doctor::FrameNote note;
  note.error = "no PCD header";
  recording.add(note, {});
  const std::string text = doctor::diagnosis_text(diagnosis_of({recording, {}, {}}));
  EXPECT_EQ(text.find("No setting needs to be changed"), std::string::npos) << text;
  EXPECT_NE(text.find("No setting is proposed"), std::string::npos) << text;
  EXPECT_NE(text.find("not usable"), std::string::npos) << text;
}

TEST(Doctor, StampsAreLookedAt) {
  doctor::Recording recording;
  const auto add = [&recording](std::int64_t stamp_ms, std::uint64_t digest) {
    doctor::FrameNote note;
    note.stamp_ns = stamp_ms * 1'000'000;
    note.has_own_stamp = true;
    note.points = note.returns = 50;  // too few to be kept
    note.digest = digest;
    recording.add(note, {});
  };
  for (const std::int64_t stamp : {0, 100, 200, 200, 300, 900, 850, 1000, 1100}) add(stamp, recording.notes.size());
  add(1200, recording.notes.back().digest);
  const doctor::StampHealth health = doctor::look_at_stamps(recording);
  EXPECT_EQ(health.frames, 10U);
  EXPECT_NEAR(health.rate_hz, 10.0, 1e-9);
  EXPECT_EQ(health.still, 1U);
  EXPECT_EQ(health.back, 1U);
  EXPECT_EQ(health.gaps, 1U);
  EXPECT_NEAR(health.longest_s, 0.6, 1e-9);
  EXPECT_EQ(health.repeated, 1U);
}

// A frame of a VLP-16 whose field of this name counts up to `rings`.
std::size_t rings_seen(const std::string& field, std::uint32_t rings) {
  const sim::Frame frame = sim::Simulator(setup_of("vlp16", {"face_distance_m=9"}), 7).render(0);
  const std::string count = std::to_string(frame.count());
  std::string file = "VERSION 0.7\nFIELDS x y z " + field + "\nSIZE 4 4 4 2\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH " +
                     count + "\nHEIGHT 1\nPOINTS " + count + "\nDATA binary\n";
  for (std::size_t i = 0; i < frame.count(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) file += test::raw(frame.xyz_intensity[4 * i + axis]);
    file += test::raw(static_cast<std::uint16_t>(i % rings));
  }
  const test::TempFolder folder;
  FrameSequence inputs({folder.write("a.pcd", file)});
  return doctor::read_recording(inputs, 10.0, [](const std::string&) {}).sensor.facts().rings;
}

TEST(Doctor, RingsAreThoseThatTheFramesTell) {
  EXPECT_EQ(rings_seen("ring", 32), 32U);
  EXPECT_EQ(rings_seen("line", 4), 16U) << "the few lines of a pattern are no rings";
  EXPECT_EQ(rings_seen("other", 32), 16U) << "by where the points lie";
  EXPECT_EQ(rings_seen("ring", 1), 16U) << "a field of zeros tells nothing";
}

// A diagnosis whose preview has these shares of valid values, of a recording this long.
doctor::Grade grade_of(doctor::Diagnosis d, double angles, double distances, double seconds) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q)
    d.preview->valid[q] = q <= POSE_WALL_YAW ? angles : distances;
  d.stamps.duration_s = seconds;
  return doctor::judge(d).grade;
}

TEST(Doctor, TheVerdictFollowsFromValidSharesAndLength) {
  using doctor::Grade;
  const doctor::Diagnosis d = diagnosis_of(simulate(setup_of("os1-64", {"face_distance_m=9", "base_height_m=1.4"}), 4));
  ASSERT_TRUE(d.preview.has_value());
  EXPECT_EQ(grade_of(d, 1.0, 0.9, 30.0), Grade::kUsable);
  EXPECT_EQ(grade_of(d, 1.0, 0.9, 12.0), Grade::kUsableInPart) << "30 s are asked";
  EXPECT_EQ(grade_of(d, 1.0, 0.89, 30.0), Grade::kUsableInPart);
  EXPECT_EQ(grade_of(d, 0.5, 0.0, 0.3), Grade::kUsableInPart);
  EXPECT_EQ(grade_of(d, 0.49, 0.0, 30.0), Grade::kNotUsable);
  EXPECT_EQ(grade_of(d, 0.0, 0.0, 0.3), Grade::kNotUsable) << "measured, never valid";
  EXPECT_TRUE(contains(doctor::diagnosis_text(d), "usable if every value is valid in 90 % of at least 30 s"));
}

TEST(Doctor, NoLineOfItsTablesIsWiderThanATerminal) {
  const Simulated simulated = simulate(setup_of("vlp16", {"body=yes", "mount_pitch_deg=5", "base_height_m=1.5"}), 4);
  for (const Language language : {Language::kEnglish, Language::kChinese}) {
    choose_language(language);
    const doctor::Diagnosis d = diagnosis_of(simulated);
    choose_language(Language::kEnglish);
    ASSERT_FALSE(d.proposal.changes().empty());
    std::istringstream lines(doctor::diagnosis_text(d));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(shown_width(line), 120U) << line;
  }
}

TEST(Doctor, TheFileHoldsAllThatWasTold) {
  const LoadedConfig settings = told({"motion=off", "motion_speed_max=1.5", "udp_port=2400", "hold_max=1.25"});
  const doctor::Diagnosis d = diagnosis_of(simulate(setup_of("os1-64", {"face_distance_m=9"}), 4), settings);
  const test::TempFolder folder;
  const LoadedConfig read = load_config(folder.write("proposed.yaml", d.proposal.yaml({})), {});
  EXPECT_EQ(read.config.number("hold_max"), 1.25);
  EXPECT_EQ(read.motion.speed_max_m_s, 1.5);
  EXPECT_EQ(read.live.udp_port, 2400.0);
  std::uint32_t of_file = 0, of_proposal = 0;
  pose_wall_config_crc(read.config.get(), &of_file);
  pose_wall_config_crc(d.proposal.config().get(), &of_proposal);
  EXPECT_EQ(of_file, of_proposal) << "what was previewed is what is written";
}

TEST(Doctor, KeepsAnEvenPartOfALongRecording) {
  doctor::Recording recording;
  for (std::uint32_t i = 0; i < 500; ++i) {
    doctor::FrameNote note;
    note.points = note.returns = 1000;
    doctor::KeptFrame kept;
    kept.xyz_lidar_m.assign(3, static_cast<float>(i));
    recording.add(note, std::move(kept));
  }
  ASSERT_GE(recording.kept.size(), 24U);
  ASSERT_LE(recording.kept.size(), 48U);
  const double step = recording.kept[1].point(0).x() - recording.kept[0].point(0).x();
  for (std::size_t i = 0; i < recording.kept.size(); ++i) {
    EXPECT_EQ(recording.kept[i].point(0).x(), static_cast<double>(i) * step);
  }
  EXPECT_GT(static_cast<double>(recording.kept.size()) * step, 490.0);
}

}  // namespace
}  // namespace pose_wall::tools
