// SPDX-License-Identifier: Apache-2.0
#include "machine_check/machine_check.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "channel_setup/channel_setup.hpp"
#include "collision_guard/collision_guard.hpp"
#include "machine/axis_faults.hpp"
#include "machine/gateway_loss.hpp"
#include "machine/machine.hpp"
#include "machine/service_constants.hpp"
#include "machine/yaml.hpp"
#include "parameter_store/tool_tables.hpp"
#include "plc/devices/hal_pins.hpp"
#include "plc/translation.hpp"
#include "storage/kept_file.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::machine_check {
namespace fs = std::filesystem;
namespace {

constexpr const char* error_mark = ": error: ";

// Cuts ":N" from the end of `text`; 0 when there is none.
int cut_number(std::string& text) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos) return 0;
  int number = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data() + colon + 1, last, number);
  if (error != std::errc() || end != last) return 0;
  text.resize(colon);
  return number;
}

// Of a message that begins with its place; `file` is that of one that does not.
Finding finding_of(const std::string& message, const std::string& file) {
  const auto mark = message.find(error_mark);
  if (mark == std::string::npos) {
    const auto prefix = file + ": ";
    return {file, 0, 0, message.starts_with(prefix) ? message.substr(prefix.size()) : message};
  }
  Finding finding;
  finding.file = message.substr(0, mark);
  finding.text = message.substr(mark + std::string_view(error_mark).size());
  const int last = cut_number(finding.file), first = cut_number(finding.file);
  finding.line = first != 0 ? first : last;
  finding.column = first != 0 ? last : 0;
  return finding;
}

class Check {
 public:
  Check(const std::string& directory, const std::string& state_directory)
      : directory_(directory), state_directory_(state_directory) {}

  MachineReport report() {
    for (const auto& finding : broken_links(directory_)) add(finding);
    attempt("machine.yaml", [&](const std::string&) {
      config_ = machine::load_machine(directory_);
      report_.name = config_->name;
    });
    parameters();
    attempt_if_there(tool_tables::tools_file, [&](const std::string& file) {
      std::uint64_t revision = 0;
      tool_tables::read_tools(machine::read_text(file), file, revision);
    });
    attempt_if_there(tool_tables::offsets_file, [&](const std::string& file) {
      std::uint64_t revision = 0;
      tool_tables::read_offsets(machine::read_text(file), file, revision);
    });
    attempt_if_there("io.yaml", [](const std::string& file) {  // of a machine with `hardware: hal`
      st::read_hal_pins(machine::read_text(file), file);
    });
    if (config_) {
      plc();
      // Without one of its parameters a machine is another one.
      if (parameters_are_whole_) whole();
    }
    return std::move(report_);
  }

 private:
  using Read = std::function<void(const std::string& file)>;
  using Setups = std::map<std::uint16_t, channel_setup::ChannelSetup>;

  void add(const Finding& finding) {
    auto& all = report_.findings;
    if (std::find(all.begin(), all.end(), finding) == all.end()) all.push_back(finding);
  }
  // A line for each error; warnings stop nothing.
  void add(const std::string& messages, const std::string& file) {
    std::istringstream lines(messages);
    for (std::string line; std::getline(lines, line);)
      if (line.find(": warning: ") == std::string::npos) add(finding_of(line, file));
  }
  void add(const machine::ParameterFault& fault) {
    for (const auto number : fault.numbers)
      if (const auto place = places_.find(number); place != places_.end())
        return add(place->second + fault.text, "");
    add(Finding{parameters_file_, 0, 0, fault.text});
  }

  std::string path(const std::string& name) const { return directory_ + "/" + name; }
  // broken_links() has named it.
  static bool leads_nowhere(const std::string& file) { return fs::is_symlink(file) && !fs::exists(file); }

  void attempt(const std::string& name, const Read& read) {
    report_.files.push_back(name);
    if (leads_nowhere(path(name))) return;
    try {
      read(path(name));
    } catch (const std::exception& e) {
      add(e.what(), path(name));
    }
  }
  void attempt_if_there(const std::string& name, const Read& read) {
    if (fs::exists(path(name))) attempt(name, read);
  }

  void parameters() {
    attempt("parameters.yaml", [&](const std::string& file) {
      auto read = machine::check_parameter_text(machine::read_text(file), file);
      for (const auto& error : read.errors) add(error, file);
      parameters_are_whole_ = read.errors.empty();
      parameters_.values = std::move(read.values);
      places_ = std::move(read.places);
    });
    if (!config_) return;
    if (const auto fault = machine::chain_conflict(parameters_.values, *config_)) {
      add(*fault);
      parameters_are_whole_ = false;
    }
    if (config_->chain_parameters.empty()) return;
    const auto file = path("machine.yaml");
    const auto chains = machine::at(file, machine::parse_yaml(machine::read_text(file), file)["chains"]);
    for (const auto& [number, value] : config_->chain_parameters) {
      parameters_.values[number] = value;
      places_[number] = chains;
    }
  }

  void plc() {
    const auto directory = config_->plc_directory();
    if (leads_nowhere(directory)) return;
    try {
      const auto files = st::read_sources(directory);
      for (const auto& file : files) report_.files.push_back("plc/" + file.name);
      const auto translated = [&](auto&& translate) {
        try {
          translate();
        } catch (const std::exception& e) {
          add(e.what(), directory);
        }
      };
      std::optional<st::Translation> translation;
      std::optional<st::ModbusFile> modbus;
      translated([&] { translation = st::translate_sources(files, config_->simulated(), directory + "/"); });
      translated([&] { modbus = st::modbus_of(files, directory + "/"); });
      if (translation && modbus) stopping_inputs(translation->uses, *modbus);
    } catch (const std::exception& e) {
      add(e.what(), directory);
    }
  }

  static bool is_read(const st::Uses& uses, const std::string& input) {
    try {
      const auto places = uses.of(input);
      return std::any_of(places.begin(), places.end(), [](const auto& place) { return place.use.reads; });
    } catch (const std::exception&) {  // nothing uses it
      return false;
    }
  }

  // A machine that runs on without its page needs inputs that hold and stop it: something outside must write
  // them, and the programs of the PLC read them.
  void stopping_inputs(const st::Uses& uses, const st::ModbusFile& modbus) {
    const auto inputs = machine::load_gateway_loss(directory_);
    if (!inputs) return;
    const auto file = path("machine.yaml");
    const auto node = machine::parse_yaml(machine::read_text(file), file)["gateway_loss"]["continue_with"];
    for (const auto& entry :
         {std::pair("feed_hold", inputs->feed_hold), std::pair("emergency_stop", inputs->emergency_stop)}) {
      const std::string name = entry.first, input = entry.second;
      const auto refuse = [&](const std::string& why) {
        auto text = machine::at(file, node[name]);
        add(text.append(name).append(" is ").append(input).append(", ").append(why), file);
      };
      const char* problem = nullptr;
      if (!st::writes_input(modbus, *st::parse_register(input, &problem)))
        refuse("which no block of plc/modbus.yaml writes: without the page the operator has no such key");
      if (!is_read(uses, "%" + input)) refuse("which no program of the PLC reads");
    }
  }

  // What the services make of the parameters.
  void whole() {
    report_.axes = machine::drive_axes(parameters_).size();
    report_.spindles = machine::spindles(parameters_).size();
    for (const auto& fault : machine::axis_faults(parameters_)) add(fault);
    Setups configured;
    for (const auto& entry : config_->services) {
      if (entry.service != machine::service::channel.name) continue;
      ++report_.channels;
      configure(static_cast<std::uint16_t>(entry.channel), configured);
    }
    bodies(configured);
    if (config_->simulated() && configured.contains(0)) truth();
    if (!state_directory_.empty()) saved(configured);
  }

  void configure(std::uint16_t channel, Setups& configured) {
    try {
      channel_setup::ChannelSetup setup(channel);
      setup.configure(parameters_);
      configured.emplace(channel, std::move(setup));
    } catch (const std::exception& e) {
      add({numbers_in(e.what()), e.what()});
    }
  }

  // Axes that do not fit together are an alarm of the parameters service, and let the machine move.
  void saved(const Setups& of_the_folder) {
    const auto file = state_directory_ + "/parameters.yaml";
    auto read = machine::check_parameter_text(storage::read_kept(file).content, file);
    for (const auto& [number, value] : read.values) parameters_.values[number] = value;
    places_ = std::move(read.places);
    parameters_file_ = file;
    Setups configured;
    for (const auto& [channel, setup] : of_the_folder) configure(channel, configured);
  }

  // Messages about a channel name its parameters: "parameter 300021 (..)", "parameters 040400 .. 040437". Of
  // a range those that the files have.
  std::vector<std::uint32_t> numbers_in(const std::string& text) const {
    constexpr std::size_t digits = 6;
    std::vector<std::uint32_t> numbers;
    std::size_t behind = 0;  // the last number
    for (std::size_t i = 0; i < text.size();) {
      const auto end = std::find_if_not(text.begin() + static_cast<long>(i), text.end(),
                                        [](unsigned char c) { return std::isdigit(c) != 0; }) -
                       text.begin();
      const auto size = static_cast<std::size_t>(end) - i;
      if (size == digits) {
        const auto number = static_cast<std::uint32_t>(std::stoul(text.substr(i, digits)));
        if (behind != 0 && text.substr(behind, i - behind) == " .. ")
          for (auto at = places_.lower_bound(numbers.back()); at != places_.end() && at->first <= number;
               ++at)
            numbers.push_back(at->first);
        numbers.push_back(number);
        behind = i + digits;
      }
      i += std::max<std::size_t>(size, 1);
    }
    return numbers;
  }

  void bodies(const Setups& configured) {
    const auto text = collision_guard::load_bodies_text(directory_);
    auto mode = machine::load_collision_mode(directory_);
    const bool needed = mode != machine::CollisionMode::off;
    if (!needed && !text.text) return;
    if (!needed) mode = machine::CollisionMode::warn;  // the commands read them nevertheless, of channel 0
    attempt("bodies.yaml", [&](const std::string&) {
      for (const auto& [channel, setup] : configured)
        if (needed || channel == 0)
          collision_guard::CollisionGuard(setup, mode, text).configure(parameters_, channel);
    });
  }

  // As the simulation of the drive reads it.
  void truth() {
    attempt_if_there("truth.yaml", [&](const std::string& file) {
      const auto outline = machine::outline_of(parameters_, 0);
      const auto read = truth::parse_truth(machine::read_text(file), file, outline);
      truth::make_geometry(read.geometry, outline, file);
    });
  }

  const std::string directory_, state_directory_;
  MachineReport report_;
  std::optional<machine::MachineConfig> config_;
  machine::Parameters parameters_;
  std::map<std::uint32_t, std::string> places_;            // of the parameters
  std::string parameters_file_ = path("parameters.yaml");  // of faults in what no file gives
  bool parameters_are_whole_ = false;
};

}  // namespace

std::string to_string(const Finding& finding) {
  std::string text = finding.file;
  for (const int number : {finding.line, finding.column})
    if (number != 0) text += ":" + std::to_string(number);
  return text + error_mark + finding.text;
}

std::vector<Finding> broken_links(const std::string& directory) {
  std::vector<Finding> findings;
  std::error_code ignored;
  const fs::recursive_directory_iterator end{};
  for (fs::recursive_directory_iterator entry(directory, ignored); entry != end; entry.increment(ignored)) {
    if (!entry->is_symlink(ignored) || entry->exists(ignored)) continue;
    std::string text = "is a link to '";
    text.append(fs::read_symlink(entry->path(), ignored).string());
    text.append("', which is not there: 'trunnion new machine NAME --from MACHINE' copies a machine whole");
    findings.push_back({entry->path().string(), 0, 0, std::move(text)});
  }
  std::sort(findings.begin(), findings.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
  return findings;
}

MachineReport check_machine(const std::string& directory, const std::string& state_directory) {
  return Check(directory, state_directory).report();
}

void require_good(const std::string& directory) {
  std::string lines;
  for (const auto& finding : check_machine(directory).findings)
    lines += (lines.empty() ? "" : "\n") + to_string(finding);
  if (!lines.empty()) throw std::runtime_error(lines);
}

}  // namespace trunnion::machine_check
