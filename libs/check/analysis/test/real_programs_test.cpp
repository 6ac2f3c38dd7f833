// SPDX-License-Identifier: Apache-2.0
// Programs from CAM systems and post processors, run where they are; they are not part of this repository.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "analysis/check_program.hpp"
#include "analysis/default_machine.hpp"
#include "analysis/file_source.hpp"

namespace trunnion::analysis {
namespace {

/// Linear axes and a rotary table whose turning moves nothing: enough to read five-axis programs.
struct FiveAxes : DefaultMachine {
  FiveAxes() : DefaultMachine(std::nullopt) {}
  std::uint16_t axes() const override { return 0b101111; }
  /// easy_gcode_plot writes P500. for half a second.
  language::DwellPoint dwell_point() const override { return language::DwellPoint::milliseconds; }
};

/// The summary and the alarm, if any.
std::string summary_of(language::Environment& machine, const std::filesystem::path& path, bool& good) {
  FileSource text(path.string());
  std::ostringstream out;
  good = check_program(
      text, machine, {}, {}, [&](std::uint32_t) { return path.filename().string(); }, out);
  return out.str();
}

struct RealProgram {
  const char* file;
  const char* moves;  ///< as the summary counts them
};

class RealPrograms : public testing::TestWithParam<RealProgram> {};

TEST_P(RealPrograms, RunToTheirEnd) {
  const auto path = std::filesystem::path(NC_PROGRAMS_DIRECTORY) / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  FiveAxes machine;
  bool good = false;
  const std::string summary = summary_of(machine, path, good);
  EXPECT_TRUE(good) << summary;
  EXPECT_NE(summary.find(GetParam().moves), std::string::npos) << summary;
}

// Counted in the texts: blocks with G0, G1, and G2 or G3 whose end differs from that of the block before, G28
// as one rapid when it begins where its point is; G83 of 12 holes 22 mm deep by 2 mm is 11 lines a hole.
INSTANTIATE_TEST_SUITE_P(
    All, RealPrograms,
    testing::Values(RealProgram{"CAMotics__flower_mold.nc", "4 rapid, 16553 lines, 0 arcs"},
                    RealProgram{"Gcode5Axis__5_Axis_Simultaneous_Milling_Aileron_bracket.nc",
                                "114 rapid, 6285 lines, 3983 arcs"},
                    RealProgram{"easy_gcode_plot__G17_18_19_G91.NC", "7 rapid, 3 lines, 3 arcs"},
                    RealProgram{"easy_gcode_plot__G83.NC", "279 rapid, 132 lines, 0 arcs"},
                    RealProgram{"easy_gcode_plot__PARALLEL.NC", "6 rapid, 3652 lines, 60 arcs"},
                    RealProgram{"linuxcnc__wheels.ngc", "5 rapid, 7273 lines, 0 arcs"}));

TEST(RealPrograms, RotaryWordsNeedAMachineThatHasThem) {
  const auto path = std::filesystem::path(NC_PROGRAMS_DIRECTORY) /
                    "Gcode5Axis__5_Axis_Simultaneous_Milling_Aileron_bracket.nc";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  DefaultMachine machine({});
  bool good = true;
  EXPECT_NE(summary_of(machine, path, good).find("1109: channel does not have this axis: A0.0"),
            std::string::npos);
  EXPECT_FALSE(good);
}

}  // namespace
}  // namespace trunnion::analysis
