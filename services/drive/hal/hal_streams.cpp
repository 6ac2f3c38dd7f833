// SPDX-License-Identifier: Apache-2.0
#include "hal_streams.hpp"

#include <time.h>
#include <unistd.h>

#include <stdexcept>

namespace trunnion::drive {
namespace {
// Of LinuxCNC's streamer.h and sampler.h, which are not installed: the shared memory of FIFO n has the key
// plus n.
constexpr int streamer_key = 0x48535430;
constexpr int sampler_key = 0x48534130;

char letter(hal_type_t type) {
  switch (type) {
    case HAL_FLOAT:
      return 'f';
    case HAL_BIT:
      return 'b';
    case HAL_S32:
      return 's';
    case HAL_U32:
      return 'u';
    default:
      return '?';
  }
}

// HAL keeps the name of a component whose process was killed, so each one has its own.
std::string component_name() {
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return "trunnion-drive-" + std::to_string(getpid()) + "-" + std::to_string(now.tv_sec);
}
}  // namespace

HalStreams::HalStreams() {
  component_ = hal_init(component_name().c_str());
  if (component_ < 0)
    throw std::runtime_error("HAL takes no component (error " + std::to_string(-component_) +
                             "): does it run?");
  try {
    attach(setpoints_, streamer_key, "streamer 0");
    attach(encoders_, sampler_key, "sampler 0");
    attach(switches_, sampler_key + 1, "sampler 1");
  } catch (...) {
    detach();
    throw;
  }
  hal_ready(component_);
}

HalStreams::~HalStreams() { detach(); }

void HalStreams::attach(Stream& stream, int key, const std::string& name) {
  if (hal_stream_attach(&stream.stream, component_, key, nullptr) < 0)
    throw std::runtime_error("The .hal file loads no " + name + ": docs/hal.md says what it needs");
  stream.attached = true;
  for (int i = 0; i < hal_stream_element_count(&stream.stream); ++i)
    stream.types += letter(hal_stream_element_type(&stream.stream, i));
}

void HalStreams::detach() {
  for (auto* stream : {&setpoints_, &encoders_, &switches_})
    if (stream->attached) hal_stream_detach(&stream->stream);
  hal_exit(component_);
}

bool HalStreams::read(HalSample& sample) {
  unsigned of_switches = 0;
  if (!readable()) return false;
  if (hal_stream_read(&encoders_.stream, sample.encoders.data(), &sample.period) < 0) return false;
  if (hal_stream_read(&switches_.stream, sample.switches.data(), &of_switches) < 0) return false;
  // After an overrun one FIFO may begin later than the other.
  while (sample.period != of_switches) {
    const bool behind = static_cast<std::int32_t>(sample.period - of_switches) < 0;
    auto& stream = behind ? encoders_.stream : switches_.stream;
    auto* data = behind ? sample.encoders.data() : sample.switches.data();
    if (hal_stream_read(&stream, data, behind ? &sample.period : &of_switches) < 0) return false;
  }
  return true;
}

}  // namespace trunnion::drive
