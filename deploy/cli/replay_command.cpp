// SPDX-License-Identifier: Apache-2.0
// replay: writes a recording into a live domain
#include <signal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <thread>

#include "bus/bus.hpp"
#include "bus/json.hpp"
#include "cluster/cluster.hpp"
#include "cluster/cluster_files.hpp"
#include "commands.hpp"
#include "service/node.hpp"
#include "verification/schedule.hpp"

namespace trunnion::cli {
namespace {

struct ReplayArguments {
  std::string file;
  std::vector<std::string> only;
  double rate = 1;
  double linger = 0;  // s that the last states are kept for late joiners
  bool wait = false;
};

constexpr int stream_batches = 4096;  // that a writer of the stream keeps, for late joiners
constexpr double match_timeout = 60;  // s for a first reader
constexpr double match_pause = 1;     // s without a reader of another topic

volatile sig_atomic_t stop_requested = 0;

int run_replay(const Common& common, const ReplayArguments& arguments) {
  if (!common.domain) throw std::runtime_error("say with --domain where to replay it");
  std::set<std::string> topics;
  for (const auto& name : arguments.only) {
    const auto* entry = bus::find_topic(name);
    if (entry == nullptr)
      throw std::runtime_error("no topic is called '" + name + "': see 'trunnion topic list'");
    topics.insert(entry->handle);
  }
  const auto recording = verification::load_recording(arguments.file, topics);
  for (const auto& topic : recording.foreign)
    std::cerr << arguments.file << ": warning: " << topic << " is of another contract and was left out\n";
  if (!recording.complete) std::cerr << arguments.file << ": warning: " << recording.problem << "\n";
  const auto due = verification::schedule(recording, topics, arguments.rate);
  if (due.empty()) throw std::runtime_error(arguments.file + ": nothing to replay");

  struct sigaction action {};
  action.sa_handler = [](int) { stop_requested = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  bus::Bus bus(bus::Vendor::cyclonedds, cluster::network_in(*common.domain), {stream_batches});
  std::map<const bus::TopicEntry*, std::unique_ptr<bus::RawWriter>> writers;
  for (const auto& d : due) {
    auto& writer = writers[d.message->topic];
    if (!writer)
      writer = bus.backend().writer(d.message->topic->description,
                                    bus::writer_qos(d.message->topic->qos, {stream_batches}));
  }
  const auto pause = [](double seconds) {
    const double until = service::monotonic_seconds() + seconds;
    while (stop_requested == 0 && service::monotonic_seconds() < until)
      std::this_thread::sleep_for(
          std::chrono::duration<double>(std::min(0.05, std::max(0.0, until - service::monotonic_seconds()))));
  };
  // A reader of many topics is discovered topic by topic; what has no history would be lost to the last ones.
  const auto matched = [&] {
    return static_cast<std::size_t>(
        std::count_if(writers.begin(), writers.end(), [](const auto& w) { return w.second->matched() > 0; }));
  };
  std::size_t known = 0;
  double since = service::monotonic_seconds();
  for (;;) {
    if (!arguments.wait || stop_requested != 0) break;
    if (const auto now = matched(); now != known) known = now, since = service::monotonic_seconds();
    const double unchanged = service::monotonic_seconds() - since;
    if (known == writers.size() || unchanged > (known > 0 ? match_pause : match_timeout)) break;
    pause(0.01);
  }
  const double began = service::monotonic_seconds();
  std::size_t written = 0;
  for (const auto& d : due) {
    pause(began + d.seconds - service::monotonic_seconds());
    if (stop_requested != 0) break;
    if (writers[d.message->topic]->write(d.message->cdr)) ++written;
  }
  const double seconds = service::monotonic_seconds() - began;
  if (common.json)
    std::cout << bus::Json{{"messages", written}, {"topics", writers.size()}, {"seconds", seconds}}.dump()
              << std::endl;
  else
    std::cout << written << " messages of " << writers.size() << " topics in " << seconds << " s"
              << std::endl;
  pause(std::max(arguments.linger, 0.1));  // what was written last is still on its way
  return written == due.size() ? 0 : 1;
}

}  // namespace

void add_replay_command(CLI::App& app, Common& common) {
  auto arguments = std::make_shared<ReplayArguments>();
  auto* command =
      add_command(app, common, "replay",
                  "Write a recording into a domain as its writers did: in the order of cycles, states "
                  "kept for late joiners",
                  [&common, arguments] { return run_replay(common, *arguments); });
  command->add_option("file", arguments->file, "Recording")->required()->check(CLI::ExistingFile);
  command->add_option("--only", arguments->only, "Handles of topics, separated by commas (default: all)")
      ->delimiter(',');
  command->add_option("--rate", arguments->rate, "Speed against the recorded one")
      ->check(CLI::Range(1e-3, 1e6));
  command->add_option("--linger", arguments->linger, "Seconds to stay afterwards, for late joiners")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--wait", arguments->wait, "Begin when there is a reader, or after a minute");
}

}  // namespace trunnion::cli
