// SPDX-License-Identifier: Apache-2.0
#include "machine/machine.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace trunnion::machine {
namespace {

const std::string all_services =
    "services:\n  - {service: parameters}\n  - {service: program}\n  - {service: plc}\n  - {service: drive}\n"
    "  - {service: gantry}\n  - {service: compensation}\n  - {service: kinematics, replicas: 2, vendor: "
    "[cyclonedds, fastdds]}\n"
    "  - {service: channel, channel: 0}\n  - {service: gateway}\n";

std::string directory_with(const std::string& yaml) {
  const std::string directory = testing::TempDir() + "machine_test";
  std::filesystem::create_directories(directory);
  std::ofstream(directory + "/machine.yaml") << yaml;
  return directory;
}

std::string error_of(const std::string& yaml) {
  const auto directory = directory_with(yaml);
  try {
    load_machine(directory);
  } catch (const std::runtime_error& e) {
    return std::string(e.what()).substr(directory.size() + 1);
  }
  return "";
}

TEST(Machine, TwinsAreServicesOfTheirOwnWithTheirOwnVendor) {
  const auto config = load_machine(directory_with("name: m\n" + all_services));
  ASSERT_EQ(config.services.size(), 10u);
  EXPECT_EQ(config.services[7].service, "kinematics");
  EXPECT_EQ(config.services[7].replica, 1u);
  EXPECT_EQ(config.services[7].vendor, "fastdds");
  EXPECT_EQ(config.channels, 1u);
}

TEST(Machine, MixedAlternatesTheVendors) {
  const auto config = load_machine(directory_with("name: m\n" + all_services), "mixed");
  for (std::size_t i = 1; i < config.services.size(); ++i)
    EXPECT_NE(config.services[i].vendor, config.services[i - 1].vendor);
}

TEST(Machine, HardwareIsASimulationUnlessTheFileSaysHal) {
  auto config = load_machine(directory_with("name: m\n" + all_services));
  EXPECT_EQ(config.hardware, Hardware::simulation);
  const ServiceEntry drive{"drive", "cyclonedds", 4, 0, 0, ""}, plc{"plc", "cyclonedds", 3, 0, 0, ""};
  EXPECT_EQ(program_of(config, drive), "trunnion-drive");
  const auto directory =
      directory_with("name: m\nhardware: hal\nhal: {file: x.hal, queue: 40}\n" + all_services);
  std::ofstream(directory + "/x.hal") << "# empty\n";
  config = load_machine(directory);
  EXPECT_EQ(config.hardware, Hardware::hal);
  EXPECT_EQ(config.hal.file, directory + "/x.hal");
  EXPECT_EQ(config.hal.queue, 40u);
  EXPECT_EQ(program_of(config, drive), "trunnion-drive-hal");
  EXPECT_EQ(program_of(config, plc), "trunnion-plc");
}

TEST(Machine, ErrorsOfTheHardwareNameLineAndColumn) {
  const auto directory = directory_with("");
  std::ofstream(directory + "/x.hal") << "# empty\n";
  EXPECT_EQ(error_of("name: m\nhardware: laser\n" + all_services),
            "machine.yaml:2:11: error: hardware must be 'simulation' or 'hal'");
  EXPECT_EQ(error_of("name: m\nhal: {file: x.hal}\n" + all_services),
            "machine.yaml:2:6: error: 'hal' needs 'hardware: hal'");
  EXPECT_EQ(
      error_of("name: m\nhardware: hal\n" + all_services),
      "machine.yaml:2:11: error: 'hardware: hal' needs 'hal: {file: NAME.hal}', the file that describes the "
      "machine");
  EXPECT_EQ(error_of("name: m\nhardware: hal\nhal: {queue: 3}\n" + all_services),
            "machine.yaml:3:6: error: 'file' is missing");
  EXPECT_EQ(error_of("name: m\nhardware: hal\nhal: {file: none.hal}\n" + all_services),
            "machine.yaml:3:13: error: there is no file '" + directory + "/none.hal'");
  EXPECT_EQ(error_of("name: m\nhardware: hal\nhal: {file: x.hal, queue: 1}\n" + all_services),
            "machine.yaml:3:27: error: queue must be 2 .. 256 setpoint rows");
  EXPECT_EQ(error_of("name: m\nhardware: hal\nhal: {file: x.hal, depth: 1}\n" + all_services),
            "machine.yaml:3:20: error: unknown key 'depth'; the keys are file, queue");
  EXPECT_EQ(
      error_of("name: m\ntime: virtual\nhardware: hal\nhal: {file: x.hal}\n" + all_services),
      "machine.yaml:2:7: error: time must be 'real' with 'hardware: hal': HAL's servo thread is the clock");
}

TEST(Machine, ErrorsNameLineAndColumn) {
  EXPECT_EQ(error_of("name: m\ndomain: 101\n" + all_services),
            "machine.yaml:2:9: error: domain must be 0 .. 100");
  EXPECT_TRUE(error_of("name: m\ncolour: red\n" + all_services)
                  .starts_with("machine.yaml:2:1: error: unknown key 'colour'; the keys are name, title,"));
  EXPECT_EQ(error_of("name: m\nport: 1\nport: 2\n" + all_services),
            "machine.yaml:3:1: error: 'port' is there twice");
  EXPECT_EQ(error_of("name: m\nservices:\n  - {service: coffee}\n"),
            "machine.yaml:3:5: error: unknown service 'coffee'");
  EXPECT_EQ(error_of("name: m\nport: many\n" + all_services),
            "machine.yaml:2:7: error: 'port' has a value of the wrong kind");
  EXPECT_EQ(error_of("name: m\nservices:\n  - {service: drive, replicas: 2}\n"),
            "machine.yaml:3:32: error: replicas must be 1, or 2 for kinematics, compensation and gantry");
  EXPECT_EQ(error_of("name: m\n" + all_services + "  - {service: drive, vendor: opendds}\n"),
            "machine.yaml:12:30: error: unknown vendor 'opendds': fastdds or cyclonedds");
  EXPECT_EQ(error_of("name: m\n" + all_services + "  - {service: drive}\n"),
            "machine.yaml:12:5: error: service 'drive' is there twice");
  EXPECT_EQ(error_of("name: m\n" + all_services + "  - {service: channel, channel: 0}\n"),
            "machine.yaml:12:5: error: service 'channel' is there twice for channel 0");
  EXPECT_EQ(error_of("name: m\n? [a]\n: 1\n"), "machine.yaml:2:3: error: expected one value");
  EXPECT_EQ(error_of("name: m\nservices:\n  - {service: drive, vendor: [[fastdds]]}\n"),
            "machine.yaml:3:31: error: expected one value");
  EXPECT_EQ(error_of("name: m\nservices:\n  - {service: channel, channel: 4294967295}\n"),
            "machine.yaml:3:33: error: channel must be 0 .. 31");
  EXPECT_EQ(error_of("name: m\ntitle: caf\xe9\n"), "machine.yaml:2:11: error: the text is not UTF-8");
}

TEST(Machine, ItsDialectsAreParametersOfEveryChannel) {
  const auto directory =
      directory_with("name: m\ndialect: haas\nprogram_dialects: {.ngc: linuxcnc, .NUM: num}\n" +
                     all_services + "  - {service: channel, channel: 1}\n");
  std::ofstream(directory + "/parameters.yaml") << "\"041959\": 1\n";
  const auto values = machine_parameters(load_machine(directory));
  std::filesystem::remove(directory + "/parameters.yaml");
  EXPECT_EQ(values.at(40959).value, 3);
  EXPECT_EQ(values.at(41959).value, 1) << "parameters.yaml has a channel of its own dialect";
  EXPECT_EQ(values.at(40800).text, ".ngc linuxcnc; .NUM num");
  EXPECT_EQ(values.at(41800).text, ".ngc linuxcnc; .NUM num");
}

TEST(Machine, ADialectThatIsNoneIsAnErrorWithItsPlace) {
  EXPECT_EQ(error_of("name: m\ndialect: fanuc\n" + all_services),
            "machine.yaml:2:10: error: 'fanuc' is none of haas, iso, linuxcnc, num");
  EXPECT_EQ(error_of("name: m\nprogram_dialects: {.ngc: emc}\n" + all_services),
            "machine.yaml:2:26: error: 'emc' is none of haas, iso, linuxcnc, num");
  EXPECT_EQ(error_of("name: m\nprogram_dialects: {'.n c': iso}\n" + all_services).substr(0, 17),
            "machine.yaml:2:28");
}

}  // namespace
}  // namespace trunnion::machine
