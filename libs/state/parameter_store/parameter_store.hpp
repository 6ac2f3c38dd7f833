// SPDX-License-Identifier: Apache-2.0
// The one owner of parameters, tools and work offsets: checks, journals, keeps and activates them.
#pragma once

#include <vector>

#include "contracts/types.hpp"
#include "machine/axis_faults.hpp"
#include "parameter_store/active_set.hpp"
#include "parameter_store/machine_tables.hpp"
#include "parameter_store/storage.hpp"
#include "parameter_store/tool_tables.hpp"

namespace trunnion::parameters {

/// What the machine builder delivers: the values a saved value is an exception from.
struct MachineDefaults {
  Values values;
  tool_tables::Tools tools;
  tool_tables::Offsets offsets;
};

/// Which published topics have news.
struct Changes {
  bool set = false, tools = false, offsets = false;
};

class ParameterStore {
 public:
  /// Reads what is saved. `boot` names this start of the cluster: when it is the one the kept active set
  /// belongs to, exactly that set is active again; otherwise (or when empty) everything stored becomes
  /// active. Throws std::runtime_error with file:line:column, StorageError when the state cannot be kept.
  ParameterStore(Storage& storage, MachineDefaults defaults, const std::string& boot);

  /// All or nothing; refused too when more parameters than before would not fit together. `time` (ISO 8601)
  /// goes into the journal only.
  idl::parameters::ParameterReply apply(const idl::parameters::ParameterRequest& request,
                                        const std::string& time);
  /// A channel shows its count of resets: when it has gone up, values that wait for a reset become active.
  /// Throws StorageError, and activates nothing then.
  void channel_reset_count(std::uint16_t channel, std::uint32_t count);

  idl::parameters::ParameterSet set() const;
  idl::parameters::ToolTable tool_table() const;
  idl::parameters::WorkOffsets work_offsets() const;
  std::uint64_t revision() const { return active_.revision; }
  /// What does not fit together of the stored values, of which some may wait to become active.
  std::vector<machine::ParameterFault> faults() const;
  /// News since the last call.
  Changes take_changes();
  /// Why the journal cannot be used, or why the start could not be stored when nothing else was new; or
  /// empty.
  const std::string& problem() const { return problem_; }

 private:
  struct State {
    Values overrides;  ///< stored values that differ from the machine's defaults
    tool_tables::Tools tools;
    tool_tables::Offsets offsets;
    std::uint64_t tools_revision = 1, offsets_revision = 1;
  };
  machine::ParameterValue machine_default(std::uint32_t number) const;
  machine::ParameterValue stored(const Values& overrides, std::uint32_t number) const;
  Values effective(const Values& overrides) const;
  std::vector<std::uint32_t> waiting(const ActiveSet& active, const Values& overrides) const;
  bool activate(ActiveSet& active, const Values& overrides, machine::Activation upto) const;
  std::string change(State& next, const idl::parameters::ParameterRequest& request,
                     std::vector<std::string>& journal, const std::string& time) const;
  std::string misfit(const Values& overrides) const;
  void repair_journal();
  void begin(const ActiveSet& next, bool kept);
  void commit(const State& next, const ActiveSet& active, const std::vector<std::string>& journal);

  Storage& storage_;
  MachineDefaults defaults_;
  State state_;
  ActiveSet active_;
  Changes changes_{true, true, true};
  std::string problem_;
};

inline constexpr const char* parameters_file = "parameters.yaml";
inline constexpr const char* active_file = "active.yaml";
inline constexpr const char* journal_file = "journal.jsonl";

}  // namespace trunnion::parameters
