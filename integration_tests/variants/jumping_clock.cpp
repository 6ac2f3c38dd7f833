// SPDX-License-Identifier: Apache-2.0
// Preloaded into every process of a cluster: the wall clock jumps an hour ahead and back every 0.7 s, for
// each process at another instant, as after a dead battery and a late time server. Monotonic clocks are true.
#include <dlfcn.h>
#include <sys/time.h>
#include <unistd.h>

#include <ctime>

namespace {
time_t jump() {
  timespec now{};
  static const auto real = reinterpret_cast<int (*)(clockid_t, timespec*)>(dlsym(RTLD_NEXT, "clock_gettime"));
  real(CLOCK_MONOTONIC, &now);
  const auto tenths = now.tv_sec * 10 + now.tv_nsec / 100'000'000 + getpid();
  return tenths / 7 % 2 == 0 ? 0 : 3600;
}
}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) {
  static const auto real = reinterpret_cast<int (*)(clockid_t, timespec*)>(dlsym(RTLD_NEXT, "clock_gettime"));
  const int result = real(clock, time);
  if (clock == CLOCK_REALTIME) time->tv_sec += jump();
  return result;
}

extern "C" int gettimeofday(timeval* time, void*) {
  timespec now{};
  const int result = clock_gettime(CLOCK_REALTIME, &now);
  time->tv_sec = now.tv_sec, time->tv_usec = now.tv_nsec / 1000;
  return result;
}

extern "C" time_t time(time_t* out) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != nullptr) *out = now.tv_sec;
  return now.tv_sec;
}
