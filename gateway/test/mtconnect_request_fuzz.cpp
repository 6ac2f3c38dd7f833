// SPDX-License-Identifier: Apache-2.0
// Any target of a request: an answer or a RequestError, nothing else.
#include <string_view>

#include "mtconnect/agent.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  using namespace trunnion::gateway::mtconnect;
  static const Agent agent = [] {
    AgentSettings settings;
    settings.machine = "dev", settings.computer = "host", settings.buffer_size = 64;
    Agent made(settings);
    gateway::ClusterState cluster;
    auto parameters = std::make_shared<idl::parameters::ParameterSet>();
    parameters->revision = 1;
    parameters->values = {{100000, 0, "X"}, {101000, 0, "Y"}};
    cluster.set_parameters(parameters);
    cluster.channels[0].letters = "XY";
    made.observe(cluster, "2026-01-01T00:00:00.000Z");
    return made;
  }();
  try {
    const auto request = agent.parse("GET", std::string_view(reinterpret_cast<const char*>(data), size));
    agent.answer(request, "2026-01-01T00:00:00.000Z");
  } catch (const RequestError& error) {
    if (agent.error(error, "2026-01-01T00:00:00.000Z").empty()) std::abort();
  }
  return 0;
}
