// SPDX-License-Identifier: Apache-2.0
// Values of a running PLC, as a watch list and a trace carry them, as text.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "contracts/types.hpp"
#include "plc/semantics/type.hpp"

namespace trunnion::plc_online {

/// {"path", "type", "retained"}, and "unit" and "names" (value by name) when it has them.
bus::Json json_of(const idl::plc::VariableInfo& info);

/// The values of a watch list or of a row of a trace.
class ShownVariables {
 public:
  explicit ShownVariables(const std::vector<idl::plc::VariableInfo>& variables = {});
  std::size_t size() const { return variables_.size(); }
  std::size_t cells() const { return cells_; }
  const idl::plc::VariableInfo& info(std::size_t i) const { return variables_[i]; }
  /// json_of() of each.
  bus::Json json() const;
  /// A literal of the language, of each variable; `cells` has at least cells().
  std::vector<std::string> texts(std::span<const std::uint64_t> cells) const;

 private:
  std::vector<idl::plc::VariableInfo> variables_;
  std::vector<st::Type> types_;
  std::size_t cells_ = 0;
};

}  // namespace trunnion::plc_online
