// SPDX-License-Identifier: Apache-2.0
// A topic of the contract for programs that use Fast DDS directly and none of our bus.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>

#include <fastdds/dds/topic/TopicDataType.hpp>

#include "bus/codec.hpp"
#include "bus/topic.hpp"

namespace trunnion::bus {

/// The type of a topic of contracts/topics.hpp by its name on the wire; samples are the structs of
/// contracts/types.hpp. Register it with a participant, and use the profile of the topic's handle from
/// share/trunnion/sdk/fastdds.xml.
template <Struct T>
class ContractType : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit ContractType(const Topic<T>& topic) {
    setName(topic.wire_type);
    m_typeSize = 1024;  // the first size of a payload; it grows
    m_isGetKeyDefined = Fields<T>::keyed;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    encode(*static_cast<const T*>(data), bytes_);
    if (bytes_.size() > payload->max_size) return false;
    std::memcpy(payload->data, bytes_.data(), bytes_.size());
    payload->length = static_cast<std::uint32_t>(bytes_.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    return decode({payload->data, payload->length}, *static_cast<T*>(data));
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] {
      Bytes bytes;
      encode(*static_cast<const T*>(data), bytes);
      return static_cast<std::uint32_t>(bytes.size());
    };
  }
  void* createData() override { return new T; }
  void deleteData(void* data) override { delete static_cast<T*>(data); }
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) override {
    if (!m_isGetKeyDefined) return false;
    Bytes bytes;
    encode(*static_cast<const T*>(data), bytes);
    KeyHash key{};
    if (!key_of<T>(bytes, key)) return false;
    for (std::size_t i = 0; i < key.size(); ++i) handle->value[i] = key[i];
    return true;
  }

 private:
  Bytes bytes_;
};

}  // namespace trunnion::bus
