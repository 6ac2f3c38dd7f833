// SPDX-License-Identifier: Apache-2.0
// Reads the batches of a topic that are whole. Others are refused, counted, and told by alarm 106.
#pragma once

#include <utility>

#include "bus/bus.hpp"
#include "stream/whole_batch.hpp"

namespace trunnion::stream {

template <class Batch>
class BatchReader {
 public:
  BatchReader(bus::Bus& bus, const bus::Topic<Batch>& topic) : BatchReader(bus, topic, bus.reader(topic)) {}
  /// With a reader of its own, for other quality of service.
  BatchReader(bus::Bus& bus, const bus::Topic<Batch>& topic, bus::Reader<Batch> reader)
      : bus_(&bus), topic_(topic.name), reader_(std::move(reader)) {}

  /// The next batch that is whole, or false.
  bool take(Batch& batch) {
    while (reader_.take(batch)) {
      const auto fault = fault_of(batch);
      if (fault.empty()) return true;
      refuse(fault);
    }
    return false;
  }
  /// For what makes the batch taken last impossible on this machine.
  void refuse(const std::string& why) { bus_->refuse(topic_, why, reader_.info().writer); }
  const bus::SampleInfo& info() const { return reader_.info(); }

 private:
  bus::Bus* bus_;
  std::string topic_;
  bus::Reader<Batch> reader_;
};

/// Without history: the newest that is written from now on.
template <class Batch>
BatchReader<Batch> present_reader(bus::Bus& bus, const bus::Topic<Batch>& topic) {
  return {bus, topic,
          bus::Reader<Batch>(bus.backend().reader(bus::describe(topic), {false, 0}, &bus.signal()))};
}

}  // namespace trunnion::stream
