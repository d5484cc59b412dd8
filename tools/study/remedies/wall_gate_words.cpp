// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/remedies/gate_table.hpp"

#include <iterator>

namespace pose_wall::tools::explain {
namespace {

constexpr GateWords kChoiceWords[] = {
    {"levelled", translatable("The wall was not looked for: this frame has no floor to level by."),
     translatable("see the floor")},
    {"wall_planes", translatable("No plane was found on this side."),
     translatable("nothing answers there: a dark or wet wall, a window with mud on it, or a road that branches off")},
    {"wall_inliers", translatable("{value} measured points lie on the plane; {limit} are needed ({key})."),
     translatable("lower {key} for a sensor of few points")},
    {"wall_length", translatable("The plane is supported over {value} along the road; {limit} is needed ({key})."),
     translatable("show more of the wall; lower {key} for short walls")},
    {"wall_solid",
     translatable("{value} of the plane is seen through: rays pass it and end behind it; {limit} is the most."),
     translatable("pipes, props, a conveyor or a vehicle stand where the wall should be")},
    {"wall_lean", translatable("The plane leans {value} from the vertical; {limit} is allowed ({key})."),
     translatable("raise {key} where walls really lean so")},
    {"pair_parallel",
     translatable("The strongest planes of the two sides are no pair: |n_left . n_right| is {value}; {limit} is needed "
                  "({key})."),
     translatable("lower {key} where walls really run so")},
    {"wall_length_alone",
     translatable(
         "The wall has no partner on the other side. Alone it needs support over {limit} ({key}); it has {value}."),
     translatable("show more of the wall; lower {key} for short walls")},
    {"walls_parallel",
     translatable("The longest planes of the two sides make no pair: they are not parallel ({key}). "
                  "They cannot both be walls of one road."),
     translatable("a junction, a niche or a vehicle; lower {key} where walls really run so")},
    {"wall_chosen", translatable("So no plane of this side can be the wall."), ""},
    {"across",
     translatable("A pair of planes ahead and behind shows {value} of the wall that the sides show; {limit} is the "
                  "most. Beyond it the machine stands across a road, and the planes beside it are faces."),
     translatable("turn the machine along the road; check forward_axis and extrinsic_yaw")},
    {"wall_rival",
     translatable("Another plane on this side scores {value} of the chosen one, less what is seen through it and what "
                  "belongs to both. From {limit} on either may be the wall, and the protection levels reach to it."),
     translatable("a vehicle, a curtain or a niche; see the planes below")},
    {"wall_rival_behind",
     translatable("A parallel plane behind the wall scores {value} of it. From {limit} on that plane may be the wall, "
                  "and the protection levels reach to it."),
     translatable("a vehicle or a curtain before the wall; see the planes below")},
    {"wall_rival_ends",
     translatable("A parallel plane goes on past the wall's ends and scores {value} of it. From {limit} on that plane "
                  "may be the wall, and the protection levels reach to it."),
     translatable("a curtain, a long vehicle or a crosscut; see the planes below")},
    {"wall_rival_stops",
     translatable("A parallel plane before the wall stops nearly all rays and scores {value} of it. From {limit} on "
                  "that plane may be the wall, and the protection levels reach to it."),
     translatable("a mesh, or ghosts behind a wet or shining wall; see the planes below")},
};

constexpr GateWords kFitWords[] = {
    {"wall_fit", translatable("The wall's points lie in too few places to fit a plane."),
     translatable("show more of the wall")},
    {"wall_bend",
     translatable("The wall bends: at the machine it is turned by {value} against the whole plane; {limit} is allowed "
                  "(a fifth of {key})."),
     translatable("a curved road, or a wall that bulges")},
    {"sample_hole",
     translatable("Around the sampling point the wall is unseen for {value}, or seen on one side only; {limit} is "
                  "allowed. The wall may end or step there."),
     translatable("s_front and s_back set the sampling points")},
    {"sample_step", translatable("At its sampling point the wall may step out or back by {value}."),
     translatable("s_front and s_back set the sampling points")},
    {"wall_away",
     translatable(
         "The wall is first seen {value} away along the road; {limit} is allowed. In between the road may bend."),
     translatable("a sensor that looks one way only, or the machine hides the wall beside it")},
    {"fit_inliers", translatable("{value} measured points lie on the fitted wall; {limit} are needed ({key})."),
     translatable("lower {key} for a sensor of few points")},
    {"fit_stayed", translatable("The fit drifted off to a surface that is no wall."),
     translatable("show more of the wall")},
    {"wall_yaw",
     translatable("The wall is turned by {value} against the machine; {limit} is the most ({key}). Beyond it a side "
                  "and a face look alike."),
     translatable("turn the machine along the road; check forward_axis and extrinsic_yaw")},
};

constexpr GateWords kSightWords[] = {
    {"wall_bright", translatable("So little of the wall answers that a gap would go unnoticed."),
     translatable("a dark or wet wall")},
    {"wall_top_seen", translatable("The wall is not seen high enough to tell it from a conveyor."),
     translatable("the sensor hardly looks up")},
    {"wall_open_doubt",
     translatable("Near the sensor {value} of the wall is silent or seen through; more than {limit} is doubted."),
     translatable("things with gaps between them stand before the wall")},
    {"wall_grooves", translatable("The wall is grooved along its length, like pipes one above the other."),
     translatable("look for pipes before the wall")},
    {"wall_silent",
     translatable("Near the sensor {value} of the wall returns nothing; {limit} is the most. Things with gaps stand "
                  "before a wall that gives no return."),
     translatable("pipes or props before a wall too dark to be seen")},
    {"wall_island",
     translatable("The sensor looks past both ends of the plane: it is a curtain, a vehicle or a pillar."),
     translatable("this object hides the wall")},
    {"wall_low", translatable("The sensor looks over the top of the plane: it is a conveyor, pipes or a vehicle."),
     translatable("this object hides the wall")},
    {"wall_layer", translatable("Behind the wall another surface shows, equally far behind over a wall's length."),
     translatable("pipes and props hide the wall")},
    {"alone_apart",
     translatable("The wall stands alone, and the other side shows a surface turned by {value} against it; {limit} is "
                  "allowed. It is not known which of them runs along the road."),
     translatable("see the other side; a junction, or a road that widens")},
    {"wall_near",
     translatable(
         "{value} returns of this side are nearer than {key}; {limit} is the most. Something blocks the view."),
     translatable("clean the window, or move the obstacle; lower {key} where the wall is that near")},
};

}  // namespace

const GateWords* find_wall_gate(const char* gate) {
  return find_gate(gate, {{kChoiceWords, std::size(kChoiceWords)},
                          {kFitWords, std::size(kFitWords)},
                          {kSightWords, std::size(kSightWords)}});
}

}  // namespace pose_wall::tools::explain
