// SPDX-License-Identifier: Apache-2.0
// A recording made up for tests: one channel, kinematics and the drive, with the credits of a real stream.
#pragma once

#include <cstdint>

#include "bus/codec.hpp"
#include "contracts/topics.hpp"
#include "recording/mcap_writer.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

constexpr std::uint64_t lead = 32;         // the catalogue's default
constexpr std::uint32_t batch_cycles = 8;  // cycles in a batch

template <class T>
StoredMessage stored(const bus::Topic<T>& topic, const T& value, std::uint64_t time) {
  StoredMessage message{bus::find_topic(topic.name), time, 0, {}};
  bus::encode(value, message.cdr);
  return message;
}

inline idl::stream::PathBatch path_batch(std::uint64_t first, bool starts, bool ends,
                                         std::uint32_t epoch = 1) {
  idl::stream::PathBatch batch;
  batch.epoch = epoch;
  batch.first = first;
  batch.count = batch_cycles;
  batch.revision = 1;
  batch.starts = starts;
  batch.ends = ends;
  for (std::uint64_t c = first; c < first + batch_cycles; ++c)
    for (int axis = 0; axis < 9; ++axis) batch.setpoints.push_back(static_cast<double>(c) + axis * 0.1);
  batch.lines.assign(batch_cycles, 7);
  return batch;
}

inline idl::stream::AxisBatch axis_batch(std::uint64_t first, bool starts, bool ends,
                                         std::uint32_t epoch = 1) {
  idl::stream::AxisBatch batch;
  batch.stage = idl::stream::Stage::KINEMATICS;
  batch.epoch = epoch;
  batch.first = first;
  batch.count = batch_cycles;
  batch.revision = 1;
  batch.starts = starts;
  batch.ends = ends;
  batch.axes = {0, 1};
  for (std::uint64_t c = first; c < first + batch_cycles; ++c)
    for (int axis = 0; axis < 2; ++axis) batch.setpoints.push_back(static_cast<double>(c) + axis * 0.1);
  batch.lines.assign(batch_cycles, 7);
  batch.states = {{idl::stream::Stage::KINEMATICS, first + batch_cycles - 1, {static_cast<double>(first)}}};
  return batch;
}

inline idl::stream::Feedback feedback(std::uint64_t first, std::uint32_t count) {
  idl::stream::Feedback batch;
  batch.first = first;
  batch.count = count;
  batch.tick = first + count;
  batch.axis_count = 2;
  batch.commanded.assign(std::size_t{count} * 2, 1.0);
  batch.actual.assign(std::size_t{count} * 2, 0.5);
  return batch;
}

/// Appends one motion of `batches` batches from `first` on: every batch once the drive has executed what its
/// credit needs, its output one time unit later.
inline void add_motion(StoredRecording& recording, std::uint64_t first, int batches,
                       std::uint32_t epoch = 1) {
  std::uint64_t time = recording.messages.empty() ? 1000 : recording.messages.back().time + 10;
  std::uint64_t executed = first;
  for (int i = 0; i < batches; ++i) {
    const std::uint64_t at = first + static_cast<std::uint64_t>(i) * batch_cycles;
    while (executed + lead < at + batch_cycles) {
      recording.messages.push_back(stored(topics::feedback, feedback(executed, batch_cycles), time += 10));
      executed += batch_cycles;
    }
    const bool starts = i == 0, ends = i + 1 == batches;
    recording.messages.push_back(stored(topics::path_batch, path_batch(at, starts, ends, epoch), time += 10));
    recording.messages.push_back(
        stored(topics::kinematics_batch, axis_batch(at, starts, ends, epoch), time += 1));
  }
  for (const std::uint64_t end = first + static_cast<std::uint64_t>(batches) * batch_cycles; executed < end;
       executed += batch_cycles)
    recording.messages.push_back(stored(topics::feedback, feedback(executed, batch_cycles), time += 10));
}

inline StoredMessage parameters(std::uint64_t revision, std::uint64_t time) {
  idl::parameters::ParameterSet set;
  set.revision = revision;
  return stored(topics::parameter_set, set, time);
}

inline StoredRecording sample_recording(int batches = 100) {
  StoredRecording recording;
  recording.complete = true;
  recording.metadata = {{"machine", "bench"}, {"contract", topics::contract_hash}};
  recording.messages.push_back(parameters(1, 1));
  add_motion(recording, 0, batches);
  return recording;
}

/// The bytes of a file with these messages.
inline recording::Bytes file_of(const StoredRecording& recording, std::size_t chunk_bytes = 1 << 20) {
  recording::MemorySink sink;
  recording::Writer writer(sink, {.library = "test", .chunk_bytes = chunk_bytes});
  writer.metadata("trunnion", {recording.metadata.begin(), recording.metadata.end()});
  std::map<const bus::TopicEntry*, std::pair<std::uint16_t, std::uint32_t>> channels;
  for (const auto& message : recording.messages) {
    const auto* topic = message.topic;
    if (!channels.contains(topic))
      channels[topic] = {writer.add_channel(topic->description.name, topic->type, topic->schema,
                                            {{"handle", topic->handle}}),
                         0};
    auto& [channel, sequence] = channels[topic];
    writer.write(channel, ++sequence, message.time, message.cdr);
  }
  writer.finish();
  return sink.data;
}

}  // namespace trunnion::verification
