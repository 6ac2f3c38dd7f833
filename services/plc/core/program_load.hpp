// SPDX-License-Identifier: Apache-2.0
// New programs on their way into a running PLC: written, translated, compared, taken over.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "online_comparison.hpp"
#include "plc/devices/modbus_file.hpp"

namespace trunnion::plc {

inline constexpr std::size_t most_source_bytes = 4 << 20, most_source_files = 200;

/// What translating has given.
struct Translated {
  std::optional<Programs> programs;  ///< nothing with errors
  st::ModbusFile modbus;
  st::Changeover change;
  std::vector<std::string> messages;
};

class ProgramLoad {
 public:
  using Phase = idl::plc::LoadPhase;

  Phase phase() const { return phase_; }
  const SourceFiles& files() const { return files_; }

  // Each returns an empty text, or why it is refused.
  void begin();
  std::string write(const std::string& file, std::string_view data);
  /// The caller translates files() and gives the result to translated().
  std::string start_compiling();
  void translated(Translated result);
  /// From now on every call on the running core is made on comparison()->core() too.
  std::string start_comparing(const PlcCore& running);
  /// Whether the programs may take over.
  std::string may_take_over(bool accept_differences) const;
  void end();

  OnlineComparison* comparison() { return comparison_.get(); }
  /// Of COMPILED and COMPARING.
  Programs& programs() { return *result_.programs; }
  const st::Changeover& change() const { return result_.change; }
  const st::ModbusFile& modbus() const { return result_.modbus; }
  /// LOAD_STATUS.
  idl::plc::OnlineReply status(std::uint32_t first) const;

 private:
  Phase phase_ = Phase::NO_LOAD;
  SourceFiles files_;
  std::size_t bytes_ = 0;
  Translated result_;
  std::unique_ptr<OnlineComparison> comparison_;
};

/// What runs while new programs are translated.
struct RunningSources {
  st::Variables variables;
  st::ModbusFile modbus;
};
using st::modbus_of;
/// translate(), modbus_of() and what `running` keeps; errors are messages.
Translated translated(const SourceFiles& files, bool simulated, const RunningSources& running);

}  // namespace trunnion::plc
