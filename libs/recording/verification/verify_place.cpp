// SPDX-License-Identifier: Apache-2.0
#include "verification/verify_place.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace trunnion::verification {
namespace fs = std::filesystem;

namespace {
constexpr double domain_timeout = 60;  // s: other verifications end soon
}

VerifyPlace::VerifyPlace(std::optional<std::uint32_t> domain)
    : run_{domain ? *domain : cluster::free_domain(domain_timeout)} {
  directory_ = run_.verification();
  fs::create_directories(directory_ + "/state");
}

VerifyPlace::~VerifyPlace() {
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
  if (fs::is_empty(run_.path(), ignored)) run_.remove();
}

std::string machine_directory(const VerifyOptions& options, const StoredRecording& recording) {
  std::string machine = options.machine;
  if (const auto name = recording.metadata.find("machine");
      machine.empty() && name != recording.metadata.end())
    machine = name->second;
  if (machine.empty())
    throw std::runtime_error(options.recording + ": it names no machine: say which with --machine");
  return cluster::find_machine(machine);
}

std::vector<std::string> command_line(const VerifyOptions& options, const StoredRecording& recording,
                                      const VerifyPlan& plan, const VerifyPlace& place) {
  std::vector<std::string> arguments{options.executable.empty()
                                         ? cluster::binary_directory() + "/trunnion-" + options.service
                                         : options.executable,
                                     "--machine",
                                     machine_directory(options, recording),
                                     "--state",
                                     place.state(),
                                     "--instance",
                                     std::to_string(plan.instance),
                                     "--channel",
                                     std::to_string(options.channel),
                                     "--domain",
                                     std::to_string(place.domain()),
                                     "--vendor",
                                     options.vendor.empty() ? "cyclonedds" : options.vendor,
                                     "--parent-bound"};
  if (plan.virtual_time) arguments.emplace_back("--virtual-time");
  if (plan.seed) {
    std::ofstream out(place.snapshot(), std::ios::binary);
    out << plan.seed->snapshot.state;
    if (!out.flush()) throw std::runtime_error(place.snapshot() + ": cannot be written");
    arguments.insert(arguments.end(), {"--snapshot", place.snapshot()});
  }
  return arguments;
}

cluster::ChildOptions child_options(std::vector<std::string> arguments, const VerifyPlace& place) {
  if (access(arguments.at(0).c_str(), X_OK) != 0)
    throw std::runtime_error(arguments[0] + ": cannot be started");
  cluster::ChildOptions options;
  options.arguments = std::move(arguments);
  options.log = place.log();
  options.ends_with_parent = true;
  return options;
}

}  // namespace trunnion::verification
