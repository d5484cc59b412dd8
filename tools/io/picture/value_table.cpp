// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <cmath>

#include "io/language/engine_words.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"
#include "io/picture/palette.hpp"
#include "io/picture/parts.hpp"

namespace pose_wall::tools::picture {
namespace {

constexpr double kRow = 31.0;
constexpr std::size_t kReasonsShown = 2;

struct Columns {
  double name, value, protection, truth, state, reasons;
};

Columns columns_of(const Box& box) {
  const double x = box.corner.x;
  return {x + 20.0, x + 172.0, x + 252.0, x + 332.0, x + 352.0, x + 446.0};
}

std::string figure(uint32_t quantity, double value, bool with_sign) {
  if (!std::isfinite(value)) return "–";
  if (!is_angle(quantity)) return fmt::format("{:.3f} m", value);
  return with_sign ? fmt::format("{:+.2f}°", value * kDegPerRad) : fmt::format("{:.2f}°", value * kDegPerRad);
}

std::string reasons_text(uint32_t reasons) {
  std::string text;
  std::size_t shown = 0;
  for (uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((reasons & (1u << bit)) == 0) continue;
    if (shown == kReasonsShown) return text + " …";
    text += (shown++ > 0 ? ", " : "") + std::string(pose_wall_reason_name(bit));
  }
  return text;
}

void draw_head(Svg& svg, const Columns& columns, double y, bool with_truth) {
  const TextStyle end{kFaintInk, 11.5, Anchor::kEnd};
  const TextStyle start{kFaintInk, 11.5};
  svg.text({columns.name, y}, tr("quantity"), start);
  svg.text({columns.value, y}, tr("value"), end);
  svg.text({columns.protection, y}, tr("± protection"), end);
  if (with_truth) svg.text({columns.truth, y}, tr("truth"), end);
  svg.text({columns.state, y}, tr("state"), start);
  svg.text({columns.reasons, y}, tr("reasons"), start);
}

// Below each value: the meaning of its sign, this frame's own measurement with its level, and the level's largest part.
void draw_second_line(Svg& svg, const Columns& columns, double y, const FrameScene& scene, uint32_t quantity) {
  const pose_wall_value& value = scene.result->quantity[quantity];
  const TextStyle start{kFaintInk, 10.0}, end{kFaintInk, 10.0, Anchor::kEnd};
  const std::string sign = positive_words(*scene.result, quantity);
  if (!sign.empty()) svg.text({columns.name, y}, "+ " + sign, start);
  if (std::isfinite(value.raw)) {
    svg.text({columns.value, y}, say("raw {}", figure(quantity, value.raw, true)), end);
    svg.text({columns.protection, y}, figure(quantity, value.raw_protection_level, false), end);
  }
  if (value.cause < POSE_WALL_PARTS)
    svg.text({columns.reasons, y}, say("level mostly: {}", spoken_part(value.cause)), start);
}

void draw_row(Svg& svg, const Columns& columns, double y, const FrameScene& scene, uint32_t quantity) {
  const pose_wall_value& value = scene.result->quantity[quantity];
  const std::string_view colour = state_colour(value.state);
  svg.text({columns.name, y}, pose_wall_quantity_name(quantity), {kInk, 14.0, Anchor::kStart, true});
  // Grey as in the report: nobody may act on a value that is not valid.
  const bool is_valid = value.state == POSE_WALL_VALID;
  const std::string_view ink = is_valid ? kInk : kFaintInk;
  svg.text({columns.value, y}, figure(quantity, value.value, true), {ink, 14.0, Anchor::kEnd, is_valid});
  svg.text({columns.protection, y}, figure(quantity, value.protection_level, false), {ink, 13.0, Anchor::kEnd});
  if (scene.truth != nullptr) {
    svg.text({columns.truth, y}, figure(quantity, scene.truth[quantity], true), {kFaintInk, 13.0, Anchor::kEnd});
  }
  svg.rectangle({columns.state, y - 9.0}, 80.0, 20.0, colour, 10.0);
  svg.text({columns.state + 40.0, y + 5.5}, state_words(value.state), {kPanel, 12.0, Anchor::kMiddle, true});
  svg.text({columns.reasons, y - 0.5}, reasons_text(value.reasons), {kFaintInk, 10.5});
  draw_second_line(svg, columns, y + 11.0, scene, quantity);
}

}  // namespace

void draw_value_table(Svg& svg, const Box& box, const FrameScene& scene) {
  draw_panel(svg, box, tr("Values (smoothed or held): act on valid ones only. Below: raw, by this frame alone"));
  const Columns columns = columns_of(box);
  double y = box.corner.y + 54.0;
  draw_head(svg, columns, y, scene.truth != nullptr);
  y += 10.0;
  for (uint32_t quantity = 0; quantity < POSE_WALL_QUANTITIES; ++quantity) {
    svg.line({columns.name, y}, {box.right() - 20.0, y}, {kGrid, 1.0});
    draw_row(svg, columns, y + 15.0, scene, quantity);
    y += kRow;
  }
}

}  // namespace pose_wall::tools::picture
