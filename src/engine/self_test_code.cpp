// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/self_test_code.hpp"

#include "base/math/crc32.hpp"

// Where they begin and end, as tools/cmake/one_object.ld says. Two versions of the archive in one program have symbols
// of their own, since these are local there. Objects that are linked without the archive have none: NULL.
// NOLINTBEGIN(readability-identifier-naming): named in a linker script
extern "C" {
extern const unsigned char engine_text_begin[] __attribute__((weak));
extern const unsigned char engine_text_end[] __attribute__((weak));
extern const unsigned char engine_constants_begin[] __attribute__((weak));
extern const unsigned char engine_constants_end[] __attribute__((weak));
}
// NOLINTEND(readability-identifier-naming)

namespace pose_wall {
namespace {

// Between constants AddressSanitizer keeps bytes that nothing else may read.
__attribute__((no_sanitize_address)) std::uint64_t add(const unsigned char* begin, const unsigned char* end,
                                                       Crc32* crc) {
  const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(begin), last = reinterpret_cast<std::uintptr_t>(end);
  const volatile unsigned char* byte = begin;  // as they lie in memory, whatever the compiler knows of them
  for (std::uintptr_t at = first; at < last; ++at) crc->add_byte(*byte++);
  return last - first;
}

}  // namespace

CodeSum sum_of_code() {
  if (engine_text_begin == nullptr) return {0, 0};
  Crc32 crc;
  const std::uint64_t text = add(engine_text_begin, engine_text_end, &crc);
  const std::uint64_t constants = add(engine_constants_begin, engine_constants_end, &crc);
  return {text + constants, crc.value()};
}

}  // namespace pose_wall
