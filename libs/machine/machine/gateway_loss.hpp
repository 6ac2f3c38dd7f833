// SPDX-License-Identifier: Apache-2.0
// What machine.yaml says about the loss of the gateway, and with it of the page, while a program runs.
#pragma once

#include <optional>
#include <string>

namespace YAML {
class Node;
}

namespace trunnion::machine {

/// PLC inputs of a panel with which an operator holds and stops a machine that runs on without its page:
/// "X102.0".
struct StoppingInputs {
  std::string feed_hold, emergency_stop;
};

/// `gateway_loss: {continue_with: {feed_hold: X102.0, emergency_stop: X24.0}}`; nothing: the channels hold.
/// `document` is that of machine.yaml in `file`. Throws std::runtime_error with file:line:column.
std::optional<StoppingInputs> read_gateway_loss(const YAML::Node& document, const std::string& file);
/// Of machine.yaml in `directory`. Throws std::runtime_error.
std::optional<StoppingInputs> load_gateway_loss(const std::string& directory);

}  // namespace trunnion::machine
