// SPDX-License-Identifier: Apache-2.0
#include "machine/gateway_loss.hpp"

#include <gtest/gtest.h>

#include "machine/yaml.hpp"

namespace trunnion::machine {
namespace {

std::optional<StoppingInputs> read_loss(const std::string& text) {
  return read_gateway_loss(parse_yaml(text, "machine.yaml"), "machine.yaml");
}

TEST(GatewayLoss, HoldsUnlessMachineYamlNamesInputsThatHoldAndStop) {
  EXPECT_FALSE(read_loss("name: mill"));
  EXPECT_FALSE(read_loss("gateway_loss: hold"));
  const auto inputs = read_loss("gateway_loss: {continue_with: {feed_hold: X102.0, emergency_stop: X511.7}}");
  ASSERT_TRUE(inputs);
  EXPECT_EQ(inputs->feed_hold, "X102.0");
  EXPECT_EQ(inputs->emergency_stop, "X511.7");
}

TEST(GatewayLoss, ContinuingWithoutBothInputsIsAnErrorWithItsPlace) {
  for (const char* text :
       {"gateway_loss: continue", "gateway_loss:", "gateway_loss: {}", "gateway_loss: {continue_with: X1.0}",
        "gateway_loss: {continue_with: {feed_hold: X1.0}}",
        "gateway_loss: {continue_with: {feed_hold: X1.0, emergency_stop: X512.0}}",
        "gateway_loss: {continue_with: {feed_hold: X1.8, emergency_stop: X2.0}}",
        "gateway_loss: {continue_with: {feed_hold: Y1.0, emergency_stop: X2.0}}",
        "gateway_loss: {continue_with: {feed_hold: X1.0, emergency_stop: X1.0}}",
        "gateway_loss: {continue_with: {feed_hold: X1.0, emergency_stop: X2.0}, hold: on}"})
    try {
      read_loss(text);
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(std::string(e.what()).rfind("machine.yaml:1:", 0), 0u) << e.what();
    }
}

}  // namespace
}  // namespace trunnion::machine
