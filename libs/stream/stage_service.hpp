// The shell of kinematics, compensation and gantry: frames in, frames out, joining, restarting, revisions.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>

#include "machine/kinematics.hpp"
#include "node/node.hpp"
#include "node/parameter_client.hpp"
#include "stream/frame_window.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::stream {

/// How many frames a writer of the stream must keep: twice the lead, in frames, and a few, for every channel.
/// Never fewer than 1024: in virtual time that is how late a recorder may be before cycles are lost to it,
/// about a quarter of a second.
inline int stream_depth(int lead, int frame_cycles, int channels) {
  return std::max(1024, (2 * lead / std::max(1, frame_cycles) + 6) * std::max(1, channels));
}

/// Topic on which a stage writes while it is only compared with the one it is to replace.
inline std::string shadow_name(const std::string& topic) { return topic + "/shadow"; }

/// Raises the alarm of copies that differ, once until it is reset: it stops the machine.
inline void raise_difference(node::AlarmBoard& alarms, const auto& first, const auto& second) {
  if (alarms.active("copies_differ", first.channel)) return;
  const auto what = difference(first, second);
  if (!what) return;
  alarms.raise("copies_differ", first.channel, what->text, what->cycle);
  alarms.release("copies_differ", first.channel);
}

template <class In>
class StageService : public node::Service {
 public:
  using MakeCore = std::function<std::unique_ptr<StageCore<In>>()>;

  StageService(node::Node& node, Stage stage, const bus::Topic<In>& in,
               const bus::Topic<idl::stream::AxisFrame>& out, MakeCore make_core)
      : node_(node),
        parameters_(node.bus()),
        stage_(stage),
        in_topic_(in),
        out_topic_(out),
        make_core_(std::move(make_core)),
        progress_writer_(node.bus().writer(topics::stage_progress)) {}

  /// As a shadow it computes what it would if it took part, and writes it beside the stream (shadow_name).
  static constexpr bool works_as_shadow = true;

  void pump() override {
    parameters_.poll();
    if (!reader_) {
      if (!parameters_.newest()) return;
      start();
    }
    if (shadow_ && !node_.shadow()) take_part();
    follow_feedback();
    idl::stream::FeedbackFrame feedback;
    while (feedback_reader_ && feedback_reader_->take(feedback)) {
      feedback_.put(feedback);
      std::swap(newest_feedback_, feedback);
      have_feedback_ = true;
      on_feedback(newest_feedback_);
    }
    while (reader_->take(frame_)) {
      ++frames_in_;
      const auto channel = frame_.channel;
      auto& window = lane(channel).window;
      if (window.put(frame_) == Arrival::differs)
        raise_difference(node_.alarms(), *window.copy_of(frame_), frame_);
    }
    for (auto& [channel, lane] : lanes_) {
      run(channel, lane);
      report_progress(channel, lane);
    }
  }
  double period() const override { return 0.02; }

  node::Health health() const override {
    using idl::service::Lifecycle;
    node::Health health;
    health.lifecycle = !reader_                     ? Lifecycle::UNCONFIGURED
                       : have_feedback_ && !shadow_ ? Lifecycle::ACTIVE
                                                    : Lifecycle::INACTIVE;
    health.detail = !fault_.empty()   ? fault_
                    : !reader_        ? "waiting for parameters"
                    : !have_feedback_ ? "waiting for the drive"
                    : shadow_         ? "shadow"
                                      : waiting_for();
    if (!fault_.empty()) health.lifecycle = Lifecycle::FAULT;
    health.frames_in = frames_in_;
    health.frames_out = frames_out_;
    health.frames_lost = frames_lost_;
    health.revision = parameters_.newest() ? parameters_.newest()->revision : 0;
    for (const auto& [channel, lane] : lanes_)
      health.in_step = health.in_step && lane.in_step && lane.settled;
    return health;
  }

 protected:
  /// The computation itself needs the feedback. Other stages read it only until they are in step.
  virtual bool needs_feedback() const { return false; }
  /// For supervision that does not belong to a setpoint.
  virtual void on_feedback(const idl::stream::FeedbackFrame&) {}
  node::Node& node_;
  node::ParameterClient parameters_;

 private:
  struct Lane {
    FrameWindow<In> window;
    std::unique_ptr<StageCore<In>> core;
    std::uint64_t revision = 0;
    std::optional<StateValues> cut;  // to go on from; a core cannot take it before it is configured
    bool in_step = false;
    bool settled = false;  // since it is in step it has computed all that was here, and there is a reader
    double gap_since = 0;
    bool at_rest = false;  // the newest frame it computed was the last of a motion
    bool told_at_rest = false;
    idl::stream::StageProgress told;
    double told_at = 0;
  };

  void start() {
    const auto& p = *parameters_.newest();
    const int frame =
        p.integer(node_.options().virtual_time ? "frame_cycles_virtual_time" : "frame_cycles_real_time");
    node_.bus().set_depth(
        {stream_depth(p.integer("stream_lead"), frame, static_cast<int>(node_.options().machine.channels))});
    lead_ = static_cast<std::uint64_t>(p.integer("stream_lead"));
    const auto& services = node_.options().machine.services;
    twins_ = std::count_if(services.begin(), services.end(),
                           [&](const auto& entry) { return entry.service == stage_name(stage_); }) > 1;
    shadow_ = node_.shadow();
    const auto shadow_topic = shadow_name(out_topic_.name);
    auto out = out_topic_;
    if (shadow_) out.name = shadow_topic.c_str();
    writer_.emplace(node_.bus().writer(out));
    feedback_reader_.emplace(node_.bus().reader(topics::feedback_frame));
    reader_.emplace(node_.bus().reader(in_topic_));
    for (const auto& entry : services)
      if (entry.service == "channel") lane(static_cast<std::uint16_t>(entry.channel));
  }

  // From the frame it computes next on; what it wrote as a shadow the others have from the service it
  // replaces.
  void take_part() {
    shadow_ = false;
    writer_.emplace(node_.bus().writer(out_topic_));
    for (auto& [channel, lane] : lanes_) lane.settled = false;
  }

  // What keeps it from being in step.
  std::string waiting_for() const {
    for (const auto& [channel, lane] : lanes_) {
      if (lane.in_step && lane.settled) continue;
      const auto what = !lane.in_step             ? "the cut to go on from"
                        : lane.window.has_next()  ? "parameters"
                        : writer_->matched() == 0 ? "a reader"
                                                  : "the next frame";
      return std::string("waiting for ") + what + " of channel " + std::to_string(channel);
    }
    return "";
  }

  // Ten times a second; of a stage with twins also whenever a lead was computed, for the channel waits for
  // it.
  void report_progress(std::uint16_t channel, Lane& lane) {
    if (lane.in_step && !lane.settled) lane.settled = !lane.window.has_next() && writer_->matched() > 0;
    if (shadow_) return;
    const idl::stream::StageProgress progress{stage_,
                                              static_cast<std::uint8_t>(node_.options().copy),
                                              channel,
                                              lane.in_step && lane.settled,
                                              lane.window.epoch(),
                                              lane.window.next()};
    const auto& told = lane.told;
    const bool news = twins_ && (progress.in_step != told.in_step || progress.epoch != told.epoch ||
                                 progress.next >= told.next + lead_ || lane.at_rest != lane.told_at_rest);
    const double now = node::monotonic_seconds();
    if (!news && now - lane.told_at <= 0.1) return;
    lane.told = progress;
    lane.told_at = now;
    lane.told_at_rest = lane.at_rest;
    progress_writer_.write(progress);
  }

  // Every reader of the feedback costs the drive a message and this process a wake-up per frame.
  void follow_feedback() {
    bool wanted = needs_feedback() || !have_feedback_ || node::monotonic_seconds() < feedback_until_;
    for (const auto& [channel, lane] : lanes_) wanted = wanted || !lane.in_step;
    if (wanted && !feedback_reader_) {
      newest_feedback_.channels.clear();
      feedback_reader_.emplace(node_.bus().reader(topics::feedback_frame));
    } else if (!wanted && feedback_reader_) {
      feedback_reader_.reset();
    }
  }

  Lane& lane(std::uint16_t channel) {
    auto& result = lanes_[channel];
    if (!result.core) result.core = make_core_();
    return result;
  }

  const idl::stream::ChannelEcho* echo(std::uint16_t channel) const {
    for (const auto& echo : newest_feedback_.channels)
      if (echo.channel == channel) return &echo;
    return nullptr;
  }

  // A process that has just begun, or has fallen behind, goes on from the consistent cut in the drive's
  // feedback as soon as it holds the input that follows it.
  void join(std::uint16_t channel, Lane& lane) {
    const auto* cut = echo(channel);
    if (cut == nullptr) return;
    if (!cut->active) {  // nothing moves: the first frame of the next motion will carry the state
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

  bool use_revision(std::uint16_t channel, Lane& lane, std::uint64_t revision) {
    if (lane.revision == revision) return true;
    const auto parameters = parameters_.find(revision);
    if (!parameters) {
      const double now = node::monotonic_seconds();
      if (unknown_since_ == 0) unknown_since_ = now;
      if (now - unknown_since_ > 1)
        node_.alarms().raise("revision_unknown", channel,
                             "Frames are made with parameter revision " + std::to_string(revision) +
                                 ", which has not arrived");
      return false;
    }
    unknown_since_ = 0;
    node_.alarms().clear("revision_unknown", channel);
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
      if (!use_revision(channel, lane, in->revision)) return;
      if (in->starts)
        if (const auto* state = find_state(in->states, stage_)) lane.core->load(state->values);
      if (!lane.core->process(*in, feedback_, out_)) break;
      out_.channel = in->channel, out_.stage = stage_,
      out_.copy = static_cast<std::uint8_t>(node_.options().copy);
      out_.epoch = in->epoch, out_.first = in->first, out_.count = in->count, out_.revision = in->revision;
      out_.starts = in->starts, out_.ends = in->ends;
      out_.lines = in->lines;
      out_.spindle_axis = in->spindle_axis;
      out_.spindle = in->spindle;
      out_.snapshot = in->snapshot;
      out_.states = in->states;
      auto& own = state_of(out_.states, stage_);
      own.cycle = in->first + in->count - 1;
      lane.core->save(own.values);
      writer_->write(out_);
      ++frames_out_;
      lane.at_rest = in->ends;
      lane.window.advance();
      lane.gap_since = 0;
      lane.window.jump_to_start();
    }
    // The next frame is missing while later ones are here: it will not come any more, so go on from the cut.
    if (lane.window.gap()) {
      const double now = node::monotonic_seconds();
      if (lane.gap_since == 0) lane.gap_since = now;
      if (now - lane.gap_since > 0.02) {
        ++frames_lost_;
        lane.in_step = lane.settled = false;
        feedback_until_ =
            now + 2;  // who fell behind may do so again, and a new reader is sent all the history
        lane.gap_since = 0;
      }
    }
  }

  Stage stage_;
  bus::Topic<In> in_topic_;
  bus::Topic<idl::stream::AxisFrame> out_topic_;
  MakeCore make_core_;
  std::optional<bus::Reader<In>> reader_;
  std::optional<bus::Reader<idl::stream::FeedbackFrame>> feedback_reader_;
  std::optional<bus::Writer<idl::stream::AxisFrame>> writer_;
  bus::Writer<idl::stream::StageProgress> progress_writer_;
  std::map<std::uint16_t, Lane> lanes_;
  FeedbackWindow feedback_;
  In frame_;
  idl::stream::AxisFrame out_;
  idl::stream::FeedbackFrame newest_feedback_;
  bool have_feedback_ = false;
  std::uint64_t frames_in_ = 0, frames_out_ = 0, frames_lost_ = 0;
  double unknown_since_ = 0, feedback_until_ = 0;
  std::uint64_t lead_ = 0;
  bool twins_ = false, shadow_ = false;
  std::string fault_;
};

}  // namespace trunnion::stream
