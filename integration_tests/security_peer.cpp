// SPDX-License-Identifier: Apache-2.0
// A participant with a certificate, with a wrong one or with none, that tries to write or read a topic of the
// stream, and says what came of it in one line: how many others it found and what it got from which mark, a
// number that every writer puts into its samples: `matched M MARK:SAMPLES...`, or `refused REASON`.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <thread>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "service/network.hpp"
#include "service/node.hpp"

namespace {

using namespace trunnion;

template <class T>
void take_part(bus::Bus& bus, const bus::Topic<T>& topic, bool write, std::uint64_t mark, double seconds) {
  std::optional<bus::Writer<T>> writer;
  std::optional<bus::Reader<T>> reader;
  write ? void(writer.emplace(bus.writer(topic))) : void(reader.emplace(bus.reader(topic)));
  T value;
  int matched = 0;
  std::map<std::uint64_t, int> samples;
  for (const double end = service::monotonic_seconds() + seconds; service::monotonic_seconds() < end;) {
    matched = std::max(matched, write ? writer->matched() : reader->matched());
    if (write) {
      value.first = mark;
      samples[mark] += writer->write(value) ? 1 : 0;
    } else {
      while (reader->take(value)) ++samples[value.first];
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::printf("matched %d", matched);
  for (const auto& [from, count] : samples)
    std::printf(" %llu:%d", static_cast<unsigned long long>(from), count);
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("security-peer");
  bus::NetworkSettings network;
  std::string vendor = "cyclonedds", action, topic;
  double seconds = 3;
  std::uint64_t mark = 0;
  service::add_network_options(app, network);
  app.add_option("--domain", network.domain);
  app.add_option("--identity", network.identity);
  app.add_option("--vendor", vendor);
  app.add_option("--seconds", seconds);
  app.add_option("--mark", mark);
  app.add_option("action", action)->required()->check(CLI::IsMember({"write", "read"}));
  app.add_option("topic", topic)->required()->check(CLI::IsMember({"path_batch", "gantry_batch"}));
  CLI11_PARSE(app, argc, argv);
  try {
    bus::Bus bus(bus::vendor_from(vendor), network);
    if (topic == "path_batch")
      take_part(bus, topics::path_batch, action == "write", mark, seconds);
    else
      take_part(bus, topics::gantry_batch, action == "write", mark, seconds);
  } catch (const std::exception& e) {
    std::printf("refused %s\n", e.what());
  }
}
