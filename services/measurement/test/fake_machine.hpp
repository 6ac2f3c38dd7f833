// SPDX-License-Identifier: Apache-2.0
// A channel, a store and parameters that answer a measurement at once; the axes are where the newest program
// has put them, and the probe touches a sphere on a machine whose table is not where the control believes.
#pragma once

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include "machine/chain_parameters.hpp"
#include "machine/machine.hpp"
#include "measurement.hpp"

namespace trunnion::measurement {

constexpr double sphere_radius = 12.5, ball_radius = 3, probe_length = 60, measuring_path = 2;  // mm

inline MachineFacts test_facts(const std::string& name = "ac-table") {
  MachineFacts facts;
  facts.name = name;
  facts.delivered.values =
      machine::machine_parameters(machine::load_machine(TRUNNION_SOURCE "/configs/machines/" + name));
  calibration::ProbeAndSphere gauges;
  gauges.probe_length = probe_length;
  gauges.sphere = {60, 40, -360};
  facts.gauges = gauges;
  facts.ways = [](const auto&...) { return nullptr; };  // by the upper end of Z
  return facts;
}

class FakeMachine {
 public:
  /// `letters` of the channel of the machine.
  explicit FakeMachine(Measurement& core, const std::string& name = "ac-table",
                       const std::string& letters = "XYZAC")
      : core_(&core), facts_(test_facts(name)) {
    set.revision = 1;
    for (const auto& [number, value] : facts_.delivered.values)
      set.values.push_back({number, value.value, value.text});
    // The axis of A is 0.1 mm beside its place.
    auto real = machine::chain_parameters(facts_.delivered, 0);
    true_offset = 0.1;
    if (real.table_1) real.table_1->offset.y() += true_offset;
    become(real);
    state.letters = letters;
    state.homed = true;
  }

  /// The machine is truly so.
  void become(const geometry::ChainParameters& real) {
    chain_.emplace(std::get<geometry::Chain>(geometry::Chain::make(real)));
  }
  const machine::Parameters& delivered() const { return facts_.delivered; }
  void attach(Measurement& core) { core_ = &core; }
  void tell() {
    core_->take(set);
    auto& view = core_->machine();
    state.machine.clear();
    for (const char letter : state.letters)
      state.machine.push_back(position[std::string_view("XYZABCUVW").find(letter)]);
    view.take(state, now);
  }
  /// One step of the measurement; false when it asks for nothing and waits for nothing.
  void step() {
    now += 0.1;
    if (state.state == idl::channel::RunState::RUNNING && !endless) finish();
    tell();
    core_->step(now);
    take_news();
    if (auto work = core_->take_work()) core_->worked((*work)(), now);
    if (auto request = core_->take_request()) serve(*request);
  }
  /// A program calls CYCLE9960 with the probe over the pole of the sphere, as the control believes it to be.
  void call_cycle(const calibration::MacroVariables& arguments) {
    const auto model =
        std::get<geometry::Chain>(geometry::Chain::make(machine::chain_parameters(facts_.delivered, 0)));
    const calibration::Vec3 over(0, 0, sphere_radius + ball_radius + measuring_path);
    const calibration::Vec3 at = model.machine_from_tip(facts_.gauges->sphere + over, {}, probe_length);
    position = {at.x(), at.y(), at.z()};
    state.state = idl::channel::RunState::WAITING;
    state.program = "part.nc";
    values_.clear();
    for (const auto& [number, value] : arguments) values_[number] = value;
    ask(9960);
  }
  /// It executes the part it was told to call, and asks again.
  void execute_part() {
    execute(stored.at(reply.program));
    for (std::size_t i = 0; i < variables_.numbers.size(); ++i)
      values_[variables_.numbers[i]] = variables_.values[i];
    state.state = idl::channel::RunState::WAITING;
    ask(0);
  }
  /// It was told to call a part and has not done so.
  bool calls_due() const {
    return reply.number == call_.number && reply.outcome == idl::channel::CycleOutcome::CALL;
  }
  void end_program() {
    call_.caller = idl::channel::CycleCaller::ENDED;
    state.state = idl::channel::RunState::IDLE;
    core_->call(call_, "2026-01-31T12:00:00Z");
  }
  /// The program as long as it goes on; false when it waits for something that does not come.
  bool run_program(int most = 3000) {
    using idl::channel::CycleOutcome;
    for (int i = 0; i < most; ++i) {
      step();
      if (reply.number != call_.number || reply.outcome == CycleOutcome::RECEIVED) continue;
      if (reply.outcome != CycleOutcome::CALL) {
        end_program();
        return true;
      }
      ++calls;
      if (calls == ends_in_call) {
        end_program();
        return true;
      }
      execute_part();
    }
    return false;
  }
  void ask(std::uint32_t cycle) {
    call_.number += 1;
    call_.caller = idl::channel::CycleCaller::ASKS;
    call_.cycle = cycle;
    call_.program = "part.nc", call_.line = 7, call_.role = role;
    call_.machine.assign(position.begin(), position.end());
    call_.numbers.clear(), call_.values.clear();
    for (const auto& [number, value] : values_)
      call_.numbers.push_back(number), call_.values.push_back(value);
    tell();
    core_->call(call_, "2026-01-31T12:00:00Z");
    take_news();
  }
  /// The newest request, again: a new process finds it.
  void ask_again() {
    core_->call(call_, "2026-01-31T12:00:00Z");
    take_news();
  }
  /// Until nothing is under way, `most` steps at most.
  Phase run(int most = 3000) {
    for (int i = 0; i < most && is_active(core_->stored().state.phase); ++i) step();
    return core_->stored().state.phase;
  }
  MeasurementReply order(MeasurementRequest request) {
    tell();
    auto reply = core_->apply(request, "2026-01-31T12:00:00Z", now);
    if (core_->take_change()) kept.push_back(text_of(core_->stored()));
    return reply;
  }
  MeasurementReply order(idl::measurement::Operation operation) {
    MeasurementRequest request;
    request.operation = operation;
    request.who = "test";
    return order(request);
  }
  MeasurementReply measure(const std::string& inputs) {
    MeasurementRequest request;
    request.inputs = inputs;
    request.retract = true;
    request.who = "test";
    return order(request);
  }
  void raise(std::uint32_t number, bool active = true) {
    idl::service::Alarm alarm;
    alarm.number = number;
    alarm.active = active;
    alarm.severity = idl::service::Severity::ERROR;
    alarm.text = "cause";
    core_->machine().take(alarm);
  }

  idl::channel::ChannelState state;
  idl::parameters::ParameterSet set;
  std::map<std::string, std::string> stored;
  std::vector<Request> requests;
  std::vector<std::string> kept;
  std::optional<std::size_t> refused;  ///< number of the request that is refused
  std::optional<std::size_t> silent;   ///< number of the request that is not answered
  bool endless = false;                ///< programs do not end
  std::uint8_t role = 2;               ///< of who has stored the program that calls
  double true_offset = 0;              ///< mm
  double now = 0;
  idl::channel::CycleReply reply;        ///< the newest one
  unsigned calls = 0, ends_in_call = 0;  ///< of parts; the program is reset in this one, 0 = in none
  calibration::AxisPosition position{};

 private:
  void take_news() {
    if (core_->take_change()) kept.push_back(text_of(core_->stored()));
    if (const auto news = core_->take_reply()) reply = *news;
  }
  void serve(const Request& request) {
    const auto number = requests.size();
    requests.push_back(request);
    if (silent == number) return;
    Answer answer{true, "", ++revision_};
    if (refused == number)
      answer = {false, "refused"};
    else if (const auto* program = std::get_if<idl::program::ProgramRequest>(&request))
      store(*program);
    else if (const auto* command = std::get_if<idl::channel::ChannelRequest>(&request))
      obey(*command);
    else
      for (const auto& value : std::get<idl::parameters::ParameterRequest>(request).values)
        set.pending.push_back(value);
    core_->answered(request.index(), answer, now);
  }
  void store(const idl::program::ProgramRequest& request) {
    using idl::program::Operation;
    if (request.operation == Operation::BEGIN_UPLOAD) upload_.clear();
    if (request.operation == Operation::WRITE) upload_.append(request.data.begin(), request.data.end());
    if (request.operation == Operation::COMMIT_UPLOAD) stored[request.name] = upload_;
    if (request.operation == Operation::REMOVE) stored.erase(request.name);
  }
  void obey(const idl::channel::ChannelRequest& request) {
    using idl::channel::CommandKind;
    using idl::channel::RunState;
    if (request.command == CommandKind::SELECT_PROGRAM) state.program = request.program;
    if (request.command == CommandKind::CYCLE_START) state.state = RunState::RUNNING;
    if (request.command == CommandKind::FEED_HOLD) state.state = RunState::HELD;
  }

  void finish() {
    if (++running_ < 4) return;
    running_ = 0;
    execute(stored.at(state.program));
    state.state = idl::channel::RunState::IDLE;
    core_->machine().take(variables_);
  }
  void execute(const std::string& text) {
    std::map<std::uint32_t, double> values;
    std::uint32_t next = 52150;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::map<char, double> found;
      for (std::string word; words >> word;)
        if (word.size() > 1 && std::isalpha(static_cast<unsigned char>(word[0])) != 0)
          found[word[0]] = std::atof(word.c_str() + 1);
      if (line.starts_with("G53 G1"))
        for (const auto& [letter, value] : found)
          if (const auto axis = std::string_view("XYZABCUVW").find(letter); axis != std::string_view::npos)
            position[axis] = value;
      if (line.starts_with("G65 P9801"))
        for (const double value : touch({found['X'], found['Y'], found['Z']})) values[next++] = value;
      if (line.starts_with("#52999=")) values[52999] = std::atof(line.c_str() + 7);
    }
    variables_ = {};
    for (const auto& [number, value] : values) {
      variables_.numbers.push_back(number);
      variables_.values.push_back(value);
    }
  }
  // Where the ball meets the sphere, on a straight line from where it is.
  std::array<double, 3> touch(const calibration::Vec3& direction) const {
    calibration::Angles angles{};
    std::copy(position.begin() + 3, position.end(), angles.begin());
    const calibration::Vec3 from(position[0], position[1], position[2]);
    const auto tip = [&](double at) {
      return calibration::Vec3(chain_->tip_from_machine(from + at * direction, angles, probe_length) -
                               facts_.gauges->sphere);
    };
    const calibration::Vec3 start = tip(0), way = tip(1) - start;
    const double b = start.dot(way), radius = sphere_radius + ball_radius;
    const double at = -b - std::sqrt(b * b - start.squaredNorm() + radius * radius);
    const calibration::Vec3 edge = from + at * direction;
    return {edge.x(), edge.y(), edge.z()};
  }

  Measurement* core_;
  MachineFacts facts_;
  std::optional<geometry::Chain> chain_;
  std::string upload_;
  idl::channel::Variables variables_;
  idl::channel::CycleRequest call_;
  std::map<std::uint32_t, double> values_;
  std::uint64_t revision_ = 0;
  int running_ = 0;
};

}  // namespace trunnion::measurement
