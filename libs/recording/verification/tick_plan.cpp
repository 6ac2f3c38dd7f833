// SPDX-License-Identifier: Apache-2.0
#include "verification/tick_plan.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>

#include "bus/codec.hpp"
#include "contracts/topics.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::verification {
namespace {

using idl::stream::Input;

// A setpoint batch that took effect is not in the recording.
struct MissingInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class TickPlan {
 public:
  TickPlan(const StoredRecording& recording, const std::string& service, VerifyPlan& plan)
      : recording_(recording), service_(service), drive_(service == "drive"), plan_(plan) {}

  void make() {
    sort_messages();
    for (std::size_t i = 0; i < stamps_.size(); ++i) find_message(i);
    if (!drive_) add_feedback();
    std::stable_sort(due_.begin(), due_.end(), [](const Due& a, const Due& b) {
      return std::tuple(a.tick, a.rank, a.after) < std::tuple(b.tick, b.rank, b.after);
    });
    weave_in_the_rest();
    for (const auto& due : due_) feed(due);
    plan_.end.push_back({own_, last_});
    if (unconfirmed_) plan_.end.push_back(*unconfirmed_);
  }

 private:
  // At one tick: for the drive what changes its orders before the setpoints that let it go on; for the PLC
  // the tick itself before what reached it then.
  static constexpr int order = 1, cyclic_before = 0, cyclic_after = 2;
  struct Due {
    std::uint64_t tick = 0;
    int rank = 0;
    const StoredMessage* message = nullptr;
    std::uint64_t time = 0;
    bool stamped = false;
    std::uint64_t after = 0;  // of one tick and rank: in this order
  };

  // Feedback that brings no new tick (a channel is given its place while time stands still) goes between the
  // inputs of its tick as it was written.
  void add_feedback() {
    std::uint64_t newest = 0;
    for (auto& due : due_) due.after = newest = std::max(newest, due.time);
    std::set<std::uint64_t> ticks;
    for (const auto& [message, place] : told_) {
      const bool brings_tick = ticks.insert(place.minor).second;
      due_.push_back({place.minor, brings_tick ? cyclic_before : order, message, message->time, false,
                      brings_tick ? 0 : message->time});
    }
  }

  void sort_messages() {
    idl::stream::InputLog log;
    idl::stream::Feedback feedback;
    idl::parameters::ParameterSet set;
    own_ = {bus::find_topic(drive_ ? "feedback" : "plc_input_log"), 0};
    for (const auto& message : recording_.messages) {
      const auto& handle = message.topic->handle;
      const bool counts = !plan_.seed || plan_.seed->covers(message);
      if (counts && plan_.topics.contains(handle)) plan_.expected.push_back(message);
      if (handle == "feedback" && bus::decode(message.cdr, feedback)) {
        if (!drive_ && !is_to_come(message)) continue;
        told_.emplace_back(&message, Place{feedback.first + feedback.count, feedback.tick});
        if (!counts) continue;
        if (drive_) stamps_.insert(stamps_.end(), feedback.applied.begin(), feedback.applied.end());
        plan_.cycles += feedback.count;
      } else if (handle == "plc_input_log" && !drive_ && counts && bus::decode(message.cdr, log)) {
        stamps_.insert(stamps_.end(), log.applied.begin(), log.applied.end());
      } else if (handle == "parameter_set" && bus::decode(message.cdr, set)) {
        revisions_[set.revision] = &message;
      } else if (handle == "alarm" && drive_ && counts && bus::decode(message.cdr, alarm_)) {
        if (alarm_.active && alarm_.number == alarm::plc_absent.number)
          plan_.spindles_unknown = "when the drive missed the PLC (alarm " + std::to_string(alarm_.number) +
                                   ") is not in the recording, and it brings spindles to rest then";
      }
      if (is_input(message)) inputs_[{message.topic, message.time}] = &message;
    }
    if (stamps_.empty() && !plan_.seed)
      throw std::runtime_error("the recording does not say when inputs took effect");
  }

  // Not in the state that the service continues from, and before its end.
  bool is_to_come(const StoredMessage& message) const {
    return !plan_.seed || (!plan_.seed->had_taken(message) && message.time < plan_.seed->until);
  }

  bool is_input(const StoredMessage& message) {
    const auto& topic = *message.topic;
    const auto reads = [&](const std::string& who) {
      return std::find(topic.readers.begin(), topic.readers.end(), who) != topic.readers.end();
    };
    if ((!reads(service_) && !reads("all")) || topic.handle == "snapshot_request") return false;
    if (topic.handle == "alarm") return bus::decode(message.cdr, alarm_) && alarm_.source != service_;
    if (topic.handle == "service_state")
      return bus::decode(message.cdr, state_) && state_.service != service_;
    return true;
  }

  void find_message(std::size_t stamp_index) {
    const auto& stamp = stamps_[stamp_index];
    const auto* topic = topic_of(stamp.input);
    const StoredMessage* message = nullptr;
    if (stamp.input == Input::PARAMETER_SET) {
      message = revisions_[stamp.identity];
    } else if (const auto found = inputs_.find({topic, stamp.identity}); found != inputs_.end()) {
      message = found->second;
    } else if (stamp.input == Input::PLC_OUTPUTS) {
      if (stamp_index + 1 < stamps_.size())
        message = stand_in(*topic, stamp.identity, stamps_[stamp_index + 1].tick);
      watch_spindles(*topic, stamp, message);
    }
    if (message == nullptr && is_setpoint_after_seed(*topic, stamp.identity))
      throw MissingInput("it cannot be verified: the " + service_ + " executed a message of " +
                         topic->handle + " at tick " + std::to_string(stamp.tick) +
                         " that the recording does not have. Begin the recording before the motion");
    // What it said of itself, or what was before the recording began.
    if (message == nullptr) return;
    if (!placed_.insert(message).second) return;
    due_.push_back({stamp.tick, is_cyclic(*topic) ? cyclic_after : order, message, message->time,
                    stamp.input != Input::PARAMETER_SET});
  }

  bool is_setpoint_after_seed(const bus::TopicEntry& topic, std::uint64_t time) const {
    if (!plan_.seed || topic.handle != "gantry_batch") return false;
    const auto taken = plan_.seed->taken.find(&topic);
    return taken == plan_.seed->taken.end() || time > taken->second;
  }

  // Outputs of the PLC that newer ones have overwritten before the recorder was there: as the newer ones, but
  // time goes on only as far as it did until the next input.
  const StoredMessage* stand_in(const bus::TopicEntry& topic, std::uint64_t time, std::uint64_t until) {
    const auto newer = inputs_.lower_bound({&topic, time});
    idl::plc::Outputs outputs;
    if (newer == inputs_.end() || newer->first.first != &topic || !bus::decode(newer->second->cdr, outputs))
      return nullptr;
    outputs.run_until_tick = until;
    auto& message = plan_.stand_ins.emplace_back(*newer->second);
    message.time = time;
    bus::encode(outputs, message.cdr);
    return &message;
  }

  // Outputs of the PLC that are not in the recording, and the ones that stand in for them: between outputs
  // that order the same of the spindles they ordered that, too. Otherwise it is not known, and the spindles
  // turn by it from then on.
  void watch_spindles(const bus::TopicEntry& topic, const idl::stream::AppliedInput& lost,
                      const StoredMessage* in_its_place) {
    if (!plan_.spindles_unknown.empty()) return;
    const auto after = inputs_.lower_bound({&topic, lost.identity});
    const bool first = after == inputs_.begin() || std::prev(after)->first.first != &topic;
    idl::plc::Outputs before, now;
    const bool known = (first || bus::decode(std::prev(after)->second->cdr, before)) &&
                       in_its_place != nullptr && bus::decode(in_its_place->cdr, now);
    if (known && order_the_same(before, now)) return;
    plan_.spindles_unknown =
        "the recording lacks outputs of the PLC that the drive took at tick " + std::to_string(lost.tick) +
        ", and those around them do not say what they ordered the spindles: record again";
  }

  // What spindles turn by.
  static bool order_the_same(const idl::plc::Outputs& a, const idl::plc::Outputs& b) {
    const auto orders = [](const idl::plc::Outputs& o) {
      return std::tie(o.emergency_stop, o.axis_enable, o.spindle_speed, o.spindle_orient, o.spindle_angle,
                      o.spindle_gear, o.spindle_couplings, o.surface_speeds);
    };
    return orders(a) == orders(b);
  }

  // What has no tick goes before the first that was written later.
  void weave_in_the_rest() {
    std::vector<Due> woven;
    std::vector<const StoredMessage*> rest;
    for (const auto& [key, message] : inputs_)
      if (!placed_.contains(message) && !is_cyclic(*message->topic) && is_to_come(*message))
        rest.push_back(message);
    std::stable_sort(rest.begin(), rest.end(),
                     [](const auto* a, const auto* b) { return a->time < b->time; });
    if (plan_.seed)
      for (const auto* message : plan_.seed->needed_to_start(recording_, drive_))
        woven.push_back({0, order, message, 0});
    auto next = rest.begin();
    for (const auto& due : due_) {
      for (; next != rest.end() && (*next)->time < due.time; ++next)
        woven.push_back({woven.empty() ? 0 : woven.back().tick, order, *next, (*next)->time});
      woven.push_back(due);
    }
    due_ = std::move(woven);
  }

  void feed(const Due& due) {
    Step step{due.message, {}, !is_cyclic(*due.message->topic)};
    // Each is taken before anything follows: a state that is overwritten would not be seen, and time must not
    // go on before it.
    if (unconfirmed_) {
      step.needs.push_back(*unconfirmed_);
      unconfirmed_.reset();
    }
    if (due.stamped && step.apart) {
      const Track track{due.message->topic, 0};
      unconfirmed_ = Mark{track, {0, ++given_[track]}};
    }
    if (const auto place = place_at(due.tick); place > last_ && (drive_ || step.apart)) {
      step.needs.push_back({own_, place});
      last_ = place;
    }
    plan_.steps.push_back(std::move(step));
  }

  // How far the service had told to be when it was at `tick`.
  Place place_at(std::uint64_t tick) const {
    if (!drive_) return {0, tick};
    const auto after =
        std::upper_bound(told_.begin(), told_.end(), tick,
                         [](std::uint64_t t, const auto& told) { return t < told.second.minor; });
    return after == told_.begin() ? Place{} : std::prev(after)->second;
  }

  const StoredRecording& recording_;
  const std::string& service_;
  const bool drive_;
  VerifyPlan& plan_;
  Track own_;
  Place last_;
  std::optional<Mark> unconfirmed_;  // of the stamped input that was fed last
  std::map<Track, std::uint64_t> given_;
  std::vector<idl::stream::AppliedInput> stamps_;
  std::vector<std::pair<const StoredMessage*, Place>> told_;  // the drive's feedback
  std::map<std::pair<const bus::TopicEntry*, std::uint64_t>, const StoredMessage*> inputs_;
  std::map<std::uint64_t, const StoredMessage*> revisions_;
  std::set<const StoredMessage*> placed_;
  std::vector<Due> due_;
  idl::service::Alarm alarm_;
  idl::service::ServiceState state_;
};

}  // namespace

bool says_when(const std::string& service) { return service == "drive" || service == "plc"; }

void plan_by_tick(const StoredRecording& recording, const std::string& service,
                  const std::vector<Seed>& seeds, VerifyPlan& plan) {
  if (seeds.empty()) return TickPlan(recording, service, plan).make();
  const auto empty = plan;
  for (const auto& seed : seeds) {
    plan = empty;
    plan.seed = seed;
    try {
      return TickPlan(recording, service, plan).make();
    } catch (const MissingInput&) {
      if (&seed == &seeds.back()) throw;
    }
  }
}

}  // namespace trunnion::verification
