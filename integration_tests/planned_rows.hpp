// SPDX-License-Identifier: Apache-2.0
// What `trunnion plan` writes against what a cluster has sent: every cycle, bit for bit.
#pragma once

#include <charconv>
#include <cstdlib>
#include <fstream>

#include "recording/file_stream.hpp"
#include "report/capture.hpp"
#include "report_run.hpp"

namespace trunnion::integration {

struct PlannedRow {
  std::uint32_t line = 0;
  std::vector<double> axes;
  std::array<double, 3> tip{};
};

/// The rows of --csv: cycle, line, axes, tip_x, tip_y, tip_z, feed. Its numbers read back to the same bits.
inline std::vector<PlannedRow> planned_rows(const std::string& machine, const std::string& program) {
  const auto file =
      std::filesystem::temp_directory_path() / ("trunnion-plan-" + std::to_string(getpid()) + ".csv");
  const std::string command = cluster::binary_directory() + "/trunnion plan " + program + " --machine " +
                              machine + " --csv " + file.string() + " > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream in(file);
  std::string text;
  std::getline(in, text);
  std::vector<PlannedRow> rows;
  std::vector<double> values;
  while (std::getline(in, text)) {
    values.clear();
    for (const char* at = text.data(); at < text.data() + text.size(); ++at) {
      double value = 0;
      at = std::from_chars(at, text.data() + text.size(), value).ptr;
      values.push_back(value);
    }
    const auto end_of_axes = values.end() - 4;
    PlannedRow row;
    row.line = static_cast<std::uint32_t>(values[1]);
    row.axes.assign(values.begin() + 2, end_of_axes);
    std::copy_n(end_of_axes, 3, row.tip.begin());
    rows.push_back(row);
  }
  std::filesystem::remove(file);
  return rows;
}

/// `recording`, of a run of `program` alone, has the planned line, axes and (with tool tip control) tip in
/// every cycle. The plan's exact stops take the least time that the check of the axes permits (parameter
/// 010166): where an axis is in position later, the recording has more cycles at rest. The machine must
/// compensate nothing: then the drive's setpoints are the planned axes.
inline void expect_as_planned(const std::string& recording, const std::string& machine,
                              const std::string& program) {
  const auto plan = planned_rows(machine, program);
  ASSERT_GT(plan.size(), 10000u);
  recording::FileSource source(recording);
  const auto sent = report::read_capture(source, 0);
  ASSERT_EQ(sent.commanded.cycles.size(), sent.path.size());
  ASSERT_EQ(sent.commanded.width, plan[0].axes.size());
  const auto at_rest = [&](std::size_t row) {
    return row > 0 && std::equal(sent.commanded.row(row), sent.commanded.row(row) + sent.commanded.width,
                                 sent.commanded.row(row - 1));
  };
  const auto is_planned = [&](std::size_t row, std::size_t k) {
    return sent.path[row].line == plan[k].line &&
           std::equal(plan[k].axes.begin(), plan[k].axes.end(), sent.commanded.row(row));
  };
  std::size_t tips = 0, row = 0, later = 0;
  for (std::size_t k = 0; k < plan.size(); ++k, ++row) {
    while (row < sent.path.size() && !is_planned(row, k) && at_rest(row)) ++row, ++later;
    ASSERT_LT(row, sent.path.size()) << "the recording ends before the plan, at its cycle " << k;
    ASSERT_EQ(sent.path[row].cycle, sent.path[0].cycle + row) << "a cycle is missing";
    ASSERT_EQ(sent.commanded.cycles[row], sent.path[row].cycle);
    ASSERT_EQ(sent.path[row].line, plan[k].line) << "cycle " << k;
    for (std::size_t axis = 0; axis < plan[k].axes.size(); ++axis)
      ASSERT_EQ(sent.commanded.row(row)[axis], plan[k].axes[axis]) << "cycle " << k << ", axis " << axis;
    if (!sent.path[row].rtcp) continue;
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_EQ(sent.path[row].position[i], plan[k].tip[i]) << "cycle " << k << ", tip " << i;
    ++tips;
  }
  while (row < sent.path.size() && at_rest(row)) ++row;
  EXPECT_EQ(row, sent.path.size()) << "the axes move behind the end of the plan";
  EXPECT_GT(tips, 10000u);
  EXPECT_EQ(later, 0u) << "cycles at exact stops beyond the plan: an axis settles later than the lead";
}

}  // namespace trunnion::integration
