// SPDX-License-Identifier: Apache-2.0
#include "topic_source.hpp"

#include <algorithm>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"

namespace trunnion::recorder {

TopicSource::TopicSource(bus::Backend& backend, const bus::TopicEntry& entry, bus::Signal* signal)
    : backend_(&backend), entry_(&entry), signal_(signal) {
  if (!is_stream()) open_reader();
}

bool TopicSource::is_feedback() const { return entry_->description.name == topics::feedback.name; }

void TopicSource::open_reader() {
  reader_needed_ = true;
  if (reader_ != nullptr) return;
  reader_came_late_ = began_ != 0;
  opened_ = bus::source_time();
  const bool with_past = is_event() || has_past() || reader_came_late_;
  reader_ = backend_->reader(entry_->description, {with_past, 0}, signal_);
}

// A process that is suspended for longer than its lease is no writer for DDS until it continues; its memory
// is there all the time.
void TopicSource::see(const std::vector<bus::DiscoveredWriter>& writers) {
  using bus::SharedHistoryReader;
  if (!is_stream()) return;
  for (auto& [address, history] : histories_)
    history.ended = SharedHistoryReader::find(address).place == SharedHistoryReader::Place::gone;
  reader_needed_ = false;
  for (const auto& writer : writers) {
    // One of another contract is not matched either.
    if (writer.topic != entry_->description.name || writer.wire_type != entry_->description.wire_type)
      continue;
    const auto known = histories_.find(writer.user_data);
    if (known != histories_.end()) {
      known->second.writer = writer.id;
      continue;
    }
    auto found = SharedHistoryReader::find(writer.user_data);
    if (found.place == SharedHistoryReader::Place::here)
      histories_[writer.user_data] = {writer.id, std::move(found.reader)};
    else if (found.place == SharedHistoryReader::Place::elsewhere)
      open_reader();
  }
}

bool TopicSource::take(bus::Bytes& cdr, bus::SampleInfo& info) {
  if (take_from_memory(cdr, info) || take_by_dds(cdr, info)) return true;
  // Not before: as long as there are samples of theirs, it must be known whose they are.
  close_ended();
  if (!reader_needed_) reader_.reset();
  return false;
}

bool TopicSource::take_from_memory(bus::Bytes& cdr, bus::SampleInfo& info) {
  for (auto& [address, history] : histories_)
    while (history.reader->take(cdr, info))
      if (recorded(info, true)) return true;
  return false;
}

// `from_begin`: what was written before does not count.
bool TopicSource::recorded(const bus::SampleInfo& info, bool from_begin) {
  if (has_past() || (began_ != 0 && (!from_begin || info.source_timestamp >= began_))) return true;
  left_out_ = std::max(left_out_, info.source_timestamp);
  return false;
}

bool TopicSource::take_by_dds(bus::Bytes& cdr, bus::SampleInfo& info) {
  if (reader_ == nullptr) return false;
  const auto in_memory = [&](const auto& entry) { return entry.second.writer == info.writer; };
  while (reader_->take(cdr, info)) {
    if (std::any_of(histories_.begin(), histories_.end(), in_memory)) continue;
    if (is_event() && info.source_timestamp < opened_) continue;
    if (recorded(info, reader_came_late_)) return true;
  }
  return false;
}

void TopicSource::close_ended() {
  for (auto at = histories_.begin(); at != histories_.end();) {
    if (at->second.ended) overwritten_ += at->second.reader->lost();
    at = at->second.ended ? histories_.erase(at) : std::next(at);
  }
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
