// SPDX-License-Identifier: Apache-2.0
// topic list|echo|hz, record
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "bus/registry.hpp"
#include "cluster/child_process.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/cluster_locks.hpp"
#include "commands.hpp"
#include "service/network.hpp"
#include "standard_output.hpp"
#include "text/quantity.hpp"

namespace trunnion::cli {
namespace {

const bus::TopicEntry& find_topic(const std::string& name) {
  const auto* entry = bus::find_topic(name);
  if (entry == nullptr)
    throw std::runtime_error("no topic is called '" + name + "': see 'trunnion topic list'");
  return *entry;
}

int list_topics(const Common& common) {
  bus::Json all = bus::Json::array();
  for (const auto& t : bus::all_topics()) {
    all.push_back({{"handle", t.handle}, {"name", t.description.name}, {"type", t.type}, {"about", t.about}});
    if (!common.json)
      std::printf("%-20s %-40s %-36s %s\n", t.handle.c_str(), t.description.name.c_str(), t.type.c_str(),
                  t.about.c_str());
  }
  if (common.json) std::cout << all.dump(2) << "\n";
  return 0;
}

int echo(const Common& common, const std::string& name, int count, double timeout) {
  const auto& topic = find_topic(name);
  bus::Bus bus(bus::Vendor::cyclonedds, cluster::find_cluster(common.domain).network);
  auto reader = bus.backend().reader(topic.description, bus::reader_qos(topic.qos), &bus.signal());
  bus::Bytes bytes;
  bus::SampleInfo info;
  double heard = service::monotonic_seconds();
  int printed = 0;
  while (count == 0 || printed < count) {
    bus.signal().wait(0.1);
    if (!output_is_read()) return raise(SIGPIPE);
    while ((count == 0 || printed < count) && reader->take(bytes, info)) {
      std::cout << bus::text_of(topic.to_json(bytes), common.json ? -1 : 2) << std::endl;
      heard = service::monotonic_seconds();
      ++printed;
    }
    if (timeout > 0 && service::monotonic_seconds() - heard > timeout)
      throw std::runtime_error("nothing on " + topic.description.name + " for " +
                               text::quantity(timeout, "s"));
  }
  return 0;
}

int rate(const Common& common, const std::string& name, double seconds) {
  const auto& topic = find_topic(name);
  bus::Bus bus(bus::Vendor::cyclonedds, cluster::find_cluster(common.domain).network);
  auto reader = bus.backend().reader(topic.description, bus::reader_qos(topic.qos), &bus.signal());
  for (int i = 0; i < 100 && reader->matched() == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  bus::Bytes bytes;
  bus::SampleInfo info;
  while (reader->take(bytes, info)) {
  }
  std::uint64_t messages = 0, size = 0;
  const double began = service::monotonic_seconds();
  while (service::monotonic_seconds() - began < seconds) {
    bus.signal().wait(0.05);
    while (reader->take(bytes, info)) ++messages, size += bytes.size();
  }
  const double elapsed = service::monotonic_seconds() - began;
  if (common.json)
    std::cout << bus::Json{{"topic", topic.description.name},
                           {"messages_per_second", messages / elapsed},
                           {"bytes_per_second", size / elapsed},
                           {"writers", reader->matched()}}
                     .dump()
              << "\n";
  else
    std::printf("%s: %.1f messages/s, %.1f kB/s, %d writers\n", topic.description.name.c_str(),
                messages / elapsed, size / elapsed / 1000, reader->matched());
  return 0;
}

// What the recorder itself understands and checks: passed on as it was written.
struct RecorderOption {
  const char* name;
  const char* help;
};
constexpr std::array recorder_options{
    RecorderOption{"--topics", "Handles, separated by commas (default: all)"},
    RecorderOption{"--duration", "Seconds, 0 = until Ctrl-C"},
    RecorderOption{
        "--free-space",
        "MB that must be free on the disk for a start; below it a warning, below a tenth of it the "
        "end (default: 200; 0: not checked)"},
    RecorderOption{"--compression", "Of the chunks in the file: none or zstd (default: zstd)"},
    RecorderOption{"--part-size",
                   "MiB after which a new part begins: FILE-0001 and so on, each whole in itself"},
    RecorderOption{"--part-time", "Seconds after which a new part begins"},
    RecorderOption{"--parts", "Newest parts to keep (default: all)"},
    RecorderOption{"--last", "Flight recorder: keep these seconds in memory, save them when an alarm fires"},
    RecorderOption{"--after", "Seconds to save of what follows the alarm (default: 1)"},
    RecorderOption{"--severity", "Least that saves: hint, warning (default), error or emergency"},
    RecorderOption{"--memory", "MiB the flight recorder may keep (default: 256)"}};
using RecorderValues = std::array<std::string, recorder_options.size()>;

// Parts and what a flight recorder saves get numbers that no file has.
bool is_numbered(const RecorderValues& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const std::string option : {"--part-size", "--part-time", "--last"})
      if (recorder_options[i].name == option && !values[i].empty()) return true;
  return false;
}

int record(const Common& common, const std::string& file, bool force, const RecorderValues& values) {
  // A pipe or a device is not replaced.
  if (!force && !is_numbered(values) && std::filesystem::is_regular_file(file))
    throw std::runtime_error(file + ": it exists already: choose another name, or replace it with --force");
  const auto cluster = cluster::find_cluster(common.domain);
  std::vector<std::string> args{cluster::binary_directory() + "/trunnion-recorder",
                                "--output",
                                file,
                                "--machine",
                                cluster.machine,
                                "--domain",
                                std::to_string(cluster.run.domain)};
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!values[i].empty()) args.insert(args.end(), {recorder_options[i].name, values[i]});
  for (auto& argument : service::network_arguments(cluster.network)) args.push_back(std::move(argument));
  if (common.json) args.emplace_back("--json");
  cluster::hold_recording(cluster.run.domain);
  cluster::replace_process(args);
  throw std::runtime_error(args[0] + ": cannot be started");
}

}  // namespace

void add_topic_commands(CLI::App& app, Common& common) {
  auto* topic = app.add_subcommand("topic", "Look at the bus");
  topic->require_subcommand(1);
  auto name = std::make_shared<std::string>();
  auto count = std::make_shared<int>(0);
  auto seconds = std::make_shared<double>(0);
  add_command(*topic, common, "list", "Every topic of the contract",
              [&common] { return list_topics(common); });
  auto* command =
      add_command(*topic, common, "echo", "Print what is published, as JSON",
                  [&common, name, count, seconds] { return echo(common, *name, *count, *seconds); });
  command->add_option("topic", *name, "Name or handle")->required();
  command->add_option("-n,--count", *count, "Messages to print, 0 = until Ctrl-C");
  command->add_option("--timeout", *seconds, "Fail after so many seconds without a message, 0 = never");
  auto window = std::make_shared<double>(2);
  command = add_command(*topic, common, "hz", "Rate and volume of a topic",
                        [&common, name, window] { return rate(common, *name, *window); });
  command->add_option("topic", *name, "Name or handle")->required();
  command->add_option("--seconds", *window, "How long to count");
}

void add_record_command(CLI::App& app, Common& common) {
  auto name = std::make_shared<std::string>();
  auto values = std::make_shared<RecorderValues>();
  auto force = std::make_shared<bool>(false);
  auto* command =
      add_command(app, common, "record", "Record the cluster into an MCAP file until Ctrl-C",
                  [&common, name, force, values] { return record(common, *name, *force, *values); });
  command->add_option("file", *name, "File to write")->required();
  command->add_flag("--force", *force, "Replace the file when it exists");
  for (std::size_t i = 0; i < recorder_options.size(); ++i)
    command->add_option(recorder_options[i].name, (*values)[i], recorder_options[i].help);
}

}  // namespace trunnion::cli
