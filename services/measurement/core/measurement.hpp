// SPDX-License-Identifier: Apache-2.0
// The measurement of the kinematics with a probe and a sphere, from its plan to the parameters: a state
// machine without bus, clock, thread and file.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "calibration/evaluation.hpp"
#include "calibration/touch_sequence.hpp"
#include "generated_program.hpp"
#include "stored_measurement.hpp"

namespace trunnion::measurement {

using idl::measurement::MeasurementReply;
using idl::measurement::MeasurementRequest;
using idl::measurement::MeasurementResult;
using idl::measurement::MeasurementState;
using idl::measurement::Phase;

/// The ways among the bodies of the machine. Nothing in it changes: another thread may ask.
class Ways {
 public:
  virtual ~Ways() = default;
  /// The pose can be measured, with a way to it from `from`: its approach position. Throws
  /// std::runtime_error: one line that names the pose.
  virtual calibration::AxisPosition check(const calibration::PlannedPose& pose,
                                          const calibration::AxisPosition& from) const = 0;
  /// Throws std::runtime_error: one line.
  virtual calibration::Way way(const calibration::AxisPosition& from,
                               const calibration::AxisPosition& to) const = 0;
};

/// What a search of ways has given.
struct WayAnswer {
  std::string error;  ///< empty, or why there is none
  calibration::Way way;
  calibration::AxisPosition end{};
};

/// The machine as its files have it.
struct MachineFacts {
  std::string name;
  machine::Parameters delivered;
  std::optional<calibration::ProbeAndSphere> gauges;
  /// Throws std::runtime_error. The arguments outlive what it makes.
  std::function<std::shared_ptr<const Ways>(const calibration::MeasurementInputs&,
                                            const calibration::MeasuredMachine&, std::uint16_t channel,
                                            const machine::Parameters& active)>
      ways;
};

inline constexpr const char* pose_program = "calibration_pose.tmp.nc";
/// The same for a program that calls CYCLE9960: the macro O9960 calls it by its number.
inline constexpr const char* part_program = "O99601.tmp.nc";

class Measurement {
 public:
  explicit Measurement(MachineFacts facts);

  /// What the process before has kept. A measurement that was under way is interrupted; nothing moves.
  void restore(StoredMeasurement kept);

  MachineView& machine() { return machine_; }
  void take(const idl::parameters::ParameterSet& set);
  bool has_parameters() const { return set_.has_value(); }
  /// `time`: of day, for the protocol. Whatever is refused changes nothing.
  MeasurementReply apply(const MeasurementRequest& request, const std::string& time, double now);
  /// A program calls the cycle, goes on or has ended. `time`: of day.
  void call(const idl::channel::CycleRequest& request, const std::string& time);
  /// What it is to be told; what is to be kept must be on the disk before.
  std::optional<idl::channel::CycleReply> take_reply();
  /// Time goes on, or news came. `now`: s, monotonic.
  void step(double now);

  /// The request that is to be sent next. What is to be kept (take_change) must be on the disk before.
  std::optional<Request> take_request();
  /// The answer to the newest request of the kind with this index in the variant.
  void answered(std::size_t kind, const Answer& answer, double now);
  /// A search that takes its time: to be called in any thread, its result is owed to worked().
  std::optional<std::function<WayAnswer()>> take_work();
  void worked(const WayAnswer& answer, double now);

  /// True when the stored measurement has changed since the last call.
  bool take_change();
  const StoredMeasurement& stored() const { return stored_; }

 private:
  struct Plan {
    calibration::MeasurementInputs inputs;
    calibration::MeasuredMachine measured;
    calibration::MeasurementPlan plan;
    machine::Parameters active;
    std::shared_ptr<const Ways> ways;  // null: by the upper end of Z
  };
  // Of a motion: a way is wanted, searched and found, the program is stored and runs, or is called.
  enum class Stage { way, search, found, program, called };
  // The program that has called the cycle.
  struct Caller {
    std::uint32_t number = 0;
    bool asks = false, ended = false;
    calibration::AxisPosition position{};
    calibration::MacroVariables values;
    std::uint8_t role = 0;
  };

  // measurement_orders.cpp
  std::shared_ptr<Plan> machine_to_measure(std::uint16_t channel) const;
  std::string prepare(const MeasurementRequest& request);
  std::string channel_fault(bool in_program) const;
  std::string start(const MeasurementRequest& request, const std::string& time, bool in_program = false);
  std::string go_on();
  std::string abort(double now);
  std::string confirm(const MeasurementRequest& request);
  std::string discard();
  void begin();

  // measurement_calls.cpp
  std::string start_called(const idl::channel::CycleRequest& request, const std::string& time);
  void watch_caller(double now);
  void answer(idl::channel::CycleOutcome outcome, const std::string& reason = "", std::uint64_t revision = 0);
  void settle_caller();
  bool called() const { return stored_.in_program; }
  bool caller_asks() const { return caller_ && caller_->asks; }

  // measurement_steps.cpp
  void change(Phase phase);
  void fail(const std::string& cause, std::uint32_t alarm, double now);
  std::string where() const;
  void ask(Request request, double now);
  void plan_next(double now);
  void drive(double now);
  calibration::AxisPosition target() const;
  calibration::Vec3 centre() const;
  calibration::Vec3 centre_of_first() const;
  bool over_pole() const;
  std::string program_text() const;
  void executed(const calibration::MacroVariables& variables, double now);
  void check_repeatability(const calibration::MacroVariables& variables);
  void pose_done();
  void search(std::function<WayAnswer()> work);
  double retract_height(const calibration::AxisPosition& from) const;
  void estimate(double now);
  void stop(double now);
  void write(double now);
  bool written_already() const;

  MachineFacts facts_;
  MachineView machine_;
  std::optional<idl::parameters::ParameterSet> set_;
  StoredMeasurement stored_;
  std::shared_ptr<Plan> plan_;
  std::unique_ptr<calibration::TouchSequence> touches_;
  bool changed_ = false;

  std::size_t planned_ = 0;  // poses whose ways are known
  Stage stage_ = Stage::way;
  calibration::AxisPosition from_{};
  calibration::Way way_;
  std::optional<GeneratedProgram> run_;
  std::uint32_t serial_ = 0;
  std::optional<std::function<WayAnswer()>> work_;
  bool searching_ = false;  // a search is out
  bool stale_ = false;      // and its result is of no use

  std::optional<Caller> caller_;
  std::optional<idl::channel::CycleReply> reply_;
  double away_since_ = -1;  // s: the caller is not to be seen executing its program

  std::optional<Request> request_;
  std::optional<std::size_t> asked_;  // kind of the request that waits for its answer
  double asked_since_ = 0;
  double stopping_since_ = 0;
  bool hold_sent_ = false;
  std::string cause_;  // of STOPPING
  std::uint32_t cause_alarm_ = 0;
  bool restored_write_ = false;  // the process ended while it wrote
};

}  // namespace trunnion::measurement
