// SPDX-License-Identifier: Apache-2.0
#include "verification/stored_recording.hpp"

#include <stdexcept>

#include "recording/file_stream.hpp"

namespace trunnion::verification {

Known known_topic(const recording::Channel& channel,
                  const std::map<std::uint16_t, recording::Schema>& schemas, const bus::TopicEntry*& entry) {
  entry = bus::find_topic(channel.topic);
  if (entry == nullptr) return Known::unknown_topic;
  const auto schema = schemas.find(channel.schema);
  if (channel.encoding == "cdr" && schema != schemas.end() && schema->second.data == entry->schema)
    return Known::same;
  entry = nullptr;
  return Known::other_type;
}

StoredRecording load_recording(recording::Source& source, const std::set<std::string>& topics) {
  StoredRecording out;
  recording::Reader reader(source);
  recording::MessageView view;
  std::map<std::uint16_t, const bus::TopicEntry*> entries;
  while (reader.next(view)) {
    auto found = entries.find(view.channel->id);
    if (found == entries.end()) {
      const bus::TopicEntry* entry = nullptr;
      if (known_topic(*view.channel, reader.schemas(), entry) != Known::same)
        out.foreign.insert(view.channel->topic);
      else if (!topics.empty() && !topics.contains(entry->handle) && !topics.contains(view.channel->topic))
        entry = nullptr;
      found = entries.emplace(view.channel->id, entry).first;
    }
    if (found->second == nullptr) continue;
    out.messages.push_back(
        {found->second, view.log_time, view.sequence, {view.data.begin(), view.data.end()}});
  }
  for (const auto& metadata : reader.metadata())
    if (metadata.name == "trunnion") out.metadata.insert(metadata.values.begin(), metadata.values.end());
  out.complete = reader.ending() == recording::Ending::complete;
  out.problem = reader.problem();
  out.damages = reader.damages();
  return out;
}

StoredRecording load_recording(const std::string& path, const std::set<std::string>& topics) {
  recording::FileSource source(path);
  auto out = load_recording(source, topics);
  if (out.messages.empty() && !out.complete && out.metadata.empty())
    throw std::runtime_error(path + ": " + out.problem);
  return out;
}

}  // namespace trunnion::verification
