// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the drive is told to do: the newest command, what was commanded in the last second, and how far the measured
// motion is from it. Whoever receives commands puts them here; the obstacle stop asks. From any thread.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "apps/live/health.hpp"
#include "io/config_file/planar_settings.hpp"

namespace pose_wall::tools::live {

// Of the origin of base along forward_axis, negative backwards; turns to the left are positive.
struct DriveMotion {
  double speed_m_s = 0.0, turn_rad_s = 0.0;
};

struct DriveSpan {
  DriveMotion least, most;  // each member for itself
};

class CommandBoard {
 public:
  // from: whence commands come, as "modbus 192.168.1.10". After age_s a command counts as none.
  CommandBoard(std::string from, double age_s);

  // False for what is no number or beyond kMost: refused, as below. now_ns: monotonic, here and below.
  bool take(const DriveMotion& command, std::int64_t now_ns);
  // What came is no command. It is counted, and until the next one no command is known.
  void refuse(const std::string& why);

  // Nothing where the newest is too old, or was refused.
  std::optional<DriveMotion> newest(std::int64_t now_ns) const;
  // The extremes of all commands of the last second; nothing without any.
  std::optional<DriveSpan> last_second(std::int64_t now_ns) const;

  // What the motion library measured, with the levels of its errors.
  void note_measured(const DriveMotion& measured, const DriveMotion& level, std::int64_t now_ns);

  PartHealth health(std::int64_t now_ns) const;

  // The stop takes settings up to here (pose_wall_planar_stop_settings.def: speed_max_m_s, turn_max_rad_s).
  static constexpr DriveMotion kMost = {3.0, 2.0};

 private:
  // A twentieth of a second: the last second needs bounded memory, however fast commands come.
  struct Slot {
    std::int64_t number = -1;
    bool has_command = false, moves_alone = false;
    DriveSpan commanded;
    std::optional<DriveMotion> difference;  // commanded less measured, each member the largest
  };
  static constexpr std::int64_t kSlot_ns = 50'000'000, kSlots = 20;

  Slot& slot_at(std::int64_t now_ns);
  template <typename Visit>
  void visit_last_second(std::int64_t now_ns, Visit visit) const;
  std::optional<DriveMotion> newest_locked(std::int64_t now_ns) const;
  std::optional<DriveSpan> last_second_locked(std::int64_t now_ns) const;
  void refuse_locked(const std::string& why);

  const std::string from_;
  const double age_s_;
  mutable std::mutex lock_;
  std::optional<DriveMotion> newest_;
  std::optional<std::int64_t> came_ns_;  // when the newest came
  std::array<Slot, kSlots> slots_;
  std::uint64_t commands_ = 0, refused_ = 0;
  std::string last_refusal_;
};

// "modbus 192.168.1.10", "ros cmd_vel"; empty where no key names a place that commands come from.
std::string command_place(const PlanarSettings& settings);

}  // namespace pose_wall::tools::live
