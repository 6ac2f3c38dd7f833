// SPDX-License-Identifier: Apache-2.0
// The test pieces on machines of three kinds: the path of the commanded tip on the part, compared as curves.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "part_path.hpp"

namespace trunnion::analysis {
namespace {

// From the approach to the piece, which comes from where the machine happens to be, until the tool has left
// it.
std::vector<Vec3> tips(const std::string& machine, const std::string& program) {
  const std::string folder = std::string(MACHINES_DIRECTORY) + "/" + machine;
  channel_setup::ChannelSetup setup(tool_tables::load_machine_tables(folder));
  std::ifstream in(folder + "/programs/" + program);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto line_of = [&](const char* word) {
    const auto at = static_cast<std::ptrdiff_t>(text.find(word));
    return static_cast<std::uint32_t>(1 + std::count(text.begin(), text.begin() + at, '\n'));
  };
  return part_path(text, setup, line_of("G9 G0"), line_of("\nG49"));
}

class TestPiece : public testing::TestWithParam<const char*> {};

// As the programs are, with rounded joins (G64): the roundings are made of the tip's path and the tolerances,
// and of the axes only where the rotary words differ, which they do not by more than an offset. The time
// differs, the curve does not.
TEST_P(TestPiece, HasTheSameTipPathOnThePartWithin1e6OnEveryMachine) {
  const auto first = tips("ac-table", GetParam());
  ASSERT_GT(first.size(), 10000u);
  for (const char* machine : {"cb-head", "b-head-c-table"}) {
    const auto other = tips(machine, GetParam());
    EXPECT_LT(farthest_from(other, first), 1e-6) << machine;
    EXPECT_LT(farthest_from(first, other), 1e-6) << machine;
  }
}

INSTANTIATE_TEST_SUITE_P(Pieces, TestPiece, testing::Values("s_piece.nc", "nas979_cone.nc"),
                         [](const auto& piece) {
                           const std::string name = piece.param;
                           return name.substr(0, name.find('.'));
                         });

// The comparison sees what it is asked about: one tip a micrometre aside. On a smooth path the
// distance itself is known to the 4e-9 mm at which its search for the nearest place ends.
TEST(PartPath, DistanceSeesATipThatIsAMicrometreAside) {
  std::vector<Vec3> circle, between;
  for (int k = 0; k < 1000; ++k) {
    circle.push_back(Vec3(50 * std::cos(0.001 * k), 50 * std::sin(0.001 * k), 0.02 * k));
    between.push_back(
        Vec3(50 * std::cos(0.001 * (k + 0.4)), 50 * std::sin(0.001 * (k + 0.4)), 0.02 * (k + 0.4)));
  }
  between.erase(between.begin());
  between.resize(997);
  EXPECT_LT(farthest_from(circle, between), 5e-9);
  between[500] += Vec3(0, 0, 1e-3);
  EXPECT_NEAR(farthest_from(circle, between), 1e-3, 3e-4);
}

}  // namespace
}  // namespace trunnion::analysis
