#include "topic_source.hpp"

#include <algorithm>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"

namespace trunnion::recorder {

TopicSource::TopicSource(bus::Backend& backend, const bus::TopicEntry& entry, bus::Signal* signal)
    : backend_(&backend), entry_(&entry), signal_(signal) {
  if (!is_stream()) open_reader();
}

bool TopicSource::is_feedback() const { return entry_->description.name == topics::feedback_frame.name; }

void TopicSource::open_reader() {
  reader_needed_ = true;
  if (reader_ != nullptr) return;
  reader_came_late_ = began_ != 0;
  const bool with_past = bus::reader_qos(entry_->qos).transient_local && (has_past() || reader_came_late_);
  reader_ = backend_->reader(entry_->description, {with_past, 0}, signal_);
}

void TopicSource::see(const std::vector<bus::DiscoveredWriter>& writers) {
  if (!is_stream()) return;
  for (auto& [id, history] : histories_)
    history.ended = std::none_of(writers.begin(), writers.end(),
                                 [id = id](const bus::DiscoveredWriter& writer) { return writer.id == id; });
  reader_needed_ = false;
  for (const auto& writer : writers) {
    // One of another contract is not matched either.
    if (writer.topic != entry_->description.name || writer.wire_type != entry_->description.wire_type ||
        histories_.count(writer.id) != 0)
      continue;
    auto found = bus::SharedHistoryReader::find(writer.user_data);
    if (found.place == bus::SharedHistoryReader::Place::here)
      histories_[writer.id].reader = std::move(found.reader);
    else if (found.place == bus::SharedHistoryReader::Place::elsewhere)
      open_reader();
  }
}

bool TopicSource::take(bus::Bytes& cdr, bus::SampleInfo& info) {
  return take_from_memory(cdr, info) || take_by_dds(cdr, info);
}

bool TopicSource::take_from_memory(bus::Bytes& cdr, bus::SampleInfo& info) {
  for (auto at = histories_.begin(); at != histories_.end();) {
    auto& [reader, ended] = at->second;
    while (reader->take(cdr, info))
      if (has_past() || (began_ != 0 && info.source_timestamp >= began_)) return true;
    if (ended) overwritten_ += reader->lost();
    at = ended ? histories_.erase(at) : std::next(at);
  }
  return false;
}

bool TopicSource::take_by_dds(bus::Bytes& cdr, bus::SampleInfo& info) {
  if (reader_ == nullptr) return false;
  while (reader_->take(cdr, info)) {
    if (histories_.count(info.writer) != 0) continue;
    if (has_past() || (began_ != 0 && (!reader_came_late_ || info.source_timestamp >= began_))) return true;
  }
  if (!reader_needed_) reader_.reset();
  return false;
}

bool TopicSource::has_writer() const {
  return !histories_.empty() || (reader_ != nullptr && reader_->matched() > 0);
}

std::uint64_t TopicSource::overwritten() const {
  std::uint64_t sum = overwritten_;
  for (const auto& [id, history] : histories_) sum += history.reader->lost();
  return sum;
}

}  // namespace trunnion::recorder
