// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <vector>

#include "service.hpp"
#include "service/network.hpp"

namespace {
// In the order of trunnion::service::Severity.
const std::vector<std::string> severities{"hint", "warning", "error", "emergency"};
}  // namespace

int main(int argc, char** argv) {
  using namespace trunnion;
  recorder::Options options;
  CLI::App app("trunnion-recorder: writes the topics of a Trunnion cluster to an MCAP file");
  app.add_option("--output", options.output, "File to write")->required();
  app.add_option("--machine", options.machine, "Name of the machine, kept in the file");
  app.add_option("--topics", options.topics, "Handles or names of topics, separated by commas (default: all)")
      ->delimiter(',');
  app.add_option("--domain", options.network.domain, "DDS domain, 0 .. 100")->check(CLI::Range(0, 100));
  service::add_network_options(app, options.network);
  app.add_option_function<std::string>(
         "--vendor", [&options](const std::string& name) { options.vendor = bus::vendor_from(name); },
         "DDS vendor: fastdds or cyclonedds")
      ->check(CLI::IsMember({"fastdds", "cyclonedds"}));
  app.add_option("--duration", options.duration, "Seconds to record (default: until SIGTERM or SIGINT)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--queue", options.queue_mebibytes,
                 "MiB that may wait for the disk before messages are dropped")
      ->check(CLI::Range(1, 65536));
  double free_megabytes = recording::default_free_megabytes;
  app.add_option(
         "--free-space", free_megabytes,
         "MB that must be free on the disk for a start; below it a warning, below a tenth of it the end "
         "(default: 200; 0: not checked)")
      ->check(CLI::NonNegativeNumber);
  app.add_option_function<std::string>(
         "--compression",
         [&options](const std::string& name) {
           options.compression = name == "none" ? recording::Compression::none : recording::Compression::zstd;
         },
         "Of the chunks: none or zstd (default: zstd)")
      ->check(CLI::IsMember({"none", "zstd"}));
  double part_mebibytes = 0;
  auto* part_size = app.add_option("--part-size", part_mebibytes,
                                   "MiB after which a new part starts, numbered FILE-0001 and so on")
                        ->check(CLI::PositiveNumber);
  auto* part_time =
      app.add_option("--part-time", options.parts.seconds, "Seconds after which a new part starts")
          ->check(CLI::PositiveNumber);
  app.add_option("--parts", options.parts.keep, "Newest parts to keep (default: all)")
      ->check(CLI::PositiveNumber);
  auto* last =
      app.add_option(
             "--last", options.last,
             "Flight recorder: keep this many seconds in memory, and save them when an alarm is raised")
          ->check(CLI::PositiveNumber)
          ->excludes(part_size)
          ->excludes(part_time);
  app.add_option("--after", options.after, "Seconds to save after the alarm")
      ->check(CLI::NonNegativeNumber)
      ->needs(last);
  app.add_option_function<std::string>(
         "--severity",
         [&options](const std::string& name) {
           options.severity = static_cast<idl::service::Severity>(
               std::find(severities.begin(), severities.end(), name) - severities.begin());
         },
         "Lowest severity that saves: hint, warning, error or emergency (default: warning)")
      ->check(CLI::IsMember(severities))
      ->needs(last);
  app.add_option("--memory", options.memory_mebibytes, "Maximum MiB that the flight recorder keeps")
      ->check(CLI::Range(1, 65536))
      ->needs(last);
  app.add_flag("--json", options.json, "Summary as JSON");
  app.add_flag("--parent-bound", options.parent_bound, "Stop when the parent process ends");
  CLI11_PARSE(app, argc, argv);
  options.parts.bytes = static_cast<std::uint64_t>(part_mebibytes * (1 << 20));
  options.free_space = static_cast<std::uint64_t>(free_megabytes * recording::bytes_per_megabyte);
  options.network.identity = "recorder";
  try {
    return recorder::record(options);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-recorder: error: " << e.what() << "\n";
    return 1;
  }
}
