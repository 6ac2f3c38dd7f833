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
/// every cycle. The machine must compensate nothing: then the drive's setpoints are the planned axes.
inline void expect_as_planned(const std::string& recording, const std::string& machine,
                              const std::string& program) {
  const auto plan = planned_rows(machine, program);
  ASSERT_GT(plan.size(), 10000u);
  recording::FileSource source(recording);
  const auto sent = report::read_capture(source, 0);
  ASSERT_EQ(sent.path.size(), plan.size());
  ASSERT_EQ(sent.commanded.cycles.size(), plan.size());
  ASSERT_EQ(sent.commanded.width, plan[0].axes.size());
  std::size_t tips = 0;
  for (std::size_t k = 0; k < plan.size(); ++k) {
    ASSERT_EQ(sent.path[k].cycle, sent.path[0].cycle + k) << "a cycle is missing";
    ASSERT_EQ(sent.commanded.cycles[k], sent.path[k].cycle);
    ASSERT_EQ(sent.path[k].line, plan[k].line) << "cycle " << k;
    for (std::size_t axis = 0; axis < plan[k].axes.size(); ++axis)
      ASSERT_EQ(sent.commanded.row(k)[axis], plan[k].axes[axis]) << "cycle " << k << ", axis " << axis;
    if (!sent.path[k].rtcp) continue;
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_EQ(sent.path[k].position[i], plan[k].tip[i]) << "cycle " << k << ", tip " << i;
    ++tips;
  }
  EXPECT_GT(tips, 10000u);
}

}  // namespace trunnion::integration
