// SPDX-License-Identifier: Apache-2.0
#include "machine_state/state_check.hpp"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "machine_state/index_file.hpp"
#include "storage/crc32.hpp"
#include "storage/file.hpp"
#include "storage/kept_file.hpp"
#include "storage/retained_pair.hpp"

namespace trunnion::machine_state {
namespace fs = std::filesystem;
using storage::KeptState;
namespace {

constexpr std::array texts = {"active.yaml",   "measurement.json", "parameters.yaml",  "plc.programs",
                              "programs.yaml", "tools.yaml",       "work_offsets.yaml"};
constexpr std::array journals = {"alarms.jsonl", "journal.jsonl", "plc.jsonl", "swaps.jsonl"};
struct Memory {
  const char* name;
  const char* kind;
};
constexpr std::array memories = {Memory{"encoders.bin", "encoders"}, Memory{"plc.image", "plc"},
                                 Memory{"references.bin", "references"},
                                 Memory{"simulation.bin", "simulation"}};
constexpr const char* programs = "programs";

bool is_channel_text(const std::string& name) {
  const auto dot = name.rfind('.');
  if (name.rfind("channel-", 0) != 0 || dot == std::string::npos) return false;
  const auto number = name.substr(8, dot - 8), kind = name.substr(dot);
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos &&
         (kind == ".program" || kind == ".variables");
}

template <class Names>
bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const Memory* memory_of(const std::string& name) {
  const auto found = std::find_if(memories.begin(), memories.end(),
                                  [&](const Memory& memory) { return name == memory.name; });
  return found == memories.end() ? nullptr : &*found;
}

bool is_text(const std::string& name) { return has(texts, name) || is_channel_text(name); }

std::string without_suffix(const std::string& name) {
  const std::string suffix = storage::previous_suffix;
  return name.ends_with(suffix) ? name.substr(0, name.size() - suffix.size()) : name;
}

bool is_no_file(const fs::path& path) { return fs::exists(path) && !fs::is_regular_file(path); }

// A directory, say, where a file of the state belongs.
void check_other_entries(const fs::path& directory, std::vector<FileReport>& reports) {
  for (const auto& entry : fs::directory_iterator(directory)) {
    const auto name = entry.path().filename().string();
    if (entry.is_regular_file()) continue;
    const bool journal = has(journals, name), memory = memory_of(name) != nullptr;
    if (journal || memory || is_text(name))
      reports.push_back({name,
                         journal  ? Kind::journal
                         : memory ? Kind::memory
                                  : Kind::text,
                         KeptState::unusable, 0, "it is no file: move it away"});
  }
}

std::vector<std::string> list(const fs::path& directory) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error))
    if (entry.is_regular_file(error)) names.push_back(entry.path().filename().string());
  if (error) throw storage::StorageError(directory.string() + ": cannot be listed: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

std::string bytes_of(const fs::path& path) {
  const storage::File file(path.string(), O_RDONLY);
  std::string bytes(file.size(), '\0');
  bytes.resize(file.read(0, {reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()}));
  return bytes;
}

void check_text(const fs::path& directory, const std::string& name, std::vector<FileReport>& reports) {
  const auto path = (directory / name).string();
  const auto kept = storage::read_kept(path);
  reports.push_back({name, Kind::text, kept.state, kept.generation, kept.problem});
  const auto previous = path + storage::previous_suffix;
  if (kept.state != KeptState::good || !fs::exists(previous)) return;
  std::string problem;
  if (!storage::unseal(name, bytes_of(previous), problem))
    reports.push_back(
        {name + storage::previous_suffix, Kind::text, KeptState::unusable, 0, problem + "; not needed now"});
}

FileReport check_memory(const fs::path& directory, const Memory& memory) {
  const auto path = (directory / memory.name).string();
  const auto kept = storage::RetainedPair::of_files(path, memory.kind).load();
  // The version before had one file without a mark.
  const bool format_0 = kept.state == KeptState::unusable && !fs::exists(path + storage::previous_suffix) &&
                        bytes_of(path).find("trunnion-state") == std::string::npos;
  if (format_0) return {memory.name, Kind::memory, KeptState::good, 0, ""};
  return {memory.name, Kind::memory, kept.state, 0, kept.problem};
}

FileReport check_journal(const fs::path& directory, const std::string& name) {
  std::ifstream in(directory / name);
  std::size_t lines = 0, bad = 0;
  for (std::string line; std::getline(in, line); ++lines)
    if (!nlohmann::json::accept(line)) ++bad;
  FileReport report{name, Kind::journal, bad == 0 ? KeptState::good : KeptState::previous, 0, ""};
  if (bad > 0) report.problem = std::to_string(bad) + " of " + std::to_string(lines) + " lines are damaged";
  return report;
}

void check_programs(const fs::path& directory, std::vector<FileReport>& reports) {
  const auto kept = storage::read_kept((directory / index_file).string());
  IndexFile index;
  if (kept.state == KeptState::good || kept.state == KeptState::previous) index = read_index(kept.content);
  std::set<std::string> files;
  if (fs::exists(directory / programs))
    for (const auto& name : list(directory / programs)) files.insert(name);
  for (const auto& [name, row] : index.rows) {
    if (!row.stored || row.removing) continue;
    FileReport report{std::string(programs) + "/" + name, Kind::program, KeptState::good, row.revision, ""};
    if (!files.contains(name)) {
      report.state = KeptState::unusable, report.problem = "it is missing";
    } else if (!files.contains(accepted_prefix + name)) {
      const auto text = bytes_of(directory / programs / name);
      const TextIdentity identity{text.size(), storage::crc32(text)};
      if (identity != identity_of(*row.stored) && row.next != identity)
        report.state = KeptState::unusable, report.problem = "it does not match its checksum";
    }
    reports.push_back(std::move(report));
  }
}

}  // namespace

const char* name_of(Kind kind) {
  constexpr const char* names[] = {"text", "memory", "program", "journal"};
  return names[static_cast<int>(kind)];
}

std::vector<FileReport> check_state(const std::string& directory) {
  std::vector<FileReport> reports;
  std::set<std::string> names;
  for (const auto& name : list(directory)) names.insert(without_suffix(name));
  for (const auto& name : names) {
    // Its previous generation alone may be a file; check_other_entries() names it.
    if (is_no_file(fs::path(directory) / name)) continue;
    if (is_text(name)) check_text(directory, name, reports);
    if (const auto* memory = memory_of(name)) reports.push_back(check_memory(directory, *memory));
    if (has(journals, name)) reports.push_back(check_journal(directory, name));
  }
  check_other_entries(directory, reports);
  check_programs(directory, reports);
  std::sort(reports.begin(), reports.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return reports;
}

std::vector<std::string> state_files(const std::string& directory) {
  std::vector<std::string> files;
  for (const auto& name : list(directory)) {
    const auto kept = without_suffix(name);
    if (is_text(kept) || memory_of(kept) != nullptr || has(journals, name)) files.push_back(name);
  }
  if (fs::exists(fs::path(directory) / programs))
    for (const auto& name : list(fs::path(directory) / programs))
      if (name.front() != '.') files.push_back(std::string(programs) + "/" + name);
  std::sort(files.begin(), files.end());
  return files;
}

void accept(const std::string& directory, const std::string& name) {
  const fs::path path = fs::path(directory) / name;
  const auto parent = fs::path(name).parent_path().string();
  const auto file = fs::path(name).filename().string();
  if (!fs::is_regular_file(path)) throw std::runtime_error(path.string() + ": there is no such file");
  if (parent == programs && file.front() != '.') {
    storage::File((fs::path(directory) / programs / (accepted_prefix + file)).string(), O_WRONLY | O_CREAT);
    return;
  }
  if (!parent.empty() || !is_text(name))
    throw std::runtime_error(name + " is no text that can be edited: the texts and 'programs/NAME' can");
  auto text = bytes_of(path);
  // An old last line is replaced, also when it no longer fits.
  for (auto at = text.rfind("# trunnion-state ");
       at != std::string::npos && (at == 0 || text[at - 1] == '\n'); at = text.rfind("# trunnion-state "))
    text.resize(at);
  storage::write_kept(path.string(), text);
}

}  // namespace trunnion::machine_state
