// SPDX-License-Identifier: Apache-2.0
// One generated program on its way: stored, and, unless a program calls it, selected, started, and its macro
// variables when it has ended.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "machine_view.hpp"

namespace trunnion::measurement {

/// What is asked of another service. One at a time; answered by an Answer.
using Request = std::variant<idl::channel::ChannelRequest, idl::program::ProgramRequest,
                             idl::parameters::ParameterRequest>;
struct Answer {
  bool accepted = false;
  std::string reason;
  std::uint64_t revision = 0;  ///< of the program that was stored
};

class GeneratedProgram {
 public:
  enum class Kind {
    store,   ///< is only stored
    execute  ///< and executed
  };
  /// It takes the place of a program of the name. An executed text must leave `serial` as completed() says.
  GeneratedProgram(std::uint16_t channel, Kind kind, std::string name, std::string text,
                   std::uint32_t serial);

  /// Time goes on, or news came. `now`: s, monotonic.
  void step(MachineView& machine, double now);
  /// The request that is to be sent next; then answered() is owed.
  std::optional<Request> take_request();
  void answered(const Answer& answer, double now);

  bool done() const { return step_ == Step::done; }
  bool failed() const { return step_ == Step::failed; }
  const std::string& error() const { return error_; }  ///< one line
  std::uint32_t alarm() const { return alarm_; }       ///< number of the cause, 0 = no alarm
  const calibration::MacroVariables& variables() const { return variables_; }
  const std::string& name() const { return name_; }
  std::uint64_t revision() const { return revision_; }  ///< of the stored text

 private:
  enum class Step {
    begin,
    write,
    commit,
    mode,
    select,
    start,
    settle,
    running,
    variables,
    news,
    done,
    failed
  };

  void ask(Request request);
  void ask_next();
  void fail(std::string otherwise, double now);
  void watch(const MachineView& machine, double now);

  std::uint16_t channel_;
  Kind kind_;
  std::string name_, text_;
  std::uint32_t serial_;
  Step step_ = Step::begin;
  std::optional<Request> request_;
  bool waits_ = false;       // for an answer
  std::size_t written_ = 0;  // bytes of the text
  int tries_ = 0;
  std::uint64_t states_before_ = 0;
  double since_ = 0;  // s, begin of the step
  std::string error_;
  std::uint32_t alarm_ = 0;
  std::uint64_t revision_ = 0;
  calibration::MacroVariables variables_;
};

}  // namespace trunnion::measurement
