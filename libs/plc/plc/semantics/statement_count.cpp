// SPDX-License-Identifier: Apache-2.0
#include "plc/semantics/statement_count.hpp"

#include <algorithm>

namespace trunnion::st {
namespace {

constexpr std::int64_t unreachable = -1;
constexpr std::int64_t very_many = std::int64_t{1} << 60;

std::int64_t sum(std::int64_t a, std::int64_t b) { return std::min(a + b, very_many); }
std::int64_t product(std::int64_t a, std::int64_t b) {
  return a != 0 && b > very_many / a ? very_many : std::min(a * b, very_many);
}

// The longest way through one routine. All jumps but those of loops lead ahead, so instructions are taken in
// their order; a loop is complete at the Op::loop behind its body, and only then it is known how long the
// ways out of it are.
class LongestWay {
 public:
  LongestWay(const ByteCode& code, const std::map<std::uint32_t, Loop>& loops,
             const std::vector<StatementCount>& done)
      : code_(code), known_(loops), done_(done) {}

  StatementCount of(const Routine& routine) {
    entry_ = routine.entry;
    most_.assign(routine.end - routine.entry + 1, unreachable);
    most_[0] = 0;
    for (auto i = routine.entry; i < routine.end; ++i)
      if (code_.code[i].op == Op::loop && is_back(i)) {
        const auto found = known_.find(i);
        if (found == known_.end() || !found->second.runs) return {std::nullopt, i};
        loops_.push_back({static_cast<std::uint32_t>(code_.code[i].a), i, {}});
      }
    for (auto i = routine.entry; i < routine.end; ++i) {
      const auto at = most_[i - entry_];
      if (at == unreachable && !(code_.code[i].op == Op::loop && is_back(i))) continue;
      if (const auto failed = step(i, at)) return *failed;
    }
    return {std::max<std::int64_t>(longest_, 0), 0};
  }

 private:
  struct Way {
    std::uint32_t to;
    std::int64_t most;
  };
  struct Open {
    std::uint32_t first, last;
    std::vector<Way> exits;
  };

  bool is_back(std::uint32_t i) const { return static_cast<std::uint32_t>(code_.code[i].a) <= i; }
  bool is_bounded_loop(const Open& loop, std::uint32_t from, std::uint32_t to) const {
    return from >= loop.first && from < loop.last && (to < loop.first || to > loop.last);
  }

  void lead(std::uint32_t from, std::uint32_t to, std::int64_t most) {
    // The innermost loop that is left has it first; it is passed on when that loop is complete.
    Open* innermost = nullptr;
    for (auto& loop : loops_)
      if (is_bounded_loop(loop, from, to) && (innermost == nullptr || loop.first >= innermost->first))
        innermost = &loop;
    if (innermost != nullptr)
      innermost->exits.push_back({to, most});
    else
      most_[to - entry_] = std::max(most_[to - entry_], most);
  }

  std::optional<StatementCount> step(std::uint32_t i, std::int64_t at) {
    const auto& in = code_.code[i];
    auto next = at;
    switch (in.op) {
      case Op::statement:
      case Op::point_save:
        next = sum(at, 1);
        break;
      case Op::copy_block:
        next = sum(at, in.c / 16);
        break;
      case Op::string_make:
      case Op::string_query:
        next = sum(at, 4);
        break;
      case Op::call:
      case Op::call_at: {
        const auto& called = done_[static_cast<std::uint32_t>(in.a)];
        if (!called.most) return called;
        next = sum(sum(at, 1), *called.most);
        break;
      }
      case Op::jump:
      case Op::jump_if:
      case Op::jump_if_not:
        lead(i, static_cast<std::uint32_t>(in.a), at);
        if (in.op == Op::jump) return std::nullopt;
        break;
      case Op::loop:
        if (!is_back(i)) {
          lead(i, static_cast<std::uint32_t>(in.a), sum(at, 1));
          return std::nullopt;
        }
        close(i, at);
        return std::nullopt;
      case Op::return_:
        longest_ = std::max(longest_, at);
        return std::nullopt;
      default:
        break;
    }
    lead(i, i + 1, next);
    return std::nullopt;
  }

  void close(std::uint32_t last, std::int64_t at) {
    const auto loop =
        std::find_if(loops_.begin(), loops_.end(), [&](const Open& l) { return l.last == last; });
    const auto before = most_[loop->first - entry_];
    const auto exits = std::move(loop->exits);
    const auto first = loop->first;
    loops_.erase(loop);
    if (before == unreachable) return;
    // One run of the body; when its end is not reached it runs once at most.
    const auto runs = at == unreachable ? std::int64_t{1} : *known_.at(last).runs;
    const auto one = at == unreachable ? 0 : sum(at - before, 1);
    for (const auto& way : exits) {
      const auto part = way.most - before;
      const auto within =
          std::max(product(runs, one), sum(product(std::max<std::int64_t>(runs - 1, 0), one), part));
      // Without a run only the way around the body remains.
      lead(first, way.to, sum(before, runs == 0 ? part : within));
    }
  }

  const ByteCode& code_;
  const std::map<std::uint32_t, Loop>& known_;
  const std::vector<StatementCount>& done_;
  std::uint32_t entry_ = 0;
  std::vector<std::int64_t> most_;  ///< statements on the way to each instruction
  std::vector<Open> loops_;
  std::int64_t longest_ = unreachable;
};

}  // namespace

std::vector<StatementCount> statement_counts(const ByteCode& code,
                                             const std::map<std::uint32_t, Loop>& loops) {
  std::vector<StatementCount> counts;
  counts.reserve(code.routines.size());
  // A routine calls only those before it.
  for (const auto& routine : code.routines) counts.push_back(LongestWay(code, loops, counts).of(routine));
  return counts;
}

}  // namespace trunnion::st
