// SPDX-License-Identifier: Apache-2.0
// A thread begins with the scheduling of the one that makes it; what waits for files or a network has none of
// its own.
#pragma once

#include <pthread.h>
#include <sched.h>

namespace trunnion::plc {

/// Gives the calling thread the scheduling of ordinary processes.
inline void use_ordinary_scheduling() {
  const sched_param parameters{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &parameters);
}

}  // namespace trunnion::plc
