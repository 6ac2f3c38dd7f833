// SPDX-License-Identifier: Apache-2.0
// Finds that a program repeats for ever.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "language/alarms.hpp"
#include "language/canonical.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

class TextSource;

/// Where a program is read, with all that its returns depend on.
struct ReadingPlace {
  struct Level {
    const TextSource* source = nullptr;
    std::uint64_t offset = 0;       ///< of the next line, of a caller the line behind the call
    std::uint32_t remaining = 0;    ///< repetitions of the program after this one
    std::uint64_t repetitions = 0;  ///< OpenStructures::repetitions()
    bool operator==(const Level&) const = default;
  };
  std::array<Level, max_nesting + 1> levels{};  ///< the main program first
  std::size_t depth = 0;
  std::size_t modal_calls = 0;  ///< of G66 and G66.1, active
  bool operator==(const ReadingPlace&) const = default;
};

/// Compares each return to a line that was read before with an earlier one (Brent: with the newest whose
/// count is a power of two). A program is certain to repeat when place and variables are the same and it has
/// read no system variable in between, or none but of its own position and modal state, and these are the
/// same. What reads others, or counts on and on, is given up after very many returns.
class EndlessLoop {
 public:
  /// A surface of 200 mm by 200 mm that macros mill in steps of 0.1 mm has 4 million.
  static constexpr std::uint64_t usual_most_returns = 5000000;

  /// Without `travel` the axes may move on and on: only with it must the position be the same, too.
  explicit EndlessLoop(bool travel, std::uint64_t most_returns = usual_most_returns);

  /// The program has returned to `place`; whether it will do so for ever, or has done so too often.
  bool returns(const ReadingPlace& place, std::uint32_t main_line, const Variables& variables,
               const AxisValues& position, const ModalState& modal);
  /// Of the main program, where it repeats; 0 when that was not found.
  std::uint32_t line() const { return line_; }
  /// It is not certain that the program repeats: it has returned more than `most_returns` times.
  bool gave_up() const { return gave_up_; }

 private:
  bool travel_;
  bool gave_up_ = false;
  std::uint64_t most_returns_;
  std::uint32_t line_ = 0;
  std::uint64_t count_ = 0, next_ = 1, matches_ = 0;
  ReadingPlace place_;
  std::unique_ptr<VariableImage> image_ = std::make_unique<VariableImage>();
  AxisValues position_{};
  ModalState modal_;
};

}  // namespace trunnion::language
