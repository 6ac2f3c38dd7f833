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
#include "machine_state/state_check.hpp"
#include "storage/crc32.hpp"
#include "storage/file.hpp"
#include "storage/kept_text.hpp"
#include "storage/temporary_directory.hpp"

namespace trunnion::machine_state {
namespace fs = std::filesystem;
namespace {

constexpr const char* manifest_name = "MANIFEST.json";
constexpr int tries = 20;  // to read what a running cluster is writing

std::string read_file(const fs::path& path) {
  const storage::File file(path.string(), O_RDONLY);
  std::string bytes(file.size(), '\0');
  bytes.resize(file.read(0, {reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()}));
  return bytes;
}

void write_files(const fs::path& directory, const std::map<std::string, std::string>& files) {
  fs::remove_all(directory);
  fs::create_directories(directory / "programs");
  for (const auto& [name, bytes] : files) {
    storage::File file((directory / name).string(), O_WRONLY | O_CREAT | O_EXCL);
    file.append(0, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    file.sync();
  }
  storage::sync_directory((directory / "programs").string());
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
    Backup backup{machine, version, time, {}};
    try {
      for (const auto& name : state_files(directory))
        backup.files[name] = read_file(fs::path(directory) / name);
      write_files(copy, backup.files);
      problem = damage_in(copy);
    } catch (const storage::StorageError& e) {
      problem = e.what();  // a file that was replaced meanwhile
    }
    if (problem.empty()) return backup;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw std::runtime_error("no backup of a damaged state: " + problem + " ('trunnion state check')");
}

std::string write_backup(const Backup& backup) {
  nlohmann::json manifest{{"format", backup_format},
                          {"machine", backup.machine},
                          {"version", backup.version},
                          {"time", backup.time},
                          {"files", nlohmann::json::array()}};
  std::vector<Member> members(1);
  for (const auto& [name, bytes] : backup.files) {
    manifest["files"].push_back({{"name", name}, {"size", bytes.size()}, {"crc32", storage::crc32(bytes)}});
    members.push_back({name, bytes});
  }
  members[0] = {manifest_name, storage::seal(manifest_name, 1, manifest.dump(1) + "\n")};
  return write_tar(members);
}

Backup read_backup(const std::string& bytes) {
  const auto members = read_tar(bytes);
  std::string problem;
  const auto sealed = members.empty() || members[0].name != manifest_name
                          ? std::nullopt
                          : storage::unseal(manifest_name, members[0].bytes, problem);
  if (!sealed) throw std::runtime_error("no backup: its list of files is damaged or missing");
  const auto manifest = nlohmann::json::parse(sealed->content, nullptr, false);
  Backup backup;
  try {
    if (const auto format = manifest.at("format").get<unsigned>(); format > backup_format)
      throw std::runtime_error("the backup has format " + std::to_string(format) +
                               ", and this version reads up to " + std::to_string(backup_format) +
                               ": install a newer version");
    backup.machine = manifest.at("machine").get<std::string>();
    backup.version = manifest.at("version").get<std::string>();
    backup.time = manifest.at("time").get<std::string>();
    const auto& list = manifest.at("files");
    if (list.size() + 1 != members.size())
      throw std::runtime_error("the backup has " + std::to_string(members.size() - 1) + " files instead of " +
                               std::to_string(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto& member = members[i + 1];
      if (list[i].at("name").get<std::string>() != member.name || !valid_name(member.name))
        throw std::runtime_error("the backup has an unexpected file: " + member.name);
      if (list[i].at("size").get<std::uint64_t>() != member.bytes.size() ||
          list[i].at("crc32").get<std::uint32_t>() != storage::crc32(member.bytes))
        throw std::runtime_error("the backup is damaged: the checksum of " + member.name + " is wrong");
      backup.files[member.name] = member.bytes;
    }
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
    write_files(fresh, backup.files);
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
