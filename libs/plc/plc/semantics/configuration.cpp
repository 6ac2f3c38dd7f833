// SPDX-License-Identifier: Apache-2.0
// The programs and tasks of a CONFIGURATION (IEC 61131-3:2013, 6.8): every task of the PLC becomes a routine
// that calls its programs, each with its own variables.
#include <algorithm>

#include "plc/semantics/lowering.hpp"
#include "plc/semantics/unit.hpp"

namespace trunnion::st {
namespace {

constexpr std::int64_t fast_interval = 1000000, main_interval = 10000000;  // ns
constexpr std::int64_t last_priority = 65535;                              // 6.8.2: the range of UINT
constexpr const char* simulation = "SIMULATION";

struct Task {
  std::int64_t interval = main_interval, priority = last_priority + 1;
  const TaskDeclaration* declaration = nullptr;  ///< none: of programs without WITH
};

// Of a program whose interval is longer than that of the main task.
struct Period {
  static constexpr std::int32_t cells = 3;
  std::int32_t first = 0;
  std::int32_t end() const { return first; }  ///< ns; with `pending` a timer of the machine
  std::int32_t pending() const {
    return first + 1;
  }  ///< a timer of the program has ended, and it was not called
  std::int32_t last() const { return first + 2; }  ///< ns, of the last call
};

/// Calls one program at the beginning of each of its intervals. Virtual time passes up to there while one of
/// its timers waits to be seen.
void call_periodically(Emitter& emit, const Period& period, std::int64_t interval,
                       const std::vector<std::uint32_t>& timers, const std::function<void()>& call) {
  const auto now = emit.temporary(), value = emit.temporary(), flag = emit.temporary();
  emit.add(Op::now, now);
  emit.add(Op::less_equal, flag, period.end(), now);
  const auto skip = emit.add(Op::jump_if_not, 0, flag);
  emit.constant(value, static_cast<std::uint64_t>(interval));
  emit.add(Op::divide, flag, now, value);
  emit.add(Op::multiply, flag, flag, value);
  emit.add(Op::add, period.end(), flag, value);
  emit.add(Op::move, period.last(), now);
  call();
  emit.jump_to_here(skip);
  emit.constant(period.pending(), 0);
  const auto due = emit.temporary();
  for (const auto timer : timers) {
    emit.add(Op::load, value, static_cast<std::int32_t>(timer));
    emit.add(Op::less_equal, due, value, now);
    emit.add(Op::less, flag, period.last(), value);
    emit.add(Op::and_, due, due, flag);
    emit.add(Op::load, flag, static_cast<std::int32_t>(timer + 1));
    emit.add(Op::and_, due, due, flag);
    emit.add(Op::or_, period.pending(), period.pending(), due);
  }
}

}  // namespace

Variable* Unit::find_instance(const std::string& upper) {
  const auto found = instance_names_.find(upper);
  return found == instance_names_.end() ? nullptr : found->second;
}

bool Unit::is_configured(const Pou& pou) const {
  return !tree_.configurations.empty() && pou.declaration->kind == PouKind::program &&
         pou.declaration->name != simulation;
}

Instance& Unit::add_instance(const Pou& pou, Variable variable, std::uint32_t base, bool retain) {
  auto& instance = instances.emplace_back();
  instance.pou = &pou;
  instance.variable = std::move(variable);
  instance.variable.type = &pou.type;
  instance.variable.used = true;
  instance.variable.place = {Place::Base::absolute, static_cast<std::int32_t>(base), 0, -1, 0, 0, true, ""};
  for (const auto timer : pou.timers) code.timers.push_back(base + timer);
  if (retain) code.retained.push_back({base, pou.frame});
  for (const auto& cells : pou.retained)
    if (!retain) code.retained.push_back({base + cells.first, cells.count});
  return instance;
}

void Unit::declare_instances() {
  if (tree_.configurations.empty()) return;
  for (std::size_t i = 1; i < tree_.configurations.size(); ++i)
    diagnostics_.error(
        tree_.configurations[i].at,
        "there is the CONFIGURATION '" + tree_.configurations[0].text + "' already; the PLC has one");
  std::set<std::string> used;
  for (const auto& declaration : tree_.configurations[0].programs) {
    auto* pou = find_pou(declaration.type);
    if (pou == nullptr || pou->declaration->kind != PouKind::program) {
      diagnostics_.error(declaration.type_at, "there is no PROGRAM '" + declaration.type_text + "'");
      continue;
    }
    if (declaration.type == simulation) {
      diagnostics_.error(declaration.type_at, "PROGRAM simulation is a task of its own and has no instances");
      continue;
    }
    if (instance_names_.contains(declaration.name) || global_names_.contains(declaration.name)) {
      diagnostics_.error(declaration.at, "the name '" + declaration.text + "' is declared already");
      continue;
    }
    used.insert(declaration.type);
    if (translated(declaration.type, declaration.type_at) == nullptr) continue;
    if (declaration.retain) refuse_retention(pou->type, declaration.text, declaration.at);
    Variable variable;
    variable.name = declaration.name;
    variable.text = declaration.text;
    variable.at = declaration.at;
    auto& instance = add_instance(*pou, std::move(variable), allocate(pou->initial), declaration.retain);
    instance_names_[declaration.name] = &instance.variable;
  }
  for (const auto& declaration : tree_.pous)
    if (const auto* pou = find_pou(declaration.name);
        pou->declaration == &declaration && is_configured(*pou) && !used.contains(declaration.name))
      diagnostics_.warning(declaration.at, "the program '" + declaration.text +
                                               "' has no instance in the CONFIGURATION and does not run");
}

void Unit::add_tasks() {
  if (tree_.configurations.empty()) return;
  const auto& configuration = tree_.configurations[0];
  std::map<std::string, Task, std::less<>> tasks;
  std::int64_t fast_priority = -1;
  for (const auto& declaration : configuration.tasks) {
    Task task;
    task.declaration = &declaration;
    Value value;
    if (!declaration.interval)
      diagnostics_.error(declaration.at,
                         "the task '" + declaration.text + "' has no INTERVAL: write INTERVAL := T#10ms");
    else if (constant(*declaration.interval, *elementary(Kind::ltime), nullptr, value)) {
      task.interval = value.integer;
      if (task.interval != fast_interval && (task.interval <= 0 || task.interval % main_interval != 0))
        diagnostics_.error(declaration.interval->at,
                           "the PLC has the intervals T#1ms and T#10ms and multiples of T#10ms");
    }
    if (declaration.priority && constant(*declaration.priority, *elementary(Kind::uint_), nullptr, value))
      task.priority = value.integer;
    if (task.interval == fast_interval) fast_priority = std::max(fast_priority, task.priority);
    if (!tasks.emplace(declaration.name, task).second)
      diagnostics_.error(declaration.at, "the task '" + declaration.text + "' is declared twice");
  }
  for (const auto& [name, task] : tasks)
    if (task.interval != fast_interval && task.priority < fast_priority)
      diagnostics_.warning(task.declaration->at, "the programs of T#1ms run before those of '" +
                                                     task.declaration->text +
                                                     "', whatever PRIORITY they have");
  struct Call {
    Task task;
    const ProgramConfiguration* program;
  };
  std::vector<Call> calls;
  for (const auto& program : configuration.programs) {
    Task task;
    if (!program.task.empty()) {
      const auto found = tasks.find(program.task);
      if (found == tasks.end()) {
        diagnostics_.error(program.task_at, "there is no TASK '" + program.task_text + "'");
        continue;
      }
      task = found->second;
    }
    if (find_instance(program.name) != nullptr) calls.push_back({task, &program});
  }
  std::stable_sort(calls.begin(), calls.end(),
                   [](const Call& a, const Call& b) { return a.task.priority < b.task.priority; });
  for (const bool fast : {true, false}) {
    const auto is_of_task = [&](std::int64_t interval) { return (interval == fast_interval) == fast; };
    auto& declaration = task_declarations_.emplace_back();
    declaration.name = fast ? "FAST" : "MAIN";
    declaration.text = fast ? "fast" : "main";
    declaration.at = declaration.end = configuration.at;
    bool exists = std::any_of(tasks.begin(), tasks.end(),
                              [&](const auto& task) { return is_of_task(task.second.interval); });
    auto& routine = tasks_.emplace_back();
    routine.declaration = &declaration;
    for (auto& instance : instances) routine.names[instance.variable.name] = &instance.variable;
    std::vector<std::pair<const Call*, Period>> own;
    for (const auto& call : calls) {
      if (!is_of_task(call.task.interval)) continue;
      exists = true;
      own.push_back({&call, {static_cast<std::int32_t>(routine.initial.size())}});
      if (call.task.interval > main_interval)
        routine.initial.resize(routine.initial.size() + Period::cells, 0);
    }
    if (!exists) continue;
    Lowering lowering(*this, &routine, static_cast<std::uint32_t>(routine.initial.size()));
    auto& emit = lowering.emitter();
    for (const auto& [call, period] : own) {
      const auto mark = emit.mark();
      emit.place(call->program->at);
      const auto run = [&, program = call->program] {
        emit.add(Op::statement);
        lowering.expression(*program->call);
      };
      const auto& instance = *find_instance(call->program->name);
      std::vector<std::uint32_t> timers;
      for (const auto timer : instance.type->block->pou->timers)
        timers.push_back(static_cast<std::uint32_t>(instance.place.offset) + timer);
      if (call->task.interval > main_interval)
        call_periodically(emit, period, call->task.interval, timers, run);
      else
        run();
      emit.release(mark);
    }
    lowering.body({});
    routine.frame = emit.frame();
    routine.initial.resize(routine.frame, 0);
    const auto base = allocate(routine.initial);
    for (const auto& [call, period] : own)
      if (call->task.interval > main_interval)
        code.timers.push_back(base + static_cast<std::uint32_t>(period.end()));
    routine.routine = add_routine(emit, routine.frame);
    code.entries.push_back({declaration.name, routine.routine, base, false});
  }
}

}  // namespace trunnion::st
