// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/saved_trail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint32_t kSavedKeyframesLeast = 4096, kSavedKeyframesMost = 65536;  // of pose_wall_planar_slam_settings
constexpr char kTrailMagic[] = {'P', 'W', 'T', 'L'};                               // of pose_wall_planar_slam_save

std::uint32_t trail_word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

[[noreturn]] void refuse_trail(const std::filesystem::path& file, const std::string& why) {
  throw TrailFileError(fmt::format("{}: {}", file.string(), why));
}

std::string trail_bytes_of(const std::filesystem::path& file) {
  try {
    return read_whole_file(file);
  } catch (const std::runtime_error& error) {
    throw TrailFileError(error.what());
  }
}

void require_trail(const std::filesystem::path& file, const std::string& bytes) {
  if (bytes.size() < 2 * sizeof kTrailMagic || std::memcmp(bytes.data(), kTrailMagic, sizeof kTrailMagic) != 0) {
    refuse_trail(file,
                 tr("this is no map for localisation. Give the folder that `pose_wall map -o` wrote, its trail.pwt, or "
                    "a map's YAML file"));
  }
  const std::uint32_t version = trail_word_at(bytes, sizeof kTrailMagic);
  if (version != POSE_WALL_PLANAR_TRAIL_VERSION) {
    refuse_trail(file,
                 say("a trail of version {}; this program reads version {}. Make the map again with pose_wall map",
                     version, POSE_WALL_PLANAR_TRAIL_VERSION));
  }
}

pose_wall_planar_slam_settings settings_for(std::uint32_t keyframes) {
  pose_wall_planar_slam_settings settings{};
  require_ok(pose_wall_planar_slam_settings_init(&settings), translatable("the settings of the map"));
  settings.keyframes_most = keyframes;
  return settings;
}

std::uint64_t bytes_for(std::uint32_t keyframes) {
  const pose_wall_planar_slam_settings settings = settings_for(keyframes);
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_slam_memory_needed(&settings, &bytes), translatable("the settings of the map"));
  return bytes;
}

}  // namespace

SavedTrail::SavedTrail(const std::filesystem::path& file) : SavedTrail(file, trail_bytes_of(file)) {}

SavedTrail::SavedTrail(const std::filesystem::path& file, const std::string& bytes) : block_(0) {
  require_trail(file, bytes);
  std::int32_t status = POSE_WALL_E_BLOCK_SMALL;
  for (std::uint32_t most = kSavedKeyframesLeast; status == POSE_WALL_E_BLOCK_SMALL && most <= kSavedKeyframesMost;
       most *= 2) {
    block_ = PartBlock(bytes_for(most));
    const pose_wall_planar_slam_settings settings = settings_for(most);
    require_ok(pose_wall_planar_slam_open(&settings, block_.data(), block_.bytes(), &slam_),
               translatable("the settings of the map"));
    status = pose_wall_planar_slam_load(slam_, bytes.data(), bytes.size(), nullptr);
  }
  if (status == POSE_WALL_PLANAR_E_MAP_FILE) {
    refuse_trail(file,
                 tr("the trail is cut off or damaged: its checksum does not fit. Copy it again, or make the map again "
                    "with pose_wall map"));
  }
  require_ok(status, translatable("the trail"));
  pose_wall_planar_keyframe keyframe{};
  keyframe.struct_size = sizeof keyframe;
  while (pose_wall_planar_slam_keyframe(slam_, keyframes_, &keyframe) == POSE_WALL_OK) ++keyframes_;
}

pose_wall_planar_keyframe SavedTrail::keyframe(std::uint32_t number) const {
  return keyframe_of(slam_, number);
}

std::vector<float> SavedTrail::points(std::uint32_t number) const {
  const std::uint32_t points = keyframe(number).points;
  std::vector<float> xy_m(2 * std::size_t{points});
  if (points > 0) {
    require_ok(pose_wall_planar_slam_points(slam_, number, xy_m.data(), points), translatable("a keyframe"));
  }
  return xy_m;
}

}  // namespace pose_wall::tools
