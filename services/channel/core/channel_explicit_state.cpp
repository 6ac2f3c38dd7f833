// SPDX-License-Identifier: Apache-2.0
// The explicit state of a channel at rest, from which a verification continues.
#include "channel_core.hpp"
#include "snapshot/fields.hpp"
#include "variable_text.hpp"

namespace trunnion::channel {
namespace {
constexpr const char* this_boot = "snapshot";  // common variables are kept, too
}

bus::Json ChannelCore::explicit_state(std::string& why_not) const {
  if (!recovered_)
    why_not = "the channel waits for the drive";
  else if (!states_.in<Idle>())
    why_not = "the channel is " + states_.name();
  else if (homing_.active())
    why_not = "the channel homes an axis";
  else if (!link().at_rest() || !handshake_.at_rest() || !table_change_.at_rest() || !cycle_call_.at_rest() ||
           !printer_.at_rest() || !manual_.offset_at_rest() || next_parameters_)
    why_not = "the channel comes to rest";
  else if (mdi_.frames_kept())
    why_not = "the coordinate frames of the MDI lines since the last program or reset are in no snapshot";
  if (!why_not.empty()) return nullptr;
  auto state = snapshot::written(*this);
  state["offset_on"] = manual_.offset_on();
  state["offset"] = manual_.offset();
  state["skips"] = snapshot::written(program_flow_.skips());
  state["variables"] = write_variables(*variables_, this_boot);
  if (const auto* executed = stream_.executed()) state["executed"] = snapshot::written(*executed);
  return state;
}

void ChannelCore::continue_from(const bus::Json& state) {
  snapshot::read(state, *this);
  AxisValues offset{};
  snapshot::read(state.at("offset"), offset);
  std::vector<program_execution::SkipResult> skips;
  snapshot::read(state.at("skips"), skips);
  program_flow_.set_skips(std::move(skips));
  *variables_ = {};
  read_variables(state.at("variables").get<std::string>(), "snapshot", this_boot, *variables_);
  if (const auto executed = state.find("executed"); executed != state.end()) {
    WrittenSetpoint written;
    snapshot::read(*executed, written);
    stream_.set_executed(written);
  }
  manual_.switch_offset(state.at("offset_on").get<bool>());
  build_paths();
  manual_.place_offset(offset);
  recovered_ = true;
}

}  // namespace trunnion::channel
