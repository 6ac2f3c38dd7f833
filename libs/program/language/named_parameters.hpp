// SPDX-License-Identifier: Apache-2.0
// Parameters with a name (#<name> of LinuxCNC): local to a call, or global when the name begins with _.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "language/alarms.hpp"
#include "language/name_key.hpp"

namespace trunnion::language {

/// Allocates in its constructor only.
class NamedParameters {
 public:
  /// Of the global ones, and of the local ones of all calls together.
  static constexpr std::size_t most = 1000;

  /// No name has a value.
  void start();
  /// Local names of its own for a called program; at most max_nesting times.
  void enter() { levels_[++level_] = locals_.size(); }
  /// Back to those of the caller.
  void leave() { locals_.cut(levels_[level_--]); }
  /// The called program begins again.
  void again() { locals_.cut(levels_[level_]); }

  /// Null when the name has no value.
  const double* find(NameKey name, bool global) const {
    return global ? globals_.find(name) : locals_.find(local(name));
  }
  /// False when there are too many names.
  bool write(NameKey name, bool global, double value) {
    return global ? globals_.write(name, value) : locals_.write(local(name), value);
  }

  /// What the newest end of a subroutine has returned: 0 when nothing.
  double returned() const { return returned_; }
  bool has_returned() const { return has_returned_; }
  void set_returned(bool given, double value) { has_returned_ = given, returned_ = value; }

  /// Different for different names and values, those of callers included.
  std::uint64_t digest() const;

 private:
  /// By open addressing; what was written last is taken out first, so that no chain is ever cut.
  class Table {
   public:
    Table() : slots_(slot_count), used_(most) {}
    std::size_t size() const { return size_; }
    const double* find(NameKey key) const {
      const Slot& slot = slots_[place(key)];
      return slot.key == key ? &slot.value : nullptr;
    }
    bool write(NameKey key, double value);
    void cut(std::size_t size);
    std::uint64_t digest() const { return digest_; }

   private:
    static constexpr std::size_t slot_count = 2048;
    struct Slot {
      NameKey key = 0;  // 0: free
      double value = 0;
    };
    static_assert(slot_count > 2 * most);
    /// Of the key, or of the free slot where it belongs.
    std::size_t place(NameKey key) const {
      std::size_t at = key % slot_count;
      while (slots_[at].key != 0 && slots_[at].key != key) at = (at + 1) % slot_count;
      return at;
    }
    static std::uint64_t trace(const Slot& slot);

    std::vector<Slot> slots_;
    std::vector<std::uint16_t> used_;  // in the order of writing
    std::size_t size_ = 0;
    std::uint64_t digest_ = 0;
  };

  NameKey local(NameKey name) const { return mixed(name + level_); }

  Table globals_, locals_;
  std::array<std::size_t, max_nesting + 1> levels_{};  // local names of the callers
  std::size_t level_ = 0;
  double returned_ = 0;
  bool has_returned_ = false;
};

}  // namespace trunnion::language
