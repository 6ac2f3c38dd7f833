// SPDX-License-Identifier: Apache-2.0
#include "machine/gateway_settings.hpp"

#include <gtest/gtest.h>

#include "machine/yaml.hpp"

namespace trunnion::machine {
namespace {

GatewaySettings read(const std::string& text) {
  return read_gateway_settings(parse_yaml(text, "machine.yaml"), "machine.yaml");
}

TEST(GatewaySettings, TheMtconnectAgentHasPort5000UnlessAnotherIsNamed) {
  EXPECT_EQ(read("name: mill").mtconnect_port, 5000);
  EXPECT_EQ(read("mtconnect_port: 5001").mtconnect_port, 5001);
  EXPECT_EQ(read("mtconnect_port: 0").mtconnect_port, 0) << "no agent";
}

TEST(GatewaySettings, UsersLogInWhenAuthIsOn) {
  EXPECT_FALSE(read("name: mill").auth);
  EXPECT_TRUE(read("auth: on").auth);
  EXPECT_FALSE(read("auth: off").auth);
  EXPECT_THROW(read("auth: perhaps"), std::runtime_error);
}

TEST(GatewaySettings, ASessionEndsAfterHalfAnHourUnlessMinutesAreGiven) {
  EXPECT_EQ(read("auth: on").session_idle, 1800);
  EXPECT_EQ(read("session_idle_minutes: 5").session_idle, 300);
  EXPECT_EQ(read("session_idle_minutes: 0.05").session_idle, 3);
  for (const char* text : {"session_idle_minutes: 0", "session_idle_minutes: 721",
                           "session_idle_minutes: .nan", "session_idle_minutes: long"})
    EXPECT_THROW(read(text), std::runtime_error) << text;
}

TEST(GatewaySettings, OneStationOperatesWhenUsersLogInUnlessTheMachineSaysOtherwise) {
  EXPECT_FALSE(read("name: mill").one_operates);
  EXPECT_TRUE(read("auth: on").one_operates);
  EXPECT_FALSE(read("auth: on\noperating_right: any").one_operates);
  EXPECT_TRUE(read("operating_right: one").one_operates);
  EXPECT_THROW(read("operating_right: two"), std::runtime_error);
  EXPECT_THROW(read("operating_right: [one]"), std::runtime_error);
}

TEST(GatewaySettings, ARecordingNeedsFreeSpace) {
  EXPECT_EQ(read("name: mill").recording_free_space, 200);
  EXPECT_EQ(read("recording_free_space: 0.5").recording_free_space, 0.5);
  EXPECT_EQ(read("recording_free_space: 0").recording_free_space, 0);
  for (const char* text : {"recording_free_space: -1", "recording_free_space: 1e10",
                           "recording_free_space: .nan", "recording_free_space: much"})
    EXPECT_THROW(read(text), std::runtime_error) << text;
}

TEST(GatewaySettings, APortOutOfRangeIsNamedWithItsPlace) {
  for (const char* text : {"name: mill\nmtconnect_port: 65536", "name: mill\nmtconnect_port: -1",
                           "name: mill\nmtconnect_port: on", "name: mill\nmtconnect_port: [5000]"}) {
    try {
      read(text);
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, 23), "machine.yaml:2:17: erro") << error.what();
    }
  }
}

TEST(GatewaySettings, TlsIsOffOnWithTheStateDirectoryOrHasTwoFiles) {
  EXPECT_FALSE(read("name: mill").tls.on);
  EXPECT_FALSE(read("tls: off").tls.on);
  EXPECT_TRUE(read("tls: on").tls.on);
  EXPECT_TRUE(read("tls: on").tls.certificate.empty());
  const auto named = read("tls: {certificate: mill.pem, key: mill.key}").tls;
  EXPECT_TRUE(named.on);
  EXPECT_EQ(named.certificate, "mill.pem");
  EXPECT_EQ(named.key, "mill.key");
  for (const auto* wrong : {"tls: perhaps", "tls: {certificate: mill.pem}", "tls: {key: mill.key}",
                            "tls: {certificate: mill.pem, key: mill.key, more: 1}", "tls: [on]"})
    EXPECT_THROW(read(wrong), std::runtime_error) << wrong;
}

}  // namespace
}  // namespace trunnion::machine
