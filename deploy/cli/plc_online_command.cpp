// SPDX-License-Identifier: Apache-2.0
// plc variables, uses, watch, force, trace, tasks: the values of the PLC that runs
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <utility>

#include "bus/json.hpp"
#include "cluster/operating_station.hpp"
#include "interrupt_watch.hpp"
#include "plc/online/task_times.hpp"
#include "plc_session.hpp"

namespace trunnion::cli {
namespace {

struct PlcOnlineOptions {
  std::vector<std::string> paths;
  std::string when, output;
  std::uint32_t scans = 1000;
  std::uint64_t count = 0;
  bool permanent = false, release = false, list = false, take_over = false;
};

// All pages of a list.
template <class Row>
std::vector<Row> listed(const Common& common, const PlcOnlineOptions& options, OnlineAction action,
                        std::vector<Row> idl::plc::OnlineReply::*rows) {
  PlcSession session(common);
  std::vector<Row> all;
  for (std::uint32_t total = 1; all.size() < total;) {
    OnlineRequest request;
    request.action = action;
    request.paths = options.paths;
    request.first = static_cast<std::uint32_t>(all.size());
    const auto reply = session.call(request);
    const auto& page = reply.*rows;
    total = reply.total;
    if (page.empty()) break;
    all.insert(all.end(), page.begin(), page.end());
  }
  return all;
}

int variables(const Common& common, const PlcOnlineOptions& options) {
  const auto all = listed(common, options, OnlineAction::LIST_VARIABLES, &idl::plc::OnlineReply::variables);
  if (common.json) {
    std::cout << bus::text_of(ShownVariables(all).json()) << "\n";
    return 0;
  }
  std::vector<std::string> above;
  for (const auto& info : all) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from < info.path.size();) {
      const auto to = std::min(info.path.find_first_of(".[", from + 1), info.path.size());
      parts.push_back(info.path.substr(from, to - from));
      from = to;
    }
    std::size_t same = 0;
    while (same + 1 < parts.size() && same < above.size() && above[same] == parts[same]) ++same;
    for (auto i = same; i + 1 < parts.size(); ++i) std::cout << std::string(2 * i, ' ') << parts[i] << "\n";
    std::cout << std::string(2 * (parts.size() - 1), ' ') << parts.back() << " : " << info.type
              << (info.unit.empty() ? "" : " [" + info.unit + "]") << (info.retained ? " RETAIN" : "")
              << "\n";
    above = parts;
  }
  return 0;
}

void show_watched(const Common& common, const ShownVariables& shown, const idl::plc::Watched& sample) {
  const auto texts = shown.texts(sample.cells);
  const auto forced = [&](std::size_t i) {
    return std::find(sample.forced.begin(), sample.forced.end(), i) != sample.forced.end();
  };
  if (common.json) {
    bus::Json json = {{"scan", sample.scan}, {"tick", sample.tick}, {"values", bus::Json::object()}};
    for (std::size_t i = 0; i < shown.size(); ++i) json["values"][shown.info(i).path] = texts[i];
    json["forced"] = bus::Json::array();
    for (std::size_t i = 0; i < shown.size(); ++i)
      if (forced(i)) json["forced"].push_back(shown.info(i).path);
    std::cout << bus::text_of(json) << std::endl;
    return;
  }
  for (std::size_t i = 0; i < shown.size(); ++i)
    std::cout << (i > 0 ? "  " : "") << shown.info(i).path << " = " << texts[i]
              << (shown.info(i).unit.empty() ? "" : " " + shown.info(i).unit)
              << (forced(i) ? " (forced)" : "");
  std::cout << std::endl;
}

int watch(const Common& common, const PlcOnlineOptions& options) {
  PlcSession session(common);
  auto reader = session.bus().reader(topics::plc_watched);
  OnlineRequest request;
  request.action = OnlineAction::WATCH;
  request.paths = options.paths;
  auto reply = session.call(request);
  auto asked = service::monotonic_seconds();
  ShownVariables shown(reply.variables);
  const InterruptWatch interrupts;
  idl::plc::Watched sample, last;
  std::uint64_t written = 0;
  while (!InterruptWatch::requested() && (options.count == 0 || written < options.count)) {
    if (service::monotonic_seconds() - asked > 1.5) {
      reply = session.call(request);
      asked = service::monotonic_seconds();
    }
    while (reader.take(sample)) {
      if (sample.slot != reply.slot || sample.client != reply.client || sample.cells.size() != shown.cells())
        continue;
      if (written > 0 && sample.cells == last.cells && sample.forced == last.forced) continue;
      if (options.count != 0 && written == options.count) continue;
      show_watched(common, shown, sample);
      ++written;
      last = sample;
    }
    session.bus().signal().wait(0.05);
  }
  session.call(OnlineAction::END_WATCH);
  return 0;
}

int list_forces(const Common& common, PlcSession& session) {
  const auto forces = session.newest(topics::plc_forces);
  if (common.json) {
    std::cout << bus::text_of(bus::to_json(forces)["values"]) << "\n";
    return 0;
  }
  for (const auto& one : forces.values)
    std::cout << one.path << " = " << one.value << (one.permanent ? " (permanent)" : "") << "\n";
  if (forces.values.empty()) std::cout << "Nothing is forced\n";
  return 0;
}

int force(const Common& common, const PlcOnlineOptions& options) {
  if (options.release && options.permanent)
    throw std::runtime_error("--release ends a force; leave out --permanent");
  if (!options.release && !options.list && options.paths.empty())
    throw std::runtime_error("write PATH=VALUE, --release or --list");
  PlcSession session(common);
  OnlineRequest request;
  request.action = options.release ? OnlineAction::RELEASE : OnlineAction::FORCE;
  request.permanent = options.permanent;
  for (const auto& text : options.paths) {
    const auto at = text.find('=');
    if (options.release) {
      request.paths.push_back(text);
      continue;
    }
    if (at == std::string::npos || at == 0) throw std::runtime_error(text + ": write PATH=VALUE");
    request.paths.push_back(text.substr(0, at));
    request.values.push_back(text.substr(at + 1));
  }
  if (options.release || !options.paths.empty()) {
    const cluster::OperatingStation station(session.domain(), options.take_over);
    session.call(request);
  }
  return options.list ? list_forces(common, session) : 0;
}

void set_condition(const std::string& when, OnlineRequest& request) {
  using idl::plc::TraceCondition;
  if (when.empty()) return;
  const struct {
    const char* text;
    TraceCondition condition;
  } operators[] = {{"<>", TraceCondition::NOT_EQUAL},
                   {"<", TraceCondition::LESS},
                   {">", TraceCondition::GREATER},
                   {"=", TraceCondition::EQUAL}};
  request.condition = TraceCondition::CHANGED;
  request.condition_path = when;
  for (const auto& one : operators)
    if (const auto at = when.find(one.text); at != std::string::npos) {
      request.condition = one.condition;
      request.condition_path = when.substr(0, at);
      request.condition_value = when.substr(at + std::string(one.text).size());
      break;
    }
  const auto trim = [](std::string& text) {
    text.erase(0, text.find_first_not_of(' '));
    text.erase(text.find_last_not_of(' ') + 1);
  };
  trim(request.condition_path), trim(request.condition_value);
}

void write_trace(const Common& common, std::ostream& out, const ShownVariables& shown,
                 const std::vector<std::uint64_t>& cells) {
  const auto width = shown.cells() + 2;
  if (common.json) {
    bus::Json json = {{"variables", shown.json()}, {"rows", bus::Json::array()}};
    for (std::size_t at = 0; at < cells.size(); at += width)
      json["rows"].push_back({{"time_ms", cells[at]},
                              {"tick", cells[at + 1]},
                              {"values", shown.texts(std::span(cells).subspan(at + 2, shown.cells()))}});
    out << bus::text_of(json) << "\n";
    return;
  }
  out << "time_ms,tick";
  const auto quoted = [](const std::string& text) {
    return text.find_first_of(",\"") == std::string::npos ? text : '"' + text + '"';
  };
  for (std::size_t i = 0; i < shown.size(); ++i) out << "," << quoted(shown.info(i).path);
  out << "\n";
  for (std::size_t at = 0; at < cells.size(); at += width) {
    out << cells[at] << "," << cells[at + 1];
    for (const auto& text : shown.texts(std::span(cells).subspan(at + 2, shown.cells())))
      out << "," << quoted(text);
    out << "\n";
  }
}

int trace(const Common& common, const PlcOnlineOptions& options) {
  PlcSession session(common);
  OnlineRequest request;
  request.action = OnlineAction::START_TRACE;
  request.paths = options.paths;
  request.scans = options.scans;
  set_condition(options.when, request);
  const ShownVariables shown(session.call(request).variables);
  const InterruptWatch interrupts;
  std::vector<std::uint64_t> cells;
  const auto width = shown.cells() + 2;
  bool complete = false;
  while (!complete || cells.size() < std::size_t{options.scans} * width) {
    OnlineRequest read;
    read.action = OnlineAction::READ_TRACE;
    read.first = static_cast<std::uint32_t>(cells.size() / width);
    const auto reply = session.call(read);
    cells.insert(cells.end(), reply.cells.begin(), reply.cells.end());
    complete = reply.complete;
    if (reply.cells.empty()) {
      if (InterruptWatch::requested()) break;
      session.bus().signal().wait(0.02);
    }
  }
  session.call(OnlineAction::END_TRACE);
  if (options.output.empty()) {
    write_trace(common, std::cout, shown, cells);
  } else {
    std::ofstream file(options.output);
    write_trace(common, file, shown, cells);
    if (!file.flush()) throw std::runtime_error(options.output + ": cannot be written");
  }
  if (complete) return 0;
  std::cerr << "trunnion: interrupted after " << cells.size() / width << " of " << options.scans
            << " scans\n";
  return 1;
}

int uses(const Common& common, const PlcOnlineOptions& options) {
  const auto all = listed(common, options, OnlineAction::LIST_USES, &idl::plc::OnlineReply::uses);
  if (common.json) {
    auto list = bus::Json::array();
    for (const auto& use : all) list.push_back(bus::to_json(use));
    std::cout << bus::text_of(list) << "\n";
    return 0;
  }
  if (all.empty()) std::cout << options.paths[0] << " is not used in the sources\n";
  for (const auto& use : all) {
    std::cout << use.file << ":" << use.line << ":" << use.column << ":";
    const char* separator = " ";
    for (const auto& [does, word] :
         {std::pair{use.reads, "reads"}, {use.writes, "writes"}, {use.calls, "calls"}})
      if (does) std::cout << std::exchange(separator, ", ") << word;
    std::cout << (use.element.empty() ? "" : " (" + use.element + ")") << "\n";
  }
  return 0;
}

int tasks(const Common& common) {
  PlcSession session(common);
  OnlineRequest request;
  request.action = OnlineAction::LIST_VARIABLES;
  request.paths = {plc_online::task_times_prefix};
  const auto times = plc_online::task_times(session.call(request));
  if (common.json) {
    std::cout << bus::text_of(plc_online::json_of(times)) << "\n";
    return 0;
  }
  const auto us = [](std::uint64_t ns) { return static_cast<double>(ns) / 1000; };
  std::printf("%-10s %10s %10s %10s %12s %12s %12s\n", "task", "last us", "worst us", "budget us",
              "statements", "most", "budget");
  for (const auto& time : times)
    std::printf("%-10s %10.1f %10.1f %10.0f %12llu %12llu %12s\n", time.name.c_str(), us(time.last_ns),
                us(time.worst_ns), us(time.budget_ns), static_cast<unsigned long long>(time.statements),
                static_cast<unsigned long long>(time.most_statements),
                time.statement_budget == 0 ? "-" : std::to_string(time.statement_budget).c_str());
  return 0;
}

}  // namespace

void add_plc_online_commands(CLI::App& plc, Common& common) {
  auto options = std::make_shared<PlcOnlineOptions>();
  const auto bind = [&common, options](auto what) {
    return [&common, options, what] { return what(common, *options); };
  };
  auto* lists = add_command(plc, common, "variables", "Variables of the PLC that runs, with their types",
                            bind(variables));
  lists->add_option("path", options->paths, "Only those whose path begins with this")->expected(0, 1);
  add_command(plc, common, "uses", "Places in the sources of the PLC that use a variable or register",
              bind(uses))
      ->add_option("path", options->paths, "Variable, register or name of a register, as of watch")
      ->expected(1)
      ->required();
  auto* watches = add_command(plc, common, "watch",
                              "Print the values of variables of the PLC whenever they change", bind(watch));
  watches
      ->add_option(
          "paths", options->paths,
          "Variables (fast.conveyor.timer.ET, main.list[2]), registers (%G300, %X0.3) or their names")
      ->required();
  watches->add_option("--count", options->count, "End after so many lines (default: until interrupted)");
  auto* forces = add_command(
      plc, common, "force", "Give variables of the PLC a value that the programs cannot change", bind(force));
  forces->add_option("values", options->paths, "PATH=VALUE; with --release: PATH, none for all");
  forces->add_flag("--permanent", options->permanent, "Also after the next start of the cluster");
  forces->add_flag("--release", options->release, "End the forces");
  forces->add_flag("--take-right", options->take_over, cluster::take_right_help);
  forces->add_flag("--list", options->list, "Print what is forced");
  auto* traces = add_command(plc, common, "trace",
                             "Record variables of the PLC after each scan, as CSV or JSON", bind(trace));
  traces->add_option("paths", options->paths, "Variables and registers, as of watch")->required();
  traces->add_option("--scans", options->scans, "Number of scans (default 1000)")
      ->check(CLI::Range(1, 1000000));
  traces->add_option(
      "--when", options->when,
      "Begin when this is true: PATH=VALUE, PATH<>VALUE, PATH<VALUE, PATH>VALUE; PATH alone: when "
      "it changes (default: at once)");
  traces->add_option("--output", options->output, "File to write (default: standard output)");
  add_command(
      plc, common, "tasks",
      "How long the tasks of the PLC take: last and worst time of a scan, statements, and their limits",
      [&common] { return tasks(common); });
}

}  // namespace trunnion::cli
