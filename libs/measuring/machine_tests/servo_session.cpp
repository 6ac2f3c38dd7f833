// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/servo_session.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>
#include <utility>

#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::machine_tests {

using idl::channel::CommandKind;
using idl::servo::TestPhase;

namespace {

constexpr const char* servo_program = "servo-test.tmp.nc";
constexpr double servo_answer_time = 30, longest_motion = 600, longest_recovery = 60;  // s of wall time
constexpr int most_runs = 4;  // of a test whose samples are lost

void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

}  // namespace

ServoSession::ServoSession(const std::string& machine, std::optional<std::uint32_t> domain,
                           std::uint16_t channel, std::function<bool()> interrupted)
    : interrupted_(std::move(interrupted)), cluster_(machine, domain), client_id_(service::make_client_id()) {
  client_ = std::make_unique<cluster::Client>(cluster_.running().run.domain);
  auto& bus = client_->bus();
  samples_ = std::make_unique<bus::Reader<idl::servo::TestSamples>>(bus.reader(topics::servo_test_samples));
  requests_ = std::make_unique<bus::Writer<idl::servo::TestRequest>>(bus.writer(topics::servo_test_request));
  alarms_ = std::make_unique<bus::Reader<idl::service::Alarm>>(bus.reader(topics::alarm));
  parameters_ = machine::parameters_of(client_->newest(topics::parameter_set));
  channel_.emplace(*client_, channel);
  channel_->take();
  take_axes();
}

ServoSession::~ServoSession() {
  try {
    channel_->hold();
    end_test(nullptr);
    channel_->end();
    if (!cluster_.own()) channel_->restore();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "trunnion: after the servo test: %s\n", e.what());
  }
}

void ServoSession::take_axes() {
  const auto& state = channel_->before();
  for (std::size_t i = 0; i < state.axes.size(); ++i) {
    TestedAxis a;
    a.letter = state.letters[i];
    a.number = state.axes[i];
    a.turns = parameters_.integer(parameter::axis_type, a.number) != machine::axis_type_linear;
    a.place = state.machine[i];
    const auto travel = machine::travel_of(parameters_, a.number);
    a.low = travel.negative;
    a.high = travel.positive;
    a.highest_feed = parameters_.get(parameter::maximum_feed, a.number);
    a.acceleration = parameters_.get(parameter::maximum_acceleration, a.number);
    axes_.push_back(a);
  }
}

const TestedAxis& ServoSession::axis(const std::string& letter) const {
  std::string known;
  for (const auto& a : axes_) {
    if (letter.size() == 1 && a.letter == letter[0]) return a;
    known += a.letter;
  }
  throw std::runtime_error("--axis " + letter + ": channel " + std::to_string(channel_->number()) +
                           " has the axes " + known);
}

double ServoSession::tool_length(std::uint32_t number) {
  for (const auto& tool : client_->newest(topics::tool_table).tools)
    if (tool.number == number) return tool.length + tool.length_wear;
  throw std::runtime_error("--tool " + std::to_string(number) + ": the tool table has no such tool");
}

// The drive ends a test whose client is gone.
void ServoSession::renew() {
  if (!testing_ || service::monotonic_seconds() - renewed_ < 0.5) return;
  requests_->write(request_);
  renewed_ = service::monotonic_seconds();
}

void ServoSession::check() {
  renew();
  if (interrupted_ && interrupted_())
    throw std::runtime_error("interrupted: the axes are stopped, the parameters are those of before");
  for (idl::service::Alarm a; alarms_->take(a);)
    if (channel_->moves() && a.active && a.severity >= idl::service::Severity::ERROR)
      throw std::runtime_error("alarm " + std::to_string(a.number) + " (" + a.source + "): " + a.text +
                               "; the parameters are those of before");
}

void ServoSession::start_program(const std::string& program) {
  check();
  channel_->select_temporary(servo_program, program);
}

void ServoSession::await_end(const std::function<void()>& meanwhile) {
  const auto end = channel_->run(
      [&] {
        check();
        meanwhile();
      },
      longest_motion);
  if (end == cluster::MachineSession::End::stopped)
    throw std::runtime_error("the motion of the test was held or interrupted");
  if (end == cluster::MachineSession::End::overdue)
    throw std::runtime_error("the motion of the test did not end");
}

// Reads samples meanwhile, so that none is lost.
void ServoSession::await_end(SessionResult* result) {
  await_end([&] { take_samples(*result); });
}

void ServoSession::begin_test(const idl::servo::TestRequest& request) {
  const double until = service::monotonic_seconds() + servo_answer_time;
  while (requests_->matched() == 0 && service::monotonic_seconds() < until) pause();
  request_ = request;
  requests_->write(request_);
  renewed_ = service::monotonic_seconds();
  testing_ = true;
  expected_ = 0;
}

// True when the test has ended.
bool ServoSession::take_samples(SessionResult& result) {
  bool ended = false;
  for (idl::servo::TestSamples s; samples_->take(s);) {
    if (s.client != client_id_ || s.number != number_) continue;
    if (s.phase == TestPhase::REFUSED) {
      testing_ = false;
      throw std::runtime_error("the drive refuses the test: " + s.reason);
    }
    ended = add_samples(result, expected_, s) || ended;
  }
  return ended;
}

void ServoSession::end_test(SessionResult* result) {
  if (!testing_) return;
  testing_ = false;
  idl::servo::TestRequest end;
  end.client = client_id_, end.number = ++number_, end.end = true;
  requests_->write(end);
  --number_;
  SessionResult unused;
  // The last samples come with the end; nobody waits long for them when the result is not needed.
  const double until = service::monotonic_seconds() + (result != nullptr ? servo_answer_time : 1);
  bool ended = false;
  while (!ended && service::monotonic_seconds() < until) {
    ended = take_samples(result != nullptr ? *result : unused);
    // A test that was ended by a vibration, or by a stop, says nothing new at its end.
    if (result != nullptr)
      ended = ended || result->phase == TestPhase::ENDED_BY_VIBRATION ||
              result->phase == TestPhase::ENDED_BY_STOP;
    pause();
  }
  if (result != nullptr && !ended) result->lost = true;
  ++number_;
}

void ServoSession::move(const std::string& program) {
  start_program(program);
  await_end([] {});
}

void ServoSession::watch(const std::string& program, const std::function<void()>& meanwhile) {
  start_program(program);
  await_end(meanwhile);
}

void ServoSession::recover(const std::string& program) {
  client_->channel(channel_->number(), CommandKind::RESET);
  const double until = service::monotonic_seconds() + longest_recovery;
  while (channel_->state().state != idl::channel::RunState::IDLE) {
    if (service::monotonic_seconds() > until) throw std::runtime_error("the channel does not come to rest");
    pause();
  }
  channel_->select_temporary(servo_program, program);
  if (channel_->run([] {}, longest_recovery) != cluster::MachineSession::End::idle)
    throw std::runtime_error("its program does not end");
}

// The writer of the drive keeps the newest samples only, and a busy computer may take them too late.
SessionResult ServoSession::run(idl::servo::TestRequest request, const std::string& program) {
  for (int runs = 1;; ++runs) {
    auto result = run_once(request, program);
    if (!result.lost) return result;
    if (runs == most_runs) throw SamplesLost();
    // The response to a signal needs the rate that was asked for.
    if (runs > 1 && request.signal == idl::servo::TestSignal::NONE)
      request.decimation = static_cast<std::uint16_t>(2 * request.decimation);
  }
}

SessionResult ServoSession::run_once(idl::servo::TestRequest request, const std::string& program) {
  request.client = client_id_;
  request.number = ++number_;
  SessionResult result;
  if (!program.empty()) start_program(program);
  begin_test(request);
  if (program.empty()) {
    const double until = service::monotonic_seconds() + longest_motion;
    while (!take_samples(result)) {
      check();
      if (service::monotonic_seconds() > until) throw std::runtime_error("the test of the drive did not end");
      client_->bus().signal().wait(0.01);
    }
    testing_ = false;
    return result;
  }
  // The drive has it before the axes move: its first answer has come.
  const double until = service::monotonic_seconds() + servo_answer_time;
  while (result.traces.empty() && result.phase != TestPhase::RUNNING) {
    take_samples(result);
    if (service::monotonic_seconds() > until) throw std::runtime_error("the drive does not answer");
    pause();
  }
  await_end(&result);
  end_test(&result);
  if (result.phase == TestPhase::ENDED_BY_STOP)
    throw std::runtime_error("the drive has ended the test: the axes were stopped");
  return result;
}

void ServoSession::write(const std::vector<servo_analysis::ServoSettings::Value>& values,
                         const std::string& who) {
  idl::parameters::ParameterRequest request;
  request.operation = idl::parameters::Operation::IMPORT;
  for (const auto& v : values) request.values.push_back({v.number, v.value, ""});
  request.who = who;
  client_->parameter(std::move(request));
  client_->channel(channel_->number(), CommandKind::RESET);
}

servo_analysis::MotionResult SessionAxisUnderTest::move(const servo_analysis::ServoSettings& trial,
                                                        const servo_analysis::ServoSettings& fallback,
                                                        double vibration_limit,
                                                        const servo_analysis::TestMotion& motion) {
  idl::servo::TestRequest request;
  request.axes = {axis_.number};
  request.vibration_limit = vibration_limit;
  request.in_motion = true;
  request.duration = longest_motion;
  request.decimation = motion.radius > 0 ? 8 : 2;
  const auto values = trial.values(axis_.number), second = fallback.values(axis_.number);
  for (std::size_t i = 0; i < values.size(); ++i)
    request.trial.push_back({values[i].number, values[i].value, second[i].value});
  const auto program = motion.radius > 0 ? circle_program(axis_, *partner_, motion.radius, motion.feed)
                                         : to_and_fro_program(axis_, axis_.into_travel(motion.distance),
                                                              motion.feed, motion.strokes);
  auto result = session_.run(request, program);
  if (result.traces.empty()) throw std::runtime_error("the drive gave no samples of the motion");
  return {result.phase == TestPhase::ENDED_BY_VIBRATION, result.vibration, std::move(result.traces[0])};
}

}  // namespace trunnion::machine_tests
