// SPDX-License-Identifier: Apache-2.0
// swap: another process in the place of a running one
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/swap_ticket.hpp"
#include "commands.hpp"
#include "text/quantity.hpp"

namespace trunnion::cli {
namespace {

int swap(const Common& common, idl::service::SwapRequest request, double timeout) {
  const auto cluster = cluster::find_cluster(common.domain);
  if (!request.executable.empty()) {
    if (cluster.host.empty() && !std::filesystem::is_regular_file(request.executable))
      throw std::runtime_error("--exec: there is no file " + request.executable);
    request.executable = std::filesystem::absolute(request.executable).lexically_normal().string();
    if (request.executable.size() > 255)
      throw std::runtime_error("the path of --exec is longer than 255 characters");
  }
  bus::Bus bus(bus::Vendor::cyclonedds, cluster.network);
  service::RequestClient<idl::service::SwapRequest, idl::service::SwapReply> client(bus, topics::swap_request,
                                                                                    topics::swap_reply);
  cluster::put_ticket(cluster.run.path(), request);
  const auto reply = client.call(request, timeout);
  if (!reply) throw std::runtime_error(service::silence("the launcher", timeout, client.connected()));
  if (common.json) {
    std::cout << bus::text_of(bus::to_json(*reply)) << "\n";
    return reply->accepted ? 0 : 1;
  }
  if (!reply->accepted)
    throw std::runtime_error(reply->reason + "; the old one was kept after " +
                             std::to_string(reply->compared) + " equal cycles");
  std::printf("%s swapped in %.2f s at cycle %llu: %u cycles compared, %s\n", request.service.c_str(),
              reply->seconds, static_cast<unsigned long long>(reply->cycle), reply->compared,
              reply->gap > 0 ? ("no service for " + text::quantity(reply->gap, "s", 3)).c_str() : "no gap");
  std::printf("Written down in %s of the state directory%s\n", cluster::swap_journal_file,
              cluster.host.empty() ? (", " + cluster.state_directory).c_str() : " on the service's host");
  if (!reply->reason.empty()) std::fprintf(stderr, "warning: %s\n", reply->reason.c_str());
  return 0;
}

}  // namespace

void add_swap_command(CLI::App& app, Common& common) {
  auto request = std::make_shared<idl::service::SwapRequest>();
  auto timeout = std::make_shared<double>(60);
  request->cycles = 500;
  auto* command =
      add_command(app, common, "swap",
                  "Put another process in the place of a running service. A stage is compared first and "
                  "kept when the new one differs; exit status 0 when the new one has taken over",
                  [&common, request, timeout] { return swap(common, *request, *timeout); });
  command->add_option("service", request->service, "Service, as in machine.yaml")->required();
  command->add_option(
      "--exec", request->executable,
      "Executable of the new one, on the host of the service, below the launcher's own directory or "
      "swap_directories of machine.yaml (default: the one that runs)");
  command->add_option("--vendor", request->vendor, "DDS vendor of the new one (default: the one that runs)")
      ->check(CLI::IsMember({"fastdds", "cyclonedds"}));
  command->add_option("--replica", request->replica, "Which replica of a stage that has two (default 0)")
      ->check(CLI::Range(0, 1));
  command->add_option("--channel", request->channel, "Which channel, for service channel (default 0)")
      ->check(CLI::Range(0, 31));
  command
      ->add_option("--cycles", request->cycles,
                   "Cycles in which a stage must compute the same before it takes part (default 500; fewer "
                   "when the stream comes to rest)")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--timeout", *timeout, "Seconds to wait for the launcher's answer (default 60)")
      ->check(CLI::PositiveNumber);
}

}  // namespace trunnion::cli
