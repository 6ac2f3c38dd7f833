// SPDX-License-Identifier: Apache-2.0
// The shell of kinematics, compensation and gantry: setpoint batches in and out, joining, restarts,
// revisions.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>

#include "machine/alarm_constants.hpp"
#include "machine/gantry_pairs.hpp"
#include "machine/kinematics.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/stream_settings.hpp"
#include "service/node.hpp"
#include "service/parameter_client.hpp"
#include "stream/batch_reader.hpp"
#include "stream/batch_window.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::stream {

/// The number of batches that a writer of the stream must keep: twice the lead, in batches, and a few, for
/// every channel. Never fewer than 1024: in virtual time that is how late a recorder may be before cycles are
/// lost to it, about a quarter of a second.
inline int stream_depth(const machine::StreamSettings& stream, std::size_t channels) {
  const auto batches = 2 * stream.ahead / std::max(1u, stream.feedback_batch) + 6;
  return static_cast<int>(std::max<std::size_t>(1024, batches * std::max<std::size_t>(1, channels)));
}

/// Topic on which a stage writes while it is on standby, only compared with the one it is to replace.
inline std::string standby_name(const std::string& topic) { return topic + topics::standby_suffix; }

/// Raises the alarm of replicas that differ, once until it is reset: it stops the machine.
inline void raise_difference(service::AlarmBoard& alarms, const auto& first, const auto& second) {
  if (alarms.active(alarm::replicas_differ, first.channel)) return;
  const auto what = difference(first, second);
  if (!what) return;
  alarms.raise(alarm::replicas_differ, first.channel, what->text, what->cycle);
  alarms.release(alarm::replicas_differ, first.channel);
}

template <class In>
class StageService : public service::Service {
 public:
  using MakeCore = std::function<std::unique_ptr<StageCore<In>>()>;

  StageService(service::Node& node, Stage stage, const bus::Topic<In>& in,
               const bus::Topic<idl::stream::AxisBatch>& out, MakeCore make_core)
      : node_(node),
        parameters_(node.bus()),
        stage_(stage),
        in_topic_(in),
        out_topic_(out),
        make_core_(std::move(make_core)),
        progress_writer_(node.bus().writer(topics::stage_progress)) {}

  /// On standby it computes what it would if it took part, and writes it beside the stream (standby_name).
  static constexpr bool works_on_standby = true;

  void pump() override {
    parameters_.poll();
    if (!reader_) {
      if (!parameters_.newest()) return;
      start();
    }
    if (standby_ && !node_.on_standby()) take_part();
    follow_feedback();
    idl::stream::Feedback feedback;
    while (feedback_reader_ && feedback_reader_->take(feedback)) {
      feedback_.put(feedback);
      std::swap(newest_feedback_, feedback);
      have_feedback_ = true;
      on_feedback(newest_feedback_);
    }
    return_to_the_drive();
    while (reader_->take(batch_)) {
      ++messages_in_;
      const auto channel = batch_.channel;
      if (channel >= node_.options().machine.channels) {
        reader_->refuse("channel: " + std::to_string(channel) + ", the machine has " +
                        std::to_string(node_.options().machine.channels));
        continue;
      }
      auto& window = lane(channel).window;
      if (window.put(batch_) == Arrival::differs)
        raise_difference(node_.alarms(), *window.first_arrival(batch_), batch_);
    }
    for (auto& [channel, lane] : lanes_) {
      run(channel, lane);
      report_progress(channel, lane);
    }
  }
  double period() const override { return 0.02; }
  bool axis_concerns(std::uint16_t axis, std::uint16_t channel) const override {
    return parameters_.newest() && machine::axis_moves_with(*parameters_.newest(), axis, channel);
  }

  // Batches that no channel wrote may have led it to where the stream never comes.
  void alarms_reset(std::uint16_t) override {
    if (!reader_) return;
    present_reader_.emplace(present_reader(node_.bus(), topics::feedback));
    present_until_ = service::monotonic_seconds() + 2;
  }

  service::Health health() const override {
    using idl::service::Lifecycle;
    service::Health health;
    health.lifecycle = !reader_                      ? Lifecycle::UNCONFIGURED
                       : have_feedback_ && !standby_ ? Lifecycle::ACTIVE
                                                     : Lifecycle::INACTIVE;
    health.detail = !fault_.empty()   ? fault_
                    : !reader_        ? "waiting for parameters"
                    : !have_feedback_ ? "waiting for the drive"
                                      : waiting_for();
    if (!fault_.empty()) health.lifecycle = Lifecycle::FAULT;
    health.messages_in = messages_in_;
    health.messages_out = messages_out_;
    health.cycles_lost = cycles_lost_;
    health.revision = parameters_.newest() ? parameters_.newest()->revision : 0;
    if (node_.on_standby()) health.in_step = reader_ && have_feedback_ && fault_.empty();
    for (const auto& [channel, lane] : lanes_)
      health.in_step = health.in_step && lane.in_step && lane.settled;
    return health;
  }

 protected:
  /// True when the computation itself needs the feedback. Other stages read it only until they are in step.
  virtual bool needs_feedback() const { return false; }
  /// For supervision that does not belong to a setpoint.
  virtual void on_feedback(const idl::stream::Feedback&) {}
  service::Node& node_;
  service::ParameterClient parameters_;

 private:
  struct Lane {
    BatchWindow<In> window;
    std::unique_ptr<StageCore<In>> core;
    std::uint64_t revision = 0;
    std::optional<StateValues> cut;  // to continue from; a core cannot load it before it is configured
    bool in_step = false;
    bool settled = false;  // since it is in step it has computed all input, and its output has a reader
    double gap_since = 0;
    bool at_rest = false;  // the newest batch it computed was the last of a motion
    bool reported_at_rest = false;
    idl::stream::StageProgress reported;
    double reported_at = 0;
  };

  void start() {
    const auto& p = *parameters_.newest();
    const machine::StreamSettings stream(p, node_.options().virtual_time);
    node_.bus().set_depth({stream_depth(stream, node_.options().machine.channels)});
    ahead_ = stream.ahead;
    const auto& services = node_.options().machine.services;
    replicated_ = std::count_if(services.begin(), services.end(),
                                [&](const auto& entry) { return entry.service == stage_name(stage_); }) > 1;
    standby_ = node_.on_standby();
    const auto standby_topic = standby_name(out_topic_.name);
    auto out = out_topic_;
    if (standby_) out.name = standby_topic.c_str();
    writer_.emplace(node_.bus().writer(out));
    feedback_reader_.emplace(node_.bus(), topics::feedback);
    reader_.emplace(node_.bus(), in_topic_);
    for (const auto& entry : services)
      if (entry.service == "channel") lane(static_cast<std::uint16_t>(entry.channel));
  }

  // From the batch it computes next on; what it wrote on standby the others have from the service it
  // replaces.
  void take_part() {
    standby_ = false;
    writer_.emplace(node_.bus().writer(out_topic_));
    for (auto& [channel, lane] : lanes_) lane.settled = false;
  }

  // The reason why it is not in step.
  std::string waiting_for() const {
    for (const auto& [channel, lane] : lanes_) {
      if (lane.in_step && lane.settled) continue;
      const auto what = !lane.in_step             ? "the consistent cut"
                        : lane.window.has_next()  ? "parameters"
                        : writer_->matched() == 0 ? "a reader"
                                                  : "the next setpoint batch";
      return std::string("waiting for ") + what + " of channel " + std::to_string(channel);
    }
    return "";
  }

  // Ten times a second; of a stage with replicas also whenever as much was computed as may be written ahead,
  // because the channel waits for it.
  void report_progress(std::uint16_t channel, Lane& lane) {
    if (lane.in_step && !lane.settled) lane.settled = !lane.window.has_next() && writer_->matched() > 0;
    if (standby_) return;
    const idl::stream::StageProgress progress{stage_,
                                              static_cast<std::uint8_t>(node_.options().replica),
                                              channel,
                                              lane.in_step && lane.settled,
                                              lane.window.epoch(),
                                              lane.window.next()};
    const auto& reported = lane.reported;
    const bool news =
        replicated_ && (progress.in_step != reported.in_step || progress.epoch != reported.epoch ||
                        progress.next >= reported.next + ahead_ || lane.at_rest != lane.reported_at_rest);
    const double now = service::monotonic_seconds();
    if (!news && now - lane.reported_at <= 0.1) return;
    lane.reported = progress;
    lane.reported_at = now;
    lane.reported_at_rest = lane.at_rest;
    progress_writer_.write(progress);
  }

  // Every reader of the feedback costs the drive a message and this process a wake-up per batch.
  void follow_feedback() {
    bool wanted = needs_feedback() || !have_feedback_ || service::monotonic_seconds() < feedback_until_;
    for (const auto& [channel, lane] : lanes_)
      wanted = wanted || !lane.in_step || (lane.revision == 0 && lane.window.has_next());
    if (wanted && !feedback_reader_) {
      newest_feedback_.channels.clear();
      feedback_reader_.emplace(node_.bus(), topics::feedback);
    } else if (!wanted && feedback_reader_) {
      feedback_reader_.reset();
    }
  }

  Lane& lane(std::uint16_t channel) {
    auto& result = lanes_[channel];
    if (!result.core) result.core = make_core_();
    return result;
  }

  static const idl::stream::ChannelEcho* echo_of(const idl::stream::Feedback& feedback,
                                                 std::uint16_t channel) {
    for (const auto& echo : feedback.channels)
      if (echo.channel == channel) return &echo;
    return nullptr;
  }

  // After a reset: a channel that owes nothing starts from where the drive is, and a lane that is elsewhere
  // or waits in vain for parameters would not find its start.
  void return_to_the_drive() {
    if (!present_reader_) return;
    while (present_reader_->take(present_))
      for (auto& [channel, lane] : lanes_) {
        const auto* cut = echo_of(present_, channel);
        if (cut == nullptr || cut->active) continue;
        if (!lane.window.is_astray(cut->epoch, cut->next) &&
            !node_.alarms().active(alarm::revision_unknown, channel))
          continue;
        lane.window.start_over(cut->epoch, cut->next);
        lane.in_step = true;
        unknown_since_ = 0;
        node_.alarms().clear(alarm::revision_unknown, channel);
      }
    if (service::monotonic_seconds() > present_until_) present_reader_.reset();
  }

  // A process that has just started, or has fallen behind, continues from the consistent cut in the drive's
  // feedback as soon as it has the input that follows it.
  void join(std::uint16_t channel, Lane& lane) {
    const auto* cut = echo_of(newest_feedback_, channel);
    if (cut == nullptr) return;
    if (!cut->active) {  // nothing moves: the first batch of the next motion will carry the state
      lane.window.set_next(cut->epoch, cut->next);
      lane.in_step = true;
      return;
    }
    const auto* state = find_state(cut->states, stage_);
    if (state == nullptr) return;
    lane.window.set_next(cut->epoch, state->cycle + 1);
    if (!lane.window.has_next()) return;
    lane.cut = state->values;
    lane.revision = 0;
    lane.in_step = true;
  }

  // The history of a process that has just started may begin with a motion whose parameters nobody publishes
  // any more. When the drive is beyond it, nobody needs it.
  void leave_out_what_was_executed(std::uint16_t channel, Lane& lane, const In& in) {
    const auto* cut = echo_of(newest_feedback_, channel);
    if (cut == nullptr || std::pair(cut->epoch, cut->next) <= std::pair(in.epoch, in.first)) return;
    lane.in_step = false;
    unknown_since_ = 0;
    node_.alarms().clear(alarm::revision_unknown, channel);
    join(channel, lane);
  }

  bool use_revision(std::uint16_t channel, Lane& lane, std::uint64_t revision) {
    if (lane.revision == revision) return true;
    const auto parameters = parameters_.find(revision);
    if (!parameters) {
      const double now = service::monotonic_seconds();
      if (unknown_since_ == 0) unknown_since_ = now;
      if (now - unknown_since_ > 1)
        node_.alarms().raise(alarm::revision_unknown, channel,
                             "Setpoint batches require parameter revision " + std::to_string(revision) +
                                 ", which has not arrived within 1 s");
      return false;
    }
    unknown_since_ = 0;
    node_.alarms().clear(alarm::revision_unknown, channel);
    StateValues state;
    if (lane.cut)
      state = *lane.cut;
    else
      lane.core->save(state);
    try {
      lane.core->configure(*parameters, channel);
      fault_.clear();
    } catch (const std::exception& e) {
      fault_ = e.what();
      node_.alarms().raise(machine::alarm_of(e), channel, e.what());
      return false;
    }
    lane.core->load(state);
    lane.cut.reset();
    lane.revision = revision;
    return true;
  }

  void run(std::uint16_t channel, Lane& lane) {
    if (lane.window.jump_to_start()) lane.in_step = true;
    if (!lane.in_step) join(channel, lane);
    if (!lane.in_step) return;
    while (const In* in = lane.window.peek()) {
      if (!use_revision(channel, lane, in->revision)) {
        if (lane.revision == 0) leave_out_what_was_executed(channel, lane, *in);
        return;
      }
      // A start without a state: the drive and the channel that kept it were both restarted. Every replica
      // and every later process then starts as on a new machine.
      if (in->starts) {
        const auto* state = find_state(in->states, stage_);
        lane.core->load(state != nullptr ? state->values : StateValues{});
      }
      if (!lane.core->process(*in, feedback_, out_)) break;
      out_.channel = in->channel, out_.stage = stage_,
      out_.replica = static_cast<std::uint8_t>(node_.options().replica);
      out_.epoch = in->epoch, out_.first = in->first, out_.count = in->count, out_.revision = in->revision;
      out_.starts = in->starts, out_.ends = in->ends;
      out_.lines = in->lines;
      out_.spindle_axis = in->spindle_axis;
      out_.spindle = in->spindle;
      out_.skip_move = in->skip_move;
      out_.follows_spindle = in->follows_spindle;
      out_.turning_radius = in->turning_radius;
      out_.snapshot = in->snapshot;
      out_.states = in->states;
      auto& own = state_of(out_.states, stage_);
      own.cycle = in->first + in->count - 1;
      lane.core->save(own.values);
      writer_->write(out_);
      ++messages_out_;
      lane.at_rest = in->ends;
      lane.window.advance();
      lane.gap_since = 0;
      lane.window.jump_to_start();
    }
    // The next batch is missing while later ones are present: it will not arrive any more, so continue from
    // the cut.
    if (lane.window.gap()) {
      const double now = service::monotonic_seconds();
      if (lane.gap_since == 0) lane.gap_since = now;
      if (now - lane.gap_since > 0.02) {
        ++cycles_lost_;
        lane.in_step = lane.settled = false;
        feedback_until_ = now + 2;  // it may fall behind again, and a new reader receives the whole history
        lane.gap_since = 0;
      }
    }
  }

  Stage stage_;
  bus::Topic<In> in_topic_;
  bus::Topic<idl::stream::AxisBatch> out_topic_;
  MakeCore make_core_;
  std::optional<BatchReader<In>> reader_;
  std::optional<BatchReader<idl::stream::Feedback>> feedback_reader_;
  std::optional<BatchReader<idl::stream::Feedback>> present_reader_;  // for a while after a reset
  std::optional<bus::Writer<idl::stream::AxisBatch>> writer_;
  bus::Writer<idl::stream::StageProgress> progress_writer_;
  std::map<std::uint16_t, Lane> lanes_;
  FeedbackWindow feedback_;
  In batch_;
  idl::stream::AxisBatch out_;
  idl::stream::Feedback newest_feedback_, present_;
  bool have_feedback_ = false;
  std::uint64_t messages_in_ = 0, messages_out_ = 0, cycles_lost_ = 0;
  double unknown_since_ = 0, feedback_until_ = 0, present_until_ = 0;
  std::uint64_t ahead_ = 0;
  bool replicated_ = false, standby_ = false;
  std::string fault_;
};

}  // namespace trunnion::stream
