// SPDX-License-Identifier: Apache-2.0
#include "cluster/cluster_locks.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pwd.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "cluster/cluster_files.hpp"

namespace trunnion::cluster {
namespace fs = std::filesystem;
namespace {

std::string holder_text(const std::string& line, const std::string& otherwise) {
  std::uint32_t domain = 0;
  const auto identity = read_identity(line, domain);
  return identity.pid != 0 ? describe(identity, domain) : otherwise;
}

std::string read_all(int file) {
  char text[2048];
  const auto size = pread(file, text, sizeof text, 0);
  return {text, size > 0 ? static_cast<std::size_t>(size) : 0};
}

// Another user's file, or one of a file system that is mounted read-only, can be read and locked, but not
// written: `why_not` is the reason.
int open_lock(const std::string& path, int& why_not) {
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  why_not = file >= 0 ? 0 : errno;
  return file >= 0 ? file : open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

std::pair<sockaddr_un, socklen_t> address_of(std::uint32_t domain, const std::string& host) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // A zero byte first: the name is in no directory and ends with its socket.
  auto name = "trunnion/domain/" + std::to_string(domain) + (host.empty() ? "" : "/" + host);
  name.resize(std::min(name.size(), sizeof address.sun_path - 1));
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  return {address, static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size())};
}

// Empty when the holder ends just now: it has closed the connection without a word.
std::string who_is_behind(int connection) {
  pollfd ready{connection, POLLIN, 0};
  std::string line;
  char text[512];
  while (poll(&ready, 1, 1000) > 0) {
    const auto size = read(connection, text, sizeof text);
    if (size <= 0 && line.empty()) return "";
    if (size <= 0) break;
    line.append(text, static_cast<std::size_t>(size));
  }
  ucred peer{};
  socklen_t size = sizeof peer;
  std::string otherwise = "a process";
  if (getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0) {
    const passwd* user = getpwuid(peer.uid);
    otherwise = "launcher " + std::to_string(peer.pid) + " of user " +
                (user != nullptr ? std::string(user->pw_name) : std::to_string(peer.uid)) +
                " on this host, which does not answer";
  }
  return holder_text(line, otherwise);
}

int parent_of(const fs::path& process) {
  std::ifstream in(process / "stat");
  std::string line;
  std::getline(in, line);
  const auto name_ends = line.rfind(") ");
  int parent = 0;
  char state = 0;
  if (name_ends == std::string::npos) return 0;
  return std::sscanf(line.c_str() + name_ends + 2, "%c %d", &state, &parent) == 2 ? parent : 0;
}

bool alive(int pid) { return kill(pid, 0) == 0 || errno == EPERM; }

}  // namespace

StateLock::StateLock(const std::string& directory, const Identity& holder, std::uint32_t domain) {
  const auto path = directory + "/" + lock_file;
  int why_not = 0;
  file_ = open_lock(path, why_not);
  if (file_ < 0) throw std::runtime_error(path + ": cannot be opened: " + std::strerror(errno));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    const auto other = holder_text(read_all(file_), "another process");
    close(file_);
    throw Locked("the state directory " + directory + " is in use by " + other);
  }
  const auto line = write_identity(holder, domain);
  // On a full disk the lock holds without the line, which only tells others who holds it.
  if (why_not == 0 && (ftruncate(file_, 0) != 0 || pwrite(file_, line.data(), line.size(), 0) < 0) &&
      errno != ENOSPC)
    why_not = errno;
  if (why_not != 0) {
    close(file_);
    throw std::runtime_error(path + ": cannot be written: " + std::strerror(why_not));
  }
}

StateLock::~StateLock() {
  static_cast<void>(ftruncate(file_, 0) == 0);
  close(file_);
}

std::optional<std::string> state_holder(const std::string& directory) {
  const int file = open((directory + "/" + lock_file).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  std::optional<std::string> other;
  if (flock(file, LOCK_SH | LOCK_NB) != 0) other = holder_text(read_all(file), "another process");
  close(file);
  return other;
}

DomainLock::DomainLock(std::uint32_t domain, const std::string& host, const Identity& holder)
    : socket_(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)),
      line_(write_identity(holder, domain)) {
  const auto [address, size] = address_of(domain, host);
  if (socket_ < 0) throw std::runtime_error(std::string("no socket: ") + std::strerror(errno));
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0 && listen(socket_, 16) == 0)
    return;
  close(socket_);
  throw Locked("domain " + std::to_string(domain) + " is in use by " +
               domain_holder(domain, host).value_or("another process"));
}

DomainLock::~DomainLock() { close(socket_); }

void DomainLock::answer() {
  for (int connection;
       (connection = accept4(socket_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)) >= 0;) {
    static_cast<void>(send(connection, line_.data(), line_.size(), MSG_NOSIGNAL) > 0);
    close(connection);
  }
}

std::optional<std::string> domain_holder(std::uint32_t domain, const std::string& host) {
  for (int i = 0; i < 20; ++i) {
    const int connection = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const auto [address, size] = address_of(domain, host);
    const bool held = connect(connection, reinterpret_cast<const sockaddr*>(&address), size) == 0;
    const auto holder = held ? who_is_behind(connection) : "";
    close(connection);
    if (!held) return std::nullopt;
    if (!holder.empty()) return holder;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return "a process that ends";
}

// Not closed on exec, so the recorder has it.
void hold_recording(std::uint32_t domain) {
  const int file = open(RunDirectory{domain}.recording_file().c_str(), O_RDWR | O_CREAT, 0600);
  if (file >= 0) flock(file, LOCK_SH);
}

bool is_recorded(std::uint32_t domain) {
  const int file = open(RunDirectory{domain}.recording_file().c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool held = flock(file, LOCK_EX | LOCK_NB) != 0;
  close(file);
  return held;
}

std::vector<int> leftover_services(const std::string& state_directory, std::uint32_t domain) {
  std::vector<int> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const auto name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    struct stat status {};
    if (stat(entry.path().c_str(), &status) != 0 || status.st_uid != geteuid()) continue;
    std::ifstream in(entry.path() / "cmdline", std::ios::binary);
    std::vector<std::string> arguments;
    for (std::string argument; std::getline(in, argument, '\0');) arguments.push_back(argument);
    const auto value = [&](const char* option) {
      const auto at = std::find(arguments.begin(), arguments.end(), option);
      return at == arguments.end() || at + 1 == arguments.end() ? std::string() : *(at + 1);
    };
    // What the launcher gives to every service, and nobody else to anything.
    if (value("--instance").empty() ||
        std::find(arguments.begin(), arguments.end(), "--parent-bound") == arguments.end())
      continue;
    if (is_launcher(parent_of(entry.path()))) continue;
    if (value("--state") == state_directory || value("--domain") == std::to_string(domain))
      found.push_back(std::stoi(name));
  }
  return found;
}

void end_processes(const std::vector<int>& pids, double timeout) {
  using clock = std::chrono::steady_clock;
  const auto until = clock::now() + std::chrono::duration<double>(timeout);
  for (const int pid : pids) kill(pid, SIGTERM);
  bool killed = false;
  while (std::any_of(pids.begin(), pids.end(), alive)) {
    if (!killed && clock::now() > until) {
      for (const int pid : pids) kill(pid, SIGKILL);
      killed = true;
    }
    if (clock::now() > until + std::chrono::seconds(2)) break;  // not yet waited for by its parent
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace trunnion::cluster
