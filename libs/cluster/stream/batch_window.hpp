// SPDX-License-Identifier: Apache-2.0
// Setpoint batches of one channel between two stages: keyed by their first cycle; the first arrival counts;
// in order.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "stream/batch_difference.hpp"

namespace trunnion::stream {

enum class Arrival { news, duplicate, differs, stale };

/// Holds the batches from `next()` on. Their boundaries are the channel's and every replica of a stage keeps
/// them, so a whole batch is the unit. Slots are reused by swapping, so the steady state does not allocate.
template <class Batch>
class BatchWindow {
 public:
  static constexpr std::size_t slots = 1024;  // above 2 * lead + 6 batches for every lead of the catalogue
  BatchWindow() : slots_(slots) {}

  /// `batch` is swapped with an old one when it is new.
  Arrival put(Batch& batch) {
    if (batch.epoch < epoch_ ||
        (batch.epoch == epoch_ && batch.first + batch.count <= next_ && !batch.starts)) {
      // A batch before `next` is still compared with the one taken: a replica with other results must be
      // detected.
      const auto& old = slots_[batch.first % slots];
      if (old.used && old.batch.epoch == batch.epoch && old.batch.first == batch.first)
        return same_values(old.batch, batch) ? Arrival::duplicate : Arrival::differs;
      return Arrival::stale;
    }
    auto& slot = slots_[batch.first % slots];
    if (slot.used && slot.batch.epoch == batch.epoch && slot.batch.first == batch.first)
      return same_values(slot.batch, batch) ? Arrival::duplicate : Arrival::differs;
    // A writer that matches late sends its whole history, which begins long ago and must not replace what is
    // still to be taken.
    const bool blocks = epoch_ != 0 && is_beyond(slot.batch.epoch) && !is_beyond(batch.epoch);
    if (slot.used && !blocks &&
        std::pair(slot.batch.epoch, slot.batch.first) > std::pair(batch.epoch, batch.first))
      return Arrival::stale;
    if (batch.starts &&
        (batch.epoch > start_epoch_ || (batch.epoch == start_epoch_ && batch.first > start_first_))) {
      start_epoch_ = batch.epoch;
      start_first_ = batch.first;
    }
    if (std::pair(batch.epoch, batch.first) > std::pair(newest_epoch_, newest_)) {
      newest_epoch_ = batch.epoch;
      newest_ = batch.first;
    }
    std::swap(slot.batch, batch);
    slot.used = true;
    return Arrival::news;
  }

  /// A start that has arrived and lies ahead moves the window there: what was before it is over.
  bool jump_to_start() {
    if (start_epoch_ < epoch_ || (start_epoch_ == epoch_ && start_first_ < next_) || start_epoch_ == 0)
      return false;
    if (start_epoch_ == epoch_ && start_first_ == next_ && has_next()) {
      start_taken();
      return true;
    }
    epoch_ = start_epoch_;
    next_ = start_first_;
    start_taken();
    return true;
  }

  /// Continues at `cycle` of `epoch`. What is here of epochs that cannot follow is forgotten: their batches
  /// would stand in the way of those that come.
  void set_next(std::uint32_t epoch, std::uint64_t cycle) {
    epoch_ = epoch;
    next_ = cycle;
    if (start_epoch_ != 0 && is_beyond(start_epoch_)) start_taken();
    if (!is_beyond(newest_epoch_)) return;
    newest_epoch_ = epoch, newest_ = cycle;
    for (auto& slot : slots_) slot.used = slot.used && !is_beyond(slot.batch.epoch);
  }
  /// The same, and everything that is here is forgotten.
  void start_over(std::uint32_t epoch, std::uint64_t cycle) {
    for (auto& slot : slots_) slot.used = false;
    start_taken();
    newest_epoch_ = epoch, newest_ = cycle;
    set_next(epoch, cycle);
  }
  /// No stream that is at `cycle` of `epoch` leads to next().
  bool is_astray(std::uint32_t epoch, std::uint64_t cycle) const {
    return std::uint64_t{epoch_} > std::uint64_t{epoch} + 1 || next_ > cycle + slots * most_cycles;
  }

  /// The batch that starts at next(), or null.
  const Batch* peek() const {
    const auto& slot = slots_[next_ % slots];
    return slot.used && slot.batch.epoch == epoch_ && slot.batch.first == next_ ? &slot.batch : nullptr;
  }
  /// Any batch held, by its first cycle.
  const Batch* find(std::uint64_t first) const {
    const auto& slot = slots_[first % slots];
    return slot.used && slot.batch.epoch == epoch_ && slot.batch.first == first ? &slot.batch : nullptr;
  }
  /// The first batch that arrived for the cycles of `batch`, or null.
  const Batch* first_arrival(const Batch& batch) const {
    const auto& slot = slots_[batch.first % slots];
    return slot.used && slot.batch.epoch == batch.epoch && slot.batch.first == batch.first ? &slot.batch
                                                                                           : nullptr;
  }
  void advance() {
    if (const auto* batch = peek()) next_ = batch->first + batch->count;
  }
  std::uint64_t next() const { return next_; }
  std::uint32_t epoch() const { return epoch_; }
  bool has_next() const { return peek() != nullptr; }
  /// Batches of which next() has not come to the end.
  std::vector<Batch> pending() const {
    std::vector<Batch> batches;
    for (const auto& slot : slots_)
      if (slot.used && (slot.batch.epoch > epoch_ ||
                        (slot.batch.epoch == epoch_ && slot.batch.first + slot.batch.count > next_)))
        batches.push_back(slot.batch);
    return batches;
  }
  /// For libs/cluster/snapshot: batches that were taken are left out.
  /// No field, `batches` are what counts of it: slots_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("epoch", self.epoch_), visit("newest_epoch", self.newest_epoch_);
    visit("start_epoch", self.start_epoch_), visit("next", self.next_), visit("newest", self.newest_);
    visit("start_first", self.start_first_);
    auto batches = self.pending();
    visit("frames", batches);
    if constexpr (!std::is_const_v<Self>)
      for (auto& batch : batches) self.slots_[batch.first % slots] = {batch, true};
  }
  /// A later batch is present while the next is missing.
  bool gap() const { return std::pair(newest_epoch_, newest_) > std::pair(epoch_, next_) && !has_next(); }

 private:
  struct Slot {
    Batch batch;
    bool used = false;
  };
  static constexpr std::uint64_t most_cycles = 64;  // of one batch
  void start_taken() { start_epoch_ = 0, start_first_ = 0; }
  // A channel begins one epoch after the other, each when the drive has answered for the one before.
  bool is_beyond(std::uint32_t epoch) const { return std::uint64_t{epoch} > std::uint64_t{epoch_} + 1; }

  std::vector<Slot> slots_;
  std::uint32_t epoch_ = 0, newest_epoch_ = 0, start_epoch_ = 0;
  std::uint64_t next_ = 0, newest_ = 0, start_first_ = 0;
};

}  // namespace trunnion::stream
