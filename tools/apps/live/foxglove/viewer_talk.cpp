// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/foxglove/viewer_talk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "pose_wall.h"

namespace pose_wall::tools::live {
namespace {

using Json = nlohmann::ordered_json;

// A viewer subscribes once to each channel; more serves nobody.
constexpr std::size_t kSubscriptionsMost = 64;
constexpr char kMessageData = 1;  // the protocol's only opcode in use; its others are time, services and assets

std::string server_info(const std::string& session) {
  return Json({{"op", "serverInfo"},
               {"name", fmt::format("pose_walld {}", pose_wall_version())},
               {"capabilities", Json::array()},
               {"metadata", Json::object()},
               {"sessionId", session}})
      .dump();
}

std::string advertisement(const std::vector<McapChannel>& channels) {
  Json list = Json::array();
  for (const McapChannel& channel : channels) {
    list.push_back({{"id", list.size() + 1},
                    {"topic", channel.topic},
                    {"encoding", channel.message_encoding},
                    {"schemaName", channel.schema_name},
                    {"schema", channel.schema_text},
                    {"schemaEncoding", channel.schema_encoding}});
  }
  return Json({{"op", "advertise"}, {"channels", list}}).dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <typename Number>
void append_little_endian(std::string* to, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    to->push_back(static_cast<char>((static_cast<std::uint64_t>(number) >> (8U * i)) & 0xFFU));
  }
}

SocketMessage text_message(std::string text) {
  return {true, "", std::make_shared<const std::string>(std::move(text))};
}

// Throws Json::exception where there is no such whole number.
std::uint64_t number_of(const Json& from, const char* name) {
  const Json& member = from.at(name);
  if (!member.is_number_unsigned()) throw Json::type_error::create(302, "no whole number", &member);
  return member.get<std::uint64_t>();
}

}  // namespace

ViewerTalk::ViewerTalk(const std::vector<McapChannel>& channels, const std::string& session, ViewerBoard& board,
                       ViewerCounts& counts, std::function<void()> is_asked)
    : channels_(channels), board_(board), counts_(counts), is_asked_(std::move(is_asked)) {
  greetings_ = {server_info(session), advertisement(channels)};
  ++counts_.viewers;
}

ViewerTalk::~ViewerTalk() {
  for (const Subscription& subscription : subscriptions_) board_.leave(subscription.channel);
  --counts_.viewers;
}

std::optional<SocketMessage> ViewerTalk::next() {
  is_asked_();
  if (!greetings_.empty()) {
    SocketMessage greeting = text_message(std::move(greetings_.front()));
    greetings_.pop_front();
    return greeting;
  }
  if (!refusal_.empty()) {
    return text_message(Json({{"op", "status"}, {"level", 2}, {"message", std::exchange(refusal_, "")}})
                            .dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  // Shares by bytes (start-time fair queueing): on a slow line large clouds take what small results leave. Who had
  // nothing to say for a while, or has just come, makes up for nothing.
  Subscription* poorest = nullptr;
  std::optional<ViewerBoard::Message> message;
  for (Subscription& subscription : subscriptions_) {
    const std::uint64_t due = std::max(subscription.bytes, served_);
    if (poorest != nullptr && due >= std::max(poorest->bytes, served_)) continue;
    std::optional<ViewerBoard::Message> found = board_.behind(subscription.channel, subscription.seen);
    if (!found) continue;
    poorest = &subscription;
    message = std::move(found);
  }
  if (poorest == nullptr) return std::nullopt;
  counts_.skipped += message->number - poorest->seen - 1;
  poorest->seen = message->number;
  served_ = std::max(poorest->bytes, served_);
  poorest->bytes = served_ + message->bytes->size();
  ++counts_.sent;
  SocketMessage data{false, std::string(1, kMessageData), message->bytes};
  append_little_endian(&data.head, poorest->id);
  append_little_endian(&data.head, static_cast<std::uint64_t>(std::max<std::int64_t>(message->time_ns, 0)));
  return data;
}

void ViewerTalk::hear(std::string_view message, bool is_text) {
  if (!is_text) return refuse("nothing can be sent to pose_walld");
  try {
    const Json request = Json::parse(message);
    const auto op = request.at("op").get<std::string>();
    if (op == "subscribe") {
      for (const Json& one : request.at("subscriptions")) subscribe(number_of(one, "id"), number_of(one, "channelId"));
    } else if (op == "unsubscribe") {
      for (const Json& id : request.at("subscriptionIds")) unsubscribe(id.get<std::uint64_t>());
    } else {
      refuse(fmt::format("{:.40}: pose_walld knows subscribe and unsubscribe alone", op));
    }
  } catch (const Json::exception&) {
    refuse("a request that is no JSON of the protocol");
  }
}

// A channel's number is its place in the table, from 1.
void ViewerTalk::subscribe(std::uint64_t id, std::uint64_t channel) {
  if (id > std::numeric_limits<std::uint32_t>::max() || channel == 0 || channel > channels_.size()) {
    return refuse(fmt::format("subscription {}: there is no channel {}", id, channel));
  }
  const bool is_taken = std::any_of(subscriptions_.begin(), subscriptions_.end(),
                                    [id](const Subscription& known) { return known.id == id; });
  if (is_taken) return refuse(fmt::format("subscription {}: the number is taken", id));
  if (subscriptions_.size() >= kSubscriptionsMost) {
    return refuse(fmt::format("subscription {}: {} are the most", id, kSubscriptionsMost));
  }
  const auto place = static_cast<std::size_t>(channel - 1);
  subscriptions_.push_back({static_cast<std::uint32_t>(id), place, board_.enter(place)});
}

void ViewerTalk::unsubscribe(std::uint64_t id) {
  const auto found = std::find_if(subscriptions_.begin(), subscriptions_.end(),
                                  [id](const Subscription& known) { return known.id == id; });
  if (found == subscriptions_.end()) return refuse(fmt::format("there is no subscription {}", id));
  board_.leave(found->channel);
  subscriptions_.erase(found);
}

void ViewerTalk::refuse(const std::string& why) {
  ++counts_.refused;
  refusal_ = why;
}

}  // namespace pose_wall::tools::live
