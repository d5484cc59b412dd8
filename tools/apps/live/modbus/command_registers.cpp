// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/modbus/command_registers.hpp"

#include "apps/live/clocks.hpp"
#include "apps/live/modbus/modbus_registers.hpp"

namespace pose_wall::tools::live {
namespace {

// Of a request (Modbus Application Protocol V1.1b3, 6.6 and 6.12), counted with the header of TCP.
constexpr std::size_t kSingleBytes = 12, kValueAt = 10, kCountOfBytesAt = 12, kValuesAt = 13;
constexpr double kPerThousand = 1e-3;  // registers hold mm/s and mrad/s

// As the register has it: a number of 16 bits with a sign.
double signed_of(std::uint16_t word) {
  return static_cast<double>(static_cast<std::int16_t>(word));
}

struct WrittenPart {
  unsigned first = 0;
  std::size_t count = 0, at = 0;  // of the values in the request
};

std::optional<WrittenPart> part_of(const std::uint8_t* request, std::size_t bytes) {
  if (bytes < kSingleBytes) return std::nullopt;
  WrittenPart part{big_endian_at(request, kAddressAt), 1, kValueAt};
  if (request[kFunctionAt] == kWriteSingleRegister) return bytes == kSingleBytes ? std::optional(part) : std::nullopt;
  part.count = big_endian_at(request, kCountAt);
  part.at = kValuesAt;
  const bool is_whole = bytes == kValuesAt + 2 * part.count && request[kCountOfBytesAt] == 2 * part.count;
  return is_whole && part.count > 0 ? std::optional(part) : std::nullopt;
}

}  // namespace

int CommandRegisters::write(const std::uint8_t* request, std::size_t bytes) {
  const std::optional<WrittenPart> part = part_of(request, bytes);
  if (!part) return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
  if (part->first < kCommandRegister || part->first + part->count > kCommandRegister + kCommandRegisters) {
    return MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS;
  }
  std::array<std::uint16_t, kCommandRegisters> written = registers_;
  for (std::size_t i = 0; i < part->count; ++i) {
    written[part->first - kCommandRegister + i] = static_cast<std::uint16_t>(big_endian_at(request, part->at + 2 * i));
  }
  if (written[kCommandCounter] != registers_[kCommandCounter]) {
    const DriveMotion command{signed_of(written[kCommandSpeed]) * kPerThousand,
                              signed_of(written[kCommandTurn]) * kPerThousand};
    if (!commands_->take(command, monotonic_ns())) return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
  }
  registers_ = written;
  return 0;
}

}  // namespace pose_wall::tools::live
