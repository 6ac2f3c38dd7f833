// SPDX-License-Identifier: Apache-2.0
#include "verification/verify.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <thread>

#include "bus/bus.hpp"
#include "cluster/child_process.hpp"
#include "contracts/topics.hpp"
#include "machine/machine.hpp"
#include "service/node.hpp"
#include "verification/answers.hpp"
#include "verification/machine_values.hpp"
#include "verification/repetitions.hpp"
#include "verification/verify_gateway.hpp"
#include "verification/verify_place.hpp"
#include "verification/verify_plan.hpp"

namespace trunnion::verification {
namespace {

constexpr double match_timeout = 5;   // s for a reader that must not miss the first message
constexpr double start_pause = 0.01;  // s for each message to a service that is not heard of yet
constexpr double take_timeout = 0.5;  // s for a service to take a message and sleep again

class Feeding {
 public:
  Feeding(const VerifyOptions& options, const StoredRecording& recording, const VerifyPlan& plan,
          bus::Bus& bus, cluster::ChildProcess& process)
      : options_(options),
        plan_(plan),
        bus_(bus),
        process_(process),
        answers_(recording),
        states_(bus.reader(topics::service_state)) {
    for (const auto& handle : plan.topics) read(handle);
    for (const auto& mark : plan.end)
      if (is_own(*mark.track.topic) && !plan.topics.contains(mark.track.topic->handle))
        read(mark.track.topic->handle);
    read("alarm");
    if (options.service == "channel") {
      read("program_request");
      writer(*bus::find_topic("program_reply"));
    }
    // Made before the service is heard of, so that it finds them all at once.
    for (const auto& step : plan.steps) writer(*step.message->topic);
  }

  // Empty when everything came, else what did not.
  std::string run() {
    bool cyclic_under_way = false;
    for (const auto& step : plan_.steps) {
      if (!wait_for(step.needs)) return missing(step.needs);
      auto& to = writer(*step.message->topic);
      if (is_request(*step.message->topic) && !await_reader(to))
        return process_.ended().empty() ? "the service does not read " + step.message->topic->handle
                                        : process_.ended();
      if (began_ == 0 && is_cyclic(*step.message->topic)) began_ = service::monotonic_seconds();
      drain();
      // What came before must not be overtaken: a request when the axes have come to rest is one that is
      // accepted.
      if (step.apart && cyclic_under_way) await_taken();
      to.write(step.message->cdr);
      cyclic_under_way = !step.apart;
      if (step.apart) await_taken();
    }
    if (!wait_for(plan_.end)) return missing(plan_.end);
    ended_ = service::monotonic_seconds();
    while (service::monotonic_seconds() - ended_ < final_messages) {
      bus_.signal().wait(final_messages / 5);
      drain();
    }
    return process_.ended();
  }

  double seconds() const { return began_ == 0 || ended_ == 0 ? 0 : ended_ - began_; }
  std::vector<StoredMessage>& produced() { return produced_; }

 private:
  bool is_own(const bus::TopicEntry& topic) const {
    return std::find(topic.writers.begin(), topic.writers.end(), options_.service) != topic.writers.end();
  }
  void read(const std::string& handle) {
    // As the recorder does, keeping all: of a state the service changes twice in a row both count.
    const auto* topic = bus::find_topic(handle);
    const bus::EndpointQos qos{bus::reader_qos(topic->qos).transient_local, 0};
    readers_.emplace_back(topic, bus_.backend().reader(topic->description, qos, &bus_.signal()));
  }
  bus::RawWriter& writer(const bus::TopicEntry& topic) {
    auto& writer = writers_[&topic];
    if (!writer)
      writer = bus_.backend().writer(topic.description, bus::writer_qos(topic.qos, {stream_batches}));
    return *writer;
  }

  // True when something came that brings the service further than it was.
  bool drain() {
    bool further = false;
    bus::SampleInfo info;
    for (auto& [topic, reader] : readers_)
      while (reader->take(bytes_, info)) {
        produced_.push_back({topic, static_cast<std::uint64_t>(info.source_timestamp), 0, bytes_});
        if (const auto answer = answers_.answer(produced_.back()))
          writer(*bus::find_topic("program_reply")).write(*answer);
        further = progress_.observe(produced_.back()).second || further;
      }
    return further;
  }

  // Topics have no common order on the way, so what the order matters for is sent one by one: the service has
  // taken it when it sleeps again. One that is just starting sleeps for other reasons.
  void await_taken() {
    const auto before = produced_.size();
    active();
    const double until = service::monotonic_seconds() + (heard_ ? take_timeout : start_pause);
    while (service::monotonic_seconds() < until) {
      if (heard_ ? process_.sleeps() : produced_.size() != before) break;
      if (!heard_) bus_.signal().wait(start_pause);
      drain();
    }
    drain();
  }

  bool wait_for(const std::vector<Mark>& needs) {
    double heard = service::monotonic_seconds();
    while (!progress_.reached(needs)) {
      if (drain()) {
        heard = service::monotonic_seconds();
        continue;
      }
      bus_.signal().wait(0.02);
      if (!process_.ended().empty() || service::monotonic_seconds() - heard > options_.timeout) {
        drain();
        return progress_.reached(needs);
      }
    }
    return true;
  }

  // A request must not be sent before the service reads it and is ready to act on it.
  static bool is_request(const bus::TopicEntry& topic) {
    return topic.qos == bus::QosKind::event || topic.handle.ends_with("_request");
  }
  bool await_reader(bus::RawWriter& to) {
    const double until = service::monotonic_seconds() + match_timeout;
    while ((to.matched() == 0 || !active()) && service::monotonic_seconds() < until &&
           process_.ended().empty()) {
      drain();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return to.matched() > 0;
  }
  bool active() {
    idl::service::ServiceState state;
    while (states_.take(state)) {
      if (state.instance != plan_.instance) continue;
      heard_ = true;
      active_ = active_ || state.lifecycle == idl::service::Lifecycle::ACTIVE;
    }
    return active_;
  }

  std::string missing(const std::vector<Mark>& needs) {
    if (const auto end = process_.ended(); !end.empty()) return end;
    for (const auto& need : needs) {
      if (progress_.reached(need)) continue;
      const auto at = progress_.at(need.track);
      if (!is_own(*need.track.topic))
        return "the service has not reported that it has taken " + need.track.topic->handle + " number " +
               std::to_string(need.place.minor);
      return "the service wrote nothing more of " + need.track.topic->handle + " after " +
             std::to_string(at.minor) + ", the recording has it up to " + std::to_string(need.place.minor);
    }
    return "";
  }

  const VerifyOptions& options_;
  const VerifyPlan& plan_;
  bus::Bus& bus_;
  cluster::ChildProcess& process_;
  std::vector<std::pair<const bus::TopicEntry*, std::unique_ptr<bus::RawReader>>> readers_;
  std::map<const bus::TopicEntry*, std::unique_ptr<bus::RawWriter>> writers_;
  std::vector<StoredMessage> produced_;
  Progress progress_;
  Answers answers_;
  bus::Reader<idl::service::ServiceState> states_;
  bool heard_ = false, active_ = false;
  bus::Bytes bytes_;
  double began_ = 0, ended_ = 0;
};

VerifyResult verify_service(const VerifyOptions& options, const StoredRecording& recording) {
  const auto plan = plan_verification(recording, options.service, options.channel);

  VerifyResult result;
  std::vector<StoredMessage> produced;
  {
    const VerifyPlace place(options.domain);
    bus::Bus bus(bus::Vendor::cyclonedds, {place.domain()}, {stream_batches});
    cluster::ChildProcess process(child_options(command_line(options, recording, plan, place), place));
    Feeding feeding(options, recording, plan, bus, process);
    result.problem = feeding.run();
    result.seconds = feeding.seconds();
    produced = std::move(feeding.produced());
  }
  if (!result.problem.empty())
    for (const auto& lost : {missing_feedback(plan), missing_request(recording)})
      if (!lost.empty()) result.problem += "; " + lost;
  result.inputs = plan.steps.size();
  result.outputs = produced.size();
  result.cycles = plan.cycles;
  result.features = coverage_of(options.service, plan.expected, recording);
  if (result.seconds > 0)
    result.times_real_time = static_cast<double>(plan.cycles) * plan.cycle_seconds / result.seconds;
  if (result.problem.empty())
    result.problem = unexpected_alarm(recording.messages, produced, options.service);
  result.unrecorded = plan.drop_unrecorded(produced);
  auto comparison = options.comparison;
  comparison.topics = plan.topics;
  comparison.ignored.insert(plan.ignored.begin(), plan.ignored.end());
  // What a batch of a channel has of a spindle depends on where the channel has cut it.
  comparison.spindles = options.service != "channel" && plan.spindles_unknown.empty();
  if (!plan.spindles_unknown.empty()) result.not_compared = "the spindles: " + plan.spindles_unknown;
  result.difference = difference(plan.expected, produced, comparison);
  return result;
}

// Which parameters the service gets, in one line when that needs saying.
std::string choose_parameters(const VerifyOptions& options, StoredRecording& recording) {
  const auto directory = machine_directory(options, recording);
  const auto delivered = machine::machine_parameters(machine::load_machine(directory));
  const auto apart = parameters_apart(recording, delivered);
  if (!options.machine_parameters)
    return apart.empty() ? ""
                         : "those of the recording, which has its own; in " + directory + " " + apart +
                               "; --machine-parameters uses the machine's";
  if (options.service == "parameters")
    throw std::runtime_error(
        "--machine-parameters: the parameters are what service parameters writes: verify another one");
  use_parameters(recording, delivered);
  return "those of " + directory + ", " + (apart.empty() ? "as recorded" : apart);
}

}  // namespace

VerifyResult verify(const VerifyOptions& options) {
  auto recording = load_recording(options.recording);
  if (!recording.damages.empty()) throw std::runtime_error(options.recording + ": " + recording.problem);
  drop_repetitions(recording.messages);
  try {
    require_contract(recording, options.service);
    const auto parameters = choose_parameters(options, recording);
    auto result = options.service == "gateway" ? verify_gateway(options, recording)
                                               : verify_service(options, recording);
    result.parameters = parameters;
    result.cut_off = recording.problem;
    if (!result.equal())
      if (const auto cut = interrupted_network(recording); !cut.empty())
        result.problem += (result.problem.empty() ? "" : "; ") + cut;
    return result;
  } catch (const NothingToVerify&) {
    throw;
  } catch (const std::runtime_error& error) {
    const auto cut = interrupted_network(recording);
    if (recording.complete && cut.empty()) throw;
    throw std::runtime_error(error.what() + (cut.empty() ? "" : "; " + cut) +
                             (recording.complete ? "" : "; " + recording.problem));
  }
}

}  // namespace trunnion::verification
