// Judges the copies of stages with twins by their progress: who is in step, who joins, who is dropped.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "contracts/types.hpp"
#include "machine/machine.hpp"
#include "stream/stage_names.hpp"

namespace trunnion::stream {

/// The part of the alarm redundancy_lost when it is a channel's, so that `status` can tell whom it means.
inline std::uint32_t copy_part(Stage stage, std::uint8_t copy) {
  return static_cast<std::uint32_t>(stage) * 256u + copy;
}

/// For one channel. Times are seconds of any clock that does not go back.
class CopyWatch {
 public:
  static constexpr double progress_patience = 0.1;  ///< s without progress until a copy is dropped
  static constexpr double sign_patience = 0.5;      ///< s without a sign of life until it lags
  static constexpr double start_patience = 2.0;     ///< s for which a start waits for a copy
  static constexpr std::uint64_t everywhere = std::numeric_limits<std::uint64_t>::max();

  enum class Standing { joining, in_step, dropped };
  struct Copy {
    Stage stage{};
    std::uint8_t copy = 0;
    Standing standing = Standing::joining;
    std::uint32_t epoch = 0;
    std::uint64_t next = 0;
    bool reports_in_step = false;
    double heard = 0;          ///< 0 = never
    double lagging_since = 0;  ///< 0 = it does not lag
    bool lags() const { return lagging_since != 0; }
  };
  struct Change {
    Stage stage{};
    std::uint8_t copy = 0;
    bool lost = false;  ///< dropped; false: in step again
  };

  CopyWatch() = default;
  /// Follows the copies of every stage of `services` that has more than one.
  CopyWatch(const std::vector<machine::ServiceEntry>& services, double now);

  void heard(const idl::stream::StageProgress& progress, double now);
  /// Judges anew; call it at least every 20 ms. A copy must come within 2 * `lead` cycles of its twin to be
  /// in step again. Returns who was dropped or is back since the last call.
  std::vector<Change> judge(std::uint64_t lead, double now);

  /// Every copy is in step, or has been late for longer than a start waits.
  bool may_start(double now) const;
  /// The cycle which the slowest copy in step computes next, `everywhere` when there is none.
  std::uint64_t floor() const;
  const std::vector<Copy>& copies() const { return copies_; }

 private:
  bool behind(const Copy& copy) const;
  bool far_behind(const Copy& copy, std::uint64_t distance) const;
  std::vector<Copy> copies_;
};

}  // namespace trunnion::stream
