// SPDX-License-Identifier: Apache-2.0
#include "verification/progress.hpp"

#include <algorithm>

#include "bus/codec.hpp"
#include "contracts/topics.hpp"
#include "text/utf8.hpp"

namespace trunnion::verification {

const bus::TopicEntry* topic_of(idl::stream::Input input) {
  // Its handle is its name in the contract, in small letters.
  return bus::find_topic(
      text::lower_case(bus::EnumNames<idl::stream::Input>::names[static_cast<std::size_t>(input)]));
}

void Progress::count(const std::vector<idl::stream::AppliedInput>& applied) {
  for (const auto& input : applied) ++places_[{topic_of(input.input), 0}].minor;
}

template <class T, class PlaceOf>
bool Progress::numbered(const StoredMessage& message, const char* handle, T& value, PlaceOf place_of,
                        Mark& mark) {
  if (message.topic->handle != handle || !bus::decode(message.cdr, value)) return false;
  mark.track.channel = value.channel;
  mark.place = place_of(value);
  return true;
}

std::pair<Mark, bool> Progress::observe(const StoredMessage& message) {
  Mark mark{{message.topic, 0}, {}};
  if (message.topic->handle == "plc_input_log") {
    if (!bus::decode(message.cdr, input_log_)) return {mark, false};
    mark.place.minor = input_log_.tick;
    count(input_log_.applied);
  } else if (!is_cyclic(*message.topic)) {
    // A state that was there before the recording began is written again, so counting would not do.
    if (!numbered(
            message, "auxiliary_done", auxiliary_done_,
            [](const auto& v) {
              return Place{0, v.number};
            },
            mark) &&
        !numbered(
            message, "macro_signal", macro_signal_,
            [](const auto& v) {
              return Place{0, v.number};
            },
            mark) &&
        !numbered(
            message, "auxiliary_request", auxiliary_request_,
            [](const auto& v) {
              return Place{v.number, v.kind == idl::channel::AuxiliaryKind::NO_AUXILIARY ? 1u : 0u};
            },
            mark) &&
        !numbered(
            message, "cycle_request", cycle_request_,
            [](const auto& v) {
              return Place{v.number, static_cast<std::uint64_t>(v.caller)};
            },
            mark) &&
        !numbered(
            message, "stream_request", stream_request_,
            [](const auto& v) {
              return Place{0, v.request};
            },
            mark))
      mark.place.minor = at(mark.track).minor + 1;
  } else if (message.topic->handle == "feedback") {
    if (!bus::decode(message.cdr, feedback_)) return {mark, false};
    mark.place = {feedback_.first + feedback_.count, feedback_.tick};
    count(feedback_.applied);
  } else {
    if (!rows_.load(*message.topic, message.cdr)) return {mark, false};
    mark.track.channel = rows_.span().channel;
    mark.place = {rows_.span().epoch, rows_.span().first + rows_.span().count};
  }
  auto& place = places_[mark.track];
  const bool further = mark.place > place;
  place = std::max(place, mark.place);
  return {mark, further};
}

Place Progress::at(const Track& track) const {
  const auto found = places_.find(track);
  return found == places_.end() ? Place{} : found->second;
}

bool Progress::reached(const Mark& mark) const { return at(mark.track) >= mark.place; }

bool Progress::reached(const std::vector<Mark>& marks) const {
  return std::all_of(marks.begin(), marks.end(), [this](const Mark& mark) { return reached(mark); });
}

}  // namespace trunnion::verification
