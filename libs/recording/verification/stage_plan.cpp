// SPDX-License-Identifier: Apache-2.0
#include "verification/stage_plan.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

#include "bus/codec.hpp"
#include "contracts/topics.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/parameters.hpp"
#include "machine/services.hpp"
#include "recording/cycle_coverage.hpp"
#include "stream/stage_names.hpp"

namespace trunnion::verification {
namespace {

// Cycles a stage may be behind what it is fed. A stage keeps 1024 cycles of input, and 2048 of feedback.
constexpr std::uint64_t window = 256;

struct Input {
  const StoredMessage* message = nullptr;
  BatchSpan span;
};

struct ReportedCycles {
  const StoredMessage* message = nullptr;
  std::uint64_t executed = 0;
};

struct Revision {
  const StoredMessage* message = nullptr;
  std::uint64_t revision = 0, lead = 0;
};

bool earlier(const BatchSpan& a, const BatchSpan& b) {
  return std::pair(a.epoch, a.first) < std::pair(b.epoch, b.first);
}

struct Lane {
  std::vector<Input> inputs;    // ascending
  std::vector<BatchSpan> done;  // recorded outputs that follow from them, ascending
  std::size_t next = 0;
  std::uint64_t joins_at = 0;  // executed cycles from which a stage can begin in the middle of a motion
  bool joined = false;         // its first output is waited for
};

class StagePlan {
 public:
  StagePlan(const StoredRecording& recording, const machine::ServiceDefinition& stage, VerifyPlan& plan)
      : recording_(recording), stage_(stage), plan_(plan) {}

  void make() {
    sort_messages();
    for (auto& [channel, lane] : lanes_) begin_lane(channel, lane);
    choose_outputs();
    merge();
    for (const auto& [channel, lane] : lanes_)
      if (!lane.done.empty()) plan_.end.push_back(mark_of(channel, lane.done.back()));
  }

 private:
  void sort_messages() {
    MessageRows rows;
    for (const auto& message : recording_.messages) {
      const auto& handle = message.topic->handle;
      if (handle == stage_.input) {
        if (rows.load(*message.topic, message.cdr))
          lanes_[rows.span().channel].inputs.push_back({&message, rows.span()});
      } else if (handle == "feedback") {
        if (rows.load(*message.topic, message.cdr))
          feedback_.push_back({&message, rows.span().first + rows.span().count});
      } else if (handle == "parameter_set") {
        idl::parameters::ParameterSet set;
        if (!bus::decode(message.cdr, set)) continue;
        revisions_.push_back(
            {&message, set.revision,
             static_cast<std::uint64_t>(machine::parameters_of(set).integer(parameter::stream_lead))});
      }
    }
    if (revisions_.empty()) throw std::runtime_error("the recording has no parameters");
    lead_ = revisions_.front().lead;
    const auto by_executed = [](const ReportedCycles& a, const ReportedCycles& b) {
      return a.executed < b.executed;
    };
    std::stable_sort(feedback_.begin(), feedback_.end(), by_executed);
    std::stable_sort(revisions_.begin(), revisions_.end(),
                     [](const Revision& a, const Revision& b) { return a.revision < b.revision; });
    for (auto& [channel, lane] : lanes_) {
      auto& inputs = lane.inputs;
      std::stable_sort(inputs.begin(), inputs.end(),
                       [](const Input& a, const Input& b) { return earlier(a.span, b.span); });
      // Of the replicas of a batch the first to arrive is what the stage took.
      inputs.erase(std::unique(inputs.begin(), inputs.end(),
                               [](const Input& a, const Input& b) {
                                 return a.span.epoch == b.span.epoch && a.span.first == b.span.first;
                               }),
                   inputs.end());
    }
  }

  // Leaves out the inputs before the first from which a stage can know its state: a start, or the batch
  // behind a consistent cut in the feedback.
  void begin_lane(std::uint16_t channel, Lane& lane) {
    auto& inputs = lane.inputs;
    if (!inputs.front().span.starts && !join(channel, lane)) {
      const auto start =
          std::find_if(inputs.begin(), inputs.end(), [](const Input& input) { return input.span.starts; });
      inputs.erase(inputs.begin(), start);
    }
    recording::CycleCoverage coverage;
    std::optional<std::uint32_t> epoch;
    for (const auto& input : inputs) {
      if (epoch != input.span.epoch) coverage = {};
      epoch = input.span.epoch;
      coverage.add(input.span.first, input.span.count, input.span.starts, input.span.ends);
      if (const auto gaps = coverage.gaps(1); !gaps.empty())
        throw std::runtime_error("the recording misses cycles " + std::to_string(gaps[0].first) + " to " +
                                 std::to_string(gaps[0].first + gaps[0].count - 1) + " of " + stage_.input);
    }
  }

  bool join(std::uint16_t channel, Lane& lane) {
    auto& inputs = lane.inputs;
    idl::stream::Feedback batch;
    std::optional<std::uint64_t> first_row;
    for (const auto& feedback : feedback_) {
      if (!bus::decode(feedback.message->cdr, batch)) continue;
      if (!first_row && batch.count > 0) first_row = batch.first;
      for (const auto& echo : batch.channels) {
        if (echo.channel != channel || !echo.active) continue;
        const auto state = std::find_if(echo.states.begin(), echo.states.end(),
                                        [&](const auto& s) { return s.stage == stream::stage_of(stage_); });
        // What is computed next looks back by the lead.
        if (state == echo.states.end() || !first_row || state->cycle < *first_row + lead_) continue;
        const auto next = std::find_if(inputs.begin(), inputs.end(), [&](const Input& input) {
          return input.span.epoch == echo.epoch && input.span.first == state->cycle + 1;
        });
        if (next == inputs.end()) continue;
        inputs.erase(inputs.begin(), next);
        lane.joins_at = feedback.executed;
        return true;
      }
    }
    return false;
  }

  // The recorded outputs that follow from inputs that are fed.
  void choose_outputs() {
    MessageRows rows;
    for (const auto& message : recording_.messages) {
      if (message.topic->handle != stage_.output || !rows.load(*message.topic, message.cdr)) continue;
      auto& lane = lanes_[rows.span().channel];
      const auto found =
          std::lower_bound(lane.inputs.begin(), lane.inputs.end(), rows.span(),
                           [](const Input& a, const BatchSpan& b) { return earlier(a.span, b); });
      if (found == lane.inputs.end() || earlier(rows.span(), found->span)) continue;
      plan_.expected.push_back(message);
      plan_.cycles += rows.rows();
      lane.done.push_back(rows.span());
    }
    for (auto& [channel, lane] : lanes_) std::stable_sort(lane.done.begin(), lane.done.end(), earlier);
  }

  Mark mark_of(std::uint16_t channel, const BatchSpan& span) const {
    return {{bus::find_topic(stage_.output), channel}, {span.epoch, span.first + span.count}};
  }

  // The executed cycles that the channel's credit for this batch needed, in real time. The first batch comes
  // with the cut that it follows, or before the first cycle of its motion: a process that has just started
  // would join at the later cut of newer feedback.
  std::uint64_t credit(const Lane& lane) const {
    const auto& span = lane.inputs[lane.next].span;
    if (lane.next == 0) return lane.joins_at > 0 ? lane.joins_at : span.first;
    const auto end = span.first + span.count;
    return std::max(lane.joins_at, end > lead_ ? end - lead_ : 0);
  }

  void merge() {
    std::size_t fed = 0;
    std::uint64_t executed = 0;
    for (;;) {
      Lane* best = nullptr;
      std::uint16_t best_channel = 0;
      std::uint64_t best_credit = std::numeric_limits<std::uint64_t>::max();
      bool any = false;
      for (auto& [channel, lane] : lanes_) {
        if (lane.next == lane.inputs.size()) continue;
        any = true;
        const auto needed = credit(lane);
        if ((needed <= executed || fed == feedback_.size()) && needed < best_credit)
          best = &lane, best_channel = channel, best_credit = needed;
      }
      if (best != nullptr) {
        feed_batch(best_channel, *best);
      } else if (any) {
        executed = feedback_[fed].executed;
        Step step{feedback_[fed++].message, {}, false};
        // With newer feedback at hand, and its inputs still on the way, it would join at a later cut.
        for (auto& [channel, lane] : lanes_)
          if (lane.next > 0 && !lane.done.empty() && !lane.joined) {
            step.needs.push_back(mark_of(channel, lane.done.front()));
            lane.joined = true;
          }
        plan_.steps.push_back(std::move(step));
      } else {
        break;
      }
    }
    if (plan_.steps.empty()) plan_.steps.push_back({revisions_.front().message, {}, false});
  }

  void feed_batch(std::uint16_t channel, Lane& lane) {
    const auto& input = lane.inputs[lane.next++];
    const Revision* wanted = nullptr;
    for (const auto& revision : revisions_)
      if (revision.revision <= input.span.revision && revision.revision > published_) wanted = &revision;
    if (wanted != nullptr) {
      // A stage knows two revisions, so what was made with older ones comes first.
      Step step{wanted->message, {}, false};
      for (const auto& [number, other] : lanes_)
        if (const auto* last = last_done(
                other, other.next == 0 ? nullptr : &other.inputs[other.next - 1].span, number == channel))
          step.needs.push_back(mark_of(number, *last));
      plan_.steps.push_back(std::move(step));
      published_ = wanted->revision;
    }
    Step step{input.message, {}, false};
    auto limit = input.span;
    if (!limit.starts) limit.first -= std::min(limit.first, window);
    if (const auto* last = last_done(lane, &limit, true)) step.needs.push_back(mark_of(channel, *last));
    plan_.steps.push_back(std::move(step));
  }

  // The newest recorded output up to `limit`; `before`: without the one there.
  static const BatchSpan* last_done(const Lane& lane, const BatchSpan* limit, bool before) {
    if (limit == nullptr) return nullptr;
    const auto end = before ? std::lower_bound(lane.done.begin(), lane.done.end(), *limit, earlier)
                            : std::upper_bound(lane.done.begin(), lane.done.end(), *limit, earlier);
    return end == lane.done.begin() ? nullptr : &*std::prev(end);
  }

  const StoredRecording& recording_;
  const machine::ServiceDefinition& stage_;
  VerifyPlan& plan_;
  std::map<std::uint16_t, Lane> lanes_;
  std::vector<ReportedCycles> feedback_;
  std::vector<Revision> revisions_;
  std::uint64_t lead_ = 32, published_ = 0;
};

}  // namespace

const machine::ServiceDefinition* find_stage(const std::string& service) {
  const auto* definition = machine::find_service(service);
  return definition != nullptr && definition->transforms() ? definition : nullptr;
}

void plan_stage(const StoredRecording& recording, const machine::ServiceDefinition& stage, VerifyPlan& plan) {
  StagePlan(recording, stage, plan).make();
}

}  // namespace trunnion::verification
