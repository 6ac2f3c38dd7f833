// SPDX-License-Identifier: Apache-2.0
// A change of a table that a program or a line of MDI demands of the table's owner while the axes are at
// rest.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "contracts/types.hpp"
#include "language/canonical.hpp"

namespace trunnion::channel {

/// One change is open at a time.
class TableChange {
 public:
  explicit TableChange(std::uint16_t channel) : channel_(channel) {}

  /// The tools as they are now: a change of one field leaves the others.
  void set_tools(const idl::parameters::ToolTable& tools) { tools_ = tools; }

  /// `command` is of kind table; `role` and `who` are those of ParameterRequest, whatever is too long of
  /// `who` is cut off.
  void begin(const language::Command& command, std::uint8_t role, std::string who);
  /// The owner's answer; false when no change is open.
  bool finish();
  /// Gives up what is open.
  void cancel() { open_ = false; }

  /// Nothing is open and everything has been taken.
  bool at_rest() const { return !open_ && !outgoing_; }
  std::optional<idl::parameters::ParameterRequest> take_request();

 private:
  std::uint16_t channel_;
  idl::parameters::ToolTable tools_;
  bool open_ = false;
  std::optional<idl::parameters::ParameterRequest> outgoing_;
};

}  // namespace trunnion::channel
