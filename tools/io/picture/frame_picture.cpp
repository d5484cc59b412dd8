// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/picture/frame_picture.hpp"

#include "io/language/engine_words.hpp"
#include "io/picture/palette.hpp"
#include "io/picture/parts.hpp"

namespace pose_wall::tools::picture {
namespace {

constexpr double kWidth = 1280.0;
constexpr double kHeight = 880.0;
constexpr double kMargin = 24.0;

void draw_title(Svg& svg, const FrameScene& scene) {
  svg.text({kMargin, 42.0}, scene.title, {kInk, 23.0, Anchor::kStart, true});
  svg.text({kMargin, 65.0}, scene.subtitle, {kFaintInk, 13.5});
  svg.text({kWidth - kMargin, 42.0}, say("confidence {:.2f}", scene.result->confidence),
           {kInk, 19.0, Anchor::kEnd, true});
  const pose_wall_result& result = *scene.result;
  svg.text({kWidth - kMargin, 65.0},
           say("{} points in, {} voxels of {:.2f} m", result.points_in, result.voxels, result.voxel_leaf_m),
           {kFaintInk, 13.5, Anchor::kEnd});
}

}  // namespace

double config_number(const FrameScene& scene, const char* key) {
  double value = 0.0;
  pose_wall_config_get_number(scene.config, key, &value);
  return value;
}

void draw_panel(Svg& svg, const Box& box, std::string_view heading) {
  svg.rectangle(box.corner, box.width, box.height, kPanel, 8.0);
  svg.text({box.corner.x + 20.0, box.corner.y + 24.0}, heading, {kInk, 13.5, Anchor::kStart, true});
}

void draw_legend(Svg& svg, const Box& box) {
  const double y = box.corner.y + 0.5 * box.height;
  double x = box.corner.x + 6.0;
  const auto entry = [&](std::string_view colour, std::string_view words, double advance) {
    svg.circle({x, y - 4.0}, 5.0, colour);
    svg.text({x + 10.0, y}, words, {kFaintInk, 12.0});
    x += advance;
  };
  entry(kLeft, tr("left wall"), 96.0);
  entry(kRight, tr("right wall"), 102.0);
  entry(kFloor, tr("floor"), 72.0);
  entry(kOther, tr("other points"), 130.0);
  for (const uint32_t state : {POSE_WALL_VALID, POSE_WALL_DEGRADED, POSE_WALL_HELD, POSE_WALL_INVALID}) {
    entry(state_colour(state), state_words(state), 98.0);
  }
  svg.text({box.right(), y}, tr("thick: from first to last inlier, dotted: prolonged. ± is the protection level"),
           {kFaintInk, 12.0, Anchor::kEnd});
}

std::string frame_picture(const FrameScene& scene) {
  const DrawnFrame frame(*scene.config, *scene.result);
  const double inside = kWidth - 2.0 * kMargin;
  const double section_width = 0.46 * inside;
  Svg svg(kWidth, kHeight, kPaper);
  draw_title(svg, scene);
  draw_top_view(svg, {{kMargin, 84.0}, inside, 430.0}, scene, frame);
  draw_section(svg, {{kMargin, 530.0}, section_width, 300.0}, scene, frame);
  const double table_x = kMargin + section_width + 16.0;
  draw_value_table(svg, {{table_x, 530.0}, kWidth - kMargin - table_x, 300.0}, scene);
  draw_legend(svg, {{kMargin, 836.0}, inside, 36.0});
  return svg.document();
}

}  // namespace pose_wall::tools::picture
