// SPDX-License-Identifier: Apache-2.0
// The machines that come with Trunnion, as their files are.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "machine/axes.hpp"
#include "machine/chain_section.hpp"
#include "machine/machine.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/yaml.hpp"

namespace trunnion::machine {
namespace {

using geometry::Angles;
using geometry::Vec3;

Parameters parameters_of(const std::string& name) {
  Parameters p;
  p.values = machine_parameters(load_machine(std::string(TRUNNION_MACHINES) + "/" + name));
  return p;
}

struct Shipped {
  const char* name;
  const char* letters;  // rotary axes from the workpiece to the tool
};

class ShippedMachine : public testing::TestWithParam<Shipped> {};

TEST_P(ShippedMachine, has_the_rotary_axes_of_its_name_and_axes_and_travels_for_them) {
  const auto p = parameters_of(GetParam().name);
  const auto chain = make_chain(p, 0);
  std::string letters;
  for (std::size_t i = 0; i < chain.rotary_count(); ++i) {
    const auto angle = chain.orienting_axis(i).angle;
    letters += "ABCUVW"[angle];
    EXPECT_GE(p.integer(parameter::channel_axis, 0, static_cast<std::uint32_t>(3 + angle)), 0) << letters;
    const auto travel = rotary_travels(p, 0)[angle];
    const bool swivels = p.integer(parameter::axis_type,
                                   static_cast<std::uint32_t>(p.integer(
                                       parameter::channel_axis, 0, static_cast<std::uint32_t>(3 + angle)))) ==
                         axis_type_swivel;
    EXPECT_EQ(travel.endless(), !swivels) << letters;
  }
  EXPECT_EQ(letters, GetParam().letters);
  EXPECT_TRUE(kinematics_warnings(p, 0).empty());
}

// At zero the spindle stands over the tip; with every rotary axis turned the tip comes back.
TEST_P(ShippedMachine, stands_upright_at_zero_and_brings_the_tip_back) {
  const auto chain = make_chain(parameters_of(GetParam().name), 0);
  EXPECT_LT((chain.machine_from_tip(Vec3(1, 2, 3), {}, 100) - Vec3(1, 2, 103)).norm(), 1e-12);
  EXPECT_LT((chain.tool_direction_in_workpiece({}) - Vec3::UnitZ()).norm(), 1e-15);
  const Angles turned{20, 30, 40};
  const Vec3 machine = chain.machine_from_tip(Vec3(1, 2, 3), turned, 100);
  EXPECT_LT((chain.tip_from_machine(machine, turned, 100) - Vec3(1, 2, 3)).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedMachine,
                         testing::Values(Shipped{"ac-table", "CA"}, Shipped{"bc-table", "CB"},
                                         Shipped{"cb-head", "CB"}, Shipped{"ac-head", "CA"},
                                         Shipped{"b-head-c-table", "CB"},
                                         Shipped{"nutating-b-head-c-table", "CB"}, Shipped{"four-axis", "A"},
                                         Shipped{"gantry-cb-head", "CB"}, Shipped{"two-channel", ""},
                                         Shipped{"hal-sim-xyz", ""}, Shipped{"lathe", ""}),
                         [](const auto& machine) {
                           std::string name = machine.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(ShippedMachines, are_all_in_the_list_above) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TRUNNION_MACHINES))
    count += std::filesystem::exists(entry.path() / "machine.yaml") ? 1 : 0;
  EXPECT_EQ(count, 11u);
}

// A copy of a machine's two files, changed.
class ChangedMachine {
 public:
  explicit ChangedMachine(const std::string& name)
      : directory_(testing::TempDir() + "machines_test_" + name),
        yaml_(read_text(std::string(TRUNNION_MACHINES) + "/" + name + "/machine.yaml")),
        parameters_(read_text(std::string(TRUNNION_MACHINES) + "/" + name + "/parameters.yaml")) {}
  void add_chain(const std::string& text) { yaml_ += text; }
  void drop_chain_parameters() {
    std::string kept;
    std::istringstream lines(parameters_);
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("\"0404", 0) != 0) kept += line + "\n";
    parameters_ = kept;
  }
  Parameters load() const {
    std::filesystem::create_directories(directory_);
    std::ofstream(directory_ + "/machine.yaml") << yaml_;
    std::ofstream(directory_ + "/parameters.yaml") << parameters_;
    Parameters p;
    p.values = machine_parameters(load_machine(directory_));
    return p;
  }

 private:
  std::string directory_, yaml_, parameters_;
};

const char* const nutating_chain = R"(chains:
  - elements:
      - {name: TABLE_OFFSET, offset: [10, 20, 0]}
      - {name: CORR_C_OFFSET, correction: [0, 0, 0]}
      - {name: C_AXIS, rotary: C, direction: [0, 0, -1]}
      - {name: X_AXIS, linear: X}
      - {name: Y_AXIS, linear: Y}
      - {name: Z_AXIS, linear: Z}
      - {name: B_AXIS, rotary: B, direction: [0, 0.7071067811865476, 0.7071067811865476]}
      - {name: CORR_SP1_OFFSET, correction: [0, 0, 0]}
      - {name: SP1_OFFSET, offset: [-0.1, 0.2, -190]}
)";

TEST(ShippedMachines, a_chain_in_machine_yaml_instead_of_the_parameters_gives_the_same_bits) {
  ChangedMachine machine("nutating-b-head-c-table");
  machine.drop_chain_parameters();
  machine.add_chain(nutating_chain);
  const auto by_chain = make_chain(machine.load(), 0),
             by_parameters = make_chain(parameters_of("nutating-b-head-c-table"), 0);
  for (double angle = -180; angle < 180; angle += 7.5) {
    const Angles a{0, angle, 3 * angle};
    ASSERT_EQ(by_chain.machine_from_tip(Vec3(1, 2, 3), a, 99),
              by_parameters.machine_from_tip(Vec3(1, 2, 3), a, 99));
    ASSERT_EQ(by_chain.tool_direction_in_workpiece(a), by_parameters.tool_direction_in_workpiece(a));
  }
}

TEST(ShippedMachines, a_chain_and_its_parameters_together_are_refused) {
  ChangedMachine machine("nutating-b-head-c-table");
  machine.add_chain(nutating_chain);
  try {
    machine.load();
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("parameters.yaml: error: parameter 040410 belongs to the kinematic "
                                         "chain of the channel, which machine.yaml has"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace trunnion::machine
