// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/modbus/modbus_registers.hpp"

#include <cstring>
#include <stdexcept>

#include "apps/live/clocks.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::size_t kHeaderBytes = 7;  // Modbus Messaging on TCP/IP V1.0b, 3.1.3

bool is_write(const std::uint8_t* request) {
  return request[kFunctionAt] == kWriteSingleRegister || request[kFunctionAt] == kWriteMultipleRegisters;
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

ModbusRegisters::ModbusRegisters(const Images& images, const StopBoard* stop, const CommandRegisters& commands)
    : images_(images),
      stop_(stop),
      commands_(commands),
      context_(modbus_new_tcp("127.0.0.1", 0)),
      image_(modbus_mapping_new_start_address(0, 0, 0, 0, 0, 0, kImageRegister, kImageRegisters)),
      image2_(modbus_mapping_new_start_address(0, 0, 0, 0, 0, 0, kImage2Register, kImage2Registers)),
      motion_image_(modbus_mapping_new_start_address(0, 0, 0, 0, 0, 0, kMotionImageRegister, kMotionImageRegisters)),
      stop_image_(modbus_mapping_new_start_address(0, 0, 0, 0, 0, 0, kStopImageRegister, kStopImageRegisters)),
      written_(modbus_mapping_new_start_address(0, 0, 0, 0, kCommandRegister, kCommandRegisters, 0, 0)) {
  if (!context_ || !image_ || !image2_ || !motion_image_ || !stop_image_ || !written_)
    throw std::runtime_error("Modbus: no memory");
}

bool ModbusRegisters::answer(int socket, std::optional<std::uint32_t> client, const std::uint8_t* request, int bytes,
                             bool* was_refused) {
  modbus_set_socket(context_.get(), socket);
  constexpr int kReadBytes = 12;  // header, function, address, count
  int sent = -1;
  if (is_write(request) && commands_.may_write(client)) {
    sent = answer_write(request, bytes);
  } else if (request[kFunctionAt] != kReadInputRegisters) {
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

int ModbusRegisters::answer_write(const std::uint8_t* request, int bytes) {
  const int fault = commands_.write(request, static_cast<std::size_t>(bytes));
  if (fault != 0) return modbus_reply_exception(context_.get(), request, static_cast<unsigned>(fault));
  // It makes the answer alone; what was written is kept elsewhere.
  return modbus_reply(context_.get(), request, bytes, written_.get());
}

// The image in whose range the address lies, or the one before it: then the range's end is what is refused.
int ModbusRegisters::answer_read(const std::uint8_t* request, int bytes) {
  const unsigned address = big_endian_at(request, kAddressAt);
  if (address >= kStopImageRegister) {
    // Without a stop all bytes are 0: that is no image, and permits nothing.
    const StopNews news = stop_ != nullptr ? stop_->stop_now() : StopNews{};
    if (news.answered_ns != 0) answer_ages_.note(monotonic_ns() - news.answered_ns);
    copy_words(stop_ != nullptr ? image_of(news) : pose_wall_planar_stop_image{}, stop_image_.get());
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
