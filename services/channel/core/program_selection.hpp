// SPDX-License-Identifier: Apache-2.0
// The stored programs, and the one of them that is selected.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "contracts/types.hpp"
#include "machine/program_number.hpp"
#include "program_record.hpp"

namespace trunnion::channel {

using machine::is_temporary;

class ProgramSelection {
 public:
  /// The selected program stays as it was until renew().
  void set_programs(const idl::program::ProgramList& programs) { programs_ = programs; }
  const idl::program::ProgramList& programs() const { return programs_; }
  /// Null when the store has none of this name.
  const idl::program::ProgramEntry* stored(const std::string& name) const;
  /// Its name is empty when none is selected. It may have been changed or deleted since.
  const idl::program::ProgramEntry& selected() const { return selected_; }

  /// False, and nothing is changed, when it is not stored.
  bool select(const std::string& name);
  /// False, and nothing is changed, when it was changed or deleted since it was left.
  bool select(const LeftProgram& left);
  /// The one with this text, if there is one.
  void select_text(std::uint32_t crc, std::uint64_t revision);
  /// The selected program as it is stored now.
  void renew();
  /// A command that was killed cannot put back the operator's program: it is selected again when a temporary
  /// one has ended. The command selects its own before each run.
  void leave_temporary();

  /// Name of the program selected before a temporary one.
  const std::string& before_temporary() const { return before_temporary_; }
  /// As the process before had it. A program that is not stored is not selected.
  void take_over(const std::string& name, const std::string& before_temporary);

  /// No field, it is received again: programs_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("selected", self.selected_);
    // Written where there is something: older recordings have no such state.
    constexpr bool reads = !std::is_const_v<Self>;
    if (reads || !self.before_temporary_.empty()) visit("before_temporary", self.before_temporary_);
  }

 private:
  idl::program::ProgramList programs_;
  idl::program::ProgramEntry selected_;
  std::string before_temporary_;
};

}  // namespace trunnion::channel
