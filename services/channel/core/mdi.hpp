// SPDX-License-Identifier: Apache-2.0
// Manual data input, from line to line: its modal state, the interpreter of its lines, and who has entered
// the newest.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "channel_setup/channel_setup.hpp"
#include "contracts/types.hpp"
#include "language/text_source.hpp"
#include "program_cache.hpp"
#include "program_execution/program_flow.hpp"

namespace trunnion::channel {

using language::AxisValues;
using program_execution::ProgramFlow;

class Mdi {
 public:
  /// `machine` must outlive this.
  explicit Mdi(channel_setup::ChannelSetup& machine) : flow_(machine) {}

  ProgramFlow& flow() { return flow_; }
  const ProgramFlow& flow() const { return flow_; }
  /// The stored programs that the line calls.
  ProgramCache& texts() { return texts_; }
  const ProgramCache& texts() const { return texts_; }

  /// In which the next line begins.
  const language::ModalState& modal() const { return modal_; }
  void set_modal(const language::ModalState& modal) { modal_ = modal; }
  void set_tool(std::uint32_t tool) { modal_.tool = static_cast<std::uint16_t>(tool); }

  /// A new line, of MDI_LINE.
  void enter(const idl::channel::ChannelRequest& request);
  /// Its start; `motion` is at rest at `position`, in the frame of modal().
  void start(motion::MoveTaker& motion, const AxisValues& position, const language::VariableStore& variables);
  /// The line was carried out, with `tool` in the spindle: the next one continues behind it.
  void end(std::uint32_t tool);

  /// The coordinate frames of the lines act on, until a program starts or a reset.
  bool frames_kept() const { return frames_kept_; }
  void forget_frames() { frames_kept_ = false; }
  /// The newest of them; null when there is none.
  const language::ProgramFrame* frame() const { return frames_kept_ ? flow_.frames().newest() : nullptr; }

  const std::string& who() const { return who_; }
  /// Of who has entered the line, as in ChannelRequest.
  std::uint8_t role_of_line() const { return role_; }
  /// What the texts change is the matter of who has stored them; what the line changes by itself, of who has
  /// entered it.
  std::uint8_t role() const { return texts_.role().value_or(role_); }

  /// No fields, nothing is under way: line_, who_, role_, source_, flow_, texts_. No field, no state is given
  /// while they act: frames_kept_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("modal", self.modal_);
  }

 private:
  std::string line_, who_;
  std::uint8_t role_ = 0;
  std::optional<language::StringSource> source_;
  language::ModalState modal_;
  bool frames_kept_ = false;
  ProgramFlow flow_;
  ProgramCache texts_;
};

}  // namespace trunnion::channel
