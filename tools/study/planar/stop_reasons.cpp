// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/stop_reasons.hpp"

#include <iterator>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// In the order of the bits; the words of the live page.
constexpr const char* kReasons[] = {translatable("no new frame"),
                                    translatable("a place in the way is not seen"),
                                    translatable("invalid frame"),
                                    translatable("the cloud does not change"),
                                    translatable("motion not known"),
                                    translatable("a thing in the way"),
                                    translatable("low"),
                                    translatable("it may come nearer"),
                                    translatable("faster than allowed"),
                                    translatable("dust or a thin thing"),
                                    translatable("floor not seen"),
                                    translatable("not clear for long enough yet")};
static_assert(std::size(kReasons) == POSE_WALL_PLANAR_STOP_REASON_COUNT);

}  // namespace

std::string stop_reasons_text(std::uint32_t reasons) {
  std::string text;
  for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) == 0) continue;
    if (!text.empty()) text += tr(", ");
    text += tr(kReasons[bit]);
  }
  return text;
}

}  // namespace pose_wall::tools
