// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The answers of the Modbus server: input registers that are the images of this moment, the registers of commands, and
// exceptions for all else.
// Framing and connections are elsewhere (modbus_server.cpp).

#pragma once

#include <modbus/modbus.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "apps/live/delays.hpp"
#include "apps/live/images.hpp"
#include "apps/live/modbus/command_registers.hpp"
#include "apps/live/planar/planar_news.hpp"

namespace pose_wall::tools::live {

// Where each image begins. A register is a word of two bytes of the image as it lies in memory (little-endian), so of a
// number of four bytes the low word comes first.
constexpr int kImageRegister = 0, kImage2Register = 1000, kMotionImageRegister = 2000, kStopImageRegister = 3000;
constexpr int kImageRegisters = POSE_WALL_IMAGE_BYTES / 2, kImage2Registers = POSE_WALL_IMAGE2_BYTES / 2,
              kMotionImageRegisters = POSE_WALL_MOTION_IMAGE_BYTES / 2,
              kStopImageRegisters = POSE_WALL_PLANAR_STOP_IMAGE_BYTES / 2;

// Of a request, counted with the header of TCP (Modbus Application Protocol V1.1b3, 6).
constexpr std::size_t kFunctionAt = 7, kAddressAt = 8, kCountAt = 10;
constexpr int kReadInputRegisters = 0x04, kWriteSingleRegister = 0x06, kWriteMultipleRegisters = 0x10;

inline unsigned big_endian_at(const std::uint8_t* bytes, std::size_t at) {
  return static_cast<unsigned>(bytes[at] << 8U) | bytes[at + 1];
}

// Bytes of a whole request that begins the buffer, by its MBAP header (Modbus Messaging on TCP/IP V1.0b, 3.1.3); 0
// where more bytes must come to tell, -1 where these are no Modbus.
int request_bytes(const std::uint8_t* bytes, std::size_t count);

class ModbusRegisters {
 public:
  ModbusRegisters(const Images& images, const StopBoard* stop, const CommandRegisters& commands);

  // Answers one whole request on this socket, of the client with this IPv4 address. False where the answer could not be
  // sent. *was_refused: an exception.
  bool answer(int socket, std::optional<std::uint32_t> client, const std::uint8_t* request, int bytes,
              bool* was_refused);

  // Of the stop's answers when they were read, since they were given. From any thread.
  const Delays& answer_ages() const { return answer_ages_; }

 private:
  template <typename Type, void (*release)(Type*)>
  struct Release {
    void operator()(Type* held) const { release(held); }
  };
  using Context = std::unique_ptr<modbus_t, Release<modbus_t, modbus_free>>;
  using Mapping = std::unique_ptr<modbus_mapping_t, Release<modbus_mapping_t, modbus_mapping_free>>;

  const Images& images_;
  const StopBoard* stop_;
  int answer_read(const std::uint8_t* request, int bytes);
  int answer_write(const std::uint8_t* request, int bytes);

  CommandRegisters commands_;
  Delays answer_ages_;
  Context context_;
  Mapping image_, image2_, motion_image_, stop_image_, written_;
};

}  // namespace pose_wall::tools::live
