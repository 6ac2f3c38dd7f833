// SPDX-License-Identifier: Apache-2.0
#include "core/program_plan.hpp"

#include <cmath>

#include "analysis/program_run.hpp"
#include "core/planned_path.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

constexpr std::uint64_t most_cycles = 100000000;
constexpr std::size_t most_points = 20000;
constexpr double mm_decimals = 1e4, second_decimals = 1e6;

double rounded(double value, double decimals) { return std::round(value * decimals) / decimals + 0.0; }

/// When the program comes to which line.
class Stretches {
 public:
  void add(std::uint32_t line, double seconds) {
    if (!lines_.empty() && lines_.back() == line) return;
    // A stretch that is shorter than the step is one with that before it.
    if (!lines_.empty() && seconds - begin_.back() < least_) return;
    if (lines_.size() == most_stretches) thin_out();
    lines_.push_back(line);
    begin_.push_back(seconds);
  }
  Json json() const {
    Json begin = Json::array();
    for (const double one : begin_) begin.push_back(rounded(one, second_decimals));
    return {{"line", lines_}, {"begin", std::move(begin)}};
  }

 private:
  void thin_out() {
    least_ = 2 * begin_.back() / static_cast<double>(most_stretches);
    std::size_t kept = 1;
    for (std::size_t i = 1; i < lines_.size(); ++i) {
      if (begin_[i] - begin_[kept - 1] < least_) continue;
      lines_[kept] = lines_[i];
      begin_[kept++] = begin_[i];
    }
    lines_.resize(kept);
    begin_.resize(kept);
  }

  std::vector<std::uint32_t> lines_;
  std::vector<double> begin_;  ///< s
  double least_ = 0;           ///< s
};

Json path_document(const PlannedPath& path, const language::AxisValues& zero) {
  std::vector<double> x, y, z, seconds;
  std::vector<std::uint32_t> line;
  std::vector<bool> rapid;
  for (const auto& point : path.points()) {
    x.push_back(rounded(point.tip.x() - zero[0], mm_decimals));
    y.push_back(rounded(point.tip.y() - zero[1], mm_decimals));
    z.push_back(rounded(point.tip.z() - zero[2], mm_decimals));
    line.push_back(point.line);
    rapid.push_back(point.rapid);
    seconds.push_back(rounded(point.seconds, second_decimals));
  }
  return {{"x", x},
          {"y", y},
          {"z", z},
          {"line", line},
          {"rapid", rapid},
          {"seconds", seconds},
          {"tolerance", path.tolerance()}};
}

}  // namespace

Json plan_document(language::TextSource& text, channel_setup::ChannelSetup& machine,
                   const std::function<bool()>& stop) {
  const double period = machine.cycle_seconds();
  PlannedPath path(most_points);
  Stretches stretches;
  double seconds = 0;
  const auto take = [&](const analysis::PlannedCycle& cycle) {
    const auto& now = *cycle.setpoint;
    seconds = static_cast<double>(cycle.cycle + 1) * period;
    stretches.add(now.line, static_cast<double>(cycle.cycle) * period);
    path.add({{cycle.tip[0], cycle.tip[1], cycle.tip[2]}, now.line, now.rapid, seconds});
  };
  std::uint64_t moves = 0;
  const auto result = analysis::run_program(
      text, machine, machine.reference_position(), take,
      [&](const language::Command&, const analysis::FrameMoves&) { ++moves; }, most_cycles, nullptr, stop);
  Json answer = {{"complete", !result.stopped}};
  answer["dialect"] = std::string(canonical::dialect_name(result.dialect));
  if (!result.good && !result.stopped) answer["alarm"] = result.alarm;
  answer["seconds"] = rounded(seconds, second_decimals);
  answer["moves"] = moves;
  answer["lines"] = stretches.json();
  answer["path"] = path_document(path, machine.work_offset(0));
  return answer;
}

}  // namespace trunnion::gateway
