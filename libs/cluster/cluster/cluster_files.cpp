// SPDX-License-Identifier: Apache-2.0
#include "cluster/cluster_files.hpp"

#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "cluster/cluster_locks.hpp"

namespace trunnion::cluster {
namespace fs = std::filesystem;

std::string run_directory_base() { return "/tmp/trunnion-" + std::to_string(getuid()); }

namespace {
std::string base() { return run_directory_base(); }
constexpr const char* verification_mark = "verify-";
}  // namespace

std::string binary_directory() { return fs::read_symlink("/proc/self/exe").parent_path().string(); }

std::string find_machine(const std::string& name) {
  if (fs::exists(fs::path(name) / "machine.yaml")) return fs::absolute(name).lexically_normal().string();
  std::vector<fs::path> roots;
  if (const char* configs = std::getenv("TRUNNION_CONFIGS")) roots.emplace_back(configs);
  for (fs::path up = binary_directory(); up.has_relative_path(); up = up.parent_path()) {
    roots.push_back(up / "configs" / "machines");
    roots.push_back(up / "share" / "trunnion" / "machines");
  }
  roots.push_back(fs::current_path() / "configs" / "machines");
  for (const auto& root : roots)
    if (fs::exists(root / name / "machine.yaml")) return fs::canonical(root / name).string();
  throw std::runtime_error("machine '" + name +
                           "': no such directory, and configs/machines has none of this name");
}

std::string web_directory() {
  for (fs::path up = binary_directory(); up.has_relative_path(); up = up.parent_path())
    for (const auto* share : {"share/trunnion/web", "share/web"})
      if (fs::exists(up / share / "index.html")) return (up / share).string();
  return "";
}

std::string default_state_directory(const std::string& machine) {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') return (fs::path(state) / "trunnion" / machine).string();
  const char* home = std::getenv("HOME");
  const passwd* user = home != nullptr && *home == '/' ? nullptr : getpwuid(getuid());
  if (user != nullptr) home = user->pw_dir;
  if (home == nullptr || *home != '/')
    throw std::runtime_error(
        "there is no home directory for the state of the machine: name one with --state");
  return (fs::path(home) / ".local" / "state" / "trunnion" / machine).string();
}

std::string RunDirectory::path() const { return base() + "/" + std::to_string(domain); }

void RunDirectory::make() const {
  const auto failed = [](const std::string& directory) {
    return std::runtime_error(directory + ": cannot be made: " + std::strerror(errno));
  };
  // A cluster that ends at this moment may remove the empty base in between.
  for (int attempt = 0;; ++attempt) {
    if (mkdir(base().c_str(), 0700) != 0 && errno != EEXIST) throw failed(base());
    if (mkdir(path().c_str(), 0700) == 0 || errno == EEXIST) break;
    if (errno != ENOENT || attempt == 100) throw failed(path());
  }
  for (const auto& directory : {base(), path()}) {
    // What is in it, for example the tickets of swaps, is this user's alone.
    struct stat status {};
    if (lstat(directory.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid())
      throw std::runtime_error(directory + " belongs to another user: remove it");
    chmod(directory.c_str(), 0700);
  }
}

bool is_launcher(int pid) {
  // The number may belong to another process by now, or to one that is dead and not yet waited for.
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && name == "(trunnion-launch)" && state != "Z";
}

std::optional<int> RunDirectory::launcher() const {
  std::ifstream in(pid_file());
  int pid = 0;
  if (!(in >> pid) || pid <= 0) return std::nullopt;
  return is_launcher(pid) ? std::optional(pid) : std::nullopt;
}

bool RunDirectory::abandoned() const { return fs::exists(info_file()) && !launcher(); }

void RunDirectory::remove() const {
  std::error_code ignored;
  fs::remove_all(path(), ignored);
  fs::remove(base(), ignored);  // only when it is empty
}

std::string RunDirectory::verification() const {
  return path() + "/" + verification_mark + std::to_string(getpid());
}

bool RunDirectory::verifies() const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path(), ignored)) {
    const auto name = entry.path().filename().string();
    if (!name.starts_with(verification_mark)) continue;
    const int pid = std::atoi(name.c_str() + std::strlen(verification_mark));
    if (pid > 0 && kill(pid, 0) == 0) return true;
  }
  return false;
}

namespace {

// A directory that another process removes meanwhile is not stale: its domain may be reserved again already.
bool is_stale(const RunDirectory& run) {
  std::error_code gone;
  const auto written = fs::last_write_time(run.path(), gone);
  return !gone && written < fs::file_time_type::clock::now() - std::chrono::minutes(1) && !run.launcher() &&
         !run.verifies();
}

}  // namespace

std::uint32_t free_domain(double timeout) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout);
  const auto first = static_cast<std::uint32_t>(getpid()) % 20;
  for (;;) {
    for (std::uint32_t i = 0; i < 20; ++i) {
      const RunDirectory run{80 + (first + i) % 20};
      if (is_stale(run)) run.remove();
      if (domain_holder(run.domain)) continue;  // of another user
      // A directory is made by one process only, so it reserves the domain.
      if (mkdir(base().c_str(), 0700) != 0 && errno != EEXIST) continue;
      if (mkdir(run.path().c_str(), 0700) == 0) return run.domain;
    }
    if (std::chrono::steady_clock::now() >= until)
      throw std::runtime_error("domains 80 .. 99 are all taken: stop a cluster with 'trunnion down'");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

std::vector<RunDirectory> run_directories() {
  std::vector<RunDirectory> all;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(base(), ignored)) {
    const auto name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") == std::string::npos && name.size() <= 3)
      all.push_back({static_cast<std::uint32_t>(std::stoul(name))});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.domain < b.domain; });
  return all;
}

}  // namespace trunnion::cluster
