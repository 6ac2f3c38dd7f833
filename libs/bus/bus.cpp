#include "bus/bus.hpp"

#include <sys/resource.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace trunnion::bus {

void Signal::notify() {
  {
    const std::lock_guard lock(mutex_);
    set_ = true;
  }
  condition_.notify_one();
}

bool Signal::wait(double seconds) {
  std::unique_lock lock(mutex_);
  const bool notified =
      condition_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return set_; });
  set_ = false;
  return notified;
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

std::int64_t source_time() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
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
      depth_(depth) {}

std::unique_ptr<SharedHistory> Bus::share(QosKind kind, EndpointQos& qos) const {
  if (kind != QosKind::frame || secured_) return nullptr;
  auto history = SharedHistory::make();
  if (history != nullptr) qos.user_data = history->address();
  return history;
}

}  // namespace trunnion::bus
