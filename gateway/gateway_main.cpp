// SPDX-License-Identifier: Apache-2.0
#include "gateway_main.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <iostream>

#include "access/certificate.hpp"
#include "cluster/cluster_files.hpp"
#include "cluster/operating_station.hpp"
#include "core/rights.hpp"
#include "http_client/client.hpp"
#include "machine/gateway_settings.hpp"
#include "machine/service_constants.hpp"
#include "recording/disk_space.hpp"
#include "service.hpp"
#include "service/network.hpp"
#include "standby_service.hpp"

namespace {

/// What the gateway starts when a recording is asked for.
std::vector<std::string> recorder(const trunnion::service::Options& options, double megabytes) {
  using namespace trunnion;
  std::vector<std::string> arguments{cluster::binary_directory() + "/trunnion-recorder",
                                     "--machine",
                                     options.machine.title,
                                     "--domain",
                                     std::to_string(options.network.domain),
                                     "--parent-bound",
                                     "--json",
                                     "--free-space",
                                     std::to_string(megabytes)};
  for (auto& argument : service::network_arguments(options.network)) arguments.push_back(std::move(argument));
  return arguments;
}

trunnion::gateway::mtconnect::AgentSettings agent_settings(const trunnion::machine::MachineConfig& machine,
                                                           const char* computer) {
  trunnion::gateway::mtconnect::AgentSettings settings;
  settings.machine = machine.name;
  settings.title = machine.title;
  settings.computer = computer;
  settings.instance = static_cast<std::uint64_t>(std::time(nullptr));
  settings.channels = machine.channels;
  for (const auto& entry : machine.services)
    if (entry.service == trunnion::machine::service::channel.name)
      settings.channel_of[entry.instance] = entry.channel;
  return settings;
}

/// The files of the certificate; none without TLS.
trunnion::gateway::TlsFiles tls_files(const trunnion::machine::TlsSettings& settings,
                                      const trunnion::service::Options& options) {
  using namespace trunnion;
  const std::filesystem::path machine = options.machine_directory, state = options.state_directory;
  if (!settings.on) return {};
  if (settings.certificate.empty())
    return {state / access::certificate_file, state / access::certificate_key_file};
  return {machine / settings.certificate, machine / settings.key};
}

/// False when the process is told to end before it is needed.
bool stand_by(trunnion::service::Node& node, const trunnion::http_client::Server& running,
              const trunnion::gateway::FeedbackChange& change) {
  if (!node.on_standby()) return node.stand_by();
  trunnion::gateway::StandbyService standby(node, running, change);
  return node.stand_by(&standby);
}

}  // namespace

int trunnion::gateway_main(int argc, char** argv, gateway::FeedbackChange change) {
  service::Options options;
  options.service = "gateway";
  gateway::GatewayOptions own;
  CLI::App app("trunnion-gateway: the cluster's HTTP and WebSocket side");
  service::add_options(app, options);
  app.add_option("--address", own.address,
                 "Address to listen on; anything but 127.0.0.1 opens the machine to a network");
  app.add_option("--port", own.port, "Port to listen on (default: the one of machine.yaml)");
  int mtconnect_port = -1;
  app.add_option("--mtconnect-port", mtconnect_port,
                 "Port of the MTConnect agent, 0 = none (default: mtconnect_port of machine.yaml)")
      ->check(CLI::Range(0, 65535));
  app.add_option("--web", own.web, "Directory of the built page");
  bool verified = false;
  app.add_flag(
      "--verified", verified,
      "As 'trunnion verify' starts it: on 127.0.0.1 without TLS, users and the right to operate; a bearer "
      "token is the name of who sends a request");
  if (const int status = service::parse_options(app, argc, argv, options); status >= 0) return status;
  try {
    service::Node node(options);
    if (own.port == 0) own.port = options.machine.port;
    own.title = options.machine.title;
    own.host_names = options.machine.host_names;
    char computer[256] = {};
    gethostname(computer, sizeof computer - 1);
    auto settings = machine::load_gateway_settings(options.machine_directory);
    if (verified) {
      if (!gateway::is_loopback(own.address)) throw std::runtime_error("--verified is for 127.0.0.1 only");
      settings.auth = settings.one_operates = false;
      settings.tls = {};
    }
    own.access = {settings.auth, options.state_directory, settings.session_idle, settings.tls.on, verified};
    if (!settings.auth && !gateway::is_loopback(own.address))
      throw std::runtime_error("every computer that reaches " + own.address +
                               " could move the machine: set 'auth: on' in machine.yaml");
    own.tls = tls_files(settings.tls, options);
    own.one_operates = settings.one_operates;
    own.command_socket = cluster::operating_socket(options.network.domain);
    own.mtconnect_port =
        mtconnect_port >= 0 ? static_cast<std::uint16_t>(mtconnect_port) : settings.mtconnect_port;
    own.mtconnect = agent_settings(options.machine, computer);
    own.host_names.insert(own.host_names.end(), {computer, std::string(computer) + ".local"});
    own.recordings = {
        std::filesystem::path(options.state_directory) / "recordings",
        recorder(options, settings.recording_free_space),
        static_cast<std::uint64_t>(settings.recording_free_space * recording::bytes_per_megabyte)};
    own.measurement = {options.machine, std::filesystem::path(options.state_directory) / "journal.jsonl"};
    own.alarm_file = (std::filesystem::path(options.state_directory) / gateway::AlarmFile::name).string();
    if (!stand_by(node, {own.port, own.tls.on()}, change)) return 0;
    own.change = std::move(change);
    gateway::GatewayService service(node, own);
    return node.run(service);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-gateway: error: " << e.what() << "\n";
    return 1;
  }
}
