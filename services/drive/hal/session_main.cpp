// SPDX-License-Identifier: Apache-2.0
// trunnion-hal-session DIRECTORY FILE.hal PID: loads a .hal file, starts HAL's threads, and ends HAL when it
// is told to (SIGTERM) or when process PID has ended. It uses LinuxCNC's program halcmd and is linked with
// nothing of LinuxCNC.
#include <fcntl.h>
#include <poll.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/shm.h>
#include <sys/stat.h>
#include <sys/syscall.h>
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
#include <string>
#include <thread>
#include <vector>

namespace {
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

// Where rtapi_app listens and whom it runs as: it refuses to be root, so an ordinary user takes the place.
void prepare_environment(const std::string& directory) {
  const auto fifo = directory + "/rtapi";
  fs::create_directories(fifo);
  setenv("RTAPI_FIFO_PATH", (fifo + "/socket").c_str(), 0);
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

// What no process uses any longer: left by processes that were killed, or that ended at the same time.
void remove_unused_memory() {
  for (const int key : keys) {
    const int memory = shmget(key, 0, 0);
    shmid_ds status{};
    if (memory >= 0 && shmctl(memory, IPC_STAT, &status) == 0 && status.shm_nattch == 0)
      shmctl(memory, IPC_RMID, nullptr);
  }
}

bool hal_is_there() {
  remove_unused_memory();
  return shmget(hal_key, 0, 0) >= 0 || errno == EACCES;
}

void unload() {
  // A process that was killed may have held HAL's lock.
  run({"halcmd", "-R"});
  run({"halcmd", "stop"});
  run({"halcmd", "unloadrt", "all"});
}

// What the .hal file has started (loadusr) and rtapi_app, which becomes our child when its parent ends.
void end_children() {
  kill(0, SIGTERM);
  for (int i = 0; i < 50; ++i) {
    int child = 0;
    while ((child = waitpid(-1, nullptr, WNOHANG)) > 0) {
    }
    if (child < 0) return;
    std::this_thread::sleep_for(10ms);
  }
  std::ifstream children("/proc/self/task/" + std::to_string(getpid()) + "/children");
  for (int child = 0; children >> child;) kill(child, SIGKILL);
  while (waitpid(-1, nullptr, 0) > 0) {
  }
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

// Until the watched process has ended or a signal asks for the end.
void wait_for_end(int watched) {
  const int process = watched > 0 ? static_cast<int>(syscall(SYS_pidfd_open, watched, 0)) : -1;
  if (watched > 0 && process < 0) return;
  pollfd descriptor{process, POLLIN, 0};
  while (end_requested == 0) {
    if (poll(&descriptor, process >= 0 ? 1 : 0, 200) > 0) return;
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: trunnion-hal-session DIRECTORY FILE.hal PID\n");
    return 2;
  }
  const std::string directory = argv[1];
  const fs::path file = argv[2];
  struct sigaction action {};
  action.sa_handler = request_end;
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGINT, SIG_IGN);
  setpgid(0, 0);  // at the end its group is ended
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  std::ofstream(directory + "/pid") << getpid() << "\n";
  prepare_environment(directory);
  if (hal_is_there() && fs::exists(directory + "/rtapi/socket"))
    unload();  // of a session of ours that was killed
  if (hal_is_there()) {
    std::fprintf(stderr,
                 "LinuxCNC's HAL runs already on this computer: end it, for example with 'halrun -U'\n");
    return 1;
  }
  fs::current_path(file.parent_path());
  const bool ready = run({"halcmd", "-f", file.string()}) == 0 && run({"halcmd", "start"}) == 0;
  const auto why = ready ? "" : first_complaint(directory + "/log", file.filename().string());
  if (ready) {
    const auto name = directory + "/ready";
    std::ofstream(name + ".new") << random_identity() << "\n";
    fs::rename(name + ".new", name);
    wait_for_end(std::atoi(argv[3]));
    fs::remove(directory + "/ready");
    std::this_thread::sleep_for(brake_time);
  }
  unload();
  end_children();
  remove_unused_memory();
  if (!ready) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return 1;
  }
  fs::remove_all(directory);
  return 0;
}
