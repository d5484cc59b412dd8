// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/clear.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kEndless_m = 1e9;         // longer than any scan
constexpr std::uint32_t kHidingMost = 24;  // gaps that hide something, of a sector; more of them: no guarantee

// Ranges between from_m and to_m, where a gap hides a thing.
struct Hiding {
  double from_m, to_m;
};

// Collects what the gaps of one sector hide.
class Gaps {
 public:
  explicit Gaps(const ClearScene& scene) : s_(scene) {}

  // Between the rays of two neighbouring tangents. False where nothing hides.
  bool between(double a, double b) {
    const double gap = b - a, room_m = s_.sensor_m - s_.thing_m;  // above the thing
    const double overhead_m = s_.high_m - s_.sensor_m - s_.thing_m;
    double to_m = kEndless_m;
    if (b < -s_.tilt_rad) {  // downwards
      if (s_.thing_m * (-b - s_.tilt_rad) >= gap * room_m && !(grounded_m(a) * (-b - s_.tilt_rad) < room_m))
        return false;
      to_m = room_m / (-b - s_.tilt_rad);
    } else if (a > 0.0) {  // upwards
      if (s_.thing_m * a >= gap * overhead_m) return false;
      to_m = overhead_m / a;
    }
    const double wide_m = s_.thing_m / gap, grounded = a < 0.0 ? grounded_m(a) : kEndless_m;
    return add({wide_m < grounded ? wide_m : grounded, to_m});
  }

  // Below the lowest ray.
  void below(double b) {
    const double room_m = s_.sensor_m - s_.thing_m;
    add({0.0, b < -s_.tilt_rad ? room_m / (-b - s_.tilt_rad) : kEndless_m});
  }

  // Above the highest ray.
  void above(double a) {
    const double overhead_m = s_.high_m - s_.sensor_m - s_.thing_m;
    if (a > 0.0) {
      add({0.0, overhead_m / a});
    } else if (overhead_m > 0.0) {
      add({0.0, kEndless_m});
    } else if (a < 0.0) {
      add({overhead_m / a, kEndless_m});
    }
  }

  ClearRange clear() const {
    if (count_ > kHidingMost) return {0.0F, 0.0F};
    double from_m = 0.0;
    for (std::uint32_t round = 0; round < count_; ++round) {
      const double before_m = from_m;
      for (std::uint32_t i = 0; i < count_; ++i) {
        if (hiding_[i].from_m <= from_m && hiding_[i].to_m > from_m) from_m = hiding_[i].to_m;
      }
      if (from_m == before_m) break;
    }
    double to_m = s_.reach_m;
    // Beyond this range the floor's tilt alone may lift it over the thing.
    if (to_m * s_.tilt_rad > s_.thing_m - s_.tolerance_m) to_m = (s_.thing_m - s_.tolerance_m) / s_.tilt_rad;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (hiding_[i].from_m > from_m && hiding_[i].from_m < to_m) to_m = hiding_[i].from_m;
    }
    return {static_cast<float>(from_m), static_cast<float>(to_m)};
  }

 private:
  // Where a ray of this downward tangent is taken for the floor.
  double grounded_m(double a) const {
    const double above_m = s_.sensor_m - s_.tolerance_m;
    return above_m > 0.0 ? above_m / (s_.tilt_rad - a) : 0.0;
  }

  bool add(const Hiding& hiding) {
    if (!(hiding.from_m < hiding.to_m) || hiding.from_m > s_.reach_m) return false;
    if (count_ < kHidingMost) hiding_[count_] = hiding;
    ++count_;
    return true;
  }

  const ClearScene& s_;
  Hiding hiding_[kHidingMost];
  std::uint32_t count_ = 0;
};

ClearRange least_of(const ClearRange& a, const ClearRange& b) {
  return {a.from_m > b.from_m ? a.from_m : b.from_m, a.to_m < b.to_m ? a.to_m : b.to_m};
}

}  // namespace

SlotEdges::SlotEdges() {
  constexpr double kHalf = kSlots / 2;  // to the horizon
  for (std::uint32_t i = 0; i <= kSlots; ++i) {
    const double bent = static_cast<double>(i) / kHalf - 1.0, straight = bent < 0.0 ? 1.0 + bent : 1.0 - bent;
    tangent[i] = straight > 0.0 ? kSlotBend * bent / straight : (bent < 0.0 ? -kEndless_m : kEndless_m);
  }
}

CloseSlots::CloseSlots() {
  for (std::uint32_t slot = 0; slot < kSlots; ++slot) from[slot] = static_cast<std::uint16_t>(slot);
}

ClearRange clear_range(const SectorRays& rays, const ClearScene& scene, const SlotEdges& edges, CloseSlots* close) {
  Gaps gaps(scene);
  bool any = false;
  std::uint32_t last = 0;
  for (std::uint32_t w = 0; w < kSlotWords; ++w) {
    for (std::uint32_t word = rays.word[w]; word != 0; word &= word - 1) {
      const std::uint32_t slot = 32 * w + static_cast<std::uint32_t>(__builtin_ctz(word));
      // Of a slot's rays the one that leaves the wider gap.
      if (any && last < close->from[slot]) {
        if (!gaps.between(edges.tangent[last], edges.tangent[slot + 1]))
          close->from[slot] = static_cast<std::uint16_t>(last);
      } else if (!any) {
        gaps.below(edges.tangent[slot + 1]);
      }
      any = true;
      last = slot;
    }
  }
  if (!any) return {0.0F, 0.0F};
  gaps.above(edges.tangent[last]);
  return gaps.clear();
}

void find_clear(const Evidence& evidence, const ClearScene& scene, const SlotEdges& edges, Span<ClearRange> alone,
                Span<ClearRange> clear) {
  const std::uint32_t sectors = evidence.rays.size();
  CloseSlots close;
  for (std::uint32_t i = 0; i < sectors; ++i) {
    alone[i] = clear_range(evidence.rays[i], scene, edges, &close);
    if (evidence.sector_end_m[i] < alone[i].to_m) alone[i].to_m = evidence.sector_end_m[i];
  }
  for (std::uint32_t i = 0; i < sectors; ++i) {
    const ClearRange& before = alone[i > 0 ? i - 1 : sectors - 1];
    const ClearRange& behind = alone[i + 1 < sectors ? i + 1 : 0];
    clear[i] = least_of(alone[i], least_of(before, behind));
  }
}

}  // namespace pose_wall::planar
