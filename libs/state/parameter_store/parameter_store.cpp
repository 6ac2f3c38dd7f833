// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/parameter_store.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "machine/alarm_constants.hpp"
#include "machine/roles.hpp"
#include "text/utf8.hpp"

namespace trunnion::parameters {
namespace {

using idl::parameters::Operation;
using idl::parameters::ParameterRequest;
using machine::Activation;
using machine::Catalogue;
using machine::ParameterValue;

constexpr std::size_t most_values = 65536, most_pending = 4096, most_tools = 1024, most_offsets = 192;

ParameterValue catalogue_default(std::uint32_t number) {
  return {Catalogue::instance().default_of(number), ""};
}

/// In the journal a parameter is a number or a text, as its type says.
nlohmann::json json_of(std::uint32_t number, const ParameterValue& value) {
  const auto* definition = Catalogue::instance().find(number);
  if (definition != nullptr && definition->type == machine::ParameterType::text) return value.text;
  return value.value;
}

nlohmann::json json_of(const idl::parameters::Tool& t) {
  return {{"length", t.length},
          {"length_wear", t.length_wear},
          {"radius", t.radius},
          {"radius_wear", t.radius_wear},
          {"name", t.name},
          {"type", t.type},
          {"life_used", t.life_used},
          {"life_limit", t.life_limit},
          {"life_unit", t.life_unit == idl::parameters::LifeUnit::PIECES ? "pieces" : "minutes"}};
}

// `part` counts the lines of one change from 1: two changes by one user may have the same second.
std::string line(const std::string& time, const std::string& who, std::size_t part, const char* what,
                 const nlohmann::json& number, const nlohmann::json& before, const nlohmann::json& after) {
  const nlohmann::ordered_json entry = {{"time", time},     {"who", who},    {"part", part}, {"what", what},
                                        {"number", number}, {"old", before}, {"new", after}};
  // Texts come from outside: bytes that are no UTF-8 are replaced, not thrown at.
  return entry.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

ParameterStore::ParameterStore(Storage& storage, MachineDefaults defaults, const std::string& boot)
    : storage_(storage), defaults_(std::move(defaults)) {
  state_.tools = defaults_.tools;
  state_.offsets = defaults_.offsets;
  if (const auto text = storage_.read(parameters_file))
    state_.overrides = machine::read_parameter_text(*text, parameters_file);
  if (const auto text = storage_.read(tool_tables::tools_file))
    state_.tools = tool_tables::read_tools(*text, tool_tables::tools_file, state_.tools_revision);
  if (const auto text = storage_.read(tool_tables::offsets_file))
    state_.offsets = tool_tables::read_offsets(*text, tool_tables::offsets_file, state_.offsets_revision);
  repair_journal();

  const auto kept = storage_.read(active_file);
  if (kept) active_ = read_active(*kept, active_file);
  ActiveSet next = active_;
  bool news;
  if (kept && !boot.empty() && active_.boot == boot) {
    // The same cluster continues. Only a crash between the two files of one change leaves `save` values
    // behind.
    news = activate(next, state_.overrides, Activation::save);
  } else {
    next.boot = boot;
    next.resets.clear();
    news = activate(next, state_.overrides, Activation::restart);
    if (next.revision == 0) next.revision = 1;
    news = news || !kept || active_.boot != boot;
  }
  if (news) begin(next, kept.has_value());
}

// A torn last line ends here, so that the next entry has a line of its own. Nothing is read from the journal:
// without one the machine starts, and a change is refused.
void ParameterStore::repair_journal() {
  try {
    if (const auto text = storage_.read(journal_file); text && !text->empty() && text->back() != '\n')
      storage_.truncate(journal_file, text->rfind('\n') == std::string::npos ? 0 : text->rfind('\n') + 1);
  } catch (const StorageError& error) {
    problem_ = std::string(error.what()) + "; no change of parameters, tools or work offsets is possible";
  }
}

void ParameterStore::begin(const ActiveSet& next, bool kept) {
  try {
    commit(state_, next, {});
  } catch (const StorageError& error) {
    if (!kept || next.revision != active_.revision || next.values != active_.values) throw;
    // Only the start is new. No value is stored without it: the next commit() finds the file different.
    active_ = next;
    problem_ = error.what();
  }
}

namespace {
// Tables are the setter's, and so are parameters that are not the machine builder's.
std::string not_permitted(const ParameterRequest& request) {
  namespace role = machine::role;
  for (const auto& parameter : request.values) {
    const auto* definition = Catalogue::instance().find(parameter.number);
    const auto needed =
        definition != nullptr && definition->access == "builder" ? role::builder : role::setter;
    if (request.role < needed)
      return "parameter " + machine::number_text(parameter.number) + " needs the role " + role::name(needed) +
             ", and this is changed for the role " + role::name(request.role);
  }
  if (request.role < role::setter && !(request.tools.empty() && request.offsets.empty()))
    return std::string(request.tools.empty() ? "work offsets need" : "the tool table needs") +
           " the role setter, and this is changed for the role " + role::name(request.role);
  return "";
}

std::string changed_meanwhile(const std::string& table, std::uint64_t now, std::uint64_t then) {
  return "the " + table + " changed meanwhile (revision " + std::to_string(now) + ", not " +
         std::to_string(then) + "): read the values again";
}
}  // namespace

ParameterValue ParameterStore::machine_default(std::uint32_t number) const {
  const auto found = defaults_.values.find(number);
  return found != defaults_.values.end() ? found->second : catalogue_default(number);
}

ParameterValue ParameterStore::stored(const Values& overrides, std::uint32_t number) const {
  const auto found = overrides.find(number);
  return found != overrides.end() ? found->second : machine_default(number);
}

Values ParameterStore::effective(const Values& overrides) const {
  Values values = defaults_.values;
  for (const auto& [number, value] : overrides) values[number] = value;
  std::erase_if(values, [](const auto& entry) { return entry.second == catalogue_default(entry.first); });
  return values;
}

std::vector<std::uint32_t> ParameterStore::waiting(const ActiveSet& active, const Values& overrides) const {
  std::vector<std::uint32_t> result;
  const auto wanted = effective(overrides);
  for (const auto& [number, value] : wanted) {
    const auto found = active.values.find(number);
    if (found == active.values.end() || found->second != value) result.push_back(number);
  }
  for (const auto& [number, value] : active.values)
    if (wanted.count(number) == 0) result.push_back(number);
  std::sort(result.begin(), result.end());
  return result;
}

bool ParameterStore::activate(ActiveSet& active, const Values& overrides, Activation upto) const {
  bool any = false;
  for (const auto number : waiting(active, overrides)) {
    const auto* definition = Catalogue::instance().find(number);
    if (definition != nullptr && definition->activation > upto) continue;
    const auto value = stored(overrides, number);
    if (value == catalogue_default(number))
      active.values.erase(number);
    else
      active.values[number] = value;
    any = true;
  }
  if (any) {
    active.previous = active.revision;
    ++active.revision;
  }
  return any;
}

std::string ParameterStore::change(State& next, const ParameterRequest& request,
                                   std::vector<std::string>& journal, const std::string& time) const {
  const auto op = request.operation;
  const bool values = op == Operation::SET || op == Operation::IMPORT || op == Operation::RESET_TO_DEFAULT;
  const bool tools = op == Operation::SET_TOOL || op == Operation::REMOVE_TOOL || op == Operation::IMPORT;
  const bool offsets = op == Operation::SET_WORK_OFFSET || op == Operation::IMPORT;
  const auto& who = request.who;
  if (auto refusal = not_permitted(request); !refusal.empty()) return refusal;
  if (tools && request.revision != 0 && request.revision != next.tools_revision)
    return changed_meanwhile("tool table", next.tools_revision, request.revision);
  if (offsets && request.revision != 0 && request.revision != next.offsets_revision)
    return changed_meanwhile("work offsets", next.offsets_revision, request.revision);
  if (values) {
    for (const auto& parameter : request.values) {
      ParameterValue value{parameter.value, parameter.text};
      const auto* definition = Catalogue::instance().find(parameter.number);
      if (op == Operation::RESET_TO_DEFAULT)
        value = machine_default(parameter.number);
      else if (definition != nullptr && definition->type == machine::ParameterType::text)
        value.value = 0;
      const auto& catalogue = Catalogue::instance();
      if (!catalogue.check(parameter.number, value.value, value.text).empty()) {
        auto all = next.overrides;  // with the machine builder's: they define the axes
        all.insert(defaults_.values.begin(), defaults_.values.end());
        return catalogue.check(parameter.number, value.value, value.text,
                               machine::unit_of(parameter.number, all));
      }
      const auto before = stored(next.overrides, parameter.number);
      if (before == value) continue;
      if (value == machine_default(parameter.number))
        next.overrides.erase(parameter.number);
      else
        next.overrides[parameter.number] = value;
      journal.push_back(line(time, who, journal.size() + 1, "parameter", parameter.number,
                             json_of(parameter.number, before), json_of(parameter.number, value)));
    }
  }
  if (tools) {
    for (const auto& tool : request.tools) {
      const auto found = next.tools.find(tool.number);
      const nlohmann::json before = found != next.tools.end() ? json_of(found->second) : nlohmann::json();
      if (op == Operation::REMOVE_TOOL) {
        if (found == next.tools.end()) return "tool " + std::to_string(tool.number) + " does not exist";
        next.tools.erase(found);
        journal.push_back(line(time, who, journal.size() + 1, "tool", tool.number, before, nlohmann::json()));
        continue;
      }
      if (auto error = tool_tables::check_tool(tool); !error.empty()) return error;
      if (found != next.tools.end() && found->second == tool) continue;
      next.tools[tool.number] = tool;
      journal.push_back(line(time, who, journal.size() + 1, "tool", tool.number, before, json_of(tool)));
    }
    if (next.tools.size() > most_tools) return "the tool table holds at most 1024 tools";
  }
  if (offsets) {
    for (auto offset : request.offsets) {
      if (offset.values.size() < 9) offset.values.resize(9, 0.0);
      if (auto error = tool_tables::check_offset(offset); !error.empty()) return error;
      auto& entry = next.offsets[{offset.channel, offset.index}];
      if (entry.values == offset.values) continue;
      journal.push_back(
          line(time, who, journal.size() + 1, "work_offset",
               std::to_string(offset.channel) + ":" + tool_tables::work_offset_code(offset.index),
               entry.values.empty() ? nlohmann::json() : nlohmann::json(entry.values), offset.values));
      entry = offset;
    }
    if (next.offsets.size() > most_offsets) return "at most 192 work offsets";
  }
  if ((values && !request.values.empty()) || (tools && !request.tools.empty()) ||
      (offsets && !request.offsets.empty()))
    return "";
  return "the request names nothing to change";
}

namespace {
std::vector<machine::ParameterFault> faults_of(const Values& values) {
  machine::Parameters parameters;
  parameters.values = values;
  return machine::axis_faults(parameters);
}
}  // namespace

std::vector<machine::ParameterFault> ParameterStore::faults() const {
  return faults_of(effective(state_.overrides));
}

// Empty, or what `overrides` would add to what does not fit already, which is corrected step by step.
std::string ParameterStore::misfit(const Values& overrides) const {
  if (overrides == state_.overrides) return "";
  const auto after = faults_of(effective(overrides));
  if (after.empty()) return "";
  const auto before = faults();
  if (after.size() <= before.size()) return "";
  const auto added = std::find_if(after.begin(), after.end(), [&](const auto& fault) {
    return std::none_of(before.begin(), before.end(),
                        [&](const auto& old) { return old.numbers == fault.numbers; });
  });
  return (added != after.end() ? *added : after.back()).text;
}

void ParameterStore::commit(const State& next, const ActiveSet& active,
                            const std::vector<std::string>& journal) {
  std::vector<NamedText> files;
  if (next.overrides != state_.overrides)
    files.push_back({parameters_file, "# Saved values; all others are the machine's defaults.\n" +
                                          machine::write_parameter_text(next.overrides)});
  if (next.tools_revision != state_.tools_revision)
    files.push_back({tool_tables::tools_file, tool_tables::write_tools(next.tools, next.tools_revision)});
  if (next.offsets_revision != state_.offsets_revision)
    files.push_back(
        {tool_tables::offsets_file, tool_tables::write_offsets(next.offsets, next.offsets_revision)});
  const auto text = write_active(active);
  if (storage_.read(active_file).value_or("") != text) files.push_back({active_file, text});

  std::string entries;
  for (const auto& entry : journal) entries += entry;
  // The journal first: it may name a change that a crash prevented, but never miss one that was made.
  std::uint64_t journal_size = 0;
  if (!entries.empty()) journal_size = storage_.append(journal_file, entries);
  try {
    if (!files.empty()) storage_.replace(files);
  } catch (const StorageError&) {
    if (!entries.empty()) storage_.truncate(journal_file, journal_size);
    throw;
  }
  changes_.set = changes_.set || active.revision != active_.revision ||
                 waiting(active, next.overrides) != waiting(active_, state_.overrides);
  changes_.tools = changes_.tools || next.tools_revision != state_.tools_revision;
  changes_.offsets = changes_.offsets || next.offsets_revision != state_.offsets_revision;
  state_ = next;
  active_ = active;
}

idl::parameters::ParameterReply ParameterStore::apply(const ParameterRequest& request,
                                                      const std::string& time) {
  idl::parameters::ParameterReply reply;
  State next = state_;
  ActiveSet active = active_;
  std::vector<std::string> journal;
  auto error = change(next, request, journal, time);
  if (error.empty()) error = misfit(next.overrides);
  if (error.empty()) {
    activate(active, next.overrides, Activation::save);
    if (active.values.size() > most_values)
      error = "at most 65536 parameters may differ from their defaults";
    else if (waiting(active, next.overrides).size() > most_pending)
      error = "more than 4096 values would wait for a reset: reset a channel first";
  }
  if (!error.empty()) {
    reply.alarm = alarm::request_invalid.number;
    reply.reason = error;
  } else {
    if (next.tools != state_.tools) ++next.tools_revision;
    if (next.offsets != state_.offsets) ++next.offsets_revision;
    try {
      if (!journal.empty()) commit(next, active, journal);
      reply.accepted = true;
    } catch (const StorageError& e) {
      reply.alarm = alarm::storage_failed.number;
      reply.reason = e.what();
    }
  }
  reply.reason = text::shortened(std::move(reply.reason), 256);
  reply.revision = active_.revision;
  reply.pending = static_cast<std::uint32_t>(waiting(active_, state_.overrides).size());
  return reply;
}

void ParameterStore::channel_reset_count(std::uint16_t channel, std::uint32_t count) {
  const auto seen = active_.resets.find(channel);
  if (seen != active_.resets.end() && seen->second == count) return;
  ActiveSet next = active_;
  next.resets[channel] = count;
  // A count that is new here, or lower than before, belongs to a channel that has just started.
  const bool reset = seen != active_.resets.end() && count > seen->second;
  if (reset) activate(next, state_.overrides, Activation::reset);
  commit(state_, next, {});
}

idl::parameters::ParameterSet ParameterStore::set() const {
  idl::parameters::ParameterSet set;
  set.revision = active_.revision;
  set.previous = active_.previous;
  for (const auto& [number, value] : active_.values) set.values.push_back({number, value.value, value.text});
  for (const auto number : waiting(active_, state_.overrides)) {
    const auto value = stored(state_.overrides, number);
    set.pending.push_back({number, value.value, value.text});
  }
  return set;
}

idl::parameters::ToolTable ParameterStore::tool_table() const {
  idl::parameters::ToolTable table;
  table.revision = state_.tools_revision;
  for (const auto& [number, tool] : state_.tools) table.tools.push_back(tool);
  return table;
}

idl::parameters::WorkOffsets ParameterStore::work_offsets() const {
  idl::parameters::WorkOffsets table;
  table.revision = state_.offsets_revision;
  for (const auto& [key, offset] : state_.offsets) table.offsets.push_back(offset);
  return table;
}

Changes ParameterStore::take_changes() { return std::exchange(changes_, Changes{false, false, false}); }

}  // namespace trunnion::parameters
