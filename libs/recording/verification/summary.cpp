// SPDX-License-Identifier: Apache-2.0
#include "verification/summary.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "bus/codec.hpp"
#include "contracts/topics.hpp"
#include "recording/stream_tally.hpp"

namespace trunnion::verification {
namespace {

constexpr std::size_t most_gaps = 10;

struct Tracked {
  TopicSummary summary;
  const bus::TopicEntry* entry = nullptr;
  std::uint32_t sequence = 0;
};

// Messages that say more than that they were sent.
class Observer {
 public:
  explicit Observer(Summary& out) : out_(out) {}
  bool take(const bus::TopicEntry& topic, std::span<const std::uint8_t> cdr) {
    if (topic.handle == "announcement") {
      if (!bus::decode(cdr, announcement_)) return false;
      const auto& a = announcement_;
      out_.participants.insert(a.service + " " + a.vendor + " " + a.version + " " + a.contract);
    } else if (topic.handle == "parameter_set") {
      if (!bus::decode(cdr, parameters_)) return false;
      out_.revisions.insert(parameters_.revision);
    } else if (topic.handle == "cluster") {
      return bus::decode(cdr, cluster_);
    } else if (topic.handle == "snapshot_request") {
      asked_ = true;
    } else if (topic.handle == "service_snapshot") {
      if (!bus::decode(cdr, snapshot_)) return false;
      if (snapshot_.kind != idl::service::SnapshotKind::LATER)
        given_.insert(snapshot_.instance);
      else
        reasons_[snapshot_.instance] = ": " + snapshot_.detail;
    }
    return true;
  }
  // A recorder asks when the recording has begun.
  void finish() {
    if (!asked_) return;
    for (const auto& service : cluster_.services)
      if (service.pid != 0 && !given_.contains(service.instance))
        out_.without_state.push_back(service.service + reasons_[service.instance]);
  }

 private:
  Summary& out_;
  idl::service::Announcement announcement_;
  idl::parameters::ParameterSet parameters_;
  idl::service::Cluster cluster_;
  idl::service::ServiceSnapshot snapshot_;
  std::set<std::uint32_t> given_;
  std::map<std::uint32_t, std::string> reasons_;
  bool asked_ = false;
};

const char* text_of(Known known) {
  switch (known) {
    case Known::same:
      return "same";
    case Known::other_type:
      return "other type";
    case Known::unknown_topic:
      return "unknown topic";
  }
  return "?";
}

std::size_t place_in_stream(const std::string& handle) {
  const auto& order = recording::StreamTally::cyclic();
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), handle) - order.begin());
}

}  // namespace

double TopicSummary::rate() const {
  return messages < 2 || last_time <= first_time
             ? 0
             : static_cast<double>(messages - 1) / (static_cast<double>(last_time - first_time) * 1e-9);
}

Summary summarize(recording::Source& source) {
  Summary out;
  Observer observer(out);
  recording::StreamTally tally;
  std::map<std::uint16_t, Tracked> tracked;
  recording::Reader reader(source);
  recording::MessageView view;
  while (reader.next(view)) {
    auto& t = tracked[view.channel->id];
    auto& s = t.summary;
    if (s.messages == 0) {
      s.topic = view.channel->topic;
      s.known = known_topic(*view.channel, reader.schemas(), t.entry);
      if (const auto schema = reader.schemas().find(view.channel->schema); schema != reader.schemas().end())
        s.type = schema->second.name;
      if (const auto handle = view.channel->metadata.find("handle"); handle != view.channel->metadata.end())
        s.handle = handle->second;
      s.first_time = s.last_time = view.log_time;
      if (view.sequence > 0) t.sequence = view.sequence - 1;
    }
    ++s.messages;
    s.bytes += view.data.size();
    s.first_time = std::min(s.first_time, view.log_time);
    s.last_time = std::max(s.last_time, view.log_time);
    if (view.sequence > t.sequence) s.missing += view.sequence - t.sequence - 1;
    t.sequence = view.sequence;
    out.first_time = out.messages == 0 ? view.log_time : std::min(out.first_time, view.log_time);
    out.last_time = std::max(out.last_time, view.log_time);
    ++out.messages;
    if (t.entry == nullptr) continue;
    tally.add(t.entry->handle, view.data);
    if (!observer.take(*t.entry, view.data)) ++s.undecodable;
  }
  observer.finish();
  for (auto& [id, t] : tracked) out.topics.push_back(std::move(t.summary));
  std::sort(out.topics.begin(), out.topics.end(),
            [](const auto& a, const auto& b) { return a.topic < b.topic; });
  for (const auto& [key, coverage] : tally.streams()) {
    if (coverage.covered() == 0) continue;
    out.streams.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), coverage.begin(),
                           coverage.end(), coverage.covered(), coverage.lost(), coverage.late(),
                           coverage.repeated(), coverage.gaps(most_gaps)});
  }
  std::stable_sort(out.streams.begin(), out.streams.end(), [](const auto& a, const auto& b) {
    return place_in_stream(a.handle) < place_in_stream(b.handle);
  });
  for (const auto& metadata : reader.metadata())
    if (metadata.name == "trunnion") out.metadata.insert(metadata.values.begin(), metadata.values.end());
  const auto contract = out.metadata.find("contract");
  out.same_contract = contract != out.metadata.end() && contract->second == topics::contract_hash;
  out.complete = reader.ending() == recording::Ending::complete;
  out.problem = reader.problem();
  out.damages = reader.damages();
  out.compressions = reader.compressions();
  return out;
}

std::string text_of(const Summary& s) {
  std::string text;
  for (const auto& [name, value] : s.metadata) text += fmt::format("{:<10} {}\n", name, value);
  if (!s.same_contract)
    text += fmt::format("           this program's contract is {}\n", topics::contract_hash);
  text += fmt::format("{:<10} {} in {:.3f} s\n", "messages", s.messages, s.seconds());
  for (const auto& [compression, chunks] : s.compressions)
    text += fmt::format("{:<10} {}, compression {}\n", "chunks", chunks, compression);
  for (const auto& damage : s.damages) text += "damaged    " + recording::text_of(damage) + "\n";
  if (!s.complete && s.damages.empty()) text += "cut off    " + s.problem + "\n";
  std::string revisions;
  for (const auto r : s.revisions) revisions += (revisions.empty() ? "" : ", ") + std::to_string(r);
  if (!revisions.empty()) text += fmt::format("{:<10} {}\n", "parameters", "revision " + revisions);
  for (const auto& name : s.without_state) text += "no state   " + name + "\n";
  text +=
      fmt::format("\n{:<24} {:>10} {:>12} {:>12}  {}\n", "topic", "messages", "bytes", "per second", "type");
  for (const auto& t : s.topics) {
    text += fmt::format("{:<24} {:10} {:12} {:>12.1f}  {}", t.handle, t.messages, t.bytes, t.rate(), t.type);
    if (t.known != Known::same) text += std::string(", ") + text_of(t.known) + " in this program's contract";
    if (t.missing != 0) text += ", " + std::to_string(t.missing) + " missing";
    if (t.undecodable != 0) text += ", " + std::to_string(t.undecodable) + " undecodable";
    text += "\n";
  }
  if (!s.streams.empty())
    text += fmt::format("\n{:<24} {:>7} {:>5} {:>20} {:>10} {:>6} {:>6} {:>8}\n", "stream", "channel",
                        "epoch", "cycles", "covered", "lost", "late", "repeated");
  for (const auto& c : s.streams) {
    const auto range = std::to_string(c.begin) + ".." + std::to_string(c.end - 1);
    text += fmt::format("{:<24} {:7} {:5} {:>20} {:10} {:6} {:6} {:8}\n", c.handle, c.channel, c.epoch, range,
                        c.cycles, c.lost, c.late, c.repeated);
    for (const auto& gap : c.gaps)
      text += fmt::format("{:>24} missing {}..{}\n", "", gap.first, gap.first + gap.count - 1);
  }
  if (!s.participants.empty()) text += "\nservice vendor version contract\n";
  for (const auto& participant : s.participants) text += participant + "\n";
  return text;
}

bus::Json json_of(const Summary& s) {
  bus::Json topics = bus::Json::array(), streams = bus::Json::array(), damages = bus::Json::array();
  for (const auto& damage : s.damages)
    damages.push_back({{"begin", damage.begin},
                       {"end", damage.end},
                       {"first_time", damage.first_time},
                       {"last_time", damage.last_time},
                       {"what", damage.what}});
  for (const auto& t : s.topics)
    topics.push_back({{"topic", t.topic},
                      {"handle", t.handle},
                      {"type", t.type},
                      {"contract", text_of(t.known)},
                      {"messages", t.messages},
                      {"missing", t.missing},
                      {"undecodable", t.undecodable},
                      {"bytes", t.bytes},
                      {"messages_per_second", t.rate()}});
  for (const auto& c : s.streams) {
    bus::Json gaps = bus::Json::array();
    for (const auto& gap : c.gaps) gaps.push_back({{"first", gap.first}, {"count", gap.count}});
    streams.push_back({{"topic", c.handle},
                       {"channel", c.channel},
                       {"epoch", c.epoch},
                       {"begin", c.begin},
                       {"end", c.end},
                       {"cycles", c.cycles},
                       {"lost", c.lost},
                       {"late", c.late},
                       {"repeated", c.repeated},
                       {"gaps", gaps}});
  }
  return {{"metadata", s.metadata}, {"same_contract", s.same_contract}, {"complete", s.complete},
          {"problem", s.problem},   {"compressions", s.compressions},   {"messages", s.messages},
          {"seconds", s.seconds()}, {"revisions", s.revisions},         {"topics", topics},
          {"streams", streams},     {"services", s.participants},       {"without_state", s.without_state},
          {"damages", damages}};
}

}  // namespace trunnion::verification
