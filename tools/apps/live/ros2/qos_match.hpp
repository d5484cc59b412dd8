// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Whether a writer and a reader of DDS come together by their quality of service, and in words why not.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct dds_qos;

namespace pose_wall::tools::live {

// The policies by which DDS matches writers and readers (DDS 1.4, 2.2.3). A larger number promises more.
struct EndpointQos {
  static constexpr std::int64_t kNever_ns = INT64_MAX;

  int reliability = 0;  // best effort, reliable
  int durability = 0;   // volatile, transient local, transient, persistent
  int liveliness = 0;   // automatic, manual by participant, manual by topic
  int ownership = 0;    // shared, exclusive
  int destination_order = 0;
  std::int64_t deadline_ns = kNever_ns, lease_ns = kNever_ns, latency_budget_ns = 0;
  std::vector<std::string> partitions;  // none: the empty one
};

EndpointQos endpoint_qos(const dds_qos* qos);

// "" where they match; else each policy with what either has: "reliability: the writer
// offers best effort, the reader asks for reliable".
std::string qos_mismatch(const EndpointQos& offered, const EndpointQos& requested);

}  // namespace pose_wall::tools::live
