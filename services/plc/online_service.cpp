// SPDX-License-Identifier: Apache-2.0
#include "online_service.hpp"

#include <chrono>
#include <fstream>
#include <iostream>
#include <sstream>

#include "bus/json.hpp"
#include "bus/json_type.hpp"
#include "machine/alarm_constants.hpp"
#include "ordinary_scheduling.hpp"
#include "program_files.hpp"
#include "service/damage_alarm.hpp"
#include "snapshot/fields.hpp"
#include "storage/file.hpp"
#include "text/utf8.hpp"

namespace trunnion::plc {
namespace {

using idl::plc::OnlineAction;

constexpr const char* programs_file = "/plc.programs";
constexpr const char* journal_file = "/plc.jsonl";
constexpr double watch_period = 0.05;  // s between two messages of a watch list

bool is_read_only(OnlineAction action) {
  return action <= OnlineAction::END_WATCH ||
         (action >= OnlineAction::START_TRACE && action <= OnlineAction::READ_SOURCE) ||
         action >= OnlineAction::LOAD_STATUS;
}

std::uint64_t steady_time() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(since).count());
}

bool is_done(const std::future<Translated>& worker) {
  return worker.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

idl::plc::OnlineReply reply_of(const std::string& refusal) {
  idl::plc::OnlineReply reply;
  reply.accepted = refusal.empty();
  reply.reason = text::shortened(refusal, 256);
  return reply;
}

SourceFiles sources_of(const bus::Json& json) {
  SourceFiles files;
  for (const auto& file : json)
    files.push_back({file.at("name").get<std::string>(), file.at("text").get<std::string>()});
  return files;
}

}  // namespace

std::string boot_of(const service::Node& node) {
  std::ifstream in(node.options().state_directory + "/cluster.boot", std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str().substr(0, 55);
}

ActiveSources active_sources(const service::Node& node, const std::string& boot) {
  ActiveSources active;
  const auto directory = node.options().machine.plc_directory();
  if (node.snapshot() != nullptr)
    if (const auto found = node.snapshot()->find("sources"); found != node.snapshot()->end()) {
      active.files = sources_of(*found);
      active.stored.emplace();
      return active;
    }
  const auto stored = LoadedPrograms(node.options().state_directory + programs_file).load(active.kept);
  try {
    active.files = read_sources(directory);
  } catch (const std::runtime_error&) {
    if (!stored || boot.empty() || stored->boot != boot) throw;
  }
  active.delivered = crc32_of(active.files);
  active.directory = directory + "/";
  if (!stored || ((boot.empty() || stored->boot != boot) && stored->delivered != active.delivered))
    return active;
  active.files = stored->active;
  active.directory.clear();
  active.stored = stored;
  return active;
}

OnlineService::OnlineService(service::Node& node, PlcCore& core, RoundRecorder& rounds, std::string boot,
                             Applied applied)
    : node_(node),
      core_(core),
      rounds_(rounds),
      boot_(std::move(boot)),
      applied_(std::move(applied)),
      store_(node.options().state_directory + programs_file),
      task_times_(steady_time),
      requests_(node.bus(), topics::online_request, topics::online_reply),
      watched_(node.bus().writer(topics::plc_watched)),
      forces_(node.bus().writer(topics::plc_forces)),
      programs_(node.bus().writer(topics::plc_programs)) {
  core_.set_task_times(&task_times_);
}

Programs OnlineService::start() {
  sources_ = active_sources(node_, boot_);
  const auto path = node_.options().state_directory + programs_file;
  service::report_damage(node_.alarms(), 1, path, sources_.kept,
                         "PLC programs that were loaded while it ran");
  if (sources_.kept.state == storage::KeptState::previous) storage::repair_kept(path, sources_.kept);
  store_.discard();  // of a process that ended while programs were loaded
  auto programs = translate(sources_.files, node_.options().machine.simulated(), sources_.directory);
  values_.replace(programs.variables, core_);
  uses_ = programs.uses;
  return programs;
}

bool OnlineService::continue_from(const Memory& memory, bool same_run) {
  if (!sources_.stored || sources_.stored->previous.empty()) return false;
  try {
    const bool simulated = node_.options().machine.simulated();
    auto before = translate(sources_.stored->previous, simulated);
    const auto variables = before.variables;
    PlcCore old;
    old.load(std::move(before));
    if (!old.accepts(memory.program)) return false;
    auto now = translate(sources_.files, simulated);
    const st::Changeover change(variables, now.variables, !same_run);
    if (same_run)
      old.restore(memory);
    else
      old.power_up(memory);
    old.take_over(now, change);
    core_.restore(old.memory());
    return true;
  } catch (const std::runtime_error&) {
    return false;  // of a version that understood other programs
  }
}

void OnlineService::pump(double now) {
  if (worker_.valid() && is_done(worker_)) load_.translated(worker_.get());
  if (waiting_ && answer(waiting_->request, waiting_->source_time, now)) waiting_.reset();
  Request request;
  while (!waiting_ && requests_.take(request))
    if (const auto time = requests_.info().source_timestamp; !answer(request, time, now))
      waiting_ = Waiting{request, time};
  values_.expire(now);
}

// False when the request waits for the worker.
bool OnlineService::answer(const Request& request, std::int64_t source_time, double now) {
  if (request.action == OnlineAction::READ_SOURCE) {
    requests_.reply(request, read_source(request));
  } else if (request.action == OnlineAction::LOAD_STATUS) {
    requests_.reply(request, load_.status(request.first));
  } else if (request.action == OnlineAction::LIST_USES) {
    requests_.reply(request, list_uses(request));
  } else if (request.action == OnlineAction::LIST_VARIABLES) {
    requests_.reply(request, list(request, now));
  } else if (is_read_only(request.action)) {
    requests_.reply(request, values_.answer(request, core_, now));
  } else {
    const bool needs_worker =
        request.action != OnlineAction::FORCE && request.action != OnlineAction::RELEASE;
    if (needs_worker && worker_.valid()) return false;
    applied_(source_time);
    requests_.reply(request, change(request));
  }
  return true;
}

idl::plc::OnlineReply OnlineService::change(const Request& request) {
  switch (request.action) {
    case OnlineAction::FORCE:
    case OnlineAction::RELEASE: {
      const auto refusal = change_forces(request, values_.variables(), core_);
      if (!refusal.empty()) return reply_of(refusal);
      if (auto* comparison = load_.comparison())
        change_forces(request, comparison->variables(), comparison->core());
      rounds_.record(StepKind::ONLINE_REQUEST, request);
      journal(request, request.action == OnlineAction::FORCE ? "force" : "release");
      forces_written_ = false;
      return reply_of("");
    }
    case OnlineAction::BEGIN_LOAD:
      store_.discard();
      load_.begin();
      return reply_of("");
    case OnlineAction::WRITE_SOURCE:
      return reply_of(load_.write(request.file,
                                  {reinterpret_cast<const char*>(request.data.data()), request.data.size()}));
    case OnlineAction::COMPILE: {
      const auto refusal = load_.start_compiling();
      if (refusal.empty()) start_compiling();
      return reply_of(refusal);
    }
    case OnlineAction::COMPARE:
      return reply_of(load_.start_comparing(core_));
    case OnlineAction::TAKE_OVER:
      return reply_of(take_over(request));
    case OnlineAction::END_LOAD:
      store_.discard();
      load_.end();
      return reply_of("");
    default:
      return reply_of("this request is not known");
  }
}

// Translating and writing to the disk take longer than a scan may.
void OnlineService::start_compiling() {
  StoredPrograms next;
  next.boot = boot_, next.delivered = sources_.delivered;
  next.changes = (sources_.stored ? sources_.stored->changes : 0) + 1;
  next.active = load_.files(), next.previous = sources_.files;
  const bool simulated = node_.options().machine.simulated();
  worker_ =
      std::async(std::launch::async,
                 [next, simulated, running = RunningSources{values_.variables(), modbus_}, store = store_] {
                   use_ordinary_scheduling();
                   auto result = translated(next.active, simulated, running);
                   try {
                     if (result.programs) store.prepare(next);
                   } catch (const storage::StorageError& e) {
                     result.programs.reset();
                     result.messages.emplace_back(e.what());
                   }
                   return result;
                 });
}

std::string OnlineService::take_over(const Request& request) {
  if (auto refusal = load_.may_take_over(request.accept_differences); !refusal.empty()) return refusal;
  if (rounds_.on()) return "another process of the PLC is compared with this one; wait until that has ended";
  try {
    store_.publish();
  } catch (const storage::StorageError& e) {
    return e.what();
  }
  // From here on a process that is started again has the new programs.
  StoredPrograms now;
  now.boot = boot_, now.delivered = sources_.delivered;
  now.changes = (sources_.stored ? sources_.stored->changes : 0) + 1;
  now.active = load_.files(), now.previous = sources_.files;
  sources_.files = now.active, sources_.directory.clear(), sources_.stored = std::move(now);
  core_.take_over(load_.programs(), load_.change());
  modbus_ = load_.modbus();
  values_.replace(load_.programs().variables, core_);
  uses_ = load_.programs().uses;
  task_times_.reset();
  load_.end();
  synchronizing_ = std::async(std::launch::async, [store = store_] {
    use_ordinary_scheduling();
    try {
      store.synchronize();
    } catch (const storage::StorageError& e) {
      std::cerr << e.what() << "\n";
    }
  });
  journal(request, "load");
  taken_over_ = true;
  forces_written_ = false;  // a variable that is not kept is not forced
  return "";
}

idl::plc::OnlineReply OnlineService::list(const Request& request, double now) {
  if (request.paths.size() != 1 || request.paths[0] != plc_online::task_times_prefix)
    return values_.answer(request, core_, now);
  Reply reply;
  reply.accepted = true;
  for (const auto& time : task_times_.shown(core_.statement_budgets())) plc_online::add(time, reply);
  return reply;
}

idl::plc::OnlineReply OnlineService::list_uses(const Request& request) const {
  constexpr std::size_t page = 128;
  if (request.paths.size() != 1) return reply_of("one path is needed");
  try {
    const auto uses = uses_.of(request.paths[0]);
    Reply reply;
    reply.accepted = true;
    reply.total = static_cast<std::uint32_t>(uses.size());
    for (std::size_t i = request.first; i < uses.size() && reply.uses.size() < page; ++i) {
      const auto& [file, use] = uses[i];
      reply.uses.push_back({file.substr(file.find_last_of('/') + 1).substr(0, 120), use.at.line,
                            use.at.column, use.reads, use.writes, use.calls, use.element.substr(0, 120)});
    }
    return reply;
  } catch (const std::runtime_error& e) {
    return reply_of(e.what());
  }
}

idl::plc::OnlineReply OnlineService::read_source(const Request& request) const {
  Reply reply;
  const SourceFiles none;
  const auto& files = request.program == idl::plc::ProgramSet::ACTIVE ? sources_.files
                      : sources_.stored                               ? sources_.stored->previous
                                                                      : none;
  reply.total = static_cast<std::uint32_t>(files.size());
  if (files.empty()) return reply_of("there are no previous programs: none have been loaded");
  if (request.first >= files.size()) return reply_of("there are " + std::to_string(files.size()) + " files");
  const auto& file = files[request.first];
  reply.accepted = true;
  reply.file = file.name.substr(0, 120);
  reply.size = static_cast<std::uint32_t>(file.text.size());
  if (request.offset < file.text.size()) {
    const auto part = std::string_view(file.text).substr(request.offset, 32768);
    reply.data.assign(part.begin(), part.end());
  }
  return reply;
}

void OnlineService::journal(const Request& request, const std::string& what) {
  bus::Json entry = {{"time", service::time_of_day()}, {"tick", core_.memory().tick}, {"what", what}};
  if (what == "load") {
    entry["crc32"] = crc32_of(sources_.files);
    entry["accept_differences"] = request.accept_differences;
  } else {
    entry["paths"] = request.paths;
    if (what == "force") entry["values"] = request.values, entry["permanent"] = request.permanent;
  }
  std::ofstream(node_.options().state_directory + journal_file, std::ios::app) << bus::text_of(entry) << "\n";
}

void OnlineService::compare(const std::vector<idl::plc::AuxiliaryDone>& done) {
  if (auto* comparison = load_.comparison()) comparison->compare(core_, done);
}

void OnlineService::publish(double now) {
  if (!forces_written_) {
    const auto forces = forces_of(core_.memory(), values_.variables());
    forces_.write(forces);
    forces_written_ = true;
    if (forces.values.empty())
      node_.alarms().clear(alarm::plc_forced, 0);
    else
      node_.alarms().raise(alarm::plc_forced, 0,
                           std::to_string(forces.values.size()) +
                               " of the PLC's values are forced, the first is " + forces.values[0].path +
                               " = " + forces.values[0].value +
                               ": release them with 'trunnion plc force --release'",
                           core_.executed());
  }
  if (now - written_ < watch_period) return;
  written_ = now;
  for (std::size_t slot = 0; slot < watch_slots; ++slot)
    if (const auto* sample = values_.watched(slot, core_.memory())) watched_.write(*sample);
  if (last_programs_ && last_programs_->phase == load_.phase() &&
      last_programs_->changes == (sources_.stored ? sources_.stored->changes : 0))
    return;
  idl::plc::Programs programs;
  programs.crc32 = crc32_of(sources_.files);
  programs.delivered = !sources_.stored || programs.crc32 == sources_.delivered;
  programs.changes = sources_.stored ? sources_.stored->changes : 0;
  programs.phase = load_.phase();
  programs_.write(programs);
  last_programs_ = programs;
}

}  // namespace trunnion::plc
