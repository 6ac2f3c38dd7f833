// SPDX-License-Identifier: Apache-2.0
// The messages of one topic: from the memory of writers on this host, by DDS from all others.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bus/registry.hpp"
#include "bus/shared_history.hpp"

namespace trunnion::recorder {

/// A topic without setpoint batches is read by DDS alone. One with batches has a DDS reader only while a
/// writer requires it, because all writers of the topic bear its cost.
class TopicSource {
 public:
  /// `signal` is notified by the vendor's threads.
  TopicSource(bus::Backend& backend, const bus::TopicEntry& entry, bus::Signal* signal);

  /// Call whenever the writers of the domain have changed: `writers` are all of them.
  void see(const std::vector<bus::DiscoveredWriter>& writers);
  /// From `now`, a bus::source_time(), on everything is recorded. Before, setpoints are left out: they would
  /// be only a thousand batches for each stage. The feedback contains the machine's position and the inputs
  /// of the drive.
  void begin(std::int64_t now) { began_ = now; }
  /// Source time stamp of the newest message that was left out; 0 = none. A reader may not have it yet.
  std::int64_t left_out() const { return left_out_; }

  /// The next message to be recorded; false when there is none yet.
  bool take(bus::Bytes& cdr, bus::SampleInfo& info);
  /// True when the topic has a writer and it is read.
  bool has_writer() const;
  /// Messages that were overwritten in memory before they were taken.
  std::uint64_t overwritten() const;

  const bus::TopicEntry& entry() const { return *entry_; }
  /// Setpoint batches or feedback. Samples of servo tests have the same QoS, and no writer without a drive.
  bool is_stream() const {
    return entry_->qos == bus::QosKind::batch && entry_->type.starts_with("trunnion::stream::");
  }
  bool is_feedback() const;

 private:
  struct History {
    bus::WriterId writer{};
    std::unique_ptr<bus::SharedHistoryReader> reader;
    bool ended = false;  // no more messages follow
  };
  // Of a writer that is discovered late all is read that it has written since the reader was opened: one of a
  // command writes as soon as the service that it asks has discovered it. What is older has had its effect.
  bool is_event() const { return entry_->qos == bus::QosKind::event; }
  bool has_past() const { return !is_stream() || is_feedback(); }
  void open_reader();
  void close_ended();
  bool take_from_memory(bus::Bytes& cdr, bus::SampleInfo& info);
  bool take_by_dds(bus::Bytes& cdr, bus::SampleInfo& info);
  bool recorded(const bus::SampleInfo& info, bool from_begin);

  bus::Backend* backend_;
  const bus::TopicEntry* entry_;
  bus::Signal* signal_;
  std::map<std::string, History> histories_;  // by address
  std::unique_ptr<bus::RawReader> reader_;
  bool reader_needed_ = false, reader_came_late_ = false;
  std::int64_t opened_ = 0;  // when the reader was
  std::int64_t began_ = 0;   // 0 = not yet
  std::int64_t left_out_ = 0;
  std::uint64_t overwritten_ = 0;  // of histories that have ended
};

}  // namespace trunnion::recorder
