// SPDX-License-Identifier: Apache-2.0
// How soon the gateway answers a hold while it has other things to do.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "http_client/client.hpp"

namespace trunnion::gateway {

/// Milliseconds from the press of a hold on the page, which sends it by its stream, to the answer, in rising
/// order. One after the other while `more()`.
inline std::vector<double> hold_times(const http_client::Server& server, const std::function<bool()>& more) {
  std::vector<double> times;
  http_client::WebSocketClient page(server, "/api/stream");
  while (more() && page.open()) {
    const auto pressed = std::chrono::steady_clock::now();
    page.send(R"({"order": 1, "path": "/api/channels/0/feed-hold"})");
    while (true) {
      const auto message = page.next();
      if (!message) return {};
      if (message->find("\"answer\"") != std::string::npos) break;
    }
    const std::chrono::duration<double, std::milli> lasted = std::chrono::steady_clock::now() - pressed;
    times.push_back(lasted.count());
    std::this_thread::sleep_for(std::chrono::milliseconds(15));
  }
  std::ranges::sort(times);
  return times;
}

/// 99 % are not larger; of times in rising order, which are some.
inline double p99(const std::vector<double>& times) { return times.at(times.size() * 99 / 100); }

}  // namespace trunnion::gateway
