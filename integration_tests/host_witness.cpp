// SPDX-License-Identifier: Apache-2.0
// host-witness CYCLIC ORDINARY COMMAND...: runs a test in real time and notes meanwhile for how long the host
// kept threads from running that were due every millisecond: on every processor one with the priority of the
// cyclic services (libs/cluster/service/node.cpp), limit CYCLIC ms, and one without, as the gateway, commands
// and the test itself, limit ORDINARY ms. A run in which the host exceeded a limit is no measurement: it is
// said, and the test runs again, whatever it showed. The result of a run within the limits is the result;
// without one in three runs the status is 77, a skipped test. Only a signal that ends the test is a failure in
// any run.
#include <pthread.h>
#include <sched.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

namespace {

constexpr int runs = 3, skipped = 77;
constexpr int priority_of_cyclic_services = 20;
constexpr std::int64_t period = 1'000'000;  // ns

std::int64_t monotonic() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

class Witness {
 public:
  Witness() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    sched_getaffinity(0, sizeof allowed, &allowed);
    for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
      if (!CPU_ISSET(processor, &allowed)) continue;
      threads_.emplace_back([this, processor] { watch(processor, SCHED_FIFO, cyclic_); });
      threads_.emplace_back([this, processor] { watch(processor, SCHED_OTHER, ordinary_); });
    }
  }
  ~Witness() {
    stop_ = true;
    for (auto& thread : threads_) thread.join();
  }
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;

  // The longest delays, ms.
  double cyclic() const { return 1e-6 * static_cast<double>(cyclic_); }
  double ordinary() const { return 1e-6 * static_cast<double>(ordinary_); }

 private:
  void watch(int processor, int policy, std::atomic<std::int64_t>& longest) const {
    cpu_set_t here;
    CPU_ZERO(&here);
    CPU_SET(processor, &here);
    pthread_setaffinity_np(pthread_self(), sizeof here, &here);
    sched_param priority{};
    priority.sched_priority = policy == SCHED_FIFO ? priority_of_cyclic_services : 0;
    pthread_setschedparam(pthread_self(), policy,
                          &priority);  // refused here, it is refused to the services, too
    for (auto now = monotonic(); !stop_;) {
      const auto due = now + period;
      const timespec until{static_cast<time_t>(due / 1'000'000'000), static_cast<long>(due % 1'000'000'000)};
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
      now = monotonic();
      auto most = longest.load();
      while (now - due > most && !longest.compare_exchange_weak(most, now - due)) {
      }
    }
  }

  std::atomic<bool> stop_ = false;
  std::atomic<std::int64_t> cyclic_ = 0, ordinary_ = 0;
  std::vector<std::thread> threads_;
};

pid_t child = 0;

// What ends this process ends the test, which ends its cluster.
void pass_on(int signal) {
  if (child > 0) kill(child, signal);
}

// The status that waitpid() gives.
int run(char** command) {
  child = fork();
  if (child == 0) {
    execvp(command[0], command);
    std::perror(command[0]);
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
  }
  child = 0;
  return status;
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) {
    std::fprintf(stderr, "usage: %s CYCLIC_MS ORDINARY_MS COMMAND...\n", words[0]);
    return 2;
  }
  // CTest asks for the names of the cases once.
  if (std::string_view(words[count - 1]).starts_with("--gtest_list_tests")) {
    execvp(words[3], words + 3);
    std::perror(words[3]);
    return 127;
  }
  const double cyclic_limit = std::atof(words[1]), ordinary_limit = std::atof(words[2]);
  std::signal(SIGTERM, pass_on);
  std::signal(SIGINT, pass_on);
  for (int i = 1; i <= runs; ++i) {
    double cyclic = 0, ordinary = 0;
    int status = 0;
    {
      const Witness witness;
      status = run(words + 3);
      cyclic = witness.cyclic();
      ordinary = witness.ordinary();
    }
    std::fprintf(
        stderr,
        "host-witness: threads waited up to %.1f ms with priority (limit %.1f), %.1f ms without (limit "
        "%.1f)\n",
        cyclic, cyclic_limit, ordinary, ordinary_limit);
    if (WIFSIGNALED(status)) {
      std::fprintf(stderr, "host-witness: ended by signal %d\n", WTERMSIG(status));
      return 1;
    }
    if (cyclic <= cyclic_limit && ordinary <= ordinary_limit) return WEXITSTATUS(status);
    std::fprintf(stderr, "host-witness: run %d is no measurement: the host was busy (its status was %d)\n", i,
                 WEXITSTATUS(status));
  }
  std::fprintf(stderr, "host-witness: none of %d runs was a measurement\n", runs);
  return skipped;
}
