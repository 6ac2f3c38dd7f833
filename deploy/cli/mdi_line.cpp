// SPDX-License-Identifier: Apache-2.0
#include "mdi_line.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "new_alarms.hpp"

namespace trunnion::cli {

idl::channel::ChannelState run_line(cluster::Client& client, std::uint16_t channel, const std::string& text,
                                    double timeout) {
  using idl::channel::RunState;
  client.set_mode(channel, idl::channel::Mode::MDI);
  NewAlarms alarms(client, channel);
  client.mdi(channel, text);
  auto reader = client.reader_from_now(topics::channel_state);
  const double until = service::monotonic_seconds() + timeout;
  std::string detail;
  std::optional<std::vector<double>> before;  // at the end of the line
  constexpr double settled = 1e-4;            // mm or deg between two states
  while (service::monotonic_seconds() < until) {
    std::optional<idl::channel::ChannelState> end;
    idl::channel::ChannelState state;
    while (!end && reader.take(state)) {
      if (state.channel != channel) continue;
      detail = state.detail;
      if (state.state != RunState::INTERRUPTED && state.state != RunState::IDLE) {
        before.reset();
        continue;
      }
      const bool stands =
          before && std::equal(before->begin(), before->end(), state.machine.begin(), state.machine.end(),
                               [](double p, double q) { return std::abs(p - q) < settled; });
      before = state.machine;
      if (stands) end = state;
    }
    // After the states: the alarm that has ended the line comes before the state that shows its end.
    const auto& error = alarms.error();
    if (end && !error.empty()) throw std::runtime_error(error);
    if (end && end->state == RunState::INTERRUPTED)
      throw std::runtime_error("the line was interrupted: see 'trunnion alarms', then reset");
    if (end) return *std::move(end);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw std::runtime_error("the line did not finish within " + std::to_string(static_cast<int>(timeout)) +
                           " s" + (detail.empty() ? "" : ": " + detail));
}

}  // namespace trunnion::cli
