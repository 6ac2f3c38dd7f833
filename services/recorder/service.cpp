// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

#include "bus/bus.hpp"
#include "bus/codec.hpp"
#include "bus/json.hpp"
#include "bus/registry.hpp"
#include "contracts/topics.hpp"
#include "file_thread.hpp"
#include "message_queue.hpp"
#include "reading_progress.hpp"
#include "recording/disk_space.hpp"
#include "recording/stream_tally.hpp"
#include "recording_alarms.hpp"
#include "service/node.hpp"
#include "service/request.hpp"
#include "snapshot_client.hpp"
#include "stream/whole_batch.hpp"
#include "topic_source.hpp"

namespace trunnion::recorder {
namespace {

constexpr double match_seconds = 1.0;   // waiting time for the writers of the stream
constexpr double cluster_seconds = 30;  // the same when a launcher publishes the list of services
// A wake-up for every message would cost as much processor time as a stage of the stream. Writers keep a
// thousand batches.
constexpr auto pause = std::chrono::milliseconds(20);
constexpr int most_requests = 5;  // of the first states
constexpr auto request_pause = std::chrono::milliseconds(20);
// After the start of a part: what was written into the part before has been taken by then.
constexpr double part_pause = 0.05;
constexpr int most_at_once = 256;  // messages of one topic

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
    for (const auto& entry : bus::all_topics())
      if (entry.description.name != topics::recording_progress.name) result.push_back(&entry);
  return result;
}

// All topics of the recording, by the numbers that messages name.
class Sources {
 public:
  Sources(bus::Bus& bus, const std::vector<const bus::TopicEntry*>& entries, bus::Signal* signal)
      : backend_(bus.backend()),
        progress_writer_(bus.writer(topics::recording_progress)),
        sequences_(entries.size()) {
    for (const auto* entry : entries) topics_.emplace_back(backend_, *entry, signal);
  }
  ~Sources() { progress_writer_.write(progress_.ended()); }
  Sources(const Sources&) = delete;
  Sources& operator=(const Sources&) = delete;

  void begin(std::int64_t now) {
    for (auto& topic : topics_) topic.begin(now);
  }
  enum class Drained { nothing, all, some };
  /// Takes messages that have arrived. `some`: there may be more of a topic, so it is behind the writers.
  Drained drain(MessageQueue& queue);

  // Of the topics that carry the stream:
  bool all_have_writers() const {
    return std::all_of(topics_.begin(), topics_.end(),
                       [](const TopicSource& topic) { return !topic.is_stream() || topic.has_writer(); });
  }
  bool feedback_has_come() const {
    for (std::size_t i = 0; i < topics_.size(); ++i)
      if (topics_[i].is_feedback() && sequences_[i] == 0) return false;
    return true;
  }
  bool left_out_are_taken(const SnapshotRequests& snapshots) const {
    return std::all_of(topics_.begin(), topics_.end(), [&](const TopicSource& topic) {
      return topic.left_out() == 0 || snapshots.has_taken(topic.entry().description.name, topic.left_out());
    });
  }
  std::uint64_t overwritten() const {
    std::uint64_t sum = 0;
    for (const auto& topic : topics_) sum += topic.overwritten();
    return sum;
  }

 private:
  bus::Backend& backend_;
  bus::Writer<idl::stream::RecordingProgress> progress_writer_;
  ReadingProgress progress_{service::make_client_id()};
  idl::stream::Feedback feedback_;
  std::vector<TopicSource> topics_;
  std::vector<std::uint32_t> sequences_;
  std::vector<bus::DiscoveredWriter> writers_;
  Message message_;
};

Sources::Drained Sources::drain(MessageQueue& queue) {
  if (backend_.discover(writers_))
    for (auto& topic : topics_) topic.see(writers_);
  auto drained = Drained::nothing;
  bus::SampleInfo info;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    // A bounded number at a time, so that one busy topic does not delay the others.
    int n = 0;
    for (; n < most_at_once && topics_[i].take(message_.cdr, info); ++n) {
      drained = std::max(drained, Drained::all);
      message_.topic = static_cast<std::uint16_t>(i);
      message_.sequence = ++sequences_[i];
      message_.source_time = info.source_timestamp;
      if (topics_[i].is_feedback() && bus::decode(message_.cdr, feedback_) &&
          stream::fault_of(feedback_).empty())
        progress_.read(feedback_, message_.cdr.size());
      queue.push(message_);
    }
    if (n == most_at_once) drained = Drained::some;
  }
  if (!queue.crowded())
    if (const auto progress = progress_.take()) progress_writer_.write(*progress);
  if (drained != Drained::nothing) queue.wake();
  return drained;
}

// Motion that starts before the stream's writers have discovered the recorder's readers would be missing from
// the recording. A writer discovers a participant's readers in the order of their creation; so a service
// whose state reaches the reader created last has discovered all others. The machine's position is in the
// feedback, so one message of it must have arrived. Without a launcher the list of services is unknown, and a
// matched writer is sufficient.
void wait_for_writers(bus::Bus& bus, Sources& sources, MessageQueue& queue, SnapshotClient& snapshots) {
  auto states = bus.reader(topics::service_state);
  idl::service::ServiceState state;
  std::set<std::uint32_t> received;
  const double began = service::monotonic_seconds();
  while (stop_requested == 0) {
    sources.drain(queue);
    const auto listed = snapshots.listed();
    while (states.take(state)) received.insert(state.instance);
    const bool known = !listed.empty();
    const bool all_received = std::includes(received.begin(), received.end(), listed.begin(), listed.end());
    const bool matched = sources.all_have_writers();
    if (known && all_received && matched && sources.feedback_has_come()) break;
    const double waited = service::monotonic_seconds() - began;
    if (waited > (known ? cluster_seconds : match_seconds) ||
        (!known && matched && waited > match_seconds / 2))
      break;
    bus.signal().wait(0.002);
  }
}

// The recording can be verified from these states on. A service that has not taken a setpoint which was
// written before the recording began is asked again: it takes this setpoint after the state it gave. Of
// replicas it takes the setpoints of one, so this may never come true.
void take_snapshots(bus::Bus& bus, Sources& sources, MessageQueue& queue, SnapshotClient& snapshots) {
  const double until = service::monotonic_seconds() + SnapshotRequests::late_seconds;
  for (int asked = 0; asked < most_requests; ++asked) {
    snapshots.ask();
    while (stop_requested == 0 && !snapshots.requests().answered() && service::monotonic_seconds() < until) {
      sources.drain(queue);
      bus.signal().wait(0.002);
      snapshots.run();
    }
    if (stop_requested != 0 || sources.left_out_are_taken(snapshots.requests())) return;
    std::this_thread::sleep_for(request_pause);
  }
}

struct Losses {
  std::uint64_t dropped = 0, overwritten = 0;
  bool none() const { return dropped == 0 && overwritten == 0; }
};

void report(const Losses& losses) {
  if (losses.dropped != 0)
    std::cerr << "trunnion-recorder: error: " << losses.dropped
              << " messages dropped: the disk was slower than the stream\n";
  if (losses.overwritten != 0)
    std::cerr << "trunnion-recorder: error: " << losses.overwritten
              << " messages overwritten: the recorder had too little processor time\n";
}

void print_summary(const Options& options, const FileThread& thread, const Losses& losses,
                   const std::vector<std::string>& without_state) {
  const auto& tally = thread.tally();
  const auto& destination = thread.destination();
  const auto& files = destination.files();
  std::uint64_t bytes = 0;
  for (const auto& file : files) bytes += file.bytes;
  if (options.json) {
    bus::Json summary = {{"file", options.output},
                         {"bytes", bytes},
                         {"messages", tally.messages()},
                         {"dropped_messages", losses.dropped},
                         {"overwritten_messages", losses.overwritten},
                         {"unwritten_messages", destination.unwritten()},
                         {"problem", destination.problem()},
                         {"without_state", without_state},
                         {"files", bus::Json::array()}};
    for (const auto& file : files)
      summary["files"].push_back(
          {{"file", file.path}, {"bytes", file.bytes}, {"messages", file.messages}, {"because", file.why}});
    for (const auto& [handle, count] : tally.messages_by_topic())
      summary["topics"][handle]["messages"] = count;
    for (const auto& handle : recording::StreamTally::cyclic()) {
      if (tally.cycles(handle) == 0) continue;
      summary["topics"][handle]["cycles"] = tally.cycles(handle);
      summary["topics"][handle]["lost_cycles"] = tally.lost(handle);
    }
    std::cout << summary.dump() << std::endl;
    return;
  }
  std::cout << options.output << ": " << tally.messages() << " messages, ";
  if (options.last > 0)
    std::cout << (files.empty() ? std::string("no alarm, nothing saved")
                                : std::to_string(files.size()) + " saved")
              << "\n";
  else
    std::cout << bytes << " bytes"
              << (options.parts.any() ? " in " + std::to_string(files.size()) + " parts" : "") << "\n";
  for (const auto& handle : recording::StreamTally::cyclic())
    if (tally.cycles(handle) != 0)
      std::cout << "  " << handle << ": " << tally.cycles(handle) << " cycles, " << tally.lost(handle)
                << " lost\n";
  if (destination.unwritten() != 0)
    std::cout << "  " << destination.unwritten() << " messages not written: " << destination.problem()
              << "\n";
  for (const auto& name : without_state) std::cout << "  no state of " << name << ": it has not answered\n";
  std::cout << std::flush;
}

void refuse_without_space(const Options& options) {
  const auto free = recording::free_space(options.output);
  if (!free) return;
  const auto refusal = recording::space_refusal(options.output, *free, options.free_space);
  if (!refusal.empty()) throw std::runtime_error(refusal);
}

}  // namespace

int record(const Options& options) {
  catch_signals(options.parent_bound);
  const auto entries = chosen_topics(options.topics);
  refuse_without_space(options);
  MessageQueue queue(options.queue_mebibytes << 20);
  const FileHeader header{entries,
                          {{"machine", options.machine},
                           {"domain", std::to_string(options.network.domain)},
                           {"contract", topics::contract_hash},
                           {"version", TRUNNION_VERSION}},
                          options.compression};
  bus::use_clock_offset(options.network.clock_offset);
  FileThread file(options, header, queue);
  bus::Gathering gathering;
  bus::Bus bus(options.vendor, options.network);
  std::optional<Sources> sources(std::in_place, bus, entries, &gathering);
  RecordingAlarms alarms(bus);
  SnapshotClient snapshots(bus);
  const bool verifiable = std::any_of(entries.begin(), entries.end(), [](const auto* entry) {
    return entry->description.name == topics::service_snapshot.name;
  });
  wait_for_writers(bus, *sources, queue, snapshots);
  sources->begin(bus::source_time());
  if (verifiable) take_snapshots(bus, *sources, queue, snapshots);
  std::cout << "recording " << options.output << std::endl;

  const double started = service::monotonic_seconds();
  std::uint64_t reported = 0;
  std::uint32_t parts = 1;
  while (stop_requested == 0 && !file.ended() &&
         (options.duration <= 0 || service::monotonic_seconds() - started < options.duration)) {
    const auto drained = sources->drain(queue);
    if (drained != Sources::Drained::nothing) {
      if (queue.dropped() != 0 && reported == 0) {
        reported = queue.dropped();
        std::cerr << "trunnion-recorder: warning: messages are dropped: the disk is slower than the stream\n";
      }
    }
    for (const auto& finding : file.take_findings()) alarms.tell(finding);
    const double now = service::monotonic_seconds();
    if (file.started() != parts && verifiable) snapshots.ask_at(now + part_pause);
    if (options.last > 0 && verifiable) snapshots.ask_at(now + std::max(1.0, options.last / 2));
    parts = file.started();
    if (verifiable) snapshots.run();
    if (drained != Sources::Drained::some) std::this_thread::sleep_for(pause);
  }
  // Messages that have arrived by now belong to the recording; a running stream must not extend it without
  // limit.
  const double until = service::monotonic_seconds() + 2;
  while (!file.ended() && sources->drain(queue) != Sources::Drained::nothing &&
         service::monotonic_seconds() < until) {
  }
  const Losses losses{queue.dropped(), sources->overwritten()};
  sources.reset();
  file.join();
  alarms.finish(file.destination().ended() ? file.destination().problem() : "");
  print_summary(options, file, losses, snapshots.requests().owing());
  report(losses);
  return losses.none() && file.destination().problem().empty() ? 0 : 1;
}

}  // namespace trunnion::recorder
