// SPDX-License-Identifier: Apache-2.0
// The fake cluster as a program, for the browser test and for work on the page: gateway_fake_cluster
// [domain].
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "test/fake_cluster.hpp"

namespace {
volatile std::sig_atomic_t stop = 0;
}

int main(int argc, char** argv) {
  using namespace trunnion;
  std::signal(SIGTERM, [](int) { stop = 1; });
  std::signal(SIGINT, [](int) { stop = 1; });
  gateway::FakeCluster cluster({static_cast<std::uint32_t>(argc > 1 ? std::atoi(argv[1]) : 51)});
  std::size_t told = 0;
  while (stop == 0) {
    cluster.step();
    for (; told < cluster.channel_requests.size(); ++told) {
      const auto& request = cluster.channel_requests[told];
      std::printf("%s %s\n", bus::to_string(request.command), (request.program + request.block).c_str());
      std::fflush(stdout);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}
