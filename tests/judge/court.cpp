// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/court.hpp"

#include <array>
#include <memory>
#include <stdexcept>

#include "judge/text.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::judge {
namespace {

void demand(std::int32_t status) {
  if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
}

class MotionBeside {
 public:
  explicit MotionBeside(const Setup& setup)
      : engine_(setup.config), block_(pose_wall_motion_memory_needed(), test::Dirt::kRandom) {
    demand(pose_wall_motion_open(&setup.config, &setup.motion, block_.data(), block_.size(), &motion_));
  }

  pose_wall_result process(const pose_wall_cloud& cloud) {
    pose_wall_motion_result moved{};
    moved.struct_size = sizeof moved;
    pose_wall_result result{};
    result.struct_size = sizeof result;
    demand(pose_wall_motion_process_both(motion_, engine_.get(), &cloud, &moved, &result));
    return result;
  }

 private:
  test::EngineUnderTest engine_;
  test::AlignedBlock block_;
  pose_wall_motion* motion_ = nullptr;
};

Finding finding_of(const pose_wall_value& value, int quantity, int frame, const Truths& truths, double alert_limit) {
  Finding finding;
  finding.alert_limit = alert_limit;
  finding.frame = frame;
  finding.quantity = quantity;
  finding.state = value.state;
  finding.raw_state = value.raw_state;
  finding.reasons = value.reasons;
  finding.cause = value.cause;
  finding.error = truths.error(quantity, value.value, alert_limit);
  finding.raw_error = truths.error(quantity, value.raw, alert_limit);
  finding.road_error = truths.road.error(quantity, value.value);
  finding.surveyed_error = truths.surveyed.error(quantity, value.value);
  finding.level = value.protection_level;
  finding.raw_level = value.raw_protection_level;
  finding.sigma = value.sigma;
  return finding;
}

Work work_of(const pose_wall_result& result) {
  std::uint32_t reasons = result.frame_reasons;
  for (const pose_wall_value& value : result.quantity) reasons |= value.reasons;
  return {result.work, (reasons & POSE_WALL_R_WORK_LIMIT) != 0};
}

std::string reason_names(std::uint32_t reasons) {
  std::string names;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0) names += std::string(names.empty() ? "" : "+") + pose_wall_reason_name(bit);
  }
  return names;
}

std::string feature_names(std::uint32_t features) {
  std::string names;
  for (std::uint32_t k = 0; k < kFeatures; ++k) {
    if ((features >> k & 1U) != 0) names += std::string(names.empty() ? "" : "+") + feature_name(k);
  }
  return names.empty() ? "bare" : names;
}

std::string replay(const Case& tried, const Treatment& treatment) {
  std::string text = format("replay: pose_wall_judge --seed %llu --roads 1 --frames %d",
                            static_cast<unsigned long long>(tried.seed), tried.frames);
  if (tried.furnishing == Furnishing::kQuiet) text += " --quiet";
  if (tried.furnishing == Furnishing::kRich) text += " --rich";
  if (tried.no_bias) text += " --no-bias";
  if (!tried.times) text += " --times off";
  if (!treatment.motion) text += " --motion off";
  if (treatment.work_max > 0) text += format(" --work-max %u", treatment.work_max);
  if (tried.going != Going::kDrawn) text += tried.going == Going::kStands ? " --going stands" : " --going drives";
  if (tried.sensor >= 0) text += std::string(" --sensor ") + sensor_at(tried.sensor).name;
  return text;
}

void judge_frame(const pose_wall_result& result, int frame, const Truths& truths, const std::array<double, 2>& limits,
                 Verdict* verdict) {
  verdict->work.push_back(work_of(result));
  for (int q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    verdict->findings.push_back(finding_of(result.quantity[q], q, frame, truths, limits[q < POSE_WALL_D_LF ? 0 : 1]));
  }
}

}  // namespace

Open opened_as(const Treatment& treatment) {
  return [treatment](const Setup& setup) -> Process {
    Setup used = setup;
    test::set(&used.config, "work_max", static_cast<double>(treatment.work_max));
    if (treatment.motion) {
      const auto both = std::make_shared<MotionBeside>(used);
      return [both](const pose_wall_cloud& cloud) { return both->process(cloud); };
    }
    const auto engine = std::make_shared<test::EngineUnderTest>(used.config);
    return [engine](const pose_wall_cloud& cloud) { return engine->process(cloud); };
  };
}

std::vector<Verdict> hear(const Case& tried, const std::vector<Open>& each) {
  Trial trial(tried);
  const Setup setup = trial.setup();
  std::array<double, 2> limits{};
  pose_wall_config_get_number(&setup.config, "alert_limit_angle_deg", limits.data());
  pose_wall_config_get_number(&setup.config, "alert_limit_distance", &limits[1]);
  limits[0] *= kRadPerDeg;
  Verdict blank;
  blank.tried = tried;
  blank.sensor = trial.sensor_row();
  blank.features = trial.road().features;
  std::vector<Verdict> verdicts(each.size(), blank);
  std::vector<Process> processes;
  for (const Open& open : each) processes.push_back(open(setup));
  for (int frame = 0; frame < tried.frames; ++frame) {
    Truths truths;
    const Cloud points = trial.next_frame(&truths);
    const pose_wall_cloud cloud = points.described((frame + 1) * kPeriod_ns);
    for (std::size_t k = 0; k < each.size(); ++k) {
      const pose_wall_result result = processes[k](cloud);
      if (frame >= tried.from_frame) judge_frame(result, frame, truths, limits, &verdicts[k]);
    }
  }
  return verdicts;
}

std::vector<Verdict> hear(const Case& tried, const std::vector<Treatment>& treatments) {
  std::vector<Open> each;
  for (const Treatment& treatment : treatments) each.push_back(opened_as(treatment));
  std::vector<Verdict> verdicts = hear(tried, each);
  for (std::size_t k = 0; k < verdicts.size(); ++k) verdicts[k].treatment = treatments[k];
  return verdicts;
}

Verdict hear(const Case& tried, const Treatment& treatment) {
  return hear(tried, std::vector<Treatment>{treatment}).front();
}

std::string Verdict::text(const Finding& finding) const {
  const int q = finding.quantity;
  std::string text = format(
      "road %llu (%s, %s), frame %d: %s %s, off by %.3f, level %.3f; raw off by %.3f, level %.3f, sigma %.3f (%s); ",
      static_cast<unsigned long long>(tried.seed), sensor_at(sensor).name, feature_names(features).c_str(),
      finding.frame, pose_wall_quantity_name(static_cast<std::uint32_t>(q)), pose_wall_state_name(finding.state),
      shown(q, finding.error), shown(q, finding.level), shown(q, finding.raw_error), shown(q, finding.raw_level),
      shown(q, finding.sigma), q < POSE_WALL_D_LF ? "deg" : "mm");
  if (finding.reasons != 0) text += reason_names(finding.reasons) + "; ";
  return text + replay(tried, treatment);
}

}  // namespace pose_wall::judge
