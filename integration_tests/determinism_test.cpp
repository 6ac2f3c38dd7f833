// SPDX-License-Identifier: Apache-2.0
// The same machine and program give the same drive commands, bit for bit, whatever the vendors, and those
// that were planned without a cluster.
#include <map>

#include "planned_rows.hpp"

namespace trunnion::integration {
namespace {

std::string program_of_ac_table(const std::string& name) {
  return cluster::find_machine("ac-table") + "/programs/" + name;
}

std::string recording_file() {
  return (std::filesystem::temp_directory_path() / ("trunnion-planned-" + std::to_string(getpid()) + ".mcap"))
      .string();
}

TEST(Determinism, TheConeIsAsPlannedAndTheSameOverThreeRunsAndEveryVendorLayout) {
  std::map<std::string, std::vector<std::string>> runs_by_hash;
  for (const std::string layout : {"cyclonedds", "cyclonedds", "cyclonedds", "fastdds", "mixed"}) {
    const bool first = runs_by_hash.empty();
    const auto report =
        run("ac-table nas979_cone --vendor " + layout + (first ? " --record " + recording_file() : ""));
    ASSERT_TRUE(report.is_object());
    if (first) {
      SCOPED_TRACE("against the plan");
      expect_as_planned(recording_file(), "ac-table", program_of_ac_table("nas979_cone.nc"));
      std::filesystem::remove(recording_file());
    }
    runs_by_hash[report["command_hash_fnv1a64"].dump()].push_back(layout);
    EXPECT_EQ(report["problem"], "") << layout;
    EXPECT_GT(report["cycles"].get<std::uint64_t>(), 10000u);
    EXPECT_EQ(report["executed_cycles"], report["cycles"]) << layout;
    for (const auto& [topic, lost] : report["lost_cycles"].items())
      EXPECT_EQ(lost, 0) << topic << " " << layout;
    EXPECT_EQ(report["late_batches"], 0) << layout;
    // The kinematics' rounding; compensation and gantry correction are off on this machine.
    EXPECT_LT(report["forward_inverse_residual"]["max_mm"].get<double>(), 1e-9) << layout;
    // Parameter 040901, the path tolerance of the machine.
    EXPECT_LE(report["contour_error"]["commands_feed"]["max_mm"].get<double>(), 0.01) << layout;
  }
  EXPECT_EQ(runs_by_hash.size(), 1u) << "different commands";
}

TEST(Determinism, TheSPieceIsAsPlanned) {
  ASSERT_TRUE(run("ac-table s_piece --record " + recording_file()).is_object());
  expect_as_planned(recording_file(), "ac-table", program_of_ac_table("s_piece.nc"));
  std::filesystem::remove(recording_file());
}

}  // namespace
}  // namespace trunnion::integration
