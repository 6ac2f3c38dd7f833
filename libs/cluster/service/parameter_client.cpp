// SPDX-License-Identifier: Apache-2.0
#include "service/parameter_client.hpp"

namespace trunnion::service {
namespace {

// The parameters service checks what it publishes. On an open domain others can publish, too.
std::string refusal(const idl::parameters::ParameterSet& set) {
  for (const auto& one : set.values)
    if (auto why = machine::Catalogue::instance().check(one.number, one.value, one.text); !why.empty())
      return why;
  return "";
}

}  // namespace

bool ParameterClient::poll() {
  bool any = false;
  idl::parameters::ParameterSet set;
  while (reader_.take(set)) {
    if (newest_ && set.revision == newest_->revision) continue;
    if (const auto why = refusal(set); !why.empty()) {
      bus_.refuse(topics::parameter_set.name, why, reader_.info().writer);
      continue;
    }
    previous_ = newest_;
    newest_ = std::make_shared<const machine::Parameters>(machine::parameters_of(set));
    any = true;
  }
  return any;
}

std::shared_ptr<const machine::Parameters> ParameterClient::find(std::uint64_t revision) const {
  if (newest_ && newest_->revision == revision) return newest_;
  if (previous_ && previous_->revision == revision) return previous_;
  return nullptr;
}

}  // namespace trunnion::service
