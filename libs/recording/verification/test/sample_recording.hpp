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
constexpr std::uint32_t frame_cycles = 8;  // cycles in a frame

template <class T>
StoredMessage stored(const bus::Topic<T>& topic, const T& value, std::uint64_t time) {
  StoredMessage message{bus::find_topic(topic.name), time, 0, {}};
  bus::encode(value, message.cdr);
  return message;
}

inline idl::stream::PathFrame path_frame(std::uint64_t first, bool starts, bool ends,
                                         std::uint32_t epoch = 1) {
  idl::stream::PathFrame frame;
  frame.epoch = epoch;
  frame.first = first;
  frame.count = frame_cycles;
  frame.revision = 1;
  frame.starts = starts;
  frame.ends = ends;
  for (std::uint64_t c = first; c < first + frame_cycles; ++c)
    for (int axis = 0; axis < 9; ++axis) frame.setpoints.push_back(static_cast<double>(c) + axis * 0.1);
  frame.lines.assign(frame_cycles, 7);
  return frame;
}

inline idl::stream::AxisFrame axis_frame(std::uint64_t first, bool starts, bool ends,
                                         std::uint32_t epoch = 1) {
  idl::stream::AxisFrame frame;
  frame.stage = idl::stream::Stage::KINEMATICS;
  frame.epoch = epoch;
  frame.first = first;
  frame.count = frame_cycles;
  frame.revision = 1;
  frame.starts = starts;
  frame.ends = ends;
  frame.axes = {0, 1};
  for (std::uint64_t c = first; c < first + frame_cycles; ++c)
    for (int axis = 0; axis < 2; ++axis) frame.setpoints.push_back(static_cast<double>(c) + axis * 0.1);
  frame.lines.assign(frame_cycles, 7);
  frame.states = {{idl::stream::Stage::KINEMATICS, first + frame_cycles - 1, {static_cast<double>(first)}}};
  return frame;
}

inline idl::stream::FeedbackFrame feedback_frame(std::uint64_t first, std::uint32_t count) {
  idl::stream::FeedbackFrame frame;
  frame.first = first;
  frame.count = count;
  frame.tick = first + count;
  frame.axis_count = 2;
  frame.commanded.assign(std::size_t{count} * 2, 1.0);
  frame.actual.assign(std::size_t{count} * 2, 0.5);
  return frame;
}

/// Appends one motion of `frames` frames from `first` on: every frame once the drive has executed what its
/// credit needs, its output one time unit later.
inline void add_motion(StoredRecording& recording, std::uint64_t first, int frames, std::uint32_t epoch = 1) {
  std::uint64_t time = recording.messages.empty() ? 1000 : recording.messages.back().time + 10;
  std::uint64_t executed = first;
  for (int i = 0; i < frames; ++i) {
    const std::uint64_t at = first + static_cast<std::uint64_t>(i) * frame_cycles;
    while (executed + lead < at + frame_cycles) {
      recording.messages.push_back(
          stored(topics::feedback_frame, feedback_frame(executed, frame_cycles), time += 10));
      executed += frame_cycles;
    }
    const bool starts = i == 0, ends = i + 1 == frames;
    recording.messages.push_back(stored(topics::path_frame, path_frame(at, starts, ends, epoch), time += 10));
    recording.messages.push_back(
        stored(topics::kinematics_frame, axis_frame(at, starts, ends, epoch), time += 1));
  }
  for (const std::uint64_t end = first + static_cast<std::uint64_t>(frames) * frame_cycles; executed < end;
       executed += frame_cycles)
    recording.messages.push_back(
        stored(topics::feedback_frame, feedback_frame(executed, frame_cycles), time += 10));
}

inline StoredMessage parameters(std::uint64_t revision, std::uint64_t time) {
  idl::parameters::ParameterSet set;
  set.revision = revision;
  return stored(topics::parameter_set, set, time);
}

inline StoredRecording sample_recording(int frames = 100) {
  StoredRecording recording;
  recording.complete = true;
  recording.metadata = {{"machine", "bench"}, {"contract", topics::contract_hash}};
  recording.messages.push_back(parameters(1, 1));
  add_motion(recording, 0, frames);
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
