// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A folder of recordings that never takes more than its room: the oldest file goes first. Files are numbered, so that
// neither a clock that jumps nor a second start of the same minute makes two of one name or the newest the oldest.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pose_wall::tools::live {

class BoundedFolder {
 public:
  // ending: of its files, ".mcap". Others in the folder are left alone, and count as nothing.
  BoundedFolder(std::filesystem::path folder, std::string ending, std::uint64_t room_bytes);

  // Makes room for so many bytes and tells the path of a file that is not there: "000012_20261125T081502Z.mcap". Throws
  // std::runtime_error (by the system: std::system_error) that names the folder where it cannot be made or written, or
  // where bytes are more than the room.
  std::filesystem::path next(std::uint64_t bytes);
  // Deletes the oldest files, but for `kept`, until so many bytes more fit. Whether they do.
  bool make_room(std::uint64_t bytes, const std::filesystem::path& kept = {}) const;

  // Oldest first.
  std::vector<std::filesystem::path> files() const;
  std::uint64_t bytes() const;
  std::uint64_t room_bytes() const { return room_bytes_; }
  // Of its disk, for others than root; 0 where nobody can say.
  std::uint64_t free_bytes() const;

 private:
  std::filesystem::path folder_;
  std::string ending_;
  std::uint64_t room_bytes_;
};

}  // namespace pose_wall::tools::live
