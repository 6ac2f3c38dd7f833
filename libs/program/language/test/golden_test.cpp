// SPDX-License-Identifier: Apache-2.0
// Every feature of the language: small programs, and the streams worked out by hand from the meaning of their
// words. A program of golden/<feature>.nc begins with the line "(=== what it shows)", its stream in
// golden/<feature>.stream with "=== what it shows".
#include "golden.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

/// The lines of a file in sections, which begin with a line that `head` puts in front of their names.
std::vector<std::pair<std::string, std::vector<std::string>>> sections(const std::filesystem::path& path,
                                                                       const std::string& head) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + " cannot be read");
  std::vector<std::pair<std::string, std::vector<std::string>>> result;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(head, 0) == 0) {
      result.emplace_back(line.substr(head.size()), std::vector<std::string>{});
    } else if (result.empty()) {
      throw std::runtime_error(path.string() + " does not begin with " + head);
    } else {
      result.back().second.push_back(line);
    }
  }
  return result;
}

TestMachine plain() { return {}; }

TestMachine with_offsets() {
  TestMachine machine;
  machine.offsets[1] = {100, 200, 300, 10, 0, 20, 0, 0, 0};  // G55
  machine.more_offsets[48] = {7, 8, 9, 0, 0, 0, 0, 0, 0};
  machine.tools[1] = {50, 0.5, 4, 0.1};
  return machine;
}

TestMachine with_lengths() {
  TestMachine machine;
  machine.offsets[1] = {100, 200, 300, 10, 0, 20, 0, 0, 0};  // G55
  machine.reference = {500, 400, 300, 0, 0, 0, 0, 0, 0};
  machine.lengths = {{1, 50.0}, {2, 80.5}};
  return machine;
}

TestMachine with_diameters() {
  TestMachine machine;
  machine.diameter = true;
  return machine;
}

/// Retract 0.5, clearance 1, shift along +X; the letter W is free for the spindle.
TestMachine with_cycles() {
  TestMachine machine;
  machine.cycles = {.retract = 0.5, .clearance = 1, .shift_axis = 1};
  machine.axis_mask = static_cast<std::uint16_t>(machine.axis_mask & ~(1u << W));
  machine.programs["O0200"] = std::make_unique<StringSource>("X1\nM99\n");
  return machine;
}

/// D1 is 5 mm, D2 is 5 - 1, D3 is 2.
TestMachine with_cutters() {
  TestMachine machine;
  machine.tools[1] = {0, 0, 5, 0};
  machine.tools[2] = {0, 0, 5, -1};
  machine.tools[3] = {0, 0, 2, 0};
  return machine;
}

/// G1007 goes by X and Z; G1010 to Y = H and stops without H; M130 calls G1010.
TestMachine with_user_cycles() {
  TestMachine machine;
  machine.programs["USERDEF.CYC"] = std::make_unique<StringSource>(
      "%1007\nG91 G0 X[#23] Z[#25]\nG90\nM99\n"
      "%1010\nIF [AR[#7] EQ 0]\n#3000=1(H IS MISSING)\nENDIF\nG0 Y#7\nM99\n");
  machine.cycle_m_codes[3] = 130;
  return machine;
}

const std::map<std::string, std::function<TestMachine()>>& machines() {
  static const std::map<std::string, std::function<TestMachine()>> by_feature{
      {"motion", with_lengths},
      {"arcs", plain},
      {"auxiliary", with_lengths},
      {"positioning", machine_with_references},
      {"offsets", with_offsets},
      {"frames", with_offsets},
      {"diameters", with_diameters},
      {"drilling", with_cycles},
      {"patterns", with_cycles},
      {"tapping_and_boring", with_cycles},
      {"threads", plain},
      {"cycle_words", with_cycles},
      {"compensation", with_cutters},
      {"curves", plain},
      {"control_flow", plain},
      {"macro_calls", plain},
      {"user_cycles", with_user_cycles},
      {"words", plain},
      {"subprograms", with_cycles},
      {"expressions", with_offsets},
      {"variables", with_offsets},
      {"tool_tip", with_lengths},
      {"tilted_planes", with_lengths},
      {"alarms", with_lengths},
  };
  return by_feature;
}

}  // namespace

std::vector<std::string> golden_features() {
  std::vector<std::string> features;
  for (const auto& entry : std::filesystem::directory_iterator(GOLDEN_DIRECTORY))
    if (entry.path().extension() == ".nc") features.push_back(entry.path().stem().string());
  std::sort(features.begin(), features.end());
  return features;
}

std::vector<Golden> golden_programs(std::string_view feature) {
  const std::filesystem::path path = std::filesystem::path(GOLDEN_DIRECTORY) / feature;
  const auto programs = sections(path.string() + ".nc", "(=== ");
  const auto streams = sections(path.string() + ".stream", "=== ");
  std::vector<Golden> result;
  for (const auto& [name, lines] : programs) {
    const std::size_t i = result.size();
    if (name.empty() || name.back() != ')' || i == streams.size() || streams[i].first + ")" != name)
      throw std::runtime_error(path.string() + ": no stream for the program " + name);
    Golden golden{streams[i].first, "(=== " + name + "\n", streams[i].second};
    for (const auto& line : lines) golden.program += line + "\n";
    result.push_back(std::move(golden));
  }
  if (result.size() != streams.size())
    throw std::runtime_error(path.string() + ": a stream without a program");
  return result;
}

namespace {

class GoldenStream : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Features, GoldenStream, testing::ValuesIn(golden_features()),
                         [](const auto& tested) { return tested.param; });

TEST_P(GoldenStream, IsWhatTheProgramsMean) {
  ASSERT_EQ(machines().count(GetParam()), 1u) << "say on which machine golden/" << GetParam() << ".nc runs";
  for (const Golden& golden : golden_programs(GetParam())) {
    TestMachine machine = machines().at(GetParam())();
    EXPECT_THAT(stream(run(machine, golden.program)), testing::ElementsAreArray(golden.commands))
        << golden.program;
  }
}

TEST_P(GoldenStream, IsTheSameOnEveryRunAndFromPiecesOfAnySize) {
  for (const Golden& golden : golden_programs(GetParam())) {
    for (std::size_t chunk = 1; chunk < 9; ++chunk) {
      TestMachine machine = machines().at(GetParam())();
      SlowSource pieces(golden.program, chunk);
      EXPECT_THAT(stream(run(machine, pieces)), testing::ElementsAreArray(golden.commands))
          << golden.shows << ", " << chunk << " bytes at a time";
    }
  }
}

TEST(GoldenStreams, EveryFeatureOfTheListHasOne) {
  std::vector<std::string> named;
  for (const auto& [feature, machine] : machines()) named.push_back(feature);
  EXPECT_EQ(golden_features(), named);
}

}  // namespace
}  // namespace trunnion::language::test
