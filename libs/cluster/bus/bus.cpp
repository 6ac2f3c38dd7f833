// SPDX-License-Identifier: Apache-2.0
#include "bus/bus.hpp"

#include <linux/futex.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>
#include <thread>

namespace trunnion::bus {

namespace {

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t) &&
              std::atomic<std::uint32_t>::is_always_lock_free);

long futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value, const timespec* until) {
  return syscall(SYS_futex, &word, operation | FUTEX_PRIVATE_FLAG, value, until, nullptr,
                 FUTEX_BITSET_MATCH_ANY);
}

timespec monotonic_after(double seconds) {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const double whole = std::floor(seconds);
  time.tv_sec += static_cast<std::time_t>(whole);
  time.tv_nsec += static_cast<long>((seconds - whole) * 1e9);
  if (time.tv_nsec >= 1'000'000'000) time.tv_nsec -= 1'000'000'000, ++time.tv_sec;
  return time;
}

}  // namespace

void Signal::notify() {
  if (state_.exchange(notified, std::memory_order_acq_rel) == waiting) futex(state_, FUTEX_WAKE, 1, nullptr);
}

bool Signal::wait(double seconds) {
  auto expected = std::uint32_t{idle};
  if (seconds > 0 && state_.compare_exchange_strong(expected, waiting, std::memory_order_acq_rel)) {
    const timespec until = monotonic_after(seconds);
    // The kernel compares and sleeps in one step, so no notification is missed. A signal ends a wait early.
    while (state_.load(std::memory_order_acquire) == waiting)
      if (futex(state_, FUTEX_WAIT_BITSET, waiting, &until) != 0 && errno == ETIMEDOUT) break;
  }
  return state_.exchange(idle, std::memory_order_acq_rel) == notified;
}

namespace {
// How often this thread has waited for something of its own accord.
long waits_of_this_thread() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}
}  // namespace

void Gathering::notify() {
  constexpr auto pause = std::chrono::milliseconds(2);
  thread_local long waits = -1;
  // While it has not waited there was always a next packet, and those are to be taken in without a break.
  if (waits_of_this_thread() == waits) return;
  std::this_thread::sleep_for(pause);
  waits = waits_of_this_thread();
}

namespace {
template <class Clock>
std::int64_t nanoseconds_of() {
  const auto now = Clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

std::atomic<std::int64_t>& clock_offset() {
  static std::atomic offset = wall_clock_offset();
  return offset;
}
}  // namespace

std::int64_t wall_clock_offset() {
  return nanoseconds_of<std::chrono::system_clock>() - nanoseconds_of<std::chrono::steady_clock>();
}

void use_clock_offset(std::int64_t offset) {
  if (offset != 0) clock_offset() = offset;
}

std::int64_t source_time() {
  return nanoseconds_of<std::chrono::steady_clock>() + clock_offset().load(std::memory_order_relaxed);
}

const char* to_string(Vendor vendor) { return vendor == Vendor::fastdds ? "fastdds" : "cyclonedds"; }

Vendor vendor_from(const std::string& name) {
  if (name == "fastdds") return Vendor::fastdds;
  if (name == "cyclonedds") return Vendor::cyclonedds;
  throw std::invalid_argument("unknown DDS vendor '" + name + "': fastdds or cyclonedds");
}

namespace {
std::unique_ptr<Backend> make_backend(Vendor vendor, const NetworkSettings& network) {
  return vendor == Vendor::fastdds ? make_fastdds(network) : make_cyclonedds(network);
}
}  // namespace

Bus::Bus(Vendor vendor, const NetworkSettings& network, StreamDepth depth)
    : vendor_(vendor),
      secured_(!network.security.empty()),
      backend_(make_backend(vendor, network)),
      depth_(depth) {
  use_clock_offset(network.clock_offset);
}

std::unique_ptr<SharedHistory> Bus::share(QosKind kind, EndpointQos& qos) const {
  if (kind != QosKind::batch || secured_) return nullptr;
  auto history = SharedHistory::make();
  if (history != nullptr) qos.user_data = history->address();
  return history;
}

}  // namespace trunnion::bus
