// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The engine's memory as bytes that are the same on every machine.

#pragma once

#include <cstdint>

#include "engine/engine.hpp"

namespace pose_wall {

std::uint64_t memento_bytes();
void save_memory(const Memory& memory, const pose_wall_moment& now, std::uint32_t config_crc32, void* to);
// False, and *then and *memory of no use, where `from` is damaged, of another version or of another config.
bool load_memory(const void* from, std::uint32_t config_crc32, pose_wall_moment* then, Memory* memory);
// Gives it to an engine, with its age from the two moments.
void take_up(const Memory& memory, const pose_wall_moment& then, const pose_wall_moment& now, Engine* engine);

}  // namespace pose_wall
