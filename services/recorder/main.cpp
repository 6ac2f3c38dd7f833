#include <CLI/CLI.hpp>
#include <iostream>

#include "service.hpp"

int main(int argc, char** argv) {
  using namespace trunnion;
  recorder::Options options;
  CLI::App app("trunnion-recorder: writes the topics of a Trunnion cluster to an MCAP file");
  app.add_option("--output", options.output, "File to write")->required();
  app.add_option("--machine", options.machine, "Name of the machine, kept in the file");
  app.add_option("--topics", options.topics, "Handles or names of topics, separated by commas (default: all)")
      ->delimiter(',');
  app.add_option("--domain", options.network.domain, "DDS domain, 0 .. 100")->check(CLI::Range(0, 100));
  app.add_option_function<std::string>(
         "--vendor", [&options](const std::string& name) { options.vendor = bus::vendor_from(name); },
         "DDS vendor: fastdds or cyclonedds")
      ->check(CLI::IsMember({"fastdds", "cyclonedds"}));
  app.add_option("--duration", options.duration, "Seconds to record (default: until SIGTERM or SIGINT)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--queue", options.queue_mebibytes,
                 "MiB that may wait for the disk before messages are dropped")
      ->check(CLI::Range(1, 65536));
  app.add_flag("--json", options.json, "Summary as JSON");
  app.add_flag("--parent-bound", options.parent_bound, "Stop when the parent process is gone");
  CLI11_PARSE(app, argc, argv);
  try {
    return recorder::record(options);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-recorder: error: " << e.what() << "\n";
    return 1;
  }
}
