// SPDX-License-Identifier: Apache-2.0
// A body that is made while it is sent.
#pragma once

#include <optional>
#include <string>

namespace trunnion::gateway {

class BodySource {
 public:
  virtual ~BodySource() = default;
  /// The next part; an empty one at the end; nothing when the rest cannot be had. Called by one thread at a
  /// time, when the part before has left.
  virtual std::optional<std::string> next() = 0;
};

}  // namespace trunnion::gateway
