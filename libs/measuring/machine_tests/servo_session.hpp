// SPDX-License-Identifier: Apache-2.0
// Servo tests on a running cluster: programs that move axes, excitation and samples of the drive.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/machine_session.hpp"
#include "cluster/session_cluster.hpp"
#include "machine/parameters.hpp"
#include "machine_tests/test_samples.hpp"
#include "servo_analysis/axis_tuning.hpp"
#include "servo_analysis/test_programs.hpp"

namespace trunnion::machine_tests {

using servo_analysis::TestedAxis;

/// The computer did not take the drive's samples in time, in any of four runs; the motion has ended.
struct SamplesLost : std::runtime_error {
  SamplesLost() : std::runtime_error("samples of the drive were lost: this computer is too slow") {}
};

/// Takes the channel of a machine at rest. When it ends, however that is, the drive's test has ended, the
/// channel has its mode and its selected program again, and nothing is left in the program store. An
/// interruption, an alarm and a hold end a test with std::runtime_error.
class ServoSession {
 public:
  /// `machine` empty: the cluster that runs; else a cluster of this machine in virtual time, which ends with
  /// the session. `interrupted` says whether the operator wants the end; it may be empty.
  ServoSession(const std::string& machine, std::optional<std::uint32_t> domain, std::uint16_t channel,
               std::function<bool()> interrupted);
  ~ServoSession();
  ServoSession(const ServoSession&) = delete;
  ServoSession& operator=(const ServoSession&) = delete;

  /// Throws std::runtime_error when the channel has no such axis.
  const TestedAxis& axis(const std::string& letter) const;
  const std::vector<TestedAxis>& axes() const { return axes_; }
  const machine::Parameters& parameters() const { return parameters_; }
  const std::string& machine() const { return cluster_.running().machine; }
  const std::string& machine_directory() const { return cluster_.running().machine_directory; }

  /// Length of tool `number` with its wear, mm. Throws std::runtime_error when there is no such tool.
  double tool_length(std::uint32_t number);

  /// Runs the program while the test runs; without a program until the test has ended by itself. Repeats a
  /// run whose samples were lost, the third and the fourth without a signal with half as many samples each:
  /// the interval is that of the result. Throws SamplesLost.
  SessionResult run(idl::servo::TestRequest request, const std::string& program);
  /// Runs a program alone.
  void move(const std::string& program);
  /// The same; calls `meanwhile` at least every 10 ms.
  void watch(const std::string& program, const std::function<void()>& meanwhile);
  /// When an exception has ended the test: resets the channel and executes `program`, also when the operator
  /// wants the end. Throws std::runtime_error when the channel does not execute it.
  void recover(const std::string& program);
  /// The channel executes nothing.
  bool idle() { return channel_->state().state == idl::channel::RunState::IDLE; }
  cluster::Client& client() { return *client_; }
  /// Writes values in one activation, with `who` in the journal, and activates them by a reset.
  void write(const std::vector<servo_analysis::ServoSettings::Value>& values, const std::string& who);

 private:
  SessionResult run_once(idl::servo::TestRequest request, const std::string& program);
  void take_axes();
  void start_program(const std::string& program);
  void await_end(SessionResult* result);
  void await_end(const std::function<void()>& meanwhile);
  void begin_test(const idl::servo::TestRequest& request);
  bool take_samples(SessionResult& result);
  void end_test(SessionResult* result);
  void check();
  void renew();

  std::function<bool()> interrupted_;
  cluster::SessionCluster cluster_;
  std::unique_ptr<cluster::Client> client_;
  std::optional<cluster::MachineSession> channel_;
  std::unique_ptr<bus::Writer<idl::servo::TestRequest>> requests_;
  std::unique_ptr<bus::Reader<idl::servo::TestSamples>> samples_;
  std::unique_ptr<bus::Reader<idl::service::Alarm>> alarms_;
  std::uint64_t client_id_, number_ = 0, expected_ = 0;
  idl::servo::TestRequest request_;
  double renewed_ = 0;
  bool testing_ = false;
  machine::Parameters parameters_;
  std::vector<TestedAxis> axes_;
};

/// One axis of a session, for figures and tuning.
class SessionAxisUnderTest : public servo_analysis::AxisUnderTest {
 public:
  /// `partner`: for circles; null: none.
  SessionAxisUnderTest(ServoSession& session, const TestedAxis& axis, const TestedAxis* partner)
      : session_(session), axis_(axis), partner_(partner) {}
  servo_analysis::MotionResult move(const servo_analysis::ServoSettings& trial,
                                    const servo_analysis::ServoSettings& fallback, double vibration_limit,
                                    const servo_analysis::TestMotion& motion) override;

 private:
  ServoSession& session_;
  const TestedAxis& axis_;
  const TestedAxis* partner_;
};

}  // namespace trunnion::machine_tests
