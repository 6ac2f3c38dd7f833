// SPDX-License-Identifier: Apache-2.0
#include "verification/alignment.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

#include "bus/codec.hpp"
#include "contracts/types.hpp"

namespace trunnion::verification {
namespace {

using idl::channel::CommandKind;
using idl::channel::RunState;

constexpr auto none = std::numeric_limits<std::uint64_t>::max();

// Cycles of a run, and the times of its start and its end.
struct Window {
  std::uint64_t begin = none, end = none;
  std::uint64_t started = 0, ended = none;
  bool has(std::uint64_t first, std::uint32_t count) const { return first >= begin && first + count <= end; }
};

class Runs {
 public:
  Runs(const StoredRecording& recording, std::uint16_t channel) : channel_(channel) {
    for (const auto& message : recording.messages) sort(message);
    std::sort(starts_.begin(), starts_.end());
  }

  Window find(unsigned run) const {
    unsigned found = 0;
    std::uint64_t time = 0;
    for (const auto start : program_starts())
      if (++found == run) time = start;
    if (time == 0)
      throw std::runtime_error("the recording has no start " + std::to_string(run) +
                               " of a program in channel " + std::to_string(channel_) + ", it has " +
                               std::to_string(found));
    Window window{first_motion(time), none, time, none};
    // Its end is the first state at rest behind it.
    const auto end = std::find_if(states_.upper_bound(time), states_.end(), [&](const auto& state) {
      return state.second.first == RunState::IDLE && state.second.second > window.begin;
    });
    if (end != states_.end()) {
      window.end = first_motion(end->first);
      window.ended = end->first;
    }
    return window;
  }

 private:
  void sort(const StoredMessage& message) {
    const auto& handle = message.topic->handle;
    if (handle == "channel_request" && bus::decode(message.cdr, request_)) {
      if (request_.channel == channel_ &&
          (request_.command == CommandKind::CYCLE_START || request_.command == CommandKind::START_FROM_LINE))
        requests_[{request_.client, request_.number}] = message.time;
    } else if (handle == "channel_reply" && bus::decode(message.cdr, reply_)) {
      if (reply_.accepted) accepted_.insert({reply_.client, reply_.number});
    } else if (handle == "channel_state" && bus::decode(message.cdr, state_)) {
      if (state_.channel == channel_) states_[message.time] = {state_.state, state_.cycle};
    } else if (handle == "path_batch" && bus::decode(message.cdr, batch_)) {
      if (batch_.channel == channel_ && batch_.starts) starts_.emplace_back(message.time, batch_.first);
    }
  }

  // The requests that were accepted with the channel idle.
  std::vector<std::uint64_t> program_starts() const {
    std::vector<std::uint64_t> times;
    for (const auto& [asker, time] : requests_) {
      if (!accepted_.contains(asker)) continue;
      const auto after = states_.upper_bound(time);
      if (after != states_.begin() && std::prev(after)->second.first == RunState::IDLE) times.push_back(time);
    }
    std::sort(times.begin(), times.end());
    return times;
  }

  std::uint64_t first_motion(std::uint64_t time) const {
    for (const auto& [written, first] : starts_)
      if (written > time) return first;
    return none;
  }

  std::uint16_t channel_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint64_t> requests_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> accepted_;
  std::map<std::uint64_t, std::pair<RunState, std::uint64_t>> states_;  // by time: state and cycle
  std::vector<std::pair<std::uint64_t, std::uint64_t>> starts_;         // time and first cycle of motions
  idl::channel::ChannelRequest request_;
  idl::channel::ChannelReply reply_;
  idl::channel::ChannelState state_;
  idl::stream::PathBatch batch_;
};

class Shift {
 public:
  explicit Shift(const Window& window) : window_(window) {}

  /// False when the message is not of the run.
  bool apply(StoredMessage& message) {
    const auto& type = message.topic->type;
    if (type == bus::Fields<idl::stream::PathBatch>::name) return batch(message, path_);
    if (type == bus::Fields<idl::stream::AxisBatch>::name) return batch(message, axis_);
    if (type == bus::Fields<idl::stream::Feedback>::name) return feedback(message);
    if (message.topic->handle == "auxiliary_request") return request(message);
    if (message.topic->handle == "macro_signal") return answer(message, signal_);
    return message.topic->handle == "auxiliary_done" && answer(message, done_);
  }

 private:
  void shift(idl::stream::ChannelSnapshot& snapshot) const {
    snapshot.cycle -= std::min(snapshot.cycle, window_.begin);
    snapshot.program_revision = 0;
  }
  template <class Batch>
  bool batch(StoredMessage& message, Batch& value) const {
    if (!bus::decode(message.cdr, value) || !window_.has(value.first, value.count)) return false;
    value.first -= window_.begin;
    value.revision = 0;
    shift(value.snapshot);
    bus::encode(value, message.cdr);
    return true;
  }
  // Its messages need not begin with the run.
  bool feedback(StoredMessage& message) {
    auto& f = feedback_;
    if (!bus::decode(message.cdr, f) || f.first + f.count <= window_.begin || f.first >= window_.end)
      return false;
    const auto before = static_cast<std::uint32_t>(window_.begin > f.first ? window_.begin - f.first : 0);
    const auto kept = static_cast<std::uint32_t>(std::min<std::uint64_t>(f.count, window_.end - f.first));
    const auto cut = [&](std::vector<double>& rows, std::size_t width) {
      rows.resize(std::min<std::size_t>(rows.size(), kept * width));
      rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(
                                                  std::min<std::size_t>(rows.size(), before * width)));
    };
    cut(f.commanded, f.axis_count), cut(f.actual, f.axis_count), cut(f.spindle_angle, f.spindle_speed.size());
    f.first = f.first + before - window_.begin;
    f.count = kept - before;
    f.revision = 0;
    bus::encode(f, message.cdr);
    return f.count > 0;
  }
  bool request(StoredMessage& message) {
    auto& r = request_;
    // At the cycle of the start there are functions of the run before, too.
    if (message.time < window_.started || message.time > window_.ended || !bus::decode(message.cdr, r))
      return false;
    const auto first = first_function_.try_emplace(r.channel, r.number).first->second;
    functions_.insert({r.channel, r.number});
    r.number -= first - 1;
    r.cycle -= std::min(r.cycle, window_.begin);
    bus::encode(r, message.cdr);
    return true;
  }
  template <class Answer>
  bool answer(StoredMessage& message, Answer& value) const {
    if (!bus::decode(message.cdr, value) || !functions_.contains({value.channel, value.number})) return false;
    value.number -= first_function_.at(value.channel) - 1;
    bus::encode(value, message.cdr);
    return true;
  }

  Window window_;
  std::map<std::uint16_t, std::uint32_t> first_function_;
  std::set<std::pair<std::uint16_t, std::uint32_t>> functions_;
  idl::stream::PathBatch path_;
  idl::stream::AxisBatch axis_;
  idl::stream::Feedback feedback_;
  idl::channel::AuxiliaryRequest request_;
  idl::plc::AuxiliaryDone done_;
  idl::plc::MacroSignal signal_;
};

}  // namespace

const std::set<std::string>& aligned_topics() {
  static const std::set<std::string> handles = {"path_batch",     "kinematics_batch", "compensation_batch",
                                                "gantry_batch",   "feedback",         "auxiliary_request",
                                                "auxiliary_done", "macro_signal"};
  return handles;
}

std::vector<StoredMessage> aligned(const StoredRecording& recording, std::uint16_t channel, unsigned run) {
  const auto window = Runs(recording, channel).find(run);
  if (window.begin == none) throw std::runtime_error("the run moves nothing");
  Shift shift(window);
  std::vector<const StoredMessage*> order;
  for (const auto& message : recording.messages)
    if (aligned_topics().contains(message.topic->handle)) order.push_back(&message);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) { return a->time < b->time; });
  std::vector<StoredMessage> result;
  for (const auto* message : order) {
    auto copy = *message;
    if (shift.apply(copy)) result.push_back(std::move(copy));
  }
  return result;
}

}  // namespace trunnion::verification
