// SPDX-License-Identifier: Apache-2.0
#include "verification/suite.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "machine/services.hpp"
#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::verification {
namespace {

using machine::at;
using machine::scalar;

constexpr int plotted_rows = 60;  // before and after the first difference

class Parser {
 public:
  explicit Parser(const std::string& file)
      : file_(file), reader_(file), directory_(std::filesystem::path(file).parent_path()) {}

  Suite parse(const std::string& text) {
    const auto document = machine::parse_yaml(text, file_);
    reader_.only(document, {"title", "timeout", "tests"});
    Suite suite;
    if (const auto title = document["title"]) suite.title = scalar(file_, title);
    if (const auto timeout = document["timeout"]) {
      suite.timeout = number(timeout);
      if (!(suite.timeout > 0 && suite.timeout <= 3600))
        throw std::runtime_error(at(file_, timeout) + "timeout must be above 0 and at most 3600 s");
    }
    const auto tests = document["tests"];
    if (!tests || !tests.IsSequence() || tests.size() == 0)
      throw std::runtime_error(file_ +
                               ":1:1: error: 'tests' is missing, a list of recordings with their services");
    for (const auto& node : tests) suite.entries.push_back(entry(node));
    return suite;
  }

 private:
  double number(const YAML::Node& node) const {
    constexpr double largest = std::numeric_limits<double>::max();
    return reader_.number(node, {-largest, largest});
  }

  std::vector<std::string> list(const YAML::Node& node) const {
    if (!node.IsSequence()) return {scalar(file_, node)};
    std::vector<std::string> names;
    for (const auto& name : node) names.push_back(scalar(file_, name));
    return names;
  }

  std::string service(const YAML::Node& node) const {
    const auto name = scalar(file_, node);
    if (machine::find_service(name) == nullptr)
      throw std::runtime_error(at(file_, node) + "there is no service '" + name + "'");
    return name;
  }

  std::string path(const std::string& text) const { return (directory_ / text).lexically_normal().string(); }

  SuiteEntry entry(const YAML::Node& node) const {
    reader_.only(node,
                 {"recording", "machine", "vendor", "services", "executables", "tolerances", "require"});
    SuiteEntry entry;
    entry.place = at(file_, node);
    if (!node["recording"]) throw std::runtime_error(entry.place + "'recording' is missing");
    if (scalar(file_, node["recording"]).empty())
      throw std::runtime_error(at(file_, node["recording"]) + "'recording' is empty");
    entry.recording = path(scalar(file_, node["recording"]));
    if (const auto machine = node["machine"]) {
      entry.machine = scalar(file_, machine);
      if (entry.machine.find('/') != std::string::npos) entry.machine = path(entry.machine);
    }
    if (const auto vendor = node["vendor"]) {
      entry.vendor = scalar(file_, vendor);
      if (entry.vendor != "fastdds" && entry.vendor != "cyclonedds")
        throw std::runtime_error(at(file_, vendor) + "vendor must be fastdds or cyclonedds");
    }
    if (const auto services = node["services"];
        services && !(services.IsScalar() && scalar(file_, services) == "all")) {
      if (!services.IsSequence() || services.size() == 0)
        throw std::runtime_error(at(file_, services) + "services must be all or a list of names");
      for (const auto& name : services) entry.services.push_back(service(name));
    }
    for (const auto& pair : map(node["executables"]))
      entry.executables[service(pair.first)] = path(scalar(file_, pair.second));
    if (const auto tolerances = node["tolerances"]; tolerances && tolerances.IsScalar()) {
      entry.tolerances[""] = tolerance(tolerances);
    } else {
      for (const auto& pair : map(tolerances))
        entry.tolerances[scalar(file_, pair.first)] = tolerance(pair.second);
    }
    for (const auto& pair : map(node["require"])) entry.required[service(pair.first)] = list(pair.second);
    return entry;
  }

  double tolerance(const YAML::Node& node) const {
    const double value = number(node);
    if (value < 0) throw std::runtime_error(at(file_, node) + "a tolerance must not be below 0");
    return value;
  }

  YAML::Node map(const YAML::Node& node) const {
    if (!node) return YAML::Node(YAML::NodeType::Map);
    if (!node.IsMap()) throw std::runtime_error(at(file_, node) + "expected names with values");
    return node;
  }

  std::string file_;
  machine::YamlReader reader_;
  std::filesystem::path directory_;
};

}  // namespace

Suite parse_suite(const std::string& text, const std::string& file) { return Parser(file).parse(text); }

std::vector<SuiteTest> tests_of(
    const Suite& suite, const std::function<std::vector<VerifiedProcess>(const SuiteEntry&)>& processes_of) {
  std::vector<SuiteTest> tests;
  for (std::size_t i = 0; i < suite.entries.size(); ++i) {
    const auto& entry = suite.entries[i];
    const auto processes = processes_of(entry);
    const auto add = [&](const std::string& service) {
      const auto before = tests.size();
      for (const auto& process : processes) {
        if (process.service != service) continue;
        const auto* definition = machine::find_service(service);
        const bool numbered = definition != nullptr && definition->per_channel;
        tests.push_back({i, process, numbered ? service + " " + std::to_string(process.channel) : service});
      }
      if (tests.size() == before)
        throw std::runtime_error(entry.place + "the machine of " + entry.recording + " has no service '" +
                                 service + "'");
    };
    std::vector<std::string> services = entry.services;
    if (services.empty())
      for (const auto& process : processes)
        if (const auto* definition = machine::find_service(process.service);
            (definition == nullptr || !definition->not_verified) &&
            std::ranges::find(services, process.service) == services.end())
          services.push_back(process.service);
    for (const auto& service : services) add(service);
    for (const auto& [service, features] : entry.required)
      if (std::ranges::find(services, service) == services.end())
        throw std::runtime_error(entry.place + "features of '" + service +
                                 "' are required, and it is not verified");
  }
  return tests;
}

std::vector<std::string> verify_arguments(const Suite& suite, const SuiteTest& test) {
  const auto& entry = suite.entries.at(test.entry);
  std::vector<std::string> arguments = {"verify",      "--json",
                                        "--service",   test.process.service,
                                        "--recording", entry.recording,
                                        "--timeout",   fmt::format("{:g}", suite.timeout),
                                        "--around",    std::to_string(plotted_rows)};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {option, value});
  };
  if (test.process.channel != 0) add("--channel", std::to_string(test.process.channel));
  add("--machine", entry.machine);
  add("--vendor", entry.vendor);
  if (const auto own = entry.executables.find(test.process.service); own != entry.executables.end())
    add("--exec", own->second);
  for (const auto& [field, value] : entry.tolerances) {
    add("--tolerance",
        field.empty() ? fmt::format("{:.17g}", value) : fmt::format("{}={:.17g}", field, value));
  }
  if (const auto required = entry.required.find(test.process.service); required != entry.required.end())
    for (const auto& feature : required->second) add("--require", feature);
  return arguments;
}

}  // namespace trunnion::verification
