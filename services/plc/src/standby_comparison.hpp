// A PLC that does in private what the running one has done, round by round, and says where it differs.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "plc_core.hpp"
#include "round.hpp"

namespace trunnion::plc {

class StandbyComparison {
 public:
  /// The parameters of a revision, nullptr when they have not arrived.
  using FindParameters = std::function<std::shared_ptr<const machine::Parameters>(std::uint64_t revision)>;

  /// `core` has its programs loaded.
  StandbyComparison(PlcCore core, bool virtual_time, FindParameters find)
      : core_(std::move(core)), virtual_time_(virtual_time), find_(std::move(find)) {}

  enum class Outcome : std::uint8_t {
    equal,    ///< or nothing to be compared: rounds of an older generation
    waiting,  ///< for parameters: play the same round again
    gap,      ///< a round is missing: ask for another beginning
    differs,  ///< difference() says where; nothing more is played
  };
  /// Does what the running PLC did in the round and compares what came of it. `generation` is the one asked
  /// for last.
  Outcome play(const Round& round, std::uint32_t generation);

  /// Has taken over the running one's memory, and agrees with it since.
  bool in_step() const { return begun_ && difference_.empty(); }
  /// Of the drive, over all rounds that came out equal.
  std::uint64_t equal_ticks() const { return equal_ticks_; }
  /// "tick 1200, register R12: 1 and 0": the running one's value stands first. Empty while there is none.
  const std::string& difference() const { return difference_; }

 private:
  Outcome begin(const Round& round);
  bool parameters(std::uint64_t revision);
  bool repeat(const Step& step);
  Outcome compare(const Round& round, const Registers& before);
  Outcome differ(std::uint64_t tick, const std::string& what);
  Outcome differ(std::uint64_t tick, const Registers& before, const Changes& running, const Changes& own);

  PlcCore core_;
  bool virtual_time_;
  FindParameters find_;
  bool begun_ = false;
  std::uint32_t generation_ = 0;
  std::uint64_t number_ = 0, tick_ = 0, equal_ticks_ = 0;
  std::string difference_;
};

}  // namespace trunnion::plc
