// SPDX-License-Identifier: Apache-2.0
#include "variable_message.hpp"

namespace trunnion::channel {
namespace {

// `first` is the number of the first of `values`.
void add(std::span<const language::Value> values, std::uint32_t first, idl::channel::Variables& out) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i].given) continue;
    out.numbers.push_back(first + static_cast<std::uint32_t>(i));
    out.values.push_back(values[i].number);
  }
}

}  // namespace

// Of the extended common variables, #900000 and the following, nothing is shown: the message has no room for
// all of them.
idl::channel::Variables variable_message(const language::VariableStore& variables, std::uint16_t channel) {
  idl::channel::Variables out;
  out.channel = channel;
  add(variables.common, 50, out);
  add(variables.kept, 500, out);
  add(variables.user, 50000, out);
  return out;
}

}  // namespace trunnion::channel
