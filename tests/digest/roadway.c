/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

#include "roadway.h"

typedef struct vec {
  double x, y, z;
} vec;
typedef struct turn {
  double c, s;
} turn;

static turn turn_by(double half_tangent) {
  const double t = half_tangent, n = 1.0 + t * t;
  const turn out = {(1.0 - t * t) / n, 2.0 * t / n};
  return out;
}

static turn further(turn a, turn b) {
  const turn out = {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s};
  return out;
}

static vec about_z(turn a, vec v) {
  const vec out = {a.c * v.x - a.s * v.y, a.s * v.x + a.c * v.y, v.z};
  return out;
}

static vec about_y(turn a, vec v) {
  const vec out = {a.c * v.x + a.s * v.z, v.y, a.c * v.z - a.s * v.x};
  return out;
}

static vec about_x(turn a, vec v) {
  const vec out = {v.x, a.c * v.y - a.s * v.z, a.s * v.y + a.c * v.z};
  return out;
}

uint64_t scramble(uint64_t x) { /* splitmix64 */
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

static double unit_of(uint64_t bits) { /* in [0, 1): 2^32 steps, exact */
  return (double)(uint32_t)(bits >> 32) / 4294967296.0;
}

/* The sum of four uniform numbers is nearly normal; variance 1. */
static double normal_of(uint64_t bits) {
  const double sum = (double)(bits & 0xFFFFu) + (double)((bits >> 16) & 0xFFFFu) + (double)((bits >> 32) & 0xFFFFu) +
                     (double)(bits >> 48);
  return (sum / 65536.0 - 2.0) * 1.7320508;
}

/* Bumps in [-1, 1] on a lattice of one step, smooth between its corners. u and v beyond -1000. */
static double bumps(double u, double v, uint64_t seed) {
  const double at_u = u + 1000.0, at_v = v + 1000.0;
  const uint64_t iu = (uint64_t)at_u, iv = (uint64_t)at_v;
  const double fu = at_u - (double)iu, fv = at_v - (double)iv;
  const double su = fu * fu * (3.0 - 2.0 * fu), sv = fv * fv * (3.0 - 2.0 * fv);
  double corner[4];
  for (uint64_t k = 0; k < 4; ++k) {
    corner[k] = 2.0 * unit_of(scramble((iu + (k & 1u)) << 32 ^ (iv + (k >> 1)) << 8 ^ seed)) - 1.0;
  }
  const double low = corner[0] + su * (corner[1] - corner[0]), high = corner[2] + su * (corner[3] - corner[2]);
  return low + sv * (high - low);
}

static double rock_m(const roadway* road, double u, double v, uint64_t seed) {
  return road->rough_m * (0.7 * bumps(u, v, seed) + 0.3 * bumps(3.1 * u, 3.1 * v, seed + 1));
}

static int holds(range_of range, double x) {
  return x >= range.from && x <= range.to;
}

/* Steel sets of 15 cm, 1 m apart. */
static int on_steel(const roadway* road, double x_m) {
  const double place = x_m + 1000.0;
  return road->steel_m > 0.0 && place - (double)(uint64_t)place < 0.15;
}

/* Where the ray enters the box, or beyond. */
static double enters(const box* b, vec from, vec ray, double beyond) {
  const double at[3] = {from.x, from.y, from.z}, way[3] = {ray.x, ray.y, ray.z};
  const range_of sides[3] = {b->x, b->y, b->z};
  double in = 0.0, out = beyond;
  for (int k = 0; k < 3; ++k) {
    if (way[k] == 0.0) {
      if (!holds(sides[k], at[k])) return beyond;
      continue;
    }
    const double a = (sides[k].from - at[k]) / way[k], c = (sides[k].to - at[k]) / way[k];
    const double first = a < c ? a : c, last = a < c ? c : a;
    if (first > in) in = first;
    if (last < out) out = last;
  }
  return in < out && in > 0.0 ? in : beyond;
}

/* Range to the plane at a distance of the ray's own axis, bumps taken along the ray; or beyond. */
static double meets(double distance_m, double along, double beyond) {
  const double range_m = along != 0.0 ? distance_m / along : beyond;
  return range_m > 0.0 && range_m < beyond ? range_m : beyond;
}

static double wall_range_m(const roadway* road, vec from, vec ray, double side, double beyond) {
  const double distance_m = side * road->half_width_m - from.y;
  const double flat_m = meets(distance_m, ray.y, beyond);
  if (flat_m >= beyond) return beyond;
  const double x = from.x + flat_m * ray.x, z = from.z + flat_m * ray.z;
  if (side < 0.0 && holds(road->door_x, x) && z < 2.2) return meets(distance_m + 3.0 * side, ray.y, beyond);
  const double nearer_m = on_steel(road, x) ? road->steel_m : rock_m(road, x, z, side < 0.0 ? 7 : 11);
  return flat_m * (1.0 - nearer_m / (distance_m * side));
}

static double range_of_ray_m(const roadway* road, vec from, vec ray) {
  const double far_m = 60.0;
  const double floor_flat_m = meets(-from.z, ray.z, far_m);
  double range_m = floor_flat_m;
  if (floor_flat_m < far_m) {
    const double up_m = 0.5 * rock_m(road, from.x + floor_flat_m * ray.x, from.y + floor_flat_m * ray.y, 3);
    range_m = floor_flat_m * (1.0 - up_m / from.z);
  }
  const double others_m[4] = {meets(road->height_m - from.z, ray.z, far_m),
                              meets(road->face_x_m - from.x, ray.x, far_m), wall_range_m(road, from, ray, 1.0, far_m),
                              wall_range_m(road, from, ray, -1.0, far_m)};
  for (int k = 0; k < 4; ++k) {
    if (others_m[k] < range_m) range_m = others_m[k];
  }
  for (uint32_t k = 0; k < road->box_count; ++k) range_m = enters(&road->boxes[k], from, ray, range_m);
  return range_m < far_m ? range_m : 0.0;
}

/* Directions of the sensor, one after the other. */
typedef struct sweep {
  turn azimuth, step;
  uint64_t chance;
} sweep;

static vec next_ray(const scanner* s, uint32_t line, sweep* at) {
  const double span = s->elevation_t.to - s->elevation_t.from;
  at->azimuth = further(at->azimuth, at->step);
  const double share = s->lines == 0 ? unit_of(at->chance) : ((double)line + 0.5) / (double)s->lines;
  const turn up = turn_by(s->elevation_t.from + span * share);
  const vec ray = {up.c * at->azimuth.c, up.c * at->azimuth.s, up.s};
  return ray;
}

/* A machine that turns a little as it goes. */
static vec into_road(const roadway* road, uint32_t frame, vec ray) {
  const vec base = about_z(turn_by(road->mount_yaw_t), ray);
  const vec level = about_y(turn_by(road->pitch_t), about_x(turn_by(road->roll_t), base));
  return about_z(turn_by(road->yaw_t + 0.001 * (double)frame), level);
}

uint32_t roadway_scan(const roadway* road, uint32_t frame, float (*points)[3]) {
  const scanner* s = &road->scanner;
  const vec from = {road->step_m * (double)frame, road->sensor_y_m, road->sensor_z_m};
  /* 2 atan(pi / n) falls short of a turn's n-th part by less than the sensor's step; by chance: two steps of no turn */
  const double step_t = s->lines == 0 ? 0.7346 : 3.14159265358979 / (double)s->turns;
  uint32_t count = 0;
  for (uint32_t line = 0; line < (s->lines == 0 ? 1u : s->lines); ++line) {
    sweep at = {turn_by(0.0), turn_by(step_t), 0};
    for (uint32_t k = 0; k < s->turns && count < ROADWAY_POINTS_MAX; ++k) {
      at.chance = scramble((uint64_t)frame << 40 ^ (uint64_t)line << 20 ^ k);
      const vec ray = next_ray(s, line, &at);
      const double range_m = range_of_ray_m(road, from, into_road(road, frame, ray));
      const uint64_t luck = scramble(at.chance);
      if (range_m == 0.0 || (luck & 127u) == 0) continue; /* one return in 128 is lost */
      const double measured_m = range_m + road->noise_m * normal_of(scramble(luck));
      points[count][0] = (float)(measured_m * ray.x);
      points[count][1] = (float)(measured_m * ray.y);
      points[count][2] = (float)(measured_m * ray.z);
      ++count;
    }
  }
  return count;
}
