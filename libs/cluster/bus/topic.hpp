// SPDX-License-Identifier: Apache-2.0
// Topic handles: name, type on the wire and quality of service of each topic of idl/topics.yaml.
#pragma once

namespace trunnion::bus {

/// The classes of quality of service; what each means is said at the head of idl/topics.yaml.
enum class QosKind { batch, state, event, history };

template <class T>
struct Topic {
  using Type = T;
  const char* name;
  const char* wire_type;  ///< with the contract's hash, so that endpoints of another contract do not match
  QosKind qos;
};

}  // namespace trunnion::bus
