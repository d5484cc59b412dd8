// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Messages as bytes for Fast DDS, under any type name.

#pragma once

#include <cstring>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>
#include <vector>

namespace pose_wall::test {

// Behind the four bytes of CDR head come the bytes; both stand in it.
using RawMessage = std::vector<char>;

class RawType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  RawType(const std::string& name, std::uint32_t bytes_most) {
    setName(name.c_str());
    m_typeSize = bytes_most;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& message = *static_cast<const RawMessage*>(data);
    const std::size_t padded = size_of(message);
    if (padded > payload->max_size) return false;
    std::memcpy(payload->data, message.data(), message.size());
    std::memset(payload->data + message.size(), 0, padded - message.size());
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(padded);
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    const char* bytes = reinterpret_cast<const char*>(payload->data);
    static_cast<RawMessage*>(data)->assign(bytes, bytes + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(size_of(*static_cast<const RawMessage*>(data))); };
  }
  void* createData() override { return new RawMessage; }
  void deleteData(void* data) override { delete static_cast<RawMessage*>(data); }
  bool getKey(void* /*data*/, eprosima::fastrtps::rtps::InstanceHandle_t* /*handle*/, bool /*force_md5*/) override {
    return false;
  }

 private:
  // What goes over the wire ends at a multiple of four.
  static std::size_t size_of(const RawMessage& message) { return (message.size() + 3) / 4 * 4; }
};

}  // namespace pose_wall::test
