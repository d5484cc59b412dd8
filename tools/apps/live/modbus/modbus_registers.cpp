// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/modbus/modbus_registers.hpp"

#include <cstring>
#include <stdexcept>

namespace pose_wall::tools::live {
namespace {

// Of a request (Modbus Messaging on TCP/IP V1.0b, 3.1.3; Modbus Application Protocol V1.1b3, 6.4).
constexpr std::size_t kHeaderBytes = 7, kFunctionAt = 7, kAddressAt = 8, kCountAt = 10;
constexpr int kReadInputRegisters = 0x04;

unsigned big_endian_at(const std::uint8_t* bytes, std::size_t at) {
  return static_cast<unsigned>(bytes[at] << 8U) | bytes[at + 1];
}

// modbus_reply would refuse it, too, but sleeps first and throws away the requests that wait behind it.
bool is_count(unsigned registers) {
  return registers >= 1 && registers <= MODBUS_MAX_READ_REGISTERS;
}

// The images are little-endian in memory on every machine that this runs on (pose_wall.h, process image).
template <typename Image>
void copy_words(const Image& image, modbus_mapping_t* mapping) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&image);
  for (int i = 0; i < mapping->nb_input_registers; ++i) {
    mapping->tab_input_registers[i] = static_cast<std::uint16_t>(bytes[2 * i] | (bytes[2 * i + 1] << 8U));
  }
}

}  // namespace

int request_bytes(const std::uint8_t* bytes, std::size_t count) {
  if (count < kHeaderBytes - 1) return 0;
  const unsigned protocol = big_endian_at(bytes, 2), length = big_endian_at(bytes, 4);
  // Unit and function at least; no more than an ADU holds.
  if (protocol != 0 || length < 2 || length + kHeaderBytes - 1 > MODBUS_TCP_MAX_ADU_LENGTH) return -1;
  const std::size_t whole = length + kHeaderBytes - 1;
  return count >= whole ? static_cast<int>(whole) : 0;
}

ModbusRegisters::ModbusRegisters(const Images& images, const StopBoard* stop)
    : images_(images),
      stop_(stop),
      context_(modbus_new_tcp("127.0.0.1", 0)),
      image_(modbus_mapping_new_start_address(0, 0, 0, 0, 0, 0, kImageRegister, kImageRegisters)),
      image2_(modbus_mapping_new_start_address(0, 0, 0, 0, 0, 0, kImage2Register, kImage2Registers)),
      motion_image_(modbus_mapping_new_start_address(0, 0, 0, 0, 0, 0, kMotionImageRegister, kMotionImageRegisters)),
      stop_image_(modbus_mapping_new_start_address(0, 0, 0, 0, 0, 0, kStopImageRegister, kStopImageRegisters)) {
  if (!context_ || !image_ || !image2_ || !motion_image_ || !stop_image_) throw std::runtime_error("Modbus: no memory");
}

bool ModbusRegisters::answer(int socket, const std::uint8_t* request, int bytes, bool* was_refused) {
  modbus_set_socket(context_.get(), socket);
  constexpr int kReadBytes = 12;  // header, function, address, count
  int sent = -1;
  if (request[kFunctionAt] != kReadInputRegisters) {
    sent = modbus_reply_exception(context_.get(), request, MODBUS_EXCEPTION_ILLEGAL_FUNCTION);
  } else if (bytes != kReadBytes || !is_count(big_endian_at(request, kCountAt))) {
    sent = modbus_reply_exception(context_.get(), request, MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE);
  } else {
    sent = answer_read(request, bytes);
  }
  constexpr int kExceptionBytes = 9;  // header, function, code; the shortest other answer has 11
  *was_refused = sent == kExceptionBytes;
  modbus_set_socket(context_.get(), -1);
  return sent > 0;
}

// The image in whose range the address lies, or the one before it: then the range's end is what is refused.
int ModbusRegisters::answer_read(const std::uint8_t* request, int bytes) {
  const unsigned address = big_endian_at(request, kAddressAt);
  if (address >= kStopImageRegister) {
    // Without a stop all bytes are 0: that is no image, and permits nothing.
    copy_words(stop_ != nullptr ? stop_->image_now() : pose_wall_planar_stop_image{}, stop_image_.get());
    return modbus_reply(context_.get(), request, bytes, stop_image_.get());
  }
  if (address >= kMotionImageRegister) {
    const std::optional<pose_wall_motion_image> image = images_.motion_image();
    if (!image) return modbus_reply_exception(context_.get(), request, MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS);
    copy_words(*image, motion_image_.get());
    return modbus_reply(context_.get(), request, bytes, motion_image_.get());
  }
  if (address >= kImage2Register) {
    copy_words(images_.image2(), image2_.get());
    return modbus_reply(context_.get(), request, bytes, image2_.get());
  }
  copy_words(images_.image(), image_.get());
  return modbus_reply(context_.get(), request, bytes, image_.get());
}

}  // namespace pose_wall::tools::live
