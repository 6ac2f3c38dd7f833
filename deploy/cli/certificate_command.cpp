// SPDX-License-Identifier: Apache-2.0
// certificate: the one by which browsers know the gateway
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>

#include "access/certificate.hpp"
#include "access/user_file.hpp"
#include "bus/json.hpp"
#include "cluster/cluster.hpp"
#include "cluster/cluster_files.hpp"
#include "commands.hpp"
#include "machine/gateway_settings.hpp"
#include "machine/machine.hpp"
#include "machine/yaml.hpp"
#include "service/node.hpp"

namespace trunnion::cli {
namespace {

using bus::Json;

struct CertificateArguments {
  std::string machine, state;
  std::vector<std::string> names;
  int days = 825;
  bool show = false;
};

/// Under which the gateway can be reached; the first is the subject.
std::vector<std::string> names_of(const machine::MachineConfig& machine,
                                  const std::vector<std::string>& more) {
  std::array<char, 256> computer{};
  gethostname(computer.data(), computer.size() - 1);
  const std::string own = computer.data();
  std::vector<std::string> names = more;
  names.insert(names.end(), machine.host_names.begin(), machine.host_names.end());
  names.insert(names.end(), {own, own + ".local", "localhost", "127.0.0.1", "::1"});
  std::vector<std::string> result;
  for (const auto& name : names)
    if (std::ranges::find(result, name) == result.end()) result.push_back(name);
  return result;
}

std::string list_text(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

int certificate(const Common& common, const CertificateArguments& arguments) {
  const auto directory = cluster::find_machine(arguments.machine);
  const auto machine = machine::load_machine(directory);
  const auto tls = machine::load_gateway_settings(directory).tls;
  const auto state = std::filesystem::absolute(
      arguments.state.empty() ? cluster::default_state_directory(machine.name) : arguments.state);
  const std::filesystem::path own = tls.certificate;
  if (!own.empty() && !arguments.show)
    throw std::runtime_error(directory + "/machine.yaml names the certificate " + own.string() +
                             ": enter 'tls: on' to use one made by this command");
  const auto file = own.empty() ? state / access::certificate_file : std::filesystem::path(directory) / own;
  if (!arguments.show) {
    const auto made =
        access::make_certificate(names_of(machine, arguments.names), arguments.days, std::time(nullptr));
    std::filesystem::create_directories(state);
    access::write_private((state / access::certificate_key_file).string(), made.key);
    access::write_private(file.string(), made.certificate);
  }
  const auto facts = access::certificate_facts(machine::read_text(file.string()));
  if (!arguments.show)
    access::journal(state.string(), service::time_of_day(), "trunnion certificate",
                    "made the certificate " + facts.fingerprint);
  if (common.json) {
    std::cout << bus::text_of({{"certificate", file.string()},
                               {"names", facts.names},
                               {"begins", facts.begins},
                               {"ends", facts.ends},
                               {"sha256", facts.fingerprint}})
              << "\n";
    return 0;
  }
  std::printf("%s\n  for      %s\n  until    %s\n  SHA-256  %s\n", file.c_str(),
              list_text(facts.names).c_str(), access::day_text(facts.ends).c_str(),
              facts.fingerprint.c_str());
  if (arguments.show) return 0;
  std::printf(
      "Trust it: compare the SHA-256 with the one that the browser shows at the first visit, or copy the "
      "file (not the\n"
      "key) to the other computers and import it there. Programs: curl --cacert FILE, trunnion.connect(..., "
      "ca=FILE).\n");
  if (!tls.on)
    std::printf("Enter 'tls: on' in %s/machine.yaml and start the machine again.\n", directory.c_str());
  return 0;
}

}  // namespace

void add_certificate_command(CLI::App& app, Common& common) {
  auto arguments = std::make_shared<CertificateArguments>();
  auto* command =
      add_command(app, common, "certificate",
                  "Make the certificate of HTTPS, for a machine with 'tls: on'; a running gateway uses it "
                  "within 2 s",
                  [&common, arguments] { return certificate(common, *arguments); });
  command->add_option("machine", arguments->machine, "Machine: a name of configs/machines or a directory")
      ->required();
  command->add_option(
      "--name", arguments->names,
      "Name or address under which browsers reach it, besides host_names of machine.yaml, this "
      "computer's name and localhost; may be repeated");
  command->add_option("--days", arguments->days, "Days it holds (default: 825)")
      ->check(CLI::Range(1, access::longest_certificate));
  command->add_option("--state", arguments->state, "State directory (default: the machine's)");
  command->add_flag("--show", arguments->show, "Make nothing, say what the present one is");
}

}  // namespace trunnion::cli
