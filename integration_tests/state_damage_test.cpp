// SPDX-License-Identifier: Apache-2.0
// A used machine whose kept files are damaged, each in eight ways: what the next start of the cluster does.
#include <set>

#include "cluster_harness.hpp"
#include "machine/alarm_constants.hpp"
#include "testing_support/damage.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;
using testing_support::Damage;

// What the alarm of a damaged file is about.
enum class Promise {
  previous,   ///< alarm 153: the previous generation is used
  reference,  ///< alarm 115 for every axis: no position is known
  refused     ///< alarm 155: the program cannot be read
};
struct KeptFile {
  const char* name;
  Promise promise;
};
constexpr KeptFile kept_files[] = {
    {"parameters.yaml", Promise::previous},   {"active.yaml", Promise::previous},
    {"tools.yaml", Promise::previous},        {"work_offsets.yaml", Promise::previous},
    {"programs.yaml", Promise::previous},     {"programs/part.nc", Promise::refused},
    {"encoders.bin", Promise::reference},     {"plc.image", Promise::previous},
    {"channel-0.program", Promise::previous}, {"channel-0.variables", Promise::previous}};

constexpr double rapid_before = 20000, rapid_newest = 21000;  // parameter 100034, mm/min
constexpr double length_before = 41, length_newest = 42;      // tool 7, mm

/// State directories of a machine that was used twice: `old` after the first time, `used` after the second.
class UsedMachine {
 public:
  UsedMachine() : root_(fs::temp_directory_path() / ("trunnion-damage-" + std::to_string(getpid()))) {
    fs::remove_all(root_);
    use(rapid_before, length_before, 10);
    fs::copy(state(), root_ / "old", fs::copy_options::recursive);
    use(rapid_newest, length_newest, 20);
    fs::copy(state(), root_ / "used", fs::copy_options::recursive);
  }
  ~UsedMachine() { fs::remove_all(root_); }
  UsedMachine(const UsedMachine&) = delete;
  UsedMachine& operator=(const UsedMachine&) = delete;

  fs::path state() const { return root_ / "state"; }
  /// The state after the second use again.
  void renew() const {
    fs::remove_all(state());
    fs::copy(root_ / "used", state(), fs::copy_options::recursive);
  }
  void damage(const std::string& name, Damage how, unsigned seed) const {
    const auto other = name == "tools.yaml" ? "work_offsets.yaml" : "tools.yaml";
    testing_support::damage(state() / name, how, testing_support::read_bytes(root_ / "old" / name),
                            testing_support::read_bytes(root_ / "used" / other), seed);
  }

 private:
  void use(double rapid, double length, double x) const {
    Cluster cluster("ac-table", Time::virtual_, "cyclonedds", false, std::nullopt, state());
    auto& client = cluster.client();
    using idl::parameters::Operation;
    idl::parameters::ParameterRequest request;
    request.role = 2;  // a builder's
    request.who = "test";
    request.operation = Operation::SET;
    request.values = {{100034, rapid, ""}};
    client.parameter(request);
    request.operation = Operation::SET_TOOL;
    request.tools = {{7, length, 0, 3, 0, "mill"}};
    client.parameter(request);
    request.operation = Operation::SET_WORK_OFFSET;
    request.offsets = {{0, 0, std::vector<double>(9, x)}};
    client.parameter(request);
    client.upload("part.nc", "G0 X" + std::to_string(x) + "\n#500=" + std::to_string(x) + "\nM30\n");
    cluster.start("part.nc");
    EXPECT_TRUE(cluster.finish()) << cluster.told();
  }
  fs::path root_;
};

class StateDamage : public testing::Test {
 protected:
  // Here and not for the suite: what fails there makes GoogleTest skip the test, and CTest would count that
  // as passed.
  void SetUp() override {
    if (!machine_) machine_ = std::make_unique<UsedMachine>();
  }
  static void TearDownTestSuite() { machine_.reset(); }
  static Cluster start() {
    return Cluster("ac-table", Time::virtual_, "cyclonedds", false, std::nullopt, machine_->state());
  }
  static std::unique_ptr<UsedMachine> machine_;
};
std::unique_ptr<UsedMachine> StateDamage::machine_;

TEST_F(StateDamage, AnUndamagedMachineStartsWithoutAnAlarmAndWithItsNewestValues) {
  machine_->renew();
  auto cluster = start();
  cluster.until([] { return false; }, 0.5);
  EXPECT_EQ(cluster.active_alarms(), "");
  EXPECT_EQ(cluster.client().newest(topics::tool_table).tools.back().length, length_newest);
  EXPECT_TRUE(cluster.channels[0].homed);
}

// Each start damages every file, in another way each, so that eight starts cover all pairs of file and way
// but one: an old program beside an old index is no damage, so the ninth start damages the index alone.
TEST_F(StateDamage, EveryDamageOfEveryFileIsFoundNamedAndRepaired) {
  constexpr std::size_t ways = std::size(testing_support::all_damages);
  std::optional<Damage> of_the_index;
  for (std::size_t start_number = 0; start_number <= ways; ++start_number) {
    machine_->renew();
    std::string all;
    std::set<std::string> damaged;
    for (std::size_t i = 0; i < std::size(kept_files); ++i) {
      auto how = testing_support::all_damages[(i + start_number) % ways];
      const bool index = kept_files[i].name == std::string("programs.yaml");
      if (start_number == ways && !index) continue;
      if (start_number == ways) how = *of_the_index;
      if (index && testing_support::all_damages[(i + 1 + start_number) % ways] == Damage::old_generation &&
          start_number < ways) {
        of_the_index = how;
        continue;
      }
      damaged.insert(kept_files[i].name);
      machine_->damage(kept_files[i].name, how, static_cast<unsigned>(100 * start_number + i));
      all += std::string(kept_files[i].name) + " " + name_of(how) + "; ";
    }
    SCOPED_TRACE(all);
    {
      auto cluster = start();
      const auto found = [&] {
        for (const auto& file : kept_files) {
          if (!damaged.contains(file.name)) continue;
          const auto name = fs::path(file.name).filename().string();
          if (file.promise == Promise::previous && !cluster.has_alarm(alarm::state_recovered.number, name))
            return false;
          if (file.promise == Promise::refused && !cluster.has_alarm(alarm::program_damaged.number, name))
            return false;
          for (const auto* axis : {"axis X ", "axis Y ", "axis Z ", "axis A ", "axis C "})
            if (file.promise == Promise::reference && !cluster.has_alarm(alarm::not_homed.number, axis))
              return false;
        }
        return true;
      };
      EXPECT_TRUE(cluster.until(found)) << cluster.active_alarms();
      EXPECT_FALSE(cluster.has_alarm(alarm::state_lost.number)) << cluster.active_alarms();
      if (start_number == ways) break;
      EXPECT_TRUE(cluster.until([&] { return !cluster.channels[0].homed; })) << "the channel knows of it";
      EXPECT_EQ(cluster.client().newest(topics::tool_table).tools.back().length, length_before);
      for (const auto& value : cluster.client().newest(topics::parameter_set).values)
        if (value.number == 100034) {
          EXPECT_EQ(value.value, rapid_before) << "never the default";
        }
      cluster.reset_alarms();
      EXPECT_TRUE(cluster.until([&] { return !cluster.has_alarm(alarm::state_recovered.number); }));
      EXPECT_TRUE(cluster.has_alarm(alarm::not_homed.number)) << "until the axes have their reference";
    }
    // What could be repaired was repaired.
    auto cluster = start();
    cluster.until([] { return false; }, 0.3);
    EXPECT_FALSE(cluster.has_alarm(alarm::state_recovered.number)) << cluster.active_alarms();
    EXPECT_TRUE(cluster.has_alarm(alarm::not_homed.number)) << "also in the next life";
    if (HasFailure()) return;
  }
}

TEST_F(StateDamage, AnAxisWithoutReferenceDoesNotMoveUntilItsReferenceReturn) {
  machine_->renew();
  machine_->damage("encoders.bin", Damage::one_bit, 3);
  auto cluster = start();
  EXPECT_TRUE(cluster.until([&] { return cluster.has_alarm(alarm::not_homed.number, "encoders.bin"); }))
      << cluster.active_alarms();
  auto& client = cluster.client();
  client.set_mode(0, Mode::MDI);
  try {
    client.mdi(0, "G0 X5");
  } catch (const std::exception&) {
  }
  cluster.until([] { return false; }, 0.5);
  EXPECT_EQ(cluster.feedback.commanded, std::vector<double>()) << "no cycle was executed";
  client.channel(0, CommandKind::RESET);
  client.set_mode(0, Mode::REF);
  // Refused until the drive's feedback has told the channel that the search before has ended.
  const auto accepted = [&](const idl::channel::ChannelRequest& request) {
    return cluster.until([&] {
      try {
        client.channel(request);
        return true;
      } catch (const std::exception&) {
        return false;
      }
    });
  };
  const auto names = {"axis X ", "axis Y ", "axis Z ", "axis A ", "axis C "};
  std::uint8_t axis = 0;
  for (const auto* name : names) {
    const auto number = cluster.channels[0].axes.at(axis);
    EXPECT_TRUE(accepted({.channel = 0, .command = CommandKind::REFERENCE_AXIS, .axis = axis})) << name;
    ++axis;
    EXPECT_TRUE(cluster.until([&] {
      for (const auto& [key, alarm] : cluster.alarms)
        if (key[1] == alarm::not_homed.number && key[2] == number && alarm.active) return false;
      return true;
    })) << name
        << cluster.told();
  }
  EXPECT_TRUE(cluster.until([&] { return cluster.channels[0].homed; })) << cluster.told();
  EXPECT_FALSE(cluster.has_alarm(alarm::not_homed.number)) << cluster.active_alarms();
  client.set_mode(0, Mode::MDI);
  EXPECT_TRUE(accepted({.channel = 0, .command = CommandKind::MDI_LINE, .block = "G53 G0 X5"}));
  EXPECT_TRUE(cluster.until([&] { return std::abs(cluster.channels[0].machine[0] - 5) < 0.01; }))
      << cluster.told();
}

TEST_F(StateDamage, ABackupOfTheRunningClusterRestoresItAndIsRefusedWhileItRuns) {
  machine_->renew();
  const auto state = machine_->state().string(), file = state + ".tar", log = state + ".log";
  const auto trunnion = [&](const std::string& arguments) {
    return std::system(
        (cluster::binary_directory() + "/trunnion " + arguments + " --state " + state + " > " + log + " 2>&1")
            .c_str());
  };
  {
    auto cluster = start();
    EXPECT_EQ(trunnion("backup " + file + " --machine ac-table"), 0) << testing_support::read_bytes(log);
    EXPECT_EQ(trunnion("state check"), 0) << testing_support::read_bytes(log);
    EXPECT_NE(trunnion("restore " + file), 0);
    EXPECT_NE(testing_support::read_bytes(log).find("is in use by launcher "), std::string::npos)
        << testing_support::read_bytes(log);
    EXPECT_NE(trunnion("state accept tools.yaml"), 0) << "nor is a file accepted";
  }
  for (const auto& file_of : kept_files)
    testing_support::write_bytes(machine_->state() / file_of.name, "damaged");
  EXPECT_NE(trunnion("state check"), 0);
  EXPECT_EQ(trunnion("restore " + file), 0) << testing_support::read_bytes(log);
  EXPECT_EQ(trunnion("state check"), 0) << testing_support::read_bytes(log);
  auto cluster = start();
  cluster.until([] { return false; }, 0.3);
  EXPECT_EQ(cluster.active_alarms(), "");
  EXPECT_TRUE(cluster.channels[0].homed);
  EXPECT_NEAR(cluster.channels[0].machine[0], 40, 0.01) << "G0 X20 with a work offset of 20 mm";
  EXPECT_EQ(cluster.client().newest(topics::tool_table).tools.back().length, length_newest);
}

TEST_F(StateDamage, WithBothGenerationsLostTheDefaultsAreAnnouncedAndMotionIsHeld) {
  machine_->renew();
  for (const auto* name : {"tools.yaml", "tools.yaml.previous"})
    testing_support::write_bytes(machine_->state() / name, "damaged\n");
  auto cluster = start();
  EXPECT_TRUE(cluster.until([&] { return cluster.has_alarm(alarm::state_lost.number, "tools.yaml"); }));
  EXPECT_THROW(cluster.start("part.nc"), std::exception) << "held until the alarm is reset";
}

}  // namespace
}  // namespace trunnion::integration
