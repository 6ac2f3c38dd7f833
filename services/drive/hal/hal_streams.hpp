// SPDX-License-Identifier: Apache-2.0
// The FIFOs of LinuxCNC's HAL: setpoint rows into the streamer, samples out of the samplers. The only code
// that calls liblinuxcnchal.
#pragma once

#include <hal.h>

#include <array>
#include <cstdint>
#include <string>

#include "columns.hpp"

namespace trunnion::drive {

using HalRow = std::array<hal_stream_data, most_hal_columns>;

/// One period of both samplers.
struct HalSample {
  unsigned period = 0;  ///< counts the servo periods
  HalRow encoders, switches;
};

class HalStreams {
 public:
  /// Becomes a component of the HAL that runs and attaches to its FIFOs. Throws std::runtime_error.
  HalStreams();
  ~HalStreams();
  HalStreams(const HalStreams&) = delete;
  HalStreams& operator=(const HalStreams&) = delete;

  /// A letter for each column: f b s u.
  const std::string& setpoint_types() const { return setpoints_.types; }
  const std::string& encoder_types() const { return encoders_.types; }
  const std::string& switch_types() const { return switches_.types; }

  // Cyclic: neither lock nor wait.
  /// Rows that the servo thread has not taken yet.
  std::uint32_t queued() { return static_cast<std::uint32_t>(hal_stream_depth(&setpoints_.stream)); }
  /// False when the FIFO is full.
  bool write(HalRow& row) { return hal_stream_write(&setpoints_.stream, row.data()) >= 0; }
  /// The oldest period that was not read yet, of both samplers. False when there is none.
  bool read(HalSample& sample);
  bool readable() { return hal_stream_readable(&encoders_.stream) && hal_stream_readable(&switches_.stream); }

 private:
  struct Stream {
    hal_stream_t stream{};
    std::string types;
    bool attached = false;
  };
  void attach(Stream& stream, int key, const std::string& name);
  void detach();

  int component_ = 0;
  Stream setpoints_, encoders_, switches_;
};

}  // namespace trunnion::drive
