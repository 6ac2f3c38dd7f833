// SPDX-License-Identifier: Apache-2.0
// Five-axis machines as whole clusters: the commanded tip on the part, and that the service computes the bits
// of the library.
#include <fstream>

#include "analysis/test/part_path.hpp"
#include "cluster_harness.hpp"
#include "machine/axes.hpp"
#include "machine/machine.hpp"
#include "report_run.hpp"

namespace trunnion::integration {
namespace {

using geometry::Vec3;

class RtcpMachine : public testing::TestWithParam<const char*> {};

// Every cycle's machine axes, sent forward through the chain, against the commanded tip; and the commanded
// tip against the program. Lines with exact stops are met exactly; the smoothing cuts arcs by at most
// parameter 000010, 0.005 mm.
TEST_P(RtcpMachine, RunsItsProgramWithTheTipOnThePath) {
  const auto report = run(std::string(GetParam()) + " rtcp");
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["problem"], "");
  EXPECT_GT(report["forward_inverse_residual"]["cycles"].get<int>(), 10000);
  EXPECT_LT(report["forward_inverse_residual"]["max_mm"].get<double>(), 1e-6);
  EXPECT_LE(report["contour_error"]["commands_feed"]["max_mm"].get<double>(), 0.005);
}

INSTANTIATE_TEST_SUITE_P(Machines, RtcpMachine,
                         testing::Values("ac-table", "bc-table", "cb-head", "ac-head", "b-head-c-table",
                                         "nutating-b-head-c-table", "four-axis"),
                         [](const auto& machine) {
                           std::string name = machine.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// The program of a machine with exact stops in place of smoothed corners, whose shape depends on the machine.
class ExactStopProgram {
 public:
  ExactStopProgram(const std::string& machine, const std::string& program)
      : path_(std::filesystem::temp_directory_path() /
              ("trunnion-exact-" + std::to_string(getpid()) + ".nc")) {
    std::ifstream in(cluster::find_machine(machine) + "/programs/" + program);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    text.replace(text.find("G64"), 3, "G61");
    std::ofstream(path_) << text;
  }
  ~ExactStopProgram() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

class TestPiece : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

// The programs have the same tips on the part (tools/programs/test compares them), so a commanded tip within
// 1e-6 mm of them on every machine is the same path within that.
TEST_P(TestPiece, HasTheSameTipPathOnThePartWithin1e6) {
  const auto [machine, program] = GetParam();
  const ExactStopProgram exact(machine, program);
  const auto report = run(std::string(machine) + " " + exact.path());
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["problem"], "");
  EXPECT_GT(report["contour_error"]["commands_feed"]["cycles"].get<int>(), 20000);
  EXPECT_LT(report["contour_error"]["commands_feed"]["max_mm"].get<double>(), 1e-6);
  EXPECT_LT(report["forward_inverse_residual"]["max_mm"].get<double>(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Pieces, TestPiece,
                         testing::Combine(testing::Values("ac-table", "cb-head", "b-head-c-table"),
                                          testing::Values("s_piece.nc", "nas979_cone.nc")),
                         [](const auto& piece) {
                           std::string name =
                               std::string(std::get<0>(piece.param)) + "_" + std::get<1>(piece.param);
                           for (char& letter : name)
                             if (letter == '-' || letter == '.') letter = '_';
                           return name;
                         });

// As the programs are, with rounded joins: what the drives of each machine are commanded puts the tip onto
// one and the same curve, that of a plan for the AC table. From the approach, which comes from where the
// machine happens to be, until the tool has left the piece.
TEST_P(TestPiece, WithRoundedJoinsIsTheCurveOfEveryOtherMachineWithin1e6) {
  const auto [machine, program] = GetParam();
  const auto folder = cluster::find_machine("ac-table");
  std::ifstream in(folder + "/programs/" + program);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto line_of = [&](const char* word) {
    const auto at = static_cast<std::ptrdiff_t>(text.find(word));
    return static_cast<std::uint32_t>(1 + std::count(text.begin(), text.begin() + at, '\n'));
  };
  channel_setup::ChannelSetup planned(tool_tables::load_machine_tables(folder));
  const auto curve = analysis::part_path(text, planned, line_of("G9 G0"), line_of("\nG49"));

  Cluster cluster(machine);
  cluster.keep_rows = true;
  cluster.start(program);
  ASSERT_TRUE(cluster.finish(0, 100)) << cluster.active_alarms();
  const channel_setup::ChannelSetup setup(tool_tables::load_machine_tables(cluster::find_machine(machine)));
  const auto zero = setup.work_offset(0);
  std::vector<Vec3> tips;
  std::size_t begin = 0, end = 0;
  for (const auto& row : cluster.rows) {
    language::AxisValues at{};
    for (std::size_t i = 0; i < setup.columns().size(); ++i)
      at[setup.channel_axes().index[i]] = row[static_cast<std::size_t>(setup.columns()[i])];
    const auto tip = setup.tip_from_machine(at, *setup.tool_length(1));
    tips.emplace_back(tip[0] - zero[0], tip[1] - zero[1], tip[2] - zero[2]);
    if (begin == 0 && (tips.back() - curve.front()).norm() < 1e-6) begin = tips.size() - 1;
    if ((tips.back() - curve.back()).norm() < 1e-6) end = tips.size();
  }
  ASSERT_GT(begin, 0u) << "the approach is there";
  ASSERT_GT(end, begin + 10000) << "and the whole piece behind it";
  const std::vector<Vec3> piece(tips.begin() + static_cast<std::ptrdiff_t>(begin),
                                tips.begin() + static_cast<std::ptrdiff_t>(end));
  EXPECT_LT(analysis::farthest_from(curve, piece), 1e-6);
}

// One program with tool vectors for every machine: lines over which the tool goes round a cone, through the
// pole and past it. Its tips are the program's on all of them.
class VectorProgram : public testing::TestWithParam<const char*> {};

TEST_P(VectorProgram, IsTheSameTextForEveryMachineAndKeepsTheTipOnItsLines) {
  const auto path =
      std::filesystem::temp_directory_path() / ("trunnion-vector-" + std::to_string(getpid()) + ".nc");
  std::ofstream(path) << "G21 G17 G90 G54 G94 G61\nG53 G0 Z0\nG43.5 H1\nG0 X0 Y0 Z80\n"
                         "G1 X0 Y0 Z60 F3000\nX30 I0.4 K1\nX30 Y30 J0.4 K1\nX0 Y30 I-0.4 K1\nX0 Y0 J-0.4 K1\n"
                         "X20 Y20 J0.4 K1\n"
                         "X0 Y0 Z65 I0.0004 J-0.4 K1\nX10 I0 J0 K1\nG49\nG53 G0 Z0\nM30\n";
  const auto report = run(std::string(GetParam()) + " " + path.string());
  std::filesystem::remove(path);
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["problem"], "");
  EXPECT_GT(report["contour_error"]["commands_feed"]["cycles"].get<int>(), 3000);
  EXPECT_LT(report["contour_error"]["commands_feed"]["max_mm"].get<double>(), 1e-6);
  EXPECT_LT(report["forward_inverse_residual"]["max_mm"].get<double>(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Machines, VectorProgram,
                         testing::Values("ac-table", "bc-table", "cb-head", "ac-head", "b-head-c-table",
                                         "nutating-b-head-c-table"),
                         [](const auto& machine) {
                           std::string name = machine.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Kinematics, TheServiceComputesTheBitsOfTheLibrary) {
  const std::string name = "nutating-b-head-c-table";
  machine::Parameters parameters;
  parameters.values = machine::machine_parameters(machine::load_machine(cluster::find_machine(name)));
  const auto chain = machine::make_chain(parameters, 0);
  const auto axes = machine::channel_axes(parameters, 0);
  Cluster cluster(name);
  auto paths = cluster.client().bus().reader(topics::path_batch);
  auto machines = cluster.client().bus().reader(topics::kinematics_batch);
  std::map<std::uint64_t, idl::stream::PathBatch> path_batches;
  std::map<std::uint64_t, idl::stream::AxisBatch> machine_batches;
  const auto collect = [&] {
    idl::stream::PathBatch path;
    while (paths.take(path)) path_batches[path.first] = path;
    idl::stream::AxisBatch machine;
    while (machines.take(machine)) machine_batches[machine.first] = machine;
  };
  cluster.start("rtcp.nc");
  ASSERT_TRUE(cluster.until(
      [&] {
        collect();
        return cluster.state() == RunState::IDLE;
      },
      60))
      << cluster.active_alarms();
  std::size_t transformed = 0;
  for (const auto& [first, path] : path_batches) {
    const auto found = machine_batches.find(first);
    if (found == machine_batches.end()) continue;
    const auto& machine = found->second;
    ASSERT_EQ(machine.axes, axes.number);
    for (std::uint32_t row = 0; row < std::min(path.count, machine.count); ++row) {
      std::array<double, 9> expected;
      std::copy_n(path.setpoints.begin() + row * 9, 9, expected.begin());
      if (path.transformation == idl::stream::Transformation::RTCP) {
        const Vec3 at = chain.machine_from_tip(Vec3(expected[0], expected[1], expected[2]),
                                               geometry::angles_of(expected.data()), path.tool_length);
        std::copy_n(at.data(), 3, expected.begin());
        ++transformed;
      }
      for (std::size_t i = 0; i < axes.index.size(); ++i)
        ASSERT_EQ(machine.setpoints[row * axes.index.size() + i], expected[axes.index[i]])
            << "cycle " << first + row << " axis " << axes.letters[i];
    }
  }
  EXPECT_GT(transformed, 10000u) << "cycles compared";
}

TEST(Kinematics, ParallelAxesAreAnAlarmOfTheirOwnAndNothingMoves) {
  Cluster cluster("ac-table");
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.operation = idl::parameters::Operation::SET;
  request.who = "test";
  request.values = {{40426, 0, ""}, {40428, -1, ""}};
  cluster.client().parameter(request);
  cluster.client().channel(0, CommandKind::RESET);
  EXPECT_TRUE(cluster.until([&] { return cluster.has_alarm(147, "the rotary axes are parallel"); }))
      << cluster.active_alarms();
}

TEST(Kinematics, ADirectionThatIsNotOneLongIsAWarning) {
  Cluster cluster("ac-table");
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.operation = idl::parameters::Operation::SET;
  request.who = "test";
  request.values = {{40426, -0.5, ""}};
  cluster.client().parameter(request);
  cluster.client().channel(0, CommandKind::RESET);
  EXPECT_TRUE(cluster.until([&] { return cluster.has_alarm(148, "040426"); })) << cluster.active_alarms();
}

struct Said {
  std::string out;
  int status = 0;
};

// Standard output and, after it, standard error.
Said kins(const std::string& arguments, const std::string& input) {
  const std::string command =
      "printf '" + input + "' | " + cluster::binary_directory() + "/trunnion kins " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  Said said;
  std::array<char, 4096> buffer;
  while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe)) said.out.append(buffer.data(), n);
  said.status = WEXITSTATUS(pclose(pipe));
  return said;
}

// The axes of the machine meet at Z-400: the tip (1, 2, 3) is 403 above them, A90 takes that to Y403 and Y2
// to Z-2 below them, and the tool of 100 stands above.
TEST(KinsCommand, AnswersLineByLineAndStopsAtABadLine) {
  auto said = kins("ac-table inverse --tool-length 100", "1 2 3 90 0\\n");
  EXPECT_EQ(said.out, "1.000000000000 403.000000000000 -302.000000000000\n");
  EXPECT_EQ(said.status, 0);
  // Both axes through Y-5 Z-300: 7 behind and 303 above goes to 303 behind and 7 below.
  said = kins("ac-table inverse --tool-length 100 --set 040436=-5 --set 040437=-300", "1 2 3 90 0\\n");
  EXPECT_EQ(said.out, "1.000000000000 298.000000000000 -207.000000000000\n");
  said = kins("ac-table forward", "1 2 3 0 0\\n1 2 3 4\\n1 2 3 0 0\\n");
  EXPECT_EQ(said.out,
            "1.000000000000 2.000000000000 3.000000000000 0.000000000000 0.000000000000 1.000000000000\n"
            "trunnion: line 2: expected 5 numbers (rotary axes AC), there are 4\n");
  EXPECT_EQ(said.status, 1);
  said = kins("no-such-machine orient", "0 0 1\\n");
  EXPECT_EQ(said.status, 1);
  said = kins("ac-table orient --set 040426=0 --set 040428=1", "0 0 1\\n");
  EXPECT_EQ(said.out, "trunnion: channel 0, parameters 040400 .. 040437: the rotary axes are parallel\n");
  EXPECT_EQ(said.status, 1);
  said = kins("ac-table inverse --tool-length nan", "1 2 3 0 0\\n");
  EXPECT_EQ(said.out, "trunnion: --tool-length: not a number\n");
  EXPECT_EQ(said.status, 1);
  said = kins("ac-table orient --set CORR_C=0,0,1", "0 0 1\\n");
  EXPECT_EQ(said.out.substr(0, 10), "trunnion: ") << "no correction of that name, and no number";
  EXPECT_EQ(said.status, 1);
  said = kins(cluster::find_machine("four-axis") + "/machine.yaml orient", "0 -0.6 0.8\\n");
  EXPECT_EQ(said.out, "36.869897645844\n");
}

}  // namespace
}  // namespace trunnion::integration
