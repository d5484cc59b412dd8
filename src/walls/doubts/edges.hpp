// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the sensor sees past the edges of a chosen plane, place by place along it: two ends and the top.

#pragma once

#include "base/containers/arena.hpp"
#include "base/estimation/plane.hpp"
#include "walls/doubts/edge_places.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

struct WallEdges {
  // It looks past both ends, near itself: a curtain or a vehicle that hides the wall. A wall goes on until it is out of
  // sight; one that bends away is seen just behind its end, and behind an opening there is more of it.
  bool island = false;
  // It looks over the top, if only far ahead where its rays have risen so high: a conveyor, or pipes. A wall reaches up
  // to the roof, or higher than the sensor looks.
  bool low = false;
  // Next to nothing is seen where the plane should be above most things that stand along walls, neither the plane nor
  // anything before it: the sensor hardly looks up, and cannot tell a wall from a conveyor.
  bool top_unseen = false;
  // Behind it, through gaps and past its foot and top, another surface shows itself, parallel to it and as long: a wall
  // behind pipes and props that hide nearly all of it.
  bool layer_behind = false;
};

struct EdgeScratch {
  EndPlaces ends;
  TopPlaces tops;
  DepthsBehind depths;

  void lay_out(Arena& arena) { tops.lay_out(arena); }
};

// margin_m: returns this near to the plane are the plane's.
WallEdges look_past(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double margin_m,
                    EdgeScratch* scratch);

}  // namespace pose_wall
