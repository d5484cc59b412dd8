// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros2/endpoint_watch.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace pose_wall::tools::live {
namespace {

// Far more than a roadway has; who announces more must not fill the memory.
constexpr std::size_t kEndpointsMost = 1000;

Gid gid_of(const dds_guid_t& guid) {
  Gid gid{};
  std::copy(std::begin(guid.v), std::end(guid.v), gid.begin());
  return gid;
}

std::string text_or_empty(const char* text) {
  return text == nullptr ? "" : text;
}

}  // namespace

EndpointWatch::EndpointWatch(const Ros2Node& node, bool of_writers, std::vector<std::string> dds_topics)
    : own_participant_(node.gid()),
      of_writers_(of_writers),
      dds_topics_(std::move(dds_topics)),
      reader_(dds_create_reader(node.participant(),
                                of_writers ? DDS_BUILTIN_TOPIC_DCPSPUBLICATION : DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION,
                                nullptr, nullptr)) {
  if (reader_ <= 0) {
    throw std::runtime_error(fmt::format("ROS 2: DDS does not tell of others: {}", dds_strretcode(reader_)));
  }
}

EndpointWatch::~EndpointWatch() {
  dds_delete(reader_);
}

bool EndpointWatch::is_of_interest(const std::string& dds_topic) const {
  return std::find(dds_topics_.begin(), dds_topics_.end(), dds_topic) != dds_topics_.end();
}

bool EndpointWatch::update() {
  constexpr std::uint32_t kAtOnce = 16;
  bool is_changed = false;
  while (true) {
    std::array<void*, kAtOnce> samples{};
    std::array<dds_sample_info_t, kAtOnce> infos{};
    const dds_return_t count = dds_take(reader_, samples.data(), infos.data(), kAtOnce, kAtOnce);
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
      const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
      const Gid gid = gid_of(endpoint.key);
      if (infos[i].instance_state != DDS_IST_ALIVE || !infos[i].valid_data) {
        is_changed = endpoints_.erase(gid) > 0 || is_changed;
        continue;
      }
      const bool is_own = gid_of(endpoint.participant_key) == own_participant_;
      if (is_own || !is_of_interest(text_or_empty(endpoint.topic_name))) continue;
      if (endpoints_.size() >= kEndpointsMost && endpoints_.count(gid) == 0) continue;
      endpoints_[gid] = {text_or_empty(endpoint.topic_name), text_or_empty(endpoint.type_name),
                         endpoint_qos(endpoint.qos)};
      is_changed = true;
    }
    if (count > 0) dds_return_loan(reader_, samples.data(), count);
    if (count < static_cast<dds_return_t>(kAtOnce)) return is_changed;
  }
}

std::vector<RemoteEndpoint> EndpointWatch::of(const std::string& dds_topic) const {
  std::vector<RemoteEndpoint> found;
  for (const auto& [gid, endpoint] : endpoints_) {
    if (endpoint.topic == dds_topic) found.push_back(endpoint);
  }
  return found;
}

std::string EndpointWatch::mismatch_with(const Ros2Node::Endpoint& ours) const {
  const std::string topic = dds_topic(ours.topic());
  const EndpointQos our_qos = ours.qos();
  for (const auto& [gid, theirs] : endpoints_) {
    if (theirs.topic != topic) continue;
    const char* what = of_writers_ ? "writer" : "reader";
    if (theirs.type != ours.type().dds_name()) {
      return fmt::format("{}: the {} {} is of type {}, this node's is {}", ours.topic(), what, gid_text(gid),
                         theirs.type, ours.type().dds_name());
    }
    const std::string mismatch = of_writers_ ? qos_mismatch(theirs.qos, our_qos) : qos_mismatch(our_qos, theirs.qos);
    if (!mismatch.empty())
      return fmt::format("{}: the {} {} does not match: {}", ours.topic(), what, gid_text(gid), mismatch);
  }
  return "";
}

}  // namespace pose_wall::tools::live
