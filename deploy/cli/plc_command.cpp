// SPDX-License-Identifier: Apache-2.0
// plc: Structured Text without a machine
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <utility>

#include "bus/json.hpp"
#include "commands.hpp"
#include "plc/compile.hpp"
#include "plc/devices/device_file.hpp"
#include "plc/devices/message_file.hpp"
#include "plc/devices/modbus_file.hpp"
#include "plc/library/register_names.hpp"
#include "plc/syntax/token.hpp"
#include "plc/tools/source_run.hpp"
#include "plc/tools/uses.hpp"

namespace trunnion::cli {
namespace {

struct PlcOptions {
  std::vector<std::string> files;
  std::string call, inputs, directory;
  std::vector<std::string> set;
  std::uint64_t scans = 1;
  double period = 10;
  bool cross_reference = false;
};

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || std::filesystem::is_directory(path)) throw std::runtime_error(path + ": cannot be read");
  return text.str();
}

st::Compilation compiled(const std::vector<std::string>& files, bool functions) {
  std::vector<st::Source> sources;
  for (const auto& path : files) {
    auto text = read(path);
    if (std::filesystem::path(path).filename() == "modbus.yaml") {
      st::read_modbus(text, path);
      continue;
    }
    if (std::filesystem::path(path).filename() == "messages.yaml") {
      st::read_messages(text, path);
      continue;
    }
    if (path.ends_with(".yaml")) text = st::read_devices(text, path, st::interface_registers()).program;
    sources.push_back({path, std::move(text)});
  }
  return st::compile(sources, st::interface_registers(), functions);
}

bus::Json diagnostics_json(const st::Compilation& result) {
  auto list = bus::Json::array();
  for (const auto& d : result.diagnostics)
    list.push_back({{"severity", d.severity == st::Severity::error ? "error" : "warning"},
                    {"file", result.files[d.at.file]},
                    {"line", d.at.line},
                    {"column", d.at.column},
                    {"text", d.text}});
  return list;
}

std::string place_text(const st::Compilation& result, st::Position at) {
  return (at.file < result.files.size() ? result.files[at.file] : std::string("?")) + ":" +
         std::to_string(at.line) + ":" + std::to_string(at.column);
}

std::string access_text(const st::Use& use) {
  std::string text;
  for (const auto& [has, word] :
       {std::pair{use.reads, "reads"}, {use.writes, "writes"}, {use.calls, "calls"}})
    if (has) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

bus::Json tasks_json(const st::Compilation& result) {
  auto list = bus::Json::array();
  for (const auto& task : result.tasks) {
    bus::Json one = {{"program", task.name}};
    if (task.most)
      one["most_statements"] = *task.most;
    else
      one["unbounded_loop"] = place_text(result, task.unbounded);
    list.push_back(std::move(one));
  }
  return list;
}

bus::Json references_json(const st::Compilation& result) {
  auto list = bus::Json::array();
  for (const auto& reference : result.references) {
    auto uses = bus::Json::array();
    for (const auto& use : reference.uses) {
      bus::Json one = {{"file", result.files[use.at.file]},
                       {"line", use.at.line},
                       {"column", use.at.column},
                       {"reads", use.reads},
                       {"writes", use.writes},
                       {"calls", use.calls}};
      if (!use.element.empty()) one["element"] = use.element;
      uses.push_back(std::move(one));
    }
    bus::Json one = {{"name", reference.name}, {"uses", uses}};
    if (!reference.type.empty()) one["type"] = reference.type;
    if (!reference.location.empty()) one["register"] = reference.location;
    if (!reference.names.empty()) one["names"] = reference.names;
    list.push_back(std::move(one));
  }
  return list;
}

void print_references(const st::Compilation& result) {
  for (const auto& reference : result.references) {
    std::cout << reference.name;
    if (!reference.type.empty()) std::cout << " : " << reference.type;
    if (!reference.location.empty()) std::cout << " at " << reference.location;
    const char* separator = "  ";
    for (const auto& name : reference.names) std::cout << std::exchange(separator, ", ") << name;
    std::cout << "\n";
    for (const auto& use : reference.uses)
      std::cout << "  " << place_text(result, use.at) << ": " << access_text(use)
                << (use.element.empty() ? "" : " (" + use.element + ")") << "\n";
  }
}

int check_plc(const PlcOptions& options, bool json) {
  const auto result = compiled(options.files, false);
  const auto instructions = result.good() ? result.code->code.size() : 0;
  const auto cells = result.good() ? result.code->initial.size() - st::image_cells : 0;
  if (json) {
    bus::Json document = {{"good", result.good()},
                          {"instructions", instructions},
                          {"cells", cells},
                          {"diagnostics", diagnostics_json(result)},
                          {"statements", tasks_json(result)}};
    if (options.cross_reference) document["cross_reference"] = references_json(result);
    std::cout << bus::text_of(document) << "\n";
    return result.good() ? 0 : 1;
  }
  for (const auto& line : result.lines()) std::cout << line << "\n";
  if (options.cross_reference) print_references(result);
  for (const auto& task : result.tasks)
    if (task.most)
      std::cout << task.name << ": at most " << *task.most << " statements in one run\n";
    else
      std::cout << task.name << ": no limit of its statements is known, because of the loop at "
                << place_text(result, task.unbounded) << "\n";
  if (result.good())
    std::cout << "No errors: " << instructions << " instructions, " << cells << " cells of memory\n";
  return result.good() ? 0 : 1;
}

/// Rows of comma-separated values below a row of names.
std::vector<std::vector<std::string>> csv_rows(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(read(path));
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) continue;
    auto& row = rows.emplace_back();
    std::istringstream values(line);
    for (std::string value; std::getline(values, value, ',');) {
      const auto from = value.find_first_not_of(' ');
      const auto to = value.find_last_not_of(' ');
      row.push_back(from == std::string::npos ? "" : value.substr(from, to - from + 1));
    }
    if (row.size() > rows[0].size())
      throw std::runtime_error(path + ":" + std::to_string(rows.size()) +
                               ": more values than the first row has names");
  }
  return rows;
}

std::pair<std::string, std::string> assignment(const std::string& text) {
  const auto at = text.find('=');
  if (at == std::string::npos || at == 0)
    throw std::runtime_error("--set " + text + ": write VARIABLE=VALUE");
  return {text.substr(0, at), text.substr(at + 1)};
}

using Values = std::vector<std::pair<std::string, std::string>>;

void print_values(const Values& values, const std::string& fault, bool json) {
  if (json) {
    bus::Json variables = bus::Json::object();
    for (const auto& [name, value] : values) variables[name] = value;
    bus::Json document = {{"variables", variables}};
    if (!fault.empty()) document["fault"] = fault;
    std::cout << bus::text_of(document) << "\n";
    return;
  }
  for (const auto& [name, value] : values) std::cout << name << " = " << value << "\n";
  if (!fault.empty()) std::cerr << fault << "\n";
}

int refuse(const st::Compilation& result, bool json) {
  if (json)
    std::cout << bus::text_of({{"good", false}, {"diagnostics", diagnostics_json(result)}}) << "\n";
  else
    for (const auto& line : result.lines()) std::cerr << line << "\n";
  return 1;
}

int run_plc(const PlcOptions& options, bool json) {
  auto result = compiled(options.files, !options.call.empty());
  if (!result.good()) return refuse(result, json);
  const auto name = st::upper_case(options.call);
  const st::FunctionInterface* function = nullptr;
  for (const auto& candidate : result.functions)
    if (!name.empty() && st::upper_case(candidate.name) == name) function = &candidate;
  const auto& entries = result.code->entries;
  const bool known = std::any_of(entries.begin(), entries.end(),
                                 [&](const auto& e) { return e.name == name && !e.is_test; });
  if (!name.empty() && !known)
    throw std::runtime_error("--call " + options.call + ": there is no such program or function");
  if (name.empty() && std::all_of(entries.begin(), entries.end(), [](const auto& e) { return e.is_test; }))
    throw std::runtime_error("there is no PROGRAM to run; name a function with --call");
  if (function != nullptr) {
    // The parameters are the variables that --set and the output name.
    result.symbols.clear();
    for (const auto& parameter : function->parameters) {
      if (parameter.in_out)
        throw std::runtime_error("--call " + options.call +
                                 ": a function with VAR_IN_OUT cannot be called alone");
      result.symbols.push_back({parameter.name, parameter.type, parameter.address, -1, false, {}});
    }
    if (function->result != nullptr)
      result.symbols.push_back({function->name, function->result, function->result_address, -1, false, {}});
  }
  st::SourceRun program(result);
  for (const auto& text : options.set) {
    const auto [path, value] = assignment(text);
    program.set(path, value);
  }
  const auto rows =
      options.inputs.empty() ? std::vector<std::vector<std::string>>{} : csv_rows(options.inputs);
  std::string fault;
  for (std::uint64_t scan = 0; scan < options.scans && fault.empty(); ++scan) {
    if (scan + 1 < rows.size())
      for (std::size_t i = 0; i < rows[scan + 1].size(); ++i)
        if (!rows[scan + 1][i].empty()) program.set(rows[0][i], rows[scan + 1][i]);
    const auto found = program.scan(name, static_cast<std::int64_t>(options.period * 1e6));
    if (found.kind != st::FaultKind::none) fault = st::fault_line(result, program.machine(), found);
  }
  print_values(program.variables(), fault, json);
  return fault.empty() ? 0 : 1;
}

int test(const PlcOptions& options, bool json) {
  std::vector<std::string> files;
  if (!std::filesystem::is_directory(options.directory))
    throw std::runtime_error(options.directory + ": is no directory");
  for (const auto& entry : std::filesystem::directory_iterator(options.directory))
    if (entry.path().extension() == ".st" || entry.path().extension() == ".xml" ||
        st::is_codesys_export(entry.path().string()) || entry.path().filename() == "devices.yaml")
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  if (files.empty()) throw std::runtime_error(options.directory + ": has no .st file");
  const auto result = compiled(files, false);
  if (!result.good()) return refuse(result, json);
  const auto tests = st::run_tests(result);
  std::size_t failed = 0;
  auto list = bus::Json::array();
  for (const auto& one : tests) {
    failed += one.passed ? 0 : 1;
    if (json)
      list.push_back(
          {{"name", one.name}, {"file", one.file}, {"passed", one.passed}, {"message", one.message}});
    else
      std::cout << (one.passed ? "passed  " : "FAILED  ") << one.name
                << (one.passed ? "" : "\n        " + one.message) << "\n";
  }
  if (json)
    std::cout << bus::text_of({{"good", failed == 0 && !tests.empty()}, {"tests", list}}) << "\n";
  else
    std::cout << tests.size() << " tests, " << failed << " failed\n";
  if (tests.empty()) std::cerr << "trunnion: " << options.directory << ": has no TEST\n";
  return failed == 0 && !tests.empty() ? 0 : 1;
}

}  // namespace

void add_plc_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<PlcOptions>();
  auto* plc = app.add_subcommand(
      "plc",
      "Programs of the PLC: check, run and test them without a machine; see and change those that run");
  plc->require_subcommand(1);
  auto* checks = add_command(*plc, common, "check",
                             "Report errors, warnings and the largest number of statements of programs",
                             [options, &common] { return check_plc(*options, common.json); });
  checks
      ->add_option("files", options->files,
                   "Structured Text, PLCopen XML, instruction lists and devices.yaml, translated together")
      ->required();
  checks->add_flag("--cross-reference", options->cross_reference,
                   "Every variable and register with the places that read, write or call it");
  auto* runs =
      add_command(*plc, common, "run", "Run programs, or one program or function, and print every variable",
                  [options, &common] { return run_plc(*options, common.json); });
  runs->add_option("files", options->files,
                   "Structured Text, PLCopen XML, instruction lists and devices.yaml, translated together")
      ->required();
  runs->add_option("--call", options->call, "Program or function to run (default: every program)");
  runs->add_option("--scans", options->scans, "Number of scans (default 1)")->check(CLI::Range(1, 100000000));
  runs->add_option("--period", options->period, "Time between two scans in ms (default 10)")
      ->check(CLI::Range(0.0, 1e9));
  runs->add_option("--set", options->set,
                   "VARIABLE=VALUE before the first scan; also a register (%X0.3); may be repeated")
      ->take_all();
  runs->add_option("--inputs", options->inputs,
                   "Comma-separated values: names in the first row, then one row before each scan");
  auto* tests = add_command(*plc, common, "test", "Run every TEST in the .st files of a directory",
                            [options, &common] { return test(*options, common.json); });
  tests->add_option("directory", options->directory, "Directory with .st files, translated together")
      ->required();
  add_plc_online_commands(*plc, common);
  add_plc_load_commands(*plc, common);
}

}  // namespace trunnion::cli
