// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The forms that a vectoriser likes to fuse: pairs a*b-c, a*b+c of rotations and complex products, sums of products.
// check_fused.py compiles it for machines with fused instructions, by the libraries' own flags.

struct Place {
  double x, y;
};

struct SmallPlace {
  float x, y;
};

template <typename Any>
void turn(Any* __restrict to, const Any* from, const Any* by) {
  to->x = from->x * by->x - from->y * by->y;
  to->y = from->x * by->y + from->y * by->x;
}

void turn_one(Place* __restrict to, const Place* from, const Place* by) {
  turn(to, from, by);
}

void turn_many(Place* __restrict to, const Place* from, const Place* by, int count) {
  for (int i = 0; i < count; ++i) turn(to + i, from + i, by + i);
}

void turn_many_small(SmallPlace* __restrict to, const SmallPlace* from, const SmallPlace* by, int count) {
  for (int i = 0; i < count; ++i) turn(to + i, from + i, by + i);
}

void turn_all_alike(Place* __restrict to, const Place* from, double cosine, double sine, int count) {
  for (int i = 0; i < count; ++i) {
    to[i].x = from[i].x * cosine - from[i].y * sine;
    to[i].y = from[i].x * sine + from[i].y * cosine;
  }
}

void add_turned(Place* __restrict to, const Place* from, const Place* by, int count) {
  for (int i = 0; i < count; ++i) {
    to[i].x += from[i].x * by[i].x - from[i].y * by[i].y;
    to[i].y += from[i].x * by[i].y + from[i].y * by[i].x;
  }
}

void add_products(float* __restrict to, const float* a, const float* b, int count) {
  for (int i = 0; i < count; ++i) to[i] += a[i] * b[i];
}

double add_product(double a, double b, double c) {
  return a * b + c;
}
