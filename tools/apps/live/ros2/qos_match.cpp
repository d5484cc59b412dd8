// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros2/qos_match.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

#include <algorithm>

namespace pose_wall::tools::live {
namespace {

const char* name_of(int kind, const std::vector<const char*>& names) {
  return kind >= 0 && static_cast<std::size_t>(kind) < names.size() ? names[static_cast<std::size_t>(kind)] : "unknown";
}

std::string time_text(std::int64_t ns) {
  return ns == EndpointQos::kNever_ns ? "none" : fmt::format("{} ms", static_cast<double>(ns) * 1e-6);
}

class Mismatch {
 public:
  void add(const char* policy, const std::string& offered, const std::string& requested) {
    text_ += fmt::format("{}{}: the writer offers {}, the reader asks for {}", text_.empty() ? "" : "; ", policy,
                         offered, requested);
  }
  // The writer must promise as much as the reader asks for.
  void at_least(const char* policy, int offered, int requested, const std::vector<const char*>& names) {
    if (offered < requested) add(policy, name_of(offered, names), name_of(requested, names));
  }
  void at_most(const char* policy, std::int64_t offered_ns, std::int64_t requested_ns) {
    if (offered_ns > requested_ns) add(policy, time_text(offered_ns), time_text(requested_ns));
  }
  void equal(const char* policy, int offered, int requested, const std::vector<const char*>& names) {
    if (offered != requested) add(policy, name_of(offered, names), name_of(requested, names));
  }

  std::string text_;
};

// Patterns are not looked at: ROS uses no partitions.
bool share_a_partition(const EndpointQos& a, const EndpointQos& b) {
  const std::vector<std::string> unnamed = {""};
  const auto& of_a = a.partitions.empty() ? unnamed : a.partitions;
  const auto& of_b = b.partitions.empty() ? unnamed : b.partitions;
  return std::any_of(of_a.begin(), of_a.end(),
                     [&](const std::string& one) { return std::find(of_b.begin(), of_b.end(), one) != of_b.end(); });
}

std::string partitions_text(const EndpointQos& qos) {
  std::string text;
  for (const std::string& name : qos.partitions) text += (text.empty() ? "'" : ", '") + name + "'";
  return text.empty() ? "''" : text;
}

std::vector<std::string> partitions_of(const dds_qos_t* qos) {
  std::vector<std::string> partitions;
  std::uint32_t count = 0;
  char** names = nullptr;
  if (!dds_qget_partition(qos, &count, &names)) return partitions;
  for (std::uint32_t i = 0; i < count; ++i) {
    partitions.emplace_back(names[i]);
    dds_free(names[i]);
  }
  dds_free(names);
  return partitions;
}

}  // namespace

EndpointQos endpoint_qos(const dds_qos* qos) {
  EndpointQos of;
  dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
  dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
  dds_liveliness_kind_t liveliness = DDS_LIVELINESS_AUTOMATIC;
  dds_ownership_kind_t ownership = DDS_OWNERSHIP_SHARED;
  dds_destination_order_kind_t order = DDS_DESTINATIONORDER_BY_RECEPTION_TIMESTAMP;
  dds_duration_t blocking = 0;
  // What a policy's absence leaves is its default.
  if (dds_qget_reliability(qos, &reliability, &blocking)) of.reliability = reliability;
  if (dds_qget_durability(qos, &durability)) of.durability = durability;
  if (dds_qget_liveliness(qos, &liveliness, &of.lease_ns)) of.liveliness = liveliness;
  if (dds_qget_ownership(qos, &ownership)) of.ownership = ownership;
  if (dds_qget_destination_order(qos, &order)) of.destination_order = order;
  static_cast<void>(dds_qget_deadline(qos, &of.deadline_ns));
  static_cast<void>(dds_qget_latency_budget(qos, &of.latency_budget_ns));
  of.partitions = partitions_of(qos);
  return of;
}

std::string qos_mismatch(const EndpointQos& offered, const EndpointQos& requested) {
  Mismatch mismatch;
  mismatch.at_least("reliability", offered.reliability, requested.reliability, {"best effort", "reliable"});
  mismatch.at_least("durability", offered.durability, requested.durability,
                    {"volatile", "transient local", "transient", "persistent"});
  mismatch.at_least("liveliness", offered.liveliness, requested.liveliness,
                    {"automatic", "manual by participant", "manual by topic"});
  mismatch.equal("ownership", offered.ownership, requested.ownership, {"shared", "exclusive"});
  mismatch.at_least("destination order", offered.destination_order, requested.destination_order,
                    {"by reception", "by source"});
  mismatch.at_most("deadline", offered.deadline_ns, requested.deadline_ns);
  mismatch.at_most("lease of liveliness", offered.lease_ns, requested.lease_ns);
  mismatch.at_most("latency budget", offered.latency_budget_ns, requested.latency_budget_ns);
  if (!share_a_partition(offered, requested)) {
    mismatch.add("partition", partitions_text(offered), partitions_text(requested));
  }
  return mismatch.text_;
}

}  // namespace pose_wall::tools::live
