// SPDX-License-Identifier: Apache-2.0
// Every topic as data: for `trunnion topic`, the recorder and the gateway.
#pragma once

#include <string>
#include <vector>

#include "bus/endpoint.hpp"
#include "bus/json_type.hpp"

namespace trunnion::bus {

struct TopicEntry {
  TopicDescription description;
  QosKind qos;
  std::string handle;  ///< short name, e.g. path_batch
  std::string type;    ///< IDL type name without hash
  std::string schema;  ///< self-contained IDL of the type
  std::string about;
  std::vector<std::string> writers, readers;  ///< services as in topics.yaml; "all" = every one
  /// Throws CdrError when the bytes are not of the type.
  Json (*to_json)(std::span<const std::uint8_t> cdr);
};

const std::vector<TopicEntry>& all_topics();
/// By topic name or handle, of today or before (former_names.hpp); null when there is none.
const TopicEntry* find_topic(const std::string& name);

}  // namespace trunnion::bus
