// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Holding registers that one controller may write: what it commands its drive, and a counter. They become a command
// when the counter changes, so that a command is never half of two, and a gateway that repeats itself is none.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "apps/live/planar/command_board.hpp"

namespace pose_wall::tools::live {

constexpr unsigned kCommandRegister = 4000;
enum CommandRegister : std::size_t { kCommandSpeed, kCommandTurn, kCommandCounter, kCommandRegisters };

class CommandRegisters {
 public:
  // commands: none: nobody may write. writer: of planar_command_modbus.
  CommandRegisters(CommandBoard* commands, std::optional<std::uint32_t> writer)
      : commands_(commands), writer_(writer) {}

  // address: IPv4 as parse_ipv4 numbers it.
  bool may_write(std::optional<std::uint32_t> address) const {
    return commands_ != nullptr && writer_ && address && *address == *writer_;
  }

  // A whole request of function 6 or 16. 0, or the code of the exception that it gets; then nothing is written.
  int write(const std::uint8_t* request, std::size_t bytes);

 private:
  CommandBoard* commands_;
  std::optional<std::uint32_t> writer_;
  std::array<std::uint16_t, kCommandRegisters> registers_{};
};

}  // namespace pose_wall::tools::live
