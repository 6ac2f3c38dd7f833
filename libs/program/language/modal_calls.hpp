// SPDX-License-Identifier: Apache-2.0
// The macros that G66 and G66.1 call. Calls nest: the newest is made first, the one before it in the blocks
// of that macro, and G67 ends the newest (NCT 99M/2000M programmer's manual, chapter 20; Fanuc custom macro
// B).
#pragma once

#include <array>
#include <cstddef>

#include "language/macro_call.hpp"

namespace trunnion::language {

class ModalCalls {
 public:
  struct Entry {
    Call call;
    Arguments arguments;  ///< of G66; G66.1 takes those of each block
  };

  /// G66, G66.1. False when as many are active as may be.
  bool add(const Call& call, const Arguments& arguments);
  /// G67: ends the newest that the current program may use; without effect when there is none.
  void remove();
  void clear() { count_ = usable_ = 0; }
  /// How many are active, whatever the current program may use of them.
  std::size_t count() const { return count_; }

  /// What a block of the current program calls; null when nothing.
  const Entry* active() const { return usable_ == 0 ? nullptr : &entries_[usable_ - 1]; }
  /// Into the macro of active(), whose blocks use the entries below it; the result is for leave().
  std::size_t enter();
  void leave(std::size_t above) { usable_ = count_ - above; }

 private:
  static constexpr std::size_t most = 4;
  std::array<Entry, most> entries_{};
  std::size_t count_ = 0, usable_ = 0;
};

}  // namespace trunnion::language
