// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Tables of what the C ABI refuses. A library's world holds all that its calls read and write. A call is made with the
// world's arguments; a row spoils one of them, and names the status that must come. Nothing of the world may change
// then. The same call without a fault gives OK, so that a row is refused for what it says and nothing else.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::test {

constexpr char kLetters[] = "abcdefghijklmnopqrstuvwxyz_0123456789";

constexpr std::int32_t kNull = POSE_WALL_E_NULL, kSize = POSE_WALL_E_STRUCT_SIZE, kNewer = POSE_WALL_E_STRUCT_NEWER;

using WorldBytes = std::vector<unsigned char>;

// Appended to what a world compares; padding and all.
inline void append(const void* from, std::uint64_t count, WorldBytes* to) {
  const auto* const bytes = static_cast<const unsigned char*>(from);
  to->insert(to->end(), bytes, bytes + count);
}

template <typename World>
struct Call {
  const char* name;  // as in the header
  std::int32_t (*make)(World*);
  bool takes_handle = false;       // its first argument is an engine, a motion or a runtime
  std::int32_t without_fault = 0;  // what it gives then: OK but for what programs of an earlier ABI call
};

template <typename World>
struct Refusal {
  const char* call;
  const char* fault;
  std::int32_t status;
  void (*spoil)(World*);
};

template <typename World, std::size_t calls>
const Call<World>& call_of(const Call<World> (&all)[calls], const std::string& name) {
  const auto* const call = std::find_if(std::begin(all), std::end(all), [&](const auto& c) { return name == c.name; });
  if (call == std::end(all)) throw std::runtime_error(name + " is no call of this table");
  return *call;
}

template <typename World>
void expect_refused(World* world, const Call<World>& call, const Refusal<World>& row) {
  SCOPED_TRACE(std::string(call.name) + ": " + row.fault);
  world->restore();
  row.spoil(world);
  static WorldBytes before, after;  // megabytes, hundreds of times
  world->copy(&before);
  EXPECT_EQ(call.make(world), row.status);
  world->copy(&after);
  EXPECT_TRUE(after == before) << "a refused call wrote";
}

template <typename World, std::size_t calls, std::size_t rows>
void expect_table(World* world, const Call<World> (&all)[calls], const Refusal<World> (&table)[rows]) {
  for (const Call<World>& call : all) {
    world->restore();
    EXPECT_EQ(call.make(world), call.without_fault) << call.name << " without a fault";
  }
  for (const Refusal<World>& row : table) expect_refused(world, call_of(all, row.call), row);
}

// What else a handle may be than open: of every call that takes one.
template <typename World, std::size_t calls, std::size_t faults>
void expect_handles(World* world, const Call<World> (&all)[calls], const Refusal<World> (&handles)[faults]) {
  int tried = 0;
  for (const Call<World>& call : all) {
    if (!call.takes_handle) continue;
    ++tried;
    for (const Refusal<World>& handle : handles) expect_refused(world, call, handle);
  }
  EXPECT_GT(tried, 0);
}

// Every function of a header that gives a status. The header lies where the repository has it: tests run at its root.
inline std::set<std::string> functions_with_a_status(const std::string& header) {
  std::ifstream file(header);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::string type = "int32_t ";
  std::set<std::string> names;
  for (std::size_t at = text.find(type); at != std::string::npos; at = text.find(type, at + 1)) {
    const std::size_t name = at + type.size(), end = text.find_first_not_of(kLetters, name);
    const bool is_signed = at > 0 && text[at - 1] != 'u';
    if (is_signed && end != std::string::npos && text[end] == '(' && text.compare(name, 10, "pose_wall_") == 0) {
      names.insert(text.substr(name, end - name));
    }
  }
  return names;
}

// A function of the header that can fail and stands in no table would be refused untested.
template <typename World, std::size_t calls>
void expect_every_call_of(const std::string& header, const Call<World> (&all)[calls]) {
  std::set<std::string> declared = functions_with_a_status(header);
  EXPECT_GE(declared.size(), 10U) << header << " was not read, or is written otherwise";
  for (const Call<World>& call : all) declared.erase(call.name);
  for (const std::string& name : declared) ADD_FAILURE() << name << " is in no table";
}

}  // namespace pose_wall::test
