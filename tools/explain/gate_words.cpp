// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "explain/gate_words.hpp"

#include <fmt/format.h>

#include <cstring>
#include <iterator>

#include "explain/amounts.hpp"

namespace pose_wall::tools::explain {
namespace {

struct GateWords {
  const char* gate;
  const char* failed;  // {value}, {limit} and {key} are put in
  const char* help;
};

constexpr GateWords kFrameWords[] = {
    {"leaf", "There were more voxels than points_max has room for, so they were made {value} wide instead of {limit}.",
     "raise points_max"},
    {"voxels_fit", "Even the largest voxels do not fit into points_max: points fill the air, or it is far too small.",
     "raise points_max; where dust or spray fills the air, wait"},
    {"points", "Only {value} voxels are left after the filters; {limit} are needed.", ""},
    {"stamp_still",
     "Its stamp is less than a millisecond after the frame before, so it counts as the same frame again.",
     "the driver's clock stands still, or its stamps are no nanoseconds"},
    {"stamp_back",
     "Its stamp is {value} from the frame before: the clock jumped back, and nobody knows how old the "
     "held values are.",
     "the clock that stamps the frames was set back"},
    {"stamp_leap",
     "Its stamp is {value} after the frame before; more than {limit} ({key}) is a leap, and smoothing "
     "starts afresh.",
     "frames were lost, or the clock was set"},
    {"inputs",
     "What the machine told of itself was not used: it contradicts itself, or what was measured speaks against it.",
     "speed, turn rate and standing still, as the caller gives them: their signs, units and sigmas"},
    {"work",
     "It was not finished: the frame had taken {value} steps when more were needed, and {limit} is the most ({key}).",
     "dust, clutter or very many points make a frame expensive; a larger {key} where the time is there"},
    {"repeated", "The very same points came {value} times again under new stamps: no LiDAR does that.",
     "the sensor, its driver or the network is frozen"},
    {"frozen", "After {limit} repeats ({key}) the sensor counts as frozen, and nothing new is measured.",
     "the sensor, its driver or the network is frozen"},
};

constexpr GateWords kFloorWords[] = {
    {"floor_points",
     "Only {value} voxels are open ground, with nothing standing on them or hanging under them; {limit} "
     "are needed.",
     "the floor gives no return (water, dark ground), is hidden, or the sensor does not look down; ask for more with "
     "ground_roi_radius_max"},
    {"floor_planes", "No plane was found that may be the floor.",
     "the floor gives no return (water, dark ground) or is hidden; check extrinsic_*, ground_height_min, "
     "ground_height_max and ground_tilt_max_deg"},
    {"floor_fit", "Its points lie nearly on one line, or in too few places: there is nothing to fit a plane to.",
     "show more of the floor, ground_roi_radius_max"},
    {"floor_bend",
     "It bends: at the machine it is tilted by {value} against the whole; {limit} is let pass (a fifth of "
     "{key}).",
     "a smaller ground_roi_radius keeps the floor local"},
    {"floor_rival",
     "By open ground and height another plane scores {value} of the chosen one; from {limit} on either "
     "may be the floor, and the protection levels reach to it.",
     "a bench, a heap or a reflection; see the planes below"},
    {"floor_rival_steep",
     "It is steep, and by open ground and height another plane scores {value} of it; from {limit} on either may be the "
     "floor, and the protection levels reach to it.",
     "a heap's flank, a bench or a reflection; see the planes below"},
    {"floor_alone",
     "It is small, and a plane that lies otherwise shows {value} of its open ground; from {limit} on "
     "neither can be taken for the floor.",
     "show more of the floor"},
    {"floor_tilt", "It is tilted by {value} against base; {limit} is allowed ({key}).",
     "check extrinsic_roll and extrinsic_pitch; {key} where the machine really stands so"},
    {"floor_height_min", "The sensor is {value} above it; {limit} at least is asked ({key}).",
     "check extrinsic_z; {key} where the sensor hangs so low"},
    {"floor_height_max", "The sensor is {value} above it; {limit} is allowed ({key}).",
     "check extrinsic_z; {key} where the sensor hangs so high"},
    {"floor_stayed", "The fit wandered off from the surface that it began with.", "show more of the floor"},
    {"floor_inliers", "{value} measured points lie on it; {limit} are needed ({key}).",
     "a sensor of few points needs a smaller {key}; ground_roi_radius_max lets it look further out"},
    {"floor_area", "{value} of it are seen as open ground; {limit} are needed.",
     "show more of the floor; ground_roi_radius_max lets it look further out"},
    {"floor_spread", "What is seen of it is a strip that spreads by {value} across; {limit} are needed.",
     "show more of the floor to the sides"},
    {"floor_beside",
     "It is seen to one side of the machine only, and other ground, that lies otherwise by {value}, to the other: the "
     "machine may stand on that, and the protection levels reach to it.",
     "a ramp, a belt or a table; show more of the floor around the machine"},
    {"floor_by_walls",
     "Both walls lean the same way about the road, which says that the floor may be off by {value}: a "
     "heap's flank, perhaps.",
     "clear the heap"},
};

constexpr GateWords kChoiceWords[] = {
    {"levelled", "It was not looked for: this frame has no floor to level by.", "see the floor"},
    {"wall_planes", "No plane at all was found on this side.",
     "nothing answers there: a dark or wet wall, a window with mud on it, or a road that branches off"},
    {"wall_inliers", "{value} measured points lie on the plane; {limit} are needed ({key}).",
     "a sensor of few points needs a smaller {key}"},
    {"wall_length", "It is supported over {value} along the road; {limit} are needed ({key}).",
     "show more of the wall; {key}"},
    {"wall_solid", "{value} of it is seen through: rays pass the plane and end behind it; {limit} is the most.",
     "pipes, props, a conveyor or a vehicle stand where the wall should be"},
    {"wall_lean", "It leans {value} from the vertical; {limit} is allowed ({key}).", "{key}"},
    {"pair_parallel",
     "The strongest planes of the two sides are no pair: |n_left . n_right| is {value}, more than {limit} is asked "
     "({key}).",
     "{key} where walls really run so"},
    {"pair_length",
     "The strongest planes of the two sides are no pair: together they are supported over {value}, and "
     "{limit} are needed.",
     "show more of the walls"},
    {"pair_contested", "The strongest pair is contested: another plane, stronger than its partner, runs apart from it.",
     "walls that run apart"},
    {"pair_share",
     "The strongest pair shows {value} of what one wall alone shows; less than {limit} is a pair by chance.",
     "the other wall is hardly seen"},
    {"wall_length_alone",
     "It has no partner on the other side, and alone it must be supported over {limit} ({key}); it is over {value}.",
     "show more of the wall; {key}"},
    {"wall_filled",
     "It has no partner on the other side, and alone it must be solid over {limit} of its span; it is over {value}.",
     "flat spots that happen to lie in line are no wall"},
    {"walls_parallel",
     "The longest planes of the two sides make no pair: they do not run parallel ({key}), or a stronger plane runs "
     "apart "
     "from them, and they cannot both be walls of one road.",
     "a junction, a niche or a vehicle; {key} where walls really run so"},
    {"wall_chosen", "So no plane of this side can be the wall.", ""},
    {"across",
     "A pair of planes ahead and behind shows {value} of the wall that the sides show; from {limit} on the "
     "machine stands across a road, and what is beside it are faces.",
     "turn the machine along the road; check forward_axis and extrinsic_yaw"},
    {"across_alone",
     "A plane ahead or behind shows {value} of what the one wall shows; from {limit} on it may be the "
     "road's direction.",
     "turn the machine along the road; check forward_axis and extrinsic_yaw"},
    {"explained",
     "The planes chosen on both sides explain {value} of what is seen at the height of walls; {limit} at "
     "least are needed. That is a hall, a cavern or a heap of things, but no road.",
     "wall_z_min and wall_z_max set the height of walls"},
    {"wall_rival",
     "By what it shows and what is seen through it another plane on this side scores {value} of the chosen one; "
     "from {limit} on either may be the wall, and the protection levels reach to it.",
     "a vehicle, a curtain or a niche; see the planes below"},
    {"wall_rival_behind",
     "A parallel plane behind it scores {value} of it; from {limit} on that may be the wall, and the protection levels "
     "reach to it.",
     "a vehicle or a curtain before the wall; see the planes below"},
    {"wall_rival_ends",
     "A parallel plane goes on past its ends and scores {value} of it; from {limit} on that may be the wall, and the "
     "protection levels reach to it.",
     "a curtain, a long vehicle or a crosscut; see the planes below"},
    {"wall_rival_stops",
     "A parallel plane before it stops nearly all rays and scores {value} of it; from {limit} on that may be the wall, "
     "and the protection levels reach to it.",
     "a mesh, or ghosts behind a wet or shining wall; see the planes below"},
};

constexpr GateWords kFitWords[] = {
    {"wall_fit", "Its points lie in too few places: there is nothing to fit a plane to.", "show more of the wall"},
    {"wall_bend",
     "It bends: at the machine it is turned by {value} against the whole; {limit} is let pass (a fifth of "
     "{key}).",
     "a curved road; nothing is wrong"},
    {"sample_bend", "It bends by {value} at a sampling point; {limit} is let pass (a fifth of {key}).",
     "a curved road; nothing is wrong"},
    {"sample_offset",
     "At the height of its sampling point the wall lies {value} off its plane; {limit} is let pass (a fifth of {key}).",
     "an arch, or a heap along the wall: wall_z_min and wall_z_max set the heights that the plane is fitted on"},
    {"sample_gap",
     "Nothing of the wall is seen at its sampling point: the nearest part is {value} away ({limit} is let "
     "pass), and the plane is prolonged to it.",
     "s_front and s_back set the sampling points"},
    {"sample_hole",
     "Around its sampling point nothing is seen of the wall for {value} ({limit} is let pass), or it is seen to one "
     "side only: it may end or step there.",
     "s_front and s_back set the sampling points"},
    {"sample_before",
     "The sampling point lies behind the wall's plane, in the rock: the distance tells how far, and has no sign.",
     "s_front, s_back, lateral_offset_left and lateral_offset_right set the sampling points"},
    {"sample_step", "At its sampling point the wall may step out or back by {value}.",
     "s_front and s_back set the sampling points"},
    {"wall_away", "It is seen only {value} away along the road ({limit} is let pass): in between the road may bend.",
     "a sensor that looks one way only, or the machine hides the wall beside it"},
    {"wall_solid_doubt", "{value} of it is seen through; from {limit} on it is doubted.",
     "things stand before the wall"},
    {"fit_inliers", "{value} measured points lie on the fitted wall; {limit} are needed ({key}).",
     "a sensor of few points needs a smaller {key}"},
    {"fit_stayed", "The fit wandered off to what is no wall any more.", "show more of the wall"},
    {"wall_yaw",
     "It is turned by {value} against the machine; beyond {limit} ({key}) side and face cannot be told "
     "apart.",
     "turn the machine along the road; check forward_axis and extrinsic_yaw"},
};

constexpr GateWords kSightWords[] = {
    {"wall_bright", "So little of it answers that a gap would go unnoticed.", "a dark or wet wall"},
    {"wall_top_seen", "It is not seen high enough to be told from a conveyor.", "the sensor hardly looks up"},
    {"wall_open_doubt", "Near the sensor {value} of it is silent or seen through; from {limit} on it is doubted.",
     "things with gaps between them stand before the wall"},
    {"wall_grooves", "It is grooved along its length, like pipes one above the other.", "pipes"},
    {"wall_silent",
     "Near the sensor nothing comes back from {value} of it; {limit} is the most: things with gaps before "
     "a wall that gives no return.",
     "pipes or props before a wall too dark to be seen"},
    {"wall_open", "Near the sensor {value} of it is silent or seen through; {limit} is the most: it has gaps.",
     "pipes, props or a row of things stand where the wall should be"},
    {"wall_topless",
     "Over the top of {value} of it something behind is seen, or nothing; {limit} is the most: a wall "
     "reaches up to the roof.",
     "a conveyor, a vehicle or a curtain stands where the wall should be"},
    {"wall_island", "The sensor looks past both of its ends: it is a curtain, a vehicle or a pillar.",
     "what stands there hides the wall"},
    {"wall_low", "The sensor looks over its top: it is a conveyor, pipes or a vehicle.",
     "what stands there hides the wall"},
    {"wall_layer", "Behind it another surface shows itself, equally far behind over a wall's length.",
     "pipes and props hide the wall"},
    {"left_alone",
     "The other side was refused, and alone it must be supported over {limit} ({key}); it is over "
     "{value}.",
     "see the other side; {key}"},
    {"alone_apart",
     "It stands alone, and what is seen on the other side is turned by {value} against it: which of them runs "
     "along the road is not known.",
     "see the other side; a junction, or a road that widens"},
    {"short_apart",
     "It is shorter than a wall that stands alone ({key}), and turned by {value} against the other side's; beyond "
     "{limit} "
     "that one does not vouch for it.",
     "see the other side; show more of the wall"},
    {"wall_near",
     "{value} returns of this side are nearer than {key}; at most {limit} are let pass: something blocks the view.",
     "clean the window, or move what stands there; a smaller {key} where the wall is that near"},
};

constexpr GateWords kOutcomeWords[] = {
    {"protection_raw", "The protection level of this frame's own measurement is {value}, beyond {limit} ({key}).",
     "more of the surface in view, or a larger {key} if you can bear it"},
    {"rate", "The smoothed yaw was to turn by {value} and follows by {limit} a frame ({key}).", ""},
    {"innovation",
     "It jumped by {value} from the last good value; {limit} can be motion and errors ({key}). Both stay "
     "possible until it has come again.",
     "a faster machine needs a larger {key}"},
    {"doubted", "A rival was seen a moment ago: for {value} frames more, this one among them, the level reaches to it.",
     ""},
    {"confirmed", "Frames before it were refused and none was good yet: it has to come again, {value} more.", ""},
    {"protection_smoothed", "Its protection level is {value}; {limit} is the alert limit ({key}).",
     "more of the surface in view, or a larger {key} if you can bear it"},
    {"ever", "It was never measured before, so there is nothing to hold.", ""},
    {"protection_held", "The held value's protection level has grown to {value}, beyond {limit} ({key}).", ""},
    {"held_age", "The held value is {value} old; {limit} is the most ({key}).", ""},
    {"held_before", "What was held had expired before, by time or by a stamp that jumped or stood still.", ""},
    {"work", "The frame had taken {value} steps when more were needed; {limit} is the most ({key}).",
     "a smaller points_max or range_max makes frames cheaper; a larger {key} lets them take longer"},
};

const GateWords* find(const char* gate) {
  for (const auto& [words, count] : {std::pair{kFrameWords, std::size(kFrameWords)},
                                     {kFloorWords, std::size(kFloorWords)},
                                     {kChoiceWords, std::size(kChoiceWords)},
                                     {kFitWords, std::size(kFitWords)},
                                     {kSightWords, std::size(kSightWords)},
                                     {kOutcomeWords, std::size(kOutcomeWords)}}) {
    for (std::size_t i = 0; i < count; ++i) {
      if (std::strcmp(words[i].gate, gate) == 0) return &words[i];
    }
  }
  return nullptr;
}

std::string filled(const char* words, const Note& note) {
  return fmt::format(fmt::runtime(words), fmt::arg("value", value_text(note)), fmt::arg("limit", limit_text(note)),
                     fmt::arg("key", key_of(note)));
}

}  // namespace

std::string sentence_of(const Note& note) {
  const GateWords* words = find(note.info.name);
  return words != nullptr ? filled(words->failed, note) : "";
}

std::string help_of(const Note& note) {
  const GateWords* words = find(note.info.name);
  return words != nullptr ? filled(words->help, note) : "";
}

}  // namespace pose_wall::tools::explain
