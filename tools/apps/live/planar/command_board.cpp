// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/planar/command_board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace pose_wall::tools::live {
namespace {

constexpr double kSPerNs = 1e-9;

// Also what is no number lies not within.
bool is_within(const DriveMotion& motion, const DriveMotion& most) {
  return std::abs(motion.speed_m_s) <= most.speed_m_s && std::abs(motion.turn_rad_s) <= most.turn_rad_s;
}

double larger_in_size(double a, double b) {
  return std::abs(a) >= std::abs(b) ? a : b;
}

DriveMotion least_of(const DriveMotion& a, const DriveMotion& b) {
  return {std::min(a.speed_m_s, b.speed_m_s), std::min(a.turn_rad_s, b.turn_rad_s)};
}

DriveMotion most_of(const DriveMotion& a, const DriveMotion& b) {
  return {std::max(a.speed_m_s, b.speed_m_s), std::max(a.turn_rad_s, b.turn_rad_s)};
}

DriveSpan span_of(const DriveSpan& a, const DriveSpan& b) {
  return {least_of(a.least, b.least), most_of(a.most, b.most)};
}

bool is_stand(const DriveSpan& span) {
  return is_within(span.least, {}) && is_within(span.most, {});
}

}  // namespace

CommandBoard::CommandBoard(std::string from, double age_s) : from_(std::move(from)), age_s_(age_s) {}

CommandBoard::Slot& CommandBoard::slot_at(std::int64_t now_ns) {
  const std::int64_t number = now_ns / kSlot_ns;
  Slot& slot = slots_[static_cast<std::size_t>(number % kSlots)];
  if (slot.number != number) slot = Slot{};
  slot.number = number;
  return slot;
}

template <typename Visit>
void CommandBoard::visit_last_second(std::int64_t now_ns, Visit visit) const {
  const std::int64_t number = now_ns / kSlot_ns;
  for (const Slot& slot : slots_) {
    if (slot.number > number - kSlots && slot.number <= number) visit(slot);
  }
}

bool CommandBoard::take(const DriveMotion& command, std::int64_t now_ns) {
  const std::lock_guard<std::mutex> locked(lock_);
  if (!is_within(command, kMost)) {
    refuse_locked(fmt::format("{:g} m/s, {:g} rad/s; allowed: up to {:g} m/s and {:g} rad/s either way",
                              command.speed_m_s, command.turn_rad_s, kMost.speed_m_s, kMost.turn_rad_s));
    return false;
  }
  Slot& slot = slot_at(now_ns);
  const DriveSpan alone{command, command};
  slot.commanded = slot.has_command ? span_of(slot.commanded, alone) : alone;
  slot.has_command = true;
  newest_ = command;
  came_ns_ = now_ns;
  ++commands_;
  return true;
}

void CommandBoard::refuse(const std::string& why) {
  const std::lock_guard<std::mutex> locked(lock_);
  refuse_locked(why);
}

// Something newer was commanded, and nobody knows what.
void CommandBoard::refuse_locked(const std::string& why) {
  newest_.reset();
  ++refused_;
  last_refusal_ = why;
}

std::optional<DriveMotion> CommandBoard::newest(std::int64_t now_ns) const {
  const std::lock_guard<std::mutex> locked(lock_);
  return newest_locked(now_ns);
}

std::optional<DriveMotion> CommandBoard::newest_locked(std::int64_t now_ns) const {
  const bool is_fresh = came_ns_ && static_cast<double>(now_ns - *came_ns_) * kSPerNs <= age_s_;
  return is_fresh ? newest_ : std::nullopt;
}

std::optional<DriveSpan> CommandBoard::last_second(std::int64_t now_ns) const {
  const std::lock_guard<std::mutex> locked(lock_);
  return last_second_locked(now_ns);
}

std::optional<DriveSpan> CommandBoard::last_second_locked(std::int64_t now_ns) const {
  std::optional<DriveSpan> span;
  visit_last_second(now_ns, [&](const Slot& slot) {
    if (slot.has_command) span = span ? span_of(*span, slot.commanded) : slot.commanded;
  });
  return span;
}

// A machine that brakes moves without a command for a moment: only where nothing but standing was commanded for a
// second does it move alone.
void CommandBoard::note_measured(const DriveMotion& measured, const DriveMotion& level, std::int64_t now_ns) {
  if (!std::isfinite(measured.speed_m_s) || !std::isfinite(measured.turn_rad_s)) return;
  const std::lock_guard<std::mutex> locked(lock_);
  Slot& slot = slot_at(now_ns);
  const std::optional<DriveSpan> commanded = last_second_locked(now_ns);
  const bool moves = std::abs(measured.speed_m_s) > level.speed_m_s || std::abs(measured.turn_rad_s) > level.turn_rad_s;
  if (moves && (!commanded || is_stand(*commanded))) slot.moves_alone = true;
  const std::optional<DriveMotion> command = newest_locked(now_ns);
  if (!command) return;
  const DriveMotion before = slot.difference.value_or(DriveMotion{});
  slot.difference = DriveMotion{larger_in_size(before.speed_m_s, command->speed_m_s - measured.speed_m_s),
                                larger_in_size(before.turn_rad_s, command->turn_rad_s - measured.turn_rad_s)};
}

PartHealth CommandBoard::health(std::int64_t now_ns) const {
  const std::lock_guard<std::mutex> locked(lock_);
  bool moves_alone = false;
  DriveMotion difference;
  visit_last_second(now_ns, [&](const Slot& slot) {
    moves_alone = moves_alone || slot.moves_alone;
    if (!slot.difference) return;
    difference = {larger_in_size(difference.speed_m_s, slot.difference->speed_m_s),
                  larger_in_size(difference.turn_rad_s, slot.difference->turn_rad_s)};
  });
  const std::optional<DriveMotion> command = newest_locked(now_ns);
  PartHealth health;
  health.part = "planar command " + from_;
  health.grade = command && !moves_alone ? Grade::kGood : Grade::kWarning;
  health.summary = moves_alone                ? "the machine moves without a command"
                   : command                  ? "commands come"
                   : !came_ns_ && !refused_   ? "waits for commands"
                   : !newest_ && refused_ > 0 ? "the newest command was refused"
                                              : "no command comes any more";
  health.add("command m/s", command ? fmt::format("{:.3f}", command->speed_m_s) : "-");
  health.add("command rad/s", command ? fmt::format("{:.3f}", command->turn_rad_s) : "-");
  health.add("command less measured m/s", fmt::format("{:.3f}", difference.speed_m_s));
  health.add("command less measured rad/s", fmt::format("{:.3f}", difference.turn_rad_s));
  health.add("command's age ms", came_ns_ ? std::to_string((now_ns - *came_ns_) / 1'000'000) : "-");
  health.add("commands", commands_);
  health.add("refused", refused_);
  if (!last_refusal_.empty()) health.add("last refusal", last_refusal_);
  return health;
}

std::string command_place(const PlanarSettings& settings) {
  if (!settings.command_modbus.empty()) return "modbus " + settings.command_modbus;
  if (!settings.command_ros.empty()) return "ros " + settings.command_ros;
  if (settings.command_can != 0.0) return fmt::format("can {:X}h", static_cast<std::uint32_t>(settings.command_can));
  return "";
}

}  // namespace pose_wall::tools::live
