// SPDX-License-Identifier: Apache-2.0
// Reads the frames of a topic that are whole. Others are refused, counted, and told by alarm 106.
#pragma once

#include <utility>

#include "bus/bus.hpp"
#include "stream/whole_frame.hpp"

namespace trunnion::stream {

template <class Frame>
class FrameReader {
 public:
  FrameReader(bus::Bus& bus, const bus::Topic<Frame>& topic) : FrameReader(bus, topic, bus.reader(topic)) {}
  /// With a reader of its own, for other quality of service.
  FrameReader(bus::Bus& bus, const bus::Topic<Frame>& topic, bus::Reader<Frame> reader)
      : bus_(&bus), topic_(topic.name), reader_(std::move(reader)) {}

  /// The next frame that is whole, or false.
  bool take(Frame& frame) {
    while (reader_.take(frame)) {
      const auto fault = fault_of(frame);
      if (fault.empty()) return true;
      refuse(fault);
    }
    return false;
  }
  /// For what makes the frame taken last impossible on this machine.
  void refuse(const std::string& why) { bus_->refuse(topic_, why, reader_.info().writer); }
  const bus::SampleInfo& info() const { return reader_.info(); }

 private:
  bus::Bus* bus_;
  std::string topic_;
  bus::Reader<Frame> reader_;
};

/// Without history: the newest that is written from now on.
template <class Frame>
FrameReader<Frame> present_reader(bus::Bus& bus, const bus::Topic<Frame>& topic) {
  return {bus, topic,
          bus::Reader<Frame>(bus.backend().reader(bus::describe(topic), {false, 0}, &bus.signal()))};
}

}  // namespace trunnion::stream
