// SPDX-License-Identifier: Apache-2.0
#include "servo_session.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <thread>

#include "figures.hpp"
#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "stored_program.hpp"

namespace trunnion::cli {

using idl::channel::CommandKind;
using idl::channel::Mode;
using idl::channel::RunState;
using idl::servo::TestPhase;
using servo_analysis::AxisTrace;

namespace {

constexpr const char* servo_program = "servo-test.tmp.nc";
constexpr double servo_answer_time = 30, longest_motion = 600;  // s of wall time
constexpr int most_runs = 4;                                    // of a test whose samples are lost
constexpr std::size_t columns = 8;                              // of a sample of idl/servo.idl

std::atomic<bool> interrupted{false};

void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

void append(AxisTrace& t, const double* v) {
  t.setpoint.push_back(v[0]), t.feedback.push_back(v[1]), t.speed_set.push_back(v[2]);
  t.speed.push_back(v[3]), t.torque.push_back(v[4]), t.excitation.push_back(v[5]);
  t.motor.push_back(v[6]), t.load.push_back(v[7]);
}

}  // namespace

double SessionAxis::into_travel(double distance) const {
  distance = std::abs(distance);
  if (high - place >= distance && high - place >= place - low) return distance;
  if (place - low >= distance) return -distance;
  throw std::runtime_error(text("axis %c at %.3f %s cannot move by %.3f: its travel is %.3f .. %.3f", letter,
                                place, turns ? "deg" : "mm", distance, low, high));
}

ServoSession::ServoSession(const std::string& machine, std::optional<std::uint32_t> domain,
                           std::uint16_t channel)
    : channel_(channel), client_id_(service::make_client_id()) {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  cluster_.emplace(machine, domain);
  client_ = std::make_unique<cluster::Client>(cluster_->running().run.domain);
  auto& bus = client_->bus();
  samples_ = std::make_unique<bus::Reader<idl::servo::TestSamples>>(bus.reader(topics::servo_test_samples));
  requests_ = std::make_unique<bus::Writer<idl::servo::TestRequest>>(bus.writer(topics::servo_test_request));
  alarms_ = std::make_unique<bus::Reader<idl::service::Alarm>>(bus.reader(topics::alarm));
  parameters_ = machine::parameters_of(client_->newest(topics::parameter_set));
  before_ = state();
  if (before_.state != RunState::IDLE)
    throw std::runtime_error("channel " + std::to_string(channel_) + " is busy: end its program or reset it");
  if (!before_.homed) throw std::runtime_error("axes have no reference: select mode REF and reference them");
  take_axes();
}

ServoSession::~ServoSession() {
  try {
    if (moving_) client_->channel(channel_, CommandKind::FEED_HOLD);
    end_test(nullptr);
    if (moving_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      client_->channel(channel_, CommandKind::RESET);
    }
    if (uploaded_ && !cluster_->own()) {
      if (!before_.program.empty()) client_->select_program(channel_, before_.program);
      client_->set_mode(channel_, before_.mode);
      idl::program::ProgramRequest remove;
      remove.operation = idl::program::Operation::REMOVE;
      remove.name = servo_program;
      client_->program(remove);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "trunnion: after the servo test: %s\n", e.what());
  }
}

idl::channel::ChannelState ServoSession::state() { return client_->newest(topics::channel_state, channel_); }

void ServoSession::take_axes() {
  for (std::size_t i = 0; i < before_.axes.size(); ++i) {
    SessionAxis a;
    a.letter = before_.letters[i];
    a.number = before_.axes[i];
    a.turns = parameters_.integer(parameter::axis_type, a.number) != machine::axis_type_linear;
    a.place = before_.machine[i];
    const auto travel = machine::travel_of(parameters_, a.number);
    a.low = travel.negative;
    a.high = travel.positive;
    a.highest_feed = parameters_.get(parameter::maximum_feed, a.number);
    a.acceleration = parameters_.get(parameter::maximum_acceleration, a.number);
    axes_.push_back(a);
  }
}

const SessionAxis& ServoSession::axis(const std::string& letter) const {
  std::string known;
  for (const auto& a : axes_) {
    if (letter.size() == 1 && a.letter == letter[0]) return a;
    known += a.letter;
  }
  throw std::runtime_error("--axis " + letter + ": channel " + std::to_string(channel_) + " has the axes " +
                           known);
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
  if (interrupted)
    throw std::runtime_error("interrupted: the axes are stopped, the parameters are those of before");
  for (idl::service::Alarm a; alarms_->take(a);)
    if (moving_ && a.active && a.severity >= idl::service::Severity::ERROR)
      throw std::runtime_error("alarm " + std::to_string(a.number) + " (" + a.source + "): " + a.text +
                               "; the parameters are those of before");
}

void ServoSession::start_program(const std::string& program) {
  check();
  client_->set_mode(channel_, Mode::AUTO);
  if (program == program_) {  // it is stored still; the channel has put back the operator's
    client_->select_program(channel_, servo_program);
    return;
  }
  program_.clear();
  uploaded_ = true;
  client_->upload(servo_program, program);
  const auto stored = find_program(client_->newest(topics::program_list), servo_program);
  // The list with the new program may reach the channel after the store's answer has reached us.
  const double until = service::monotonic_seconds() + servo_answer_time;
  for (;;) {
    try {
      client_->select_program(channel_, servo_program);
      if (stored && state().program_revision >= stored->revision) break;
    } catch (const std::exception&) {
      if (service::monotonic_seconds() > until) throw;
    }
    if (service::monotonic_seconds() > until)
      throw std::runtime_error("the channel does not take the program of the test");
    pause();
  }
  program_ = program;
}

// Reads samples meanwhile, so that none is lost.
void ServoSession::await_end(SessionResult* result) {
  moving_ = true;
  client_->channel(channel_, CommandKind::CYCLE_START);
  auto states = client_->reader_from_now(topics::channel_state);
  const double until = service::monotonic_seconds() + longest_motion;
  while (service::monotonic_seconds() < until) {
    check();
    if (result != nullptr) take_samples(*result);
    for (idl::channel::ChannelState s; states.take(s);) {
      if (s.channel != channel_) continue;
      if (s.state == RunState::HELD || s.state == RunState::INTERRUPTED)
        throw std::runtime_error("the motion of the test was held or interrupted");
      if (s.state == RunState::IDLE) {
        moving_ = false;
        return;
      }
    }
    client_->bus().signal().wait(0.01);
  }
  throw std::runtime_error("the motion of the test did not end");
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
    if (s.first != expected_) result.lost = true, expected_ = s.first;
    if (result.phase != TestPhase::ENDED_BY_VIBRATION) result.phase = s.phase;
    result.vibration = std::max(result.vibration, s.vibration);
    const std::size_t n = s.axes.size();
    result.traces.resize(n);
    for (std::size_t k = 0; k * columns < s.values.size(); ++k)
      append(result.traces[k % n], &s.values[k * columns]);
    for (auto& t : result.traces) t.interval = s.interval;
    expected_ += s.values.size() / columns / n;
    ended = ended || s.phase == TestPhase::COMPLETED || s.phase == TestPhase::ENDED_BY_CLIENT ||
            s.phase == TestPhase::ENDED_BY_STOP;
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
  await_end(nullptr);
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
  client_->channel(channel_, CommandKind::RESET);
}

std::string to_and_fro_program(const SessionAxis& axis, double distance, double feed, int strokes) {
  // Incremental: an axis that counts modulo 360 would go to an angle by the shorter way.
  std::string program = "G91\n";
  for (int i = 0; i < strokes + strokes % 2; ++i)
    program += text("G1 %c%.6f F%.3f\n", axis.letter, i % 2 == 0 ? distance : -distance, feed);
  return program + "G90\nM30\n";
}

std::string circle_program(const SessionAxis& first, const SessionAxis& second, double radius, double feed) {
  const double to_centre = first.into_travel(2 * radius) / 2;
  if (second.place - radius < second.low || second.place + radius > second.high)
    throw std::runtime_error(text("axis %c at %.3f mm has no space for a circle of radius %.3f mm",
                                  second.letter, second.place, radius));
  const auto centre_word = [](char letter) { return static_cast<char>('I' + (letter - 'X')); };
  const std::string both{std::min(first.letter, second.letter), std::max(first.letter, second.letter)};
  const char* plane = both == "XY" ? "G17" : both == "XZ" ? "G18" : both == "YZ" ? "G19" : nullptr;
  if (plane == nullptr) throw std::runtime_error("a circle needs two of the axes X, Y, Z");
  const auto turn =
      text("G3 %c%.6f %c0 F%.3f\n", centre_word(first.letter), to_centre, centre_word(second.letter), feed);
  return std::string(plane) + "\n" + turn + turn + "G17\nM30\n";
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

}  // namespace trunnion::cli
