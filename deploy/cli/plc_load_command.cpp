// SPDX-License-Identifier: Apache-2.0
// plc load, plc programs: new programs into the PLC that runs
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>

#include "bus/json.hpp"
#include "cluster/operating_station.hpp"
#include "plc/source_files.hpp"
#include "plc_session.hpp"

namespace trunnion::cli {
namespace {

using idl::plc::LoadPhase;

struct PlcLoadOptions {
  std::string directory;
  bool dry_run = false, undo = false, accept_differences = false, take_over = false;
  double seconds = 1;
};
struct Source {
  std::string name, text;
};

constexpr std::size_t part_bytes = 30000;
constexpr double longest_compilation = 30, longest_comparison = 10;  // s

std::vector<Source> sources_of(const std::string& directory) {
  if (!std::filesystem::is_directory(directory)) throw std::runtime_error(directory + ": is no directory");
  std::vector<Source> sources;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const auto name = entry.path().filename().string();
    if (!st::is_source(name)) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw std::runtime_error(entry.path().string() + ": cannot be read");
    sources.push_back({name, text.str()});
  }
  std::sort(sources.begin(), sources.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  if (sources.empty()) throw std::runtime_error(directory + ": has no program of a PLC");
  return sources;
}

std::vector<Source> previous(PlcSession& session) {
  std::vector<Source> sources;
  for (std::uint32_t files = 1; sources.size() < files;) {
    OnlineRequest request;
    request.action = OnlineAction::READ_SOURCE;
    request.program = idl::plc::ProgramSet::PREVIOUS;
    request.first = static_cast<std::uint32_t>(sources.size());
    Source source;
    for (std::uint32_t size = 1; source.text.size() < size;) {
      request.offset = static_cast<std::uint32_t>(source.text.size());
      const auto reply = session.call(request);
      files = reply.total, size = reply.size, source.name = reply.file;
      source.text.append(reply.data.begin(), reply.data.end());
      if (reply.data.empty()) break;
    }
    sources.push_back(std::move(source));
  }
  return sources;
}

OnlineReply load_status(PlcSession& session, std::vector<std::string>& messages) {
  OnlineRequest request;
  request.action = OnlineAction::LOAD_STATUS;
  request.first = static_cast<std::uint32_t>(messages.size());
  auto reply = session.call(request);
  messages.insert(messages.end(), reply.messages.begin(), reply.messages.end());
  return reply;
}

struct Outcome {
  bool good = false, taken_over = false;
  std::uint64_t compared = 0;
  std::uint32_t differences = 0;
  std::vector<std::string> messages;
  std::string refusal;
};

void print_outcome(const Outcome& outcome, bool json, std::size_t from) {
  if (json) {
    bus::Json document = {{"good", outcome.good},
                          {"taken_over", outcome.taken_over},
                          {"compared", outcome.compared},
                          {"differences", outcome.differences},
                          {"messages", outcome.messages}};
    if (!outcome.refusal.empty()) document["refusal"] = outcome.refusal;
    std::cout << bus::text_of(document) << "\n";
    return;
  }
  for (auto i = from; i < outcome.messages.size(); ++i) std::cout << outcome.messages[i] << "\n";
}

void send(PlcSession& session, const std::vector<Source>& sources) {
  session.call(OnlineAction::BEGIN_LOAD);
  for (const auto& source : sources) {
    OnlineRequest request;
    request.action = OnlineAction::WRITE_SOURCE;
    request.file = source.name;
    std::size_t at = 0;
    do {
      const auto part = std::string_view(source.text).substr(at, part_bytes);
      request.data.assign(part.begin(), part.end());
      session.call(request);
      at += part.size();
    } while (at < source.text.size());
  }
  session.call(OnlineAction::COMPILE);
}

// Messages so far are printed before the programs take over.
Outcome load_programs(const Common& common, PlcSession& session, const PlcLoadOptions& options) {
  Outcome outcome;
  const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(10)); };
  auto until = service::monotonic_seconds() + longest_compilation;
  auto reply = load_status(session, outcome.messages);
  for (; reply.phase == LoadPhase::COMPILING && service::monotonic_seconds() < until; wait())
    reply = load_status(session, outcome.messages);
  while (outcome.messages.size() < reply.total) reply = load_status(session, outcome.messages);
  const auto told = outcome.messages.size();
  outcome.good = reply.phase == LoadPhase::COMPILED;
  if (!common.json) print_outcome(outcome, false, 0);
  if (!outcome.good) {
    outcome.refusal = "the programs have errors; nothing has changed";
    return outcome;
  }
  if (options.dry_run) return outcome;
  session.call(OnlineAction::COMPARE);
  until = service::monotonic_seconds() + longest_comparison;
  // While time stands still, in virtual time without motion, there is nothing more to compare.
  auto advanced = service::monotonic_seconds();
  do {
    wait();
    const auto before = reply.compared;
    reply = load_status(session, outcome.messages);
    if (reply.compared != before) advanced = service::monotonic_seconds();
  } while (static_cast<double>(reply.compared) < options.seconds * 1000 &&
           reply.phase == LoadPhase::COMPARING && service::monotonic_seconds() < until &&
           service::monotonic_seconds() - advanced < 0.5);
  while (outcome.messages.size() < reply.total) reply = load_status(session, outcome.messages);
  outcome.compared = reply.compared, outcome.differences = reply.differences;
  if (!common.json) print_outcome(outcome, false, told);
  OnlineRequest request;
  const cluster::OperatingStation station(session.domain(), options.take_over);
  request.action = OnlineAction::TAKE_OVER;
  request.accept_differences = options.accept_differences;
  try {
    session.call(request);
    outcome.taken_over = true;
  } catch (const std::runtime_error& e) {
    outcome.refusal = e.what();
  }
  return outcome;
}

int run_load(const Common& common, const PlcLoadOptions& options) {
  if (options.undo != options.directory.empty())
    throw std::runtime_error("name a directory with programs, or --undo for those before the last load");
  PlcSession session(common);
  const auto sources = options.undo ? previous(session) : sources_of(options.directory);
  send(session, sources);
  const auto outcome = load_programs(common, session, options);
  if (!outcome.taken_over) session.call(OnlineAction::END_LOAD);
  if (common.json) {
    print_outcome(outcome, true, 0);
  } else if (outcome.taken_over) {
    std::cout << "The new programs run; compared over " << outcome.compared << " ms, " << outcome.differences
              << " differences\n";
  } else if (!outcome.refusal.empty()) {
    std::cerr << "trunnion: " << outcome.refusal << "\n";
    if (outcome.differences > 0)
      std::cerr << "trunnion: nothing has changed; '--accept-differences' loads them all the same\n";
  }
  return outcome.taken_over || (options.dry_run && outcome.good) ? 0 : 1;
}

int programs(const Common& common) {
  PlcSession session(common);
  const auto programs = session.newest(topics::plc_programs);
  if (common.json) {
    std::cout << bus::text_of(bus::to_json(programs)) << "\n";
    return 0;
  }
  std::printf("CRC-32 %08x, %s; %u online changes\n", programs.crc32,
              programs.delivered ? "those of the machine's directory" : "loaded online", programs.changes);
  return 0;
}

}  // namespace

void add_plc_load_commands(CLI::App& plc, Common& common) {
  auto options = std::make_shared<PlcLoadOptions>();
  auto* loads =
      add_command(plc, common, "load",
                  "Load programs into the PLC that runs, after a comparison; says before what is not kept",
                  [options, &common] { return run_load(common, *options); });
  loads->add_option("directory", options->directory,
                    "Directory with .st, .exp and .xml files, fast.il, main.il, devices.yaml, modbus.yaml");
  loads->add_flag("--dry-run", options->dry_run, "Only translate them and say what is not kept");
  loads->add_flag("--undo", options->undo, "Load those again that ran before the last load");
  loads->add_flag("--take-right", options->take_over, cluster::take_right_help);
  loads->add_flag("--accept-differences", options->accept_differences,
                  "Load them although they do something else than the running ones");
  loads->add_option("--compare", options->seconds, "Seconds of machine time to compare (default 1)")
      ->check(CLI::Range(0.0, 600.0));
  add_command(plc, common, "programs", "Which programs the PLC runs", [&common] { return programs(common); });
}

}  // namespace trunnion::cli
