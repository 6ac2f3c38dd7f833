// SPDX-License-Identifier: Apache-2.0
// trunnion-hal-session DIRECTORY FILE.hal PID: loads a .hal file, starts HAL's threads, and ends HAL when it
// is told to (SIGTERM), when process PID has ended or when rtapi_app has. trunnion-hal-session --end
// DIRECTORY ends what a session that was killed has left. It uses LinuxCNC's program halcmd and is linked
// with nothing of LinuxCNC.
#include <fcntl.h>
#include <poll.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "processes.hpp"

namespace {
using namespace trunnion::drive;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

// Shared memory of HAL, of its library, of the streamer and of both samplers. HAL's is one on a computer, and
// in a namespace of its own one there.
constexpr int hal_key = 0x48414c32;
constexpr int keys[] = {hal_key, 0x48484c34, 0x48535430, 0x48534130, 0x48534131};
constexpr auto brake_time = 400ms;  // from the last setpoint row on, for the axes to come to rest under HAL

volatile std::sig_atomic_t end_requested = 0;
void request_end(int) { end_requested = 1; }

// Status of the program, 127 when it cannot be started.
int run(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int child = fork();
  if (child == 0) {
    signal(SIGTERM, SIG_DFL);
    execvp(argv[0], argv.data());
    std::perror(argv[0]);
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::string socket_in(const std::string& directory) { return directory + "/rtapi/socket"; }

// Where rtapi_app listens and whom it runs as: it refuses to be root, so an ordinary user takes the place.
void prepare_environment(const std::string& directory) {
  const auto fifo = directory + "/rtapi";
  fs::create_directories(fifo);
  setenv("RTAPI_FIFO_PATH", socket_in(directory).c_str(), 0);
  setenv("HAL_RTMOD_DIR", "/usr/lib/linuxcnc/modules", 0);
  // A .hal file finds trunnion-hal-io beside this program.
  const auto own = fs::read_symlink("/proc/self/exe").parent_path().string();
  const char* path = std::getenv("PATH");
  setenv("PATH", (path == nullptr ? own : own + ":" + path).c_str(), 1);
  if (getuid() != 0) return;
  const passwd* nobody = getpwnam("nobody");
  if (nobody == nullptr || std::getenv("RTAPI_UID") != nullptr) return;
  setenv("RTAPI_UID", std::to_string(nobody->pw_uid).c_str(), 0);
  if (chown(fifo.c_str(), nobody->pw_uid, nobody->pw_gid) != 0) std::perror(fifo.c_str());
}

// What no process uses any longer: left by processes that were killed, or that ended at the same time. `all`:
// also what the drive is attached to yet, which is gone when it detaches.
void remove_memory(bool all) {
  for (const int key : keys) {
    const int memory = shmget(key, 0, 0);
    shmid_ds status{};
    if (memory >= 0 && shmctl(memory, IPC_STAT, &status) == 0 && (all || status.shm_nattch == 0))
      shmctl(memory, IPC_RMID, nullptr);
  }
}

bool hal_is_there() {
  remove_memory(false);
  return shmget(hal_key, 0, 0) >= 0 || errno == EACCES;
}

// Whom HAL's memory belongs to; the kernel tells it to everybody. -1 when there is none.
int user_of_hal() {
  std::ifstream table("/proc/sysvipc/shm");
  std::string line;
  while (std::getline(table, line)) {
    std::istringstream columns(line);
    long key = 0, other = 0;
    int user = -1;
    columns >> key;
    for (int i = 0; i < 6; ++i) columns >> other;
    if (columns >> user && key == hal_key) return user;
  }
  return -1;
}

// A process of another namespace has another HAL.
bool shares_our_hal(const fs::path& process) {
  std::error_code own_unknown, other_unknown;
  const auto own = fs::read_symlink("/proc/self/ns/ipc", own_unknown);
  const auto other = fs::read_symlink(process / "ns/ipc", other_unknown);
  return own_unknown || other_unknown || own == other;
}

// "process 4711 (rtapi_app) of user otto"
std::string who_has_hal() {
  const int user = user_of_hal();
  const passwd* entry = getpwuid(static_cast<uid_t>(user));
  const auto of_user = " of user " + (entry != nullptr ? std::string(entry->pw_name) : std::to_string(user));
  std::error_code none;
  for (const auto& process : fs::directory_iterator("/proc", none)) {
    const auto number = process.path().filename().string();
    if (number.find_first_not_of("0123456789") != std::string::npos) continue;
    if (process_name(std::atoi(number.c_str())) == real_time_process && shares_our_hal(process.path()))
      return std::string("process ").append(number).append(" (").append(real_time_process).append(")") +
             of_user;
  }
  return "a process" + of_user;
}

void unload() {
  // A process that was killed may have held HAL's lock.
  run({"halcmd", "-R"});
  run({"halcmd", "stop"});
  run({"timeout", "1", "halcmd", "unloadrt", "all"});  // rtapi_app may not answer
}

// What the .hal file has started (loadusr) and rtapi_app, which become ours when their parents end.
std::vector<int> children() {
  std::ifstream file("/proc/self/task/" + std::to_string(getpid()) + "/children");
  std::vector<int> all;
  for (int child = 0; file >> child;) all.push_back(child);
  return all;
}

int real_time_child() {
  for (const int child : children())
    if (process_name(child) == real_time_process) return child;
  return 0;
}

void end_children() {
  kill(0, SIGTERM);
  for (int i = 0; i < 50; ++i) {
    int child = 0;
    while ((child = waitpid(-1, nullptr, WNOHANG)) > 0) {
    }
    if (child < 0) return;
    std::this_thread::sleep_for(10ms);
  }
  for (const int child : children()) kill(child, SIGKILL);
  while (waitpid(-1, nullptr, 0) > 0) {
  }
}

// The real-time process of a session in `directory` listens. HAL of anybody else is not ours to end.
bool own_hal_runs(const std::string& directory) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const auto path = socket_in(directory);
  if (path.size() >= sizeof address.sun_path) return false;
  path.copy(address.sun_path, path.size());
  const int one = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool listens = one >= 0 && connect(one, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  if (one >= 0) close(one);
  return listens;
}

// Of a session that was killed: HAL, and what its .hal file has started, which is still of its group.
void end_what_is_left(const std::string& directory, int session) {
  const bool own = own_hal_runs(directory) && hal_is_there();
  if (own) {
    std::this_thread::sleep_for(brake_time);
    unload();
  }
  // The number may belong to another process by now; then no group is left of the session.
  const bool group = session > 1 && process_name(session).empty() && kill(-session, SIGTERM) == 0;
  for (int i = 0; i < 50 && (own || group) && hal_is_there(); ++i) std::this_thread::sleep_for(10ms);
  if (group) kill(-session, SIGKILL);
}

// What halcmd has said of the file: "file:line: reason".
std::string first_complaint(const std::string& log, const std::string& file) {
  std::ifstream in(log);
  std::string line;
  while (std::getline(in, line))
    if (line.find(file + ":") != std::string::npos) return line;
  return file + ": halcmd cannot load it";
}

std::string random_identity() {
  std::random_device random;
  return std::to_string(random()) + "-" + std::to_string(random());
}

// Until the watched process has ended or a signal asks for the end. False when rtapi_app has ended, and with
// it HAL.
bool wait_for_end(int watched, int real_time) {
  pollfd polled[] = {{process_descriptor(real_time), POLLIN, 0},
                     {watched > 0 ? process_descriptor(watched) : -1, POLLIN, 0}};
  if (polled[0].fd < 0) return false;
  if (watched > 0 && polled[1].fd < 0) return true;
  while (end_requested == 0) {
    if (poll(polled, 2, 200) > 0) return polled[0].revents == 0;
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
  }
  return true;
}

int run_session(const std::string& directory, const fs::path& file, int watched) {
  if (hal_is_there()) {
    std::fprintf(
        stderr,
        "LinuxCNC's HAL is in use by %s, and a computer has one: end that machine by its own program\n",
        who_has_hal().c_str());
    return 1;
  }
  fs::current_path(file.parent_path());
  const bool ready = run({"halcmd", "-f", file.string()}) == 0 && run({"halcmd", "start"}) == 0;
  const auto why = ready ? "" : first_complaint(directory + "/log", file.filename().string());
  bool hal_runs = true;
  if (ready) {
    const int real_time = real_time_child();
    const auto name = directory + "/ready";
    std::ofstream(name + ".new") << random_identity() << "\n" << real_time << "\n";
    fs::rename(name + ".new", name);
    hal_runs = wait_for_end(watched, real_time);
    fs::remove(name);
  }
  if (ready && hal_runs) std::this_thread::sleep_for(brake_time);
  if (hal_runs) unload();
  end_children();
  remove_memory(!hal_runs);
  if (!ready) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return 1;
  }
  fs::remove_all(directory);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool only_end = argc == 3 && std::string(argv[1]) == "--end";
  if (argc != 4 && !only_end) {
    std::fprintf(stderr,
                 "usage: trunnion-hal-session DIRECTORY FILE.hal PID\n"
                 "       trunnion-hal-session --end DIRECTORY\n");
    return 2;
  }
  const std::string directory = argv[only_end ? 2 : 1];
  struct sigaction action {};
  action.sa_handler = request_end;
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGINT, SIG_IGN);
  setpgid(0, 0);  // at the end its group is ended
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  int before = 0;
  std::ifstream(directory + "/pid") >> before;
  std::ofstream(directory + "/pid") << getpid() << "\n";
  prepare_environment(directory);
  end_what_is_left(directory, before);
  if (!only_end) return run_session(directory, argv[2], std::atoi(argv[3]));
  end_children();
  fs::remove_all(directory);
  return 0;
}
