// SPDX-License-Identifier: Apache-2.0
// Typed writers and readers over either vendor.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "bus/codec.hpp"
#include "bus/endpoint.hpp"
#include "bus/shared_history.hpp"
#include "bus/topic.hpp"

namespace trunnion::bus {

template <class T>
TopicDescription describe(const Topic<T>& topic) {
  return {topic.name, topic.wire_type, Fields<T>::keyed, &key_of<T>};
}

/// Depths of the stream's writers; everything else has a fixed one.
struct StreamDepth {
  int batches = 64;
};

inline EndpointQos writer_qos(QosKind kind, StreamDepth depth) {
  switch (kind) {
    case QosKind::batch:
      return {true, depth.batches};
    case QosKind::state:
      return {true, 1};
    case QosKind::event:
      // Kept for a recorder that has discovered the writer late; a service must not act on what is old.
      return {true, 64};
    case QosKind::history:
      return {true, 16};
  }
  return {};
}

inline EndpointQos reader_qos(QosKind kind) {
  switch (kind) {
    case QosKind::batch:
      return {true, 0};
    case QosKind::state:
      return {true, 1};
    case QosKind::event:
      return {false, 64};
    case QosKind::history:
      return {true, 64};
  }
  return {};
}

template <class T>
class Writer {
 public:
  explicit Writer(std::unique_ptr<RawWriter> raw, std::unique_ptr<SharedHistory> history = nullptr)
      : history_(std::move(history)), raw_(std::move(raw)) {}
  /// Throws CdrError when a field is beyond its bound; false when the vendor could not send.
  bool write(const T& value) {
    encode(value, buffer_);
    const std::int64_t now = source_time();
    // First, so that nobody has a batch which a recorder does not find.
    if (history_ != nullptr) history_->write(now, buffer_);
    return raw_->write(buffer_, now);
  }
  int matched() const { return raw_->matched(); }

 private:
  std::unique_ptr<SharedHistory> history_;
  std::unique_ptr<RawWriter> raw_;
  Bytes buffer_;
};

/// Messages of a topic that its readers have refused: not of its type, or with a value that a field cannot
/// have.
struct Refusals {
  std::uint64_t count = 0;
  std::string newest;  ///< why the newest was: field and value
  std::string writer;  ///< who has written the first that is not told yet; empty: all are told
  Backend* backend = nullptr;
  WriterId known{};        ///< the writer that was asked for last
  std::string known_text;  ///< what it is; empty: not known for good

  /// Asks for the writer once until it is told, and not again when it is the same: a flood of messages must
  /// not cost more than it is, and asking can take longer than a cycle.
  void add(const std::string& why, const WriterId& from) {
    ++count, newest = why;
    if (!writer.empty()) return;
    if (known_text.empty() || known != from) {
      const auto origin = backend->origin_of(from);
      writer = to_text(origin);
      known = from;
      known_text = origin.pid.empty() ? "" : writer;
    } else {
      writer = known_text;
    }
  }
};

template <class T>
class Reader {
 public:
  /// `newest`, if there is one, becomes the newest source time stamp of the samples taken.
  explicit Reader(std::unique_ptr<RawReader> raw, std::int64_t* newest = nullptr,
                  Refusals* refusals = nullptr)
      : raw_(std::move(raw)), newest_(newest), refusals_(refusals) {}
  /// The next sample that decodes; samples that do not are counted and skipped.
  bool take(T& value) {
    while (raw_->take(buffer_, info_)) {
      if (newest_ != nullptr) *newest_ = std::max(*newest_, info_.source_timestamp);
      if (decode(buffer_, value, &why_)) return true;
      ++undecodable_;
      if (refusals_ != nullptr) refusals_->add(why_, info_.writer);
    }
    return false;
  }
  /// The newest of what has arrived, or false when nothing has.
  bool take_newest(T& value) {
    bool any = false;
    while (take(value)) any = true;
    return any;
  }
  int matched() { return raw_->matched(); }
  const SampleInfo& info() const { return info_; }
  std::uint64_t undecodable() const { return undecodable_; }

 private:
  std::unique_ptr<RawReader> raw_;
  std::int64_t* newest_;
  Refusals* refusals_;
  Bytes buffer_;
  std::string why_;
  SampleInfo info_;
  std::uint64_t undecodable_ = 0;
};

/// One DDS participant. Everything made from it must be destroyed before it.
class Bus {
 public:
  Bus(Vendor vendor, const NetworkSettings& network, StreamDepth depth = {});

  template <class T>
  Writer<T> writer(const Topic<T>& topic) {
    EndpointQos qos = writer_qos(topic.qos, depth_);
    auto history = share(topic.qos, qos);
    return Writer<T>(backend_->writer(describe(topic), qos), std::move(history));
  }
  template <class T>
  Reader<T> reader(const Topic<T>& topic) {
    return Reader<T>(backend_->reader(describe(topic), reader_qos(topic.qos), &signal_), &taken_[topic.name],
                     &refusals_of(topic.name));
  }
  Backend& backend() { return *backend_; }
  Signal& signal() { return signal_; }
  Vendor vendor() const { return vendor_; }
  void set_depth(StreamDepth depth) { depth_ = depth; }
  /// Of each topic that is read the newest source time stamp among the samples taken, by the topic's name; 0
  /// = none.
  const std::map<std::string, std::int64_t>& taken() const { return taken_; }
  /// Of each topic that is read what was refused, by the topic's name.
  const std::map<std::string, Refusals>& refusals() const { return refusals_; }
  /// A message of this topic cannot be what its writer has to write; `why` names field and value.
  void refuse(const std::string& topic, const std::string& why, const WriterId& writer) {
    refusals_of(topic).add(why, writer);
  }
  /// Whoever writes from now on is asked for again.
  void refusals_told() {
    for (auto& [topic, refusals] : refusals_) refusals.writer.clear();
  }

 private:
  Refusals& refusals_of(const std::string& topic) {
    auto& refusals = refusals_[topic];
    refusals.backend = backend_.get();
    return refusals;
  }
  // Batches can be recorded from memory, unless the cluster is secured: then certificates decide who reads.
  std::unique_ptr<SharedHistory> share(QosKind kind, EndpointQos& qos) const;

  Vendor vendor_;
  bool secured_;
  std::map<std::string, std::int64_t> taken_;
  std::map<std::string, Refusals> refusals_;
  Signal signal_;
  std::unique_ptr<Backend> backend_;
  StreamDepth depth_;
};

}  // namespace trunnion::bus
