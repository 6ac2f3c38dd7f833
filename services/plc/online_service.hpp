// SPDX-License-Identifier: Apache-2.0
// The side of the PLC that faces its programmers: which programs run, their values, new programs.
#pragma once

#include <functional>
#include <future>
#include <optional>
#include <string>

#include "force_request.hpp"
#include "loaded_programs.hpp"
#include "online_values.hpp"
#include "program_load.hpp"
#include "round_recorder.hpp"
#include "service/node.hpp"
#include "service/request.hpp"
#include "task_times.hpp"

namespace trunnion::plc {

/// The sources that run in this start of the cluster: those of a snapshot, those that were loaded online, or
/// those of the machine's directory. `directory` goes before their names in messages.
struct ActiveSources {
  SourceFiles files;
  std::string directory;
  std::optional<StoredPrograms> stored;  ///< when they were loaded online
  std::uint32_t delivered = 0;           ///< CRC-32 of the sources of the machine's directory
  storage::Kept kept;                    ///< the file of the state directory
};
/// Programs that were loaded online run until the machine's directory has others at a start of the cluster.
/// Throws std::runtime_error and storage::StorageError.
ActiveSources active_sources(const service::Node& node, const std::string& boot);
/// The first 55 bytes of the file that names the start of the cluster; empty without one.
std::string boot_of(const service::Node& node);

class OnlineService {
 public:
  /// A request takes effect: its source time stamp in ns.
  using Applied = std::function<void(std::int64_t source_time)>;

  OnlineService(service::Node& node, PlcCore& core, RoundRecorder& rounds, std::string boot, Applied applied);

  /// The programs to load into the core. Throws std::runtime_error with the errors of the programs.
  Programs start();
  /// The memory of the programs before, when they are not those of start(): the core has it afterwards with
  /// the variables that are kept. False when it is of neither.
  bool continue_from(const Memory& memory, bool same_run);

  /// Makes a call on the running core, and on one that is compared with it.
  template <class Act>
  void each(Act act) {
    act(core_);
    if (auto* comparison = load_.comparison()) act(comparison->core());
  }
  /// Takes requests. `now` in s.
  void pump(double now);
  /// After each round, with the functions finished in it.
  void compare(const std::vector<idl::plc::AuxiliaryDone>& done);
  void publish(double now);

  /// Other programs have taken over since the last call.
  bool has_taken_over() { return std::exchange(taken_over_, false); }
  /// It continues from a snapshot: what is forced was published before.
  void forces_are_published() { forces_written_ = true; }
  bool is_loading() const { return load_.phase() != ProgramLoad::Phase::NO_LOAD; }
  /// The sources that run, and what goes before their names in messages.
  const ActiveSources& sources() const { return sources_; }
  /// Of the programs that have taken over last.
  const st::ModbusFile& modbus() const { return modbus_; }
  /// start() has found it, where it could be read.
  void set_modbus(st::ModbusFile file) { modbus_ = std::move(file); }
  /// The sources, when they are not those of the machine's directory.
  const SourceFiles* loaded_sources() const { return sources_.stored ? &sources_.files : nullptr; }

 private:
  using Request = idl::plc::OnlineRequest;
  using Reply = idl::plc::OnlineReply;

  bool answer(const Request& request, std::int64_t source_time, double now);
  Reply change(const Request& request);
  Reply read_source(const Request& request) const;
  Reply list_uses(const Request& request) const;
  Reply list(const Request& request, double now);
  std::string take_over(const Request& request);
  void start_compiling();
  void journal(const Request& request, const std::string& what);

  service::Node& node_;
  PlcCore& core_;
  RoundRecorder& rounds_;
  std::string boot_;
  Applied applied_;
  ActiveSources sources_;
  st::ModbusFile modbus_;
  LoadedPrograms store_;
  OnlineValues values_{st::Variables()};
  st::Uses uses_;
  ProgramLoad load_;
  TaskTimes task_times_;
  std::future<Translated> worker_;
  std::future<void> synchronizing_;
  service::RequestServer<Request, Reply> requests_;
  bus::Writer<idl::plc::Watched> watched_;
  bus::Writer<idl::plc::Forces> forces_;
  bus::Writer<idl::plc::Programs> programs_;
  struct Waiting {
    Request request;
    std::int64_t source_time = 0;
  };
  std::optional<Waiting> waiting_;  ///< for the worker
  std::optional<idl::plc::Programs> last_programs_;
  double written_ = 0;
  bool forces_written_ = false, taken_over_ = false;
};

}  // namespace trunnion::plc
