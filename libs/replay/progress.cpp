#include "replay/progress.hpp"

#include <algorithm>

#include "bus/cdr.hpp"

namespace trunnion::replay {

std::pair<Mark, bool> Progress::observe(const StoredMessage& message) {
  Mark mark{{message.topic, 0}, {}};
  if (!is_cyclic(*message.topic)) {
    mark.place.minor = at(mark.track).minor + 1;
  } else if (message.topic->handle == "feedback_frame") {
    if (!bus::decode(message.cdr, feedback_)) return {mark, false};
    mark.place = {feedback_.first + feedback_.count, feedback_.tick};
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

}  // namespace trunnion::replay
