// SPDX-License-Identifier: Apache-2.0
#include "machine_state/backup.hpp"

#include <fcntl.h>
#include <linux/fs.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "machine_state/archive.hpp"
#include "machine_state/machine_directory.hpp"
#include "machine_state/state_check.hpp"
#include "storage/crc32.hpp"
#include "storage/file.hpp"
#include "storage/kept_text.hpp"
#include "storage/temporary_directory.hpp"

namespace trunnion::machine_state {
namespace fs = std::filesystem;
namespace {

constexpr const char* manifest_name = "MANIFEST.json";
constexpr const char* configuration_folder = "configuration/";
constexpr int tries = 20;  // to read what a running cluster is writing

// The folder is there in a state without a program, too.
void write_state(const fs::path& directory, const FileSet& files) {
  write_files(directory.string(), files);
  fs::create_directory(directory / "programs");
  storage::sync_directory(directory.string());
}

// The first file that is not good; empty when all are.
std::string damage_in(const fs::path& directory) {
  for (const auto& report : check_state(directory.string()))
    if (!report.problem.empty()) return report.name + ": " + report.problem;
  return "";
}

// Names as state_files() gives them: none leads out of the directory.
bool valid_name(const std::string& name) {
  const auto slash = name.find('/');
  const auto file = slash == std::string::npos ? name : name.substr(slash + 1);
  if (slash != std::string::npos && name.substr(0, slash) != "programs") return false;
  return !file.empty() && file.front() != '.' && file.size() <= 128 &&
         std::all_of(file.begin(), file.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                  c == '_' || c == '-';
         });
}

}  // namespace

Backup collect(const std::string& directory, const std::string& machine, const std::string& version,
               const std::string& time) {
  const storage::TemporaryDirectory scratch("trunnion-backup");
  const auto copy = scratch.path() / "state";
  std::string problem;
  for (int i = 0; i < tries; ++i) {
    Backup backup{machine, version, time, {}, {}};
    try {
      for (const auto& name : state_files(directory))
        backup.files[name] = read_file(fs::path(directory) / name);
      write_state(copy, backup.files);
      problem = damage_in(copy);
    } catch (const storage::StorageError& e) {
      problem = e.what();  // a file that was replaced meanwhile
    }
    if (problem.empty()) return backup;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw std::runtime_error("no backup of a damaged state: " + problem + " ('trunnion state check')");
}

namespace {

// Adds the files as members, and what the manifest has of them.
nlohmann::json add_members(const FileSet& files, const std::string& folder, std::vector<Member>& members) {
  auto list = nlohmann::json::array();
  for (const auto& [name, bytes] : files) {
    list.push_back({{"name", name}, {"size", bytes.size()}, {"crc32", storage::crc32(bytes)}});
    members.push_back({folder + name, bytes});
  }
  return list;
}

// The members from `at` on that the list names, which are moved behind them.
FileSet take_members(const nlohmann::json& list, const std::string& folder,
                     bool (*valid)(const std::string& name), std::vector<Member>& members, std::size_t& at) {
  FileSet files;
  for (const auto& entry : list) {
    auto& member = members.at(at++);
    const auto name = entry.at("name").get<std::string>();
    if (folder + name != member.name || !valid(name))
      throw std::runtime_error("the backup has an unexpected file: " + member.name);
    if (entry.at("size").get<std::uint64_t>() != member.bytes.size() ||
        entry.at("crc32").get<std::uint32_t>() != storage::crc32(member.bytes))
      throw std::runtime_error("the backup is damaged: the checksum of " + member.name + " is wrong");
    files[name] = std::move(member.bytes);
  }
  return files;
}

}  // namespace

std::string write_backup(const Backup& backup) {
  std::vector<Member> members(1);
  nlohmann::json manifest{{"format", backup_format},
                          {"machine", backup.machine},
                          {"version", backup.version},
                          {"time", backup.time}};
  manifest["files"] = add_members(backup.files, "", members);
  manifest["configuration"] = add_members(backup.configuration, configuration_folder, members);
  members[0] = {manifest_name, storage::seal(manifest_name, 1, manifest.dump(1) + "\n")};
  return write_tar(members);
}

Backup read_backup(const std::string& bytes) {
  auto members = read_tar(bytes);
  std::string problem;
  const auto sealed = members.empty() || members[0].name != manifest_name
                          ? std::nullopt
                          : storage::unseal(manifest_name, members[0].bytes, problem);
  if (!sealed) throw std::runtime_error("no backup: its list of files is damaged or missing");
  const auto manifest = nlohmann::json::parse(sealed->content, nullptr, false);
  Backup backup;
  try {
    const auto format = manifest.at("format").get<unsigned>();
    if (format > backup_format)
      throw std::runtime_error("the backup has format " + std::to_string(format) +
                               ", and this version reads up to " + std::to_string(backup_format) +
                               ": install a newer version");
    backup.machine = manifest.at("machine").get<std::string>();
    backup.version = manifest.at("version").get<std::string>();
    backup.time = manifest.at("time").get<std::string>();
    const auto& state = manifest.at("files");
    const auto configuration = format == 1 ? nlohmann::json::array() : manifest.at("configuration");
    const auto listed = state.size() + configuration.size();
    if (listed + 1 != members.size())
      throw std::runtime_error("the backup has " + std::to_string(members.size() - 1) + " files instead of " +
                               std::to_string(listed));
    std::size_t at = 1;
    backup.files = take_members(state, "", valid_name, members, at);
    backup.configuration = take_members(configuration, configuration_folder, is_machine_file, members, at);
  } catch (const nlohmann::json::exception&) {
    throw std::runtime_error("no backup: its list of files has another shape");
  }
  return backup;
}

std::string restore(const Backup& backup, const std::string& directory) {
  const fs::path state = fs::path(directory).lexically_normal(), fresh = state.string() + ".restoring",
                 old = state.string() + ".before-restore";
  const bool replaces = fs::exists(state);
  try {
    write_state(fresh, backup.files);
    if (const auto problem = damage_in(fresh); !problem.empty())
      throw std::runtime_error("the backup has a damaged state: " + problem);
    if (!replaces)
      fs::rename(fresh, state);
    else if (renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, state.c_str(), RENAME_EXCHANGE) != 0)
      throw std::runtime_error(state.string() + ": cannot be exchanged: " + std::strerror(errno));
  } catch (const std::exception&) {
    std::error_code ignored;
    fs::remove_all(fresh, ignored);
    throw;
  }
  storage::sync_directory(state.parent_path().string());
  if (!replaces) return "";
  // From here on `fresh` is the old state.
  fs::remove_all(old);
  fs::rename(fresh, old);
  storage::sync_directory(state.parent_path().string());
  return old.string();
}

}  // namespace trunnion::machine_state
