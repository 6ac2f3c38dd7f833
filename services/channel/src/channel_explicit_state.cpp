// SPDX-License-Identifier: Apache-2.0
// The explicit state of a channel at rest, from which a verification continues.
#include "channel_core.hpp"
#include "snapshot/fields.hpp"
#include "variable_text.hpp"

namespace trunnion::channel {
namespace {
constexpr const char* this_boot = "snapshot";  // common variables are kept, too
}

/// The list of fields of a channel that is idle; all others are empty then or made when something starts.
struct ChannelFields {
  // No fields, explicit_state() writes what counts of them: stream_, manual_, program_flow_, variables_.
  // No fields, the constructor sets them or they are received again: number_, virtual_time_, machine_,
  // parameters_, next_parameters_, cycle_service_. No field, nothing is under way and
  // the state of the service has the axes: homing_. No fields, nothing is under way: states_, table_change_,
  // skip_, exact_stop_, tapping_, restart_, recovered_, variables_news_, events_. No fields, they
  // are made again: program_path_, manual_path_, program_cache_, bodies_, unusable_, state_.
  template <class Core>
  struct Of {
    Core& core;
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      auto& c = self.core;
      visit("link", c.stream_.link()), visit("handshake", c.handshake_), visit("cycle_call", c.cycle_call_),
          visit("lock", c.lock_);
      visit("mode", c.mode_), visit("switches", c.switches_);
      Interlock::fields(c.interlock_, visit);
      visit("reset_count", c.reset_count_);
      ProgramSelection::fields(c.selection_, visit);
      visit("program_start", c.program_start_), visit("interrupted", c.interrupted_);
      Mdi::fields(c.mdi_, visit);
      visit("position", c.machine_start_), visit("progress", c.progress_);
      visit("tool", c.tool_), visit("spindle_programmed", c.spindle_programmed_);
      visit("ended", c.ended_), visit("parts", c.parts_);
      // Written where there is something: older recordings have no such state.
      constexpr bool reads = !std::is_const_v<Core>;
      if (reads || c.tool_since_ != 0) visit("tool_since", c.tool_since_);
    }
  };
};

bus::Json ChannelCore::explicit_state(std::string& why_not) const {
  if (!recovered_)
    why_not = "the channel waits for the drive";
  else if (!states_.in<Idle>())
    why_not = "the channel is " + states_.name();
  else if (homing_.active())
    why_not = "the channel homes an axis";
  else if (!link().at_rest() || !handshake_.at_rest() || !table_change_.at_rest() || !cycle_call_.at_rest() ||
           !manual_.offset_at_rest() || next_parameters_)
    why_not = "the channel comes to rest";
  else if (mdi_.frames_kept())
    why_not = "the coordinate frames of the MDI lines since the last program or reset are in no snapshot";
  if (!why_not.empty()) return nullptr;
  auto state = snapshot::written(ChannelFields::Of<const ChannelCore>{*this});
  state["offset_on"] = manual_.offset_on();
  state["offset"] = manual_.offset();
  state["skips"] = snapshot::written(program_flow_.skips());
  state["variables"] = write_variables(*variables_, this_boot);
  if (const auto* executed = stream_.executed()) state["executed"] = snapshot::written(*executed);
  return state;
}

void ChannelCore::continue_from(const bus::Json& state) {
  ChannelFields::Of<ChannelCore> fields{*this};
  snapshot::read(state, fields);
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
