#include "service.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <set>
#include <stdexcept>
#include <thread>

#include "bus/bus.hpp"
#include "bus/registry.hpp"
#include "contracts/topics.hpp"
#include "message_queue.hpp"
#include "node/node.hpp"
#include "recording/file_stream.hpp"
#include "recording/mcap_writer.hpp"
#include "replay/stream_tally.hpp"

namespace trunnion::recorder {
namespace {

constexpr double flush_seconds = 1.0;    // what a crash of the recorder may cost
constexpr double match_seconds = 1.0;    // how long to wait for the writers of the stream
constexpr double cluster_seconds = 5.0;  // the same when a launcher says which services there are
constexpr int priority = -10;            // of the threads that take samples; they use little

volatile sig_atomic_t stop_requested = 0;

void catch_signals(bool parent_bound) {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_requested = 1; };
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  if (parent_bound) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() == 1) stop_requested = 1;
  }
}

std::vector<const bus::TopicEntry*> chosen_topics(const std::vector<std::string>& names) {
  std::vector<const bus::TopicEntry*> result;
  for (const auto& name : names) {
    const auto* entry = bus::find_topic(name);
    if (entry == nullptr) throw std::runtime_error("unknown topic '" + name + "'");
    result.push_back(entry);
  }
  if (names.empty())
    for (const auto& entry : bus::all_topics()) result.push_back(&entry);
  return result;
}

struct Topic {
  const bus::TopicEntry* entry = nullptr;
  std::unique_ptr<bus::RawReader> reader;
  std::uint32_t sequence = 0;
};

// The thread that compresses and writes. It reads what it has to know of the stream from the bytes it writes.
class FileThread {
 public:
  FileThread(const Options& options, const std::vector<const bus::TopicEntry*>& topics, MessageQueue& queue)
      : sink_(options.output), writer_(sink_), topics_(topics), queue_(queue) {
    writer_.metadata("trunnion", {{"machine", options.machine},
                                  {"domain", std::to_string(options.network.domain)},
                                  {"contract", topics::contract_hash},
                                  {"version", TRUNNION_VERSION}});
    for (const auto* entry : topics_)
      writer_.add_channel(entry->description.name, entry->type, entry->schema, {{"handle", entry->handle}});
    thread_ = std::thread([this] { run(); });
  }
  ~FileThread() { join(); }
  FileThread(const FileThread&) = delete;
  FileThread& operator=(const FileThread&) = delete;

  void join() {
    queue_.close();
    if (thread_.joinable()) thread_.join();
  }
  /// After join().
  const replay::StreamTally& tally() const { return tally_; }
  std::uint64_t bytes() const { return writer_.bytes(); }
  std::uint64_t unwritten() const { return unwritten_; }
  const std::string& problem() const { return sink_.problem(); }

 private:
  void run() {
    std::vector<Message> messages;
    double flushed = node::monotonic_seconds();
    while (queue_.pop_all(messages, 0.2)) {
      for (const auto& message : messages) {
        if (writer_.write(message.topic, message.sequence, static_cast<std::uint64_t>(message.source_time),
                          message.cdr))
          tally_.add(topics_[message.topic]->handle, message.cdr);
        else
          ++unwritten_;
      }
      if (const double now = node::monotonic_seconds(); now - flushed > flush_seconds) {
        writer_.flush();
        flushed = now;
      }
      report_failure();
    }
    if (writer_.finish()) sink_.sync();
    report_failure();
  }

  void report_failure() {
    if (reported_ || sink_.problem().empty()) return;
    reported_ = true;
    std::cerr << "trunnion-recorder: error: "
              << sink_.problem() + "; the file ends at byte " + std::to_string(writer_.bytes()) + "\n";
  }

  recording::FileSink sink_;
  recording::Writer writer_;
  const std::vector<const bus::TopicEntry*>& topics_;
  MessageQueue& queue_;
  replay::StreamTally tally_;
  std::uint64_t unwritten_ = 0;
  bool reported_ = false;
  std::thread thread_;
};

// Takes what has arrived at every reader; true when there was anything.
bool drain(std::vector<Topic>& topics, MessageQueue& queue, Message& message) {
  bool any = false;
  bus::SampleInfo info;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    // A bounded number at a time, so that one topic in full flow does not keep the others waiting.
    for (int n = 0; n < 256 && topics[i].reader->take(message.cdr, info); ++n) {
      any = true;
      message.topic = static_cast<std::uint16_t>(i);
      message.sequence = ++topics[i].sequence;
      message.source_time = info.source_timestamp;
      queue.push(message);
    }
  }
  return any;
}

// Motion that begins before the stream's writers know of our readers would be missing from the recording. A
// writer learns of a participant's readers in the order in which they were made; so a service whose state
// reaches a reader made last knows of all the others. Without a launcher nobody says which services there
// are, and a matched writer must do.
template <class Drain>
void wait_for_writers(bus::Bus& bus, const std::vector<Topic>& topics, Drain&& drain_all) {
  auto clusters = bus.reader(topics::cluster);
  auto states = bus.reader(topics::service_state);
  idl::service::Cluster cluster;
  idl::service::ServiceState state;
  std::set<std::uint32_t> heard;
  const double began = node::monotonic_seconds();
  while (stop_requested == 0) {
    drain_all();
    while (clusters.take(cluster)) {
    }
    while (states.take(state)) heard.insert(state.instance);
    const bool known = !cluster.services.empty();
    const bool all_heard =
        std::all_of(cluster.services.begin(), cluster.services.end(),
                    [&](const auto& service) { return heard.count(service.instance) != 0; });
    const bool matched = std::all_of(topics.begin(), topics.end(), [](const Topic& topic) {
      return topic.entry->qos != bus::QosKind::frame || topic.reader->matched() > 0;
    });
    if (known && all_heard && matched) return;
    const double waited = node::monotonic_seconds() - began;
    if (waited > (known ? cluster_seconds : match_seconds) ||
        (!known && matched && waited > match_seconds / 2))
      return;
    bus.signal().wait(0.002);
  }
}

void print_summary(const Options& options, const FileThread& file, std::uint64_t dropped) {
  const auto& tally = file.tally();
  if (options.json) {
    bus::Json summary = {{"file", options.output},
                         {"bytes", file.bytes()},
                         {"messages", tally.messages()},
                         {"dropped_messages", dropped},
                         {"unwritten_messages", file.unwritten()},
                         {"problem", file.problem()}};
    for (const auto& [handle, count] : tally.messages_by_topic())
      summary["topics"][handle]["messages"] = count;
    for (const auto& handle : replay::StreamTally::cyclic()) {
      if (tally.cycles(handle) == 0) continue;
      summary["topics"][handle]["cycles"] = tally.cycles(handle);
      summary["topics"][handle]["lost_cycles"] = tally.lost(handle);
    }
    std::cout << summary.dump() << std::endl;
    return;
  }
  std::cout << options.output << ": " << tally.messages() << " messages, " << file.bytes() << " bytes\n";
  for (const auto& handle : replay::StreamTally::cyclic())
    if (tally.cycles(handle) != 0)
      std::cout << "  " << handle << ": " << tally.cycles(handle) << " cycles, " << tally.lost(handle)
                << " lost\n";
  if (dropped != 0)
    std::cout << "  " << dropped << " messages dropped: the disk was slower than the stream\n";
  if (file.unwritten() != 0)
    std::cout << "  " << file.unwritten() << " messages not written: " << file.problem() << "\n";
  std::cout << std::flush;
}

}  // namespace

int record(const Options& options) {
  catch_signals(options.parent_bound);
  const auto entries = chosen_topics(options.topics);
  MessageQueue queue(options.queue_mebibytes << 20);
  FileThread file(options, entries, queue);
  // A stream faster than real time keeps only some milliseconds for whoever is late, so the threads that take
  // samples go first where that is allowed; the one that compresses has begun before and stays as it is.
  setpriority(PRIO_PROCESS, 0, priority);
  bus::Bus bus(options.vendor, options.network);
  std::vector<Topic> topics;
  for (const auto* entry : entries) {
    const bool late = bus::reader_qos(entry->qos).transient_local;
    topics.push_back({entry, bus.backend().reader(entry->description, {late, 0}, &bus.signal()), 0});
  }
  Message message;
  wait_for_writers(bus, topics, [&] { drain(topics, queue, message); });
  std::cout << "recording " << options.output << std::endl;

  const double started = node::monotonic_seconds();
  std::uint64_t told = 0;
  while (stop_requested == 0 &&
         (options.duration <= 0 || node::monotonic_seconds() - started < options.duration)) {
    if (drain(topics, queue, message)) {
      if (queue.dropped() != 0 && told == 0) {
        told = queue.dropped();
        std::cerr << "trunnion-recorder: warning: messages are dropped: the disk is slower than the stream\n";
      }
      continue;
    }
    bus.signal().wait(0.05);
  }
  // What has arrived by now belongs to the recording; a stream in full flow does not keep us for ever.
  const double until = node::monotonic_seconds() + 2;
  while (drain(topics, queue, message) && node::monotonic_seconds() < until) {
  }
  topics.clear();
  file.join();
  print_summary(options, file, queue.dropped());
  return queue.dropped() == 0 && file.problem().empty() ? 0 : 1;
}

}  // namespace trunnion::recorder
