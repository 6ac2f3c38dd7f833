// SPDX-License-Identifier: Apache-2.0
// The snapshot of a service as messages, and back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contracts/types.hpp"

namespace trunnion::snapshot {

using idl::service::ServiceSnapshot;
using idl::service::SnapshotKind;

/// As many messages as `state` needs, at least one; `head` has everything but part, parts, crc32 and state.
std::vector<ServiceSnapshot> parts_of(const ServiceSnapshot& head, const std::string& state);

/// A whole snapshot.
struct Snapshot {
  ServiceSnapshot head;  ///< of part 0, without its state
  std::string state;     ///< as the service wrote it
};

/// Takes the parts of one process in the order in which they were written.
class Assembly {
 public:
  /// The snapshot that `part` completes; nothing when parts are missing or the check sum is wrong.
  std::optional<Snapshot> add(const ServiceSnapshot& part);

 private:
  Snapshot snapshot_;
  std::uint32_t next_ = 0;
};

}  // namespace trunnion::snapshot
