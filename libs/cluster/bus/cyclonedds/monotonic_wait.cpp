// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS 0.10 waits with deadlines of the wall clock: when that is put back by an hour, its thread for
// heartbeats, retransmissions and discovery stands still for an hour (eclipse-cyclonedds/cyclonedds #1995,
// mended by #2255 after 0.10). The dynamic linker prefers this definition to the library's: the time that is
// left is measured by the monotonic clock.
#include <dds/ddsrt/sync.h>
#include <dds/ddsrt/time.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

extern "C" bool ddsrt_cond_waituntil(ddsrt_cond_t* condition, ddsrt_mutex_t* mutex, dds_time_t deadline) {
  if (deadline == DDS_NEVER) {
    ddsrt_cond_wait(condition, mutex);
    return true;
  }
  constexpr dds_time_t nanoseconds = 1'000'000'000;
  timespec until{};
  const auto left = std::max<dds_time_t>(0, deadline - dds_time());
  clock_gettime(CLOCK_MONOTONIC, &until);
  const auto end = until.tv_nsec + left;
  until.tv_sec += end / nanoseconds, until.tv_nsec = end % nanoseconds;
  return pthread_cond_clockwait(&condition->cond, &mutex->mutex, CLOCK_MONOTONIC, &until) != ETIMEDOUT;
}
