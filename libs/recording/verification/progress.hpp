// SPDX-License-Identifier: Apache-2.0
// How far a service has come, as its outputs tell: what verification waits for before it feeds more.
#pragma once

#include <compare>
#include <map>
#include <vector>

#include "verification/batch_rows.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

/// One line along which outputs ascend: a topic, for batches of one channel.
struct Track {
  const bus::TopicEntry* topic = nullptr;
  std::uint16_t channel = 0;
  auto operator<=>(const Track&) const =
      default;  // NOLINT(modernize-use-nullptr): a false alarm of clang-tidy 14
};

/// The topic by which an input came that a service has told the tick of.
const bus::TopicEntry* topic_of(idl::stream::Input input);

/// Of batches: epoch and the cycle after the last. Of the drive's feedback: executed cycles and tick. Of the
/// PLC's input log: its tick. Of what is numbered: the number. Of an input: 0 and how many were applied, as
/// the feedback or the log tells. Otherwise: 0 and how many messages there were.
struct Place {
  std::uint64_t major = 0, minor = 0;
  auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr)
};

struct Mark {
  Track track;
  Place place;
};

class Progress {
 public:
  /// Returns where this message has brought its track, and whether that is further than before.
  std::pair<Mark, bool> observe(const StoredMessage& message);
  bool reached(const Mark& mark) const;
  bool reached(const std::vector<Mark>& marks) const;
  Place at(const Track& track) const;

 private:
  template <class T, class PlaceOf>
  bool numbered(const StoredMessage& message, const char* handle, T& value, PlaceOf place_of, Mark& mark);
  void count(const std::vector<idl::stream::AppliedInput>& applied);
  std::map<Track, Place> places_;
  MessageRows rows_;
  idl::stream::Feedback feedback_;
  idl::stream::InputLog input_log_;
  idl::stream::StreamRequest stream_request_;
  idl::channel::AuxiliaryRequest auxiliary_request_;
  idl::channel::CycleRequest cycle_request_;
  idl::plc::AuxiliaryDone auxiliary_done_;
  idl::plc::MacroSignal macro_signal_;
};

}  // namespace trunnion::verification
