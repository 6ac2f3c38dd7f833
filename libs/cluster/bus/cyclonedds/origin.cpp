// SPDX-License-Identifier: Apache-2.0
#include "origin.hpp"

#include <cstring>

namespace trunnion::bus {
namespace {

/// Calls `use` with what a built-in topic has of an instance, if it has it.
template <class Sample, class Use>
void look_up(dds_entity_t participant, dds_entity_t topic, dds_instance_handle_t instance, Use&& use) {
  const dds_entity_t reader = dds_create_reader(participant, topic, nullptr, nullptr);
  if (reader < 0) return;
  void* sample = nullptr;
  dds_sample_info_t info{};
  const auto count = dds_read_instance(reader, &sample, &info, 1, 1, instance);
  if (count > 0) {
    if (info.valid_data) use(*static_cast<const Sample*>(sample));
    dds_return_loan(reader, &sample, count);
  }
  dds_delete(reader);
}

}  // namespace

WriterOrigin cyclone_origin(dds_entity_t participant, const WriterId& writer) {
  WriterOrigin origin;
  dds_instance_handle_t handle = 0, process = 0;
  std::memcpy(&handle, writer.data(), sizeof handle);
  look_up<dds_builtintopic_endpoint_t>(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, handle,
                                       [&](const auto& endpoint) {
                                         process = endpoint.participant_instance_handle;
                                         origin.participant = prefix_text(endpoint.participant_key.v);
                                       });
  if (process == 0) return origin;
  const auto take = [&](const dds_builtintopic_participant_t& found) {
    for (const char* name : origin_properties)
      if (char* value = nullptr; dds_qget_prop(found.qos, name, &value)) {
        take_property(origin, name, value);
        dds_free(value);
      }
    void* data = nullptr;
    std::size_t size = 0;
    if (dds_qget_userdata(found.qos, &data, &size) && size > 0)
      origin.identity.assign(static_cast<const char*>(data), size);
    dds_free(data);
  };
  look_up<dds_builtintopic_participant_t>(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, process, take);
  return origin;
}

}  // namespace trunnion::bus
