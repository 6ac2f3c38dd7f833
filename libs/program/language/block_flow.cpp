// SPDX-License-Identifier: Apache-2.0
// The part of BlockExecutor that says where the program continues: calls, returns and ends.
#include "language/block_executor.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t highest_repetition = 999999;

}  // namespace

Fault BlockExecutor::set_flow(Flow& flow) {
  flow = Flow{};
  BlockWords& words = context_.words;
  const MCodes& m = words.m();
  for (std::size_t i = 0; i < m.count; ++i) {
    const MAction action = m.codes[i].action;
    if (action == MAction::auxiliary || action == MAction::tool_change) continue;
    flow.offset = m.offsets[i];
    if (action == MAction::program_end) flow.kind = Flow::Kind::end;
    if (action == MAction::go_back) {
      flow.kind = Flow::Kind::go_back;
      flow.to_label = words.has('P');
      if (flow.to_label && words.used('P')) return {AlarmNumber::unused_word, words.offset('P')};
      if (flow.to_label) {
        if (const Fault fault = words.whole_number('P', 0, 99999999, flow.subprogram)) return fault;
      }
    }
    if (action != MAction::call) continue;
    if (const Fault fault = set_call(flow)) return fault;
  }
  return {};
}

Fault BlockExecutor::set_call(Flow& flow) {
  BlockWords& words = context_.words;
  flow.kind = Flow::Kind::call;
  flow.local = words.calls_locally();
  if (words.called() != 0) {
    flow.subprogram = words.called();
    flow.counted = true;
    return {};
  }
  // Q alone is a sequence number of this program, as on Fanuc 30i. LinuxCNC has neither Q nor H here.
  const bool label_alone = !words.linuxcnc() && !words.has('P') && words.has('Q') && !words.used('Q');
  const char number = label_alone ? 'Q' : 'P';
  flow.local = flow.local || label_alone;
  if (!words.has(number)) return {AlarmNumber::missing_word, flow.offset, needs('P')};
  // P and L have one meaning each: a dwell or turns in the same block leave none for the call.
  for (const char letter : {number, 'L'}) {
    if (words.has(letter) && words.used(letter)) return {AlarmNumber::unused_word, words.offset(letter)};
  }
  if (const Fault fault = words.whole_number(number, 1, 99999999, flow.subprogram)) return fault;
  // What is called by a sequence number begins there.
  if (!flow.local && !words.linuxcnc()) {
    if (const Fault fault = set_label(flow)) return fault;
  }
  if (!words.has('L')) return {};
  flow.counted = true;
  const Fault fault = words.whole_number('L', 0, highest_repetition, flow.repetitions);
  // As in LinuxCNC a call no times is none.
  if (!fault && flow.repetitions == 0) flow.kind = Flow::Kind::next;
  return fault;
}

// H is the tool length where G43 has taken it, as Q may be a word of a cycle.
Fault BlockExecutor::set_label(Flow& flow) {
  BlockWords& words = context_.words;
  for (const char letter : {'H', 'Q'}) {
    if (!words.has(letter) || words.used(letter)) continue;
    if (flow.from_label) return {AlarmNumber::unused_word, words.offset(letter)};
    flow.from_label = true;
    flow.label_offset = words.offset(letter);
    if (const Fault fault = words.whole_number(letter, 0, 99999999, flow.label)) return fault;
  }
  return {};
}

bool BlockExecutor::calls() const {
  const MCodes& m = context_.words.m();
  for (std::size_t i = 0; i < m.count; ++i)
    if (m.codes[i].action == MAction::call) return true;
  return false;
}

}  // namespace trunnion::language
