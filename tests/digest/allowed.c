/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * All that the engine may ask of a library, in the plainest way: a stand-in for what a real-time system brings. Slow on
 * purpose; nothing here is delivered.
 */

#include <stddef.h>

void* memcpy(void* restrict to, const void* restrict from, size_t bytes);
void* memmove(void* to, const void* from, size_t bytes);
void* memset(void* to, int value, size_t bytes);
int memcmp(const void* a, const void* b, size_t bytes);
char* strchr(const char* text, int c);
int strcmp(const char* a, const char* b);
size_t strlen(const char* text);
double fabs(double x);
double sqrt(double x);
float sqrtf(float x);
double floor(double x);
double ceil(double x);

void* memcpy(void* restrict to, const void* restrict from, size_t bytes) {
  unsigned char* const t = to;
  const unsigned char* const f = from;
  for (size_t i = 0; i < bytes; ++i) t[i] = f[i];
  return to;
}

void* memmove(void* to, const void* from, size_t bytes) {
  unsigned char* const t = to;
  const unsigned char* const f = from;
  if (t < f) {
    for (size_t i = 0; i < bytes; ++i) t[i] = f[i];
  } else {
    for (size_t i = bytes; i > 0; --i) t[i - 1] = f[i - 1];
  }
  return to;
}

void* memset(void* to, int value, size_t bytes) {
  unsigned char* const t = to;
  for (size_t i = 0; i < bytes; ++i) t[i] = (unsigned char)value;
  return to;
}

int memcmp(const void* a, const void* b, size_t bytes) {
  const unsigned char *const x = a, *const y = b;
  for (size_t i = 0; i < bytes; ++i) {
    if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
  }
  return 0;
}

char* strchr(const char* text, int c) {
  for (; *text != (char)c; ++text) {
    if (*text == '\0') return NULL;
  }
  return (char*)(size_t)text;
}

int strcmp(const char* a, const char* b) {
  for (; *a != '\0' && *a == *b; ++a) ++b;
  return (unsigned char)*a - (unsigned char)*b;
}

size_t strlen(const char* text) {
  size_t length = 0;
  while (text[length] != '\0') ++length;
  return length;
}

double fabs(double x) {
  double magnitude;
  __asm__("fabs %d0, %d1" : "=w"(magnitude) : "w"(x));
  return magnitude;
}

double sqrt(double x) {
  double root;
  __asm__("fsqrt %d0, %d1" : "=w"(root) : "w"(x));
  return root;
}

float sqrtf(float x) {
  float root;
  __asm__("fsqrt %s0, %s1" : "=w"(root) : "w"(x));
  return root;
}

double floor(double x) {
  double whole;
  __asm__("frintm %d0, %d1" : "=w"(whole) : "w"(x));
  return whole;
}

double ceil(double x) {
  double whole;
  __asm__("frintp %d0, %d1" : "=w"(whole) : "w"(x));
  return whole;
}
