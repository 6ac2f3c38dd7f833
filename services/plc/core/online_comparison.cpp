// SPDX-License-Identifier: Apache-2.0
#include "online_comparison.hpp"

#include <algorithm>

#include "round.hpp"

namespace trunnion::plc {

OnlineComparison::OnlineComparison(const PlcCore& running, Programs next, st::Changeover change)
    : change_(std::move(change)), variables_(next.variables), core_(running) {
  core_.scan_unseen();
  core_.take_over(next, change_);
  // As of the running one, which does not scan again only because programs are compared.
  core_.adopt({core_.memory(), running.state().view});
  first_scan_ = core_.memory().scans;
  compare_registers(running.rescanned(), core_.rescanned());
}

void OnlineComparison::differ(const std::string& what) {
  ++differences_;
  if (lines_.size() < most_told_differences)
    lines_.push_back("tick " + std::to_string(core_.memory().tick) + ", " + what);
}

void OnlineComparison::compare_registers(const Registers& running, const Registers& own) {
  if (running == own) return;
  for (const auto& at : changes(own, running)) {
    const auto name = register_name(at);
    if (!told_.insert(name).second) continue;
    const Address address{static_cast<Area>(at.area), at.index, -1};
    differ("register " + name + ": " + std::to_string(at.value) + " and " +
           std::to_string(load(own, address)));
  }
}

void OnlineComparison::compare_variables(const Memory& running) {
  const auto& own = core_.memory().program.values;
  const auto& other = running.program.values;
  for (const auto& move : change_.moves()) {
    const auto a = other.begin() + (move.from - st::image_cells),
               b = own.begin() + (move.to - st::image_cells);
    if (std::equal(a, a + move.count, b) || !told_.insert(move.path).second) continue;
    differ("variable " + move.path + " has other values");
  }
}

void OnlineComparison::compare(const PlcCore& running, const std::vector<idl::plc::AuxiliaryDone>& done) {
  compare_registers(running.memory().registers, core_.memory().registers);
  compare_variables(running.memory());
  if (core_.take_done() != done && told_.insert("done").second) differ("the finished functions M, S, T");
  if (core_.has_program_fault() && told_.insert("fault").second) differ(core_.program_fault());
}

}  // namespace trunnion::plc
