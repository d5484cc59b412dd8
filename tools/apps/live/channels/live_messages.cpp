// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/channels/live_messages.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/live/result_json.hpp"
#include "io/config_file/key_table.hpp"
#include "io/json/json_words.hpp"

namespace pose_wall::tools::live {
namespace {

// foxglove.LogLevel
enum LogLevel { kInfo = 2, kWarning = 3, kError = 4 };

LogLevel level_of(Grade grade) {
  return grade == Grade::kGood ? kInfo : grade == Grade::kWarning ? kWarning : kError;
}

std::string log_message(const PartHealth& part, std::int64_t now_ns) {
  return json_text({{"timestamp", {{"sec", now_ns / 1'000'000'000}, {"nsec", now_ns % 1'000'000'000}}},
                    {"level", level_of(part.grade)},
                    {"message", part.summary},
                    {"name", part.part},
                    {"file", ""},
                    {"line", 0}});
}

void put_some(ChannelOut* out, ChannelNumber channel, std::string message) {
  if (!message.empty()) out->put(channel, std::move(message));
}

}  // namespace

LiveMessages::LiveMessages(const LoadedConfig& loaded)
    : ros_(MessageEncoding::kCdr, config_text(*loaded.config.get(), "base_frame")),
      planar_(MessageEncoding::kCdr, loaded.planar, config_text(*loaded.config.get(), "base_frame")),
      scene_(loaded) {}

void LiveMessages::tell(const LiveResult& result, ChannelOut* out) const {
  if (result.frame && out->wants(kCloudChannel)) out->put(kCloudChannel, ros_.cloud(*result.frame));
  if (out->wants(kResultChannel)) out->put(kResultChannel, result_json(result));
  if (out->wants(kTransformChannel)) out->put(kTransformChannel, scene_.transforms(result));
  if (out->wants(kPoseChannel)) put_some(out, kPoseChannel, scene_.pose(result));
  if (out->wants(kSceneChannel)) out->put(kSceneChannel, scene_.scene(result));
  if (result.points && out->wants(kPointsChannel)) out->put(kPointsChannel, ros_.points(result));
}

void LiveMessages::tell(const StopNews& news, ChannelOut* out) const {
  if (out->wants(kStopChannel)) out->put(kStopChannel, planar_.stop_state(news));
  if (out->wants(kStopSceneChannel)) out->put(kStopSceneChannel, scene_.scene(news));
}

void LiveMessages::tell(const RoadwayNews& news, ChannelOut* out) {
  if (out->wants(kPlaceTransformChannel)) put_some(out, kPlaceTransformChannel, scene_.transforms(news));
  if (news.pose && out->wants(kPlaceChannel)) out->put(kPlaceChannel, planar_.pose(news));
  if (!out->wants(kMapChannel)) {
    map_told_ = 0;
    return;
  }
  if (!news.map || news.map->version == map_told_) return;
  map_told_ = news.map->version;
  out->put(kMapChannel, planar_.map(*news.map));
}

void LiveMessages::tell(const std::vector<PartHealth>& parts, std::int64_t now_ns, ChannelOut* out) {
  if (out->wants(kHealthChannel)) out->put(kHealthChannel, health_json(parts));
  for (const PartHealth& part : parts) {
    const bool is_told = std::any_of(parts_told_.begin(), parts_told_.end(),
                                     [&](const PartHealth& told) { return told.fares_as(part); });
    if (!is_told && out->wants(kLogChannel)) out->put(kLogChannel, log_message(part, now_ns));
  }
  parts_told_ = parts;
}

}  // namespace pose_wall::tools::live
