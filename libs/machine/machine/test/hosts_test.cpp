// SPDX-License-Identifier: Apache-2.0
#include "machine/hosts.hpp"

#include <gtest/gtest.h>

#include "machine/machine.hpp"
#include "testing_support/refusal.hpp"

namespace trunnion::machine::hosts_test {
namespace {

const std::string three_hosts =
    "name: m\n"
    "hosts:\n"
    "  - {name: control, address: 10.77.0.1}\n"
    "  - {name: motion, address: 10.77.0.2}\n"
    "  - {name: drives, address: 10.77.0.3}\n";

std::string services(
    const std::string& drive = "{service: drive, host: drives}",
    const std::string& kinematics = "{service: kinematics, replicas: 2, host: [motion, control]}") {
  return "services:\n  - {service: parameters}\n  - {service: program}\n  - {service: plc}\n  - " + drive +
         "\n  - {service: gantry, host: motion}\n  - {service: compensation, host: motion}\n  - " +
         kinematics + "\n  - {service: channel}\nopen: true\n";
}

std::string error_of(const std::string& yaml) {
  return testing_support::refusal_of([&] { parse_machine(yaml, "m"); });
}

TEST(Hosts, AServiceRunsOnItsHostACopyOnItsOwnAndTheRestOnTheFirst) {
  const auto config = parse_machine(three_hosts + services(), "m");
  ASSERT_EQ(config.hosts.size(), 3u);
  EXPECT_EQ(config.hosts[1].name, "motion");
  EXPECT_EQ(config.hosts[1].address, "10.77.0.2");
  std::vector<std::string> where;
  for (const auto& service : config.services) where.push_back(service.service + "@" + service.host);
  EXPECT_EQ(where, (std::vector<std::string>{"parameters@control", "program@control", "plc@control",
                                             "drive@drives", "gantry@motion", "compensation@motion",
                                             "kinematics@motion", "kinematics@control", "channel@control"}));
  EXPECT_FALSE(config.multicast);
  EXPECT_TRUE(parse_machine(three_hosts + "network: multicast\n" + services(), "m").multicast);
}

TEST(Hosts, NeedSecurityOrTheStatementThatTheNetworkIsOpen) {
  auto text = three_hosts + services();
  EXPECT_TRUE(parse_machine(text, "m").open);
  text.resize(text.find("open: true"));
  EXPECT_EQ(
      error_of(text),
      "m/machine.yaml:3:3: error: every computer in the network of these hosts could move the machine: add "
      "'security: on' (docs/security.md), or 'open: true' when the network is yours alone");
  EXPECT_EQ(error_of(text + "security: on\n"), "taken");
}

TEST(Hosts, DirectoriesForSwapsAreAbsoluteOrBesideTheMachine) {
  const auto config =
      parse_machine(three_hosts + services() + "swap_directories: [/opt/stages, stages]\n", "m");
  EXPECT_EQ(config.swap_directories, (std::vector<std::string>{"/opt/stages", "m/stages"}));
  EXPECT_EQ(error_of(three_hosts + services() + "swap_directories: here\n"),
            "m/machine.yaml:16:19: error: 'swap_directories' must be a list of directories");
}

TEST(Hosts, WithoutTheSectionEverythingIsOnOneComputer) {
  const auto config = parse_machine(
      "name: m\nservices:\n  - {service: parameters}\n  - {service: program}\n  - {service: plc}\n"
      "  - {service: drive}\n  - {service: gantry}\n  - {service: compensation}\n  - {service: kinematics}\n"
      "  - {service: channel}\n",
      "m");
  for (const auto& service : config.services) EXPECT_EQ(service.host, "") << service.service;
  EXPECT_TRUE(config.hosts.empty());
}

TEST(Hosts, SecurityIsOffOrADirectoryBesideTheMachineOrElsewhere) {
  const auto directory = [](const std::string& line) {
    return parse_machine(three_hosts + line + services(), "/m").security;
  };
  EXPECT_EQ(directory(""), "");
  EXPECT_EQ(directory("security: off\n"), "");
  EXPECT_EQ(directory("security: on\n"), "/m/security");
  EXPECT_EQ(directory("security: keys\n"), "/m/keys");
  EXPECT_EQ(directory("security: /etc/keys\n"), "/etc/keys");
}

TEST(Hosts, EachMistakeIsOneLineWithItsPlace) {
  // Counted from the texts above: the list of services begins in line 6, the drive is its fourth entry.
  EXPECT_EQ(error_of(three_hosts + services("{service: drive, host: driver}")),
            "m/machine.yaml:10:28: error: unknown host 'driver': there is control, motion, drives");
  EXPECT_EQ(error_of("name: m\n" + services()), "m/machine.yaml:6:28: error: there is no section 'hosts'");
  EXPECT_EQ(error_of(three_hosts +
                     services("{service: drive}", "{service: kinematics, replicas: 2, host: [motion]}")),
            "m/machine.yaml:13:46: error: replica 1 has no host");
  EXPECT_EQ(error_of(three_hosts + "  - {name: motion, address: 10.77.0.4}\n" + services()),
            "m/machine.yaml:6:12: error: host 'motion' is there twice");
  EXPECT_EQ(error_of(three_hosts + "  - {name: fourth, address: 10.77.0.3}\n" + services()),
            "m/machine.yaml:6:29: error: address 10.77.0.3 is that of host 'drives'");
  EXPECT_EQ(error_of(three_hosts + "  - {name: fourth, address: fourth.local}\n" + services()),
            "m/machine.yaml:6:29: error: 'fourth.local' is not an IPv4 address");
  EXPECT_EQ(error_of(three_hosts + "  - {name: ../x, address: 10.77.0.4}\n" + services()),
            "m/machine.yaml:6:12: error: a host's name has 1 .. 32 letters, digits and dashes");
  EXPECT_EQ(error_of(three_hosts + "  - {name: fourth}\n" + services()),
            "m/machine.yaml:6:5: error: a host is {name: ..., address: ...}");
  EXPECT_EQ(error_of("name: m\nhosts: here\n" + services()),
            "m/machine.yaml:2:8: error: 'hosts' must be a list of {name: ..., address: ...}");
  EXPECT_EQ(error_of(three_hosts + "network: broadcast\n" + services()),
            "m/machine.yaml:6:10: error: network must be 'unicast' or 'multicast'");
}

}  // namespace
}  // namespace trunnion::machine::hosts_test
