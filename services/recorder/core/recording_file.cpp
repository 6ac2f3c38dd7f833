// SPDX-License-Identifier: Apache-2.0
#include "recording_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>

namespace trunnion::recorder {

RecordingFile::RecordingFile(const std::string& path, const FileHeader& header,
                             const recording::StringMap& more)
    : path_(path), sink_(path), writer_(sink_, {.compression = header.compression}) {
  auto metadata = header.metadata;
  metadata.insert(more.begin(), more.end());
  writer_.metadata("trunnion", metadata);
  for (const auto* topic : header.topics)
    writer_.add_channel(topic->description.name, topic->type, topic->schema, {{"handle", topic->handle}});
}

bool RecordingFile::write(const Message& message) {
  return writer_.write(message.topic, message.sequence, static_cast<std::uint64_t>(message.source_time),
                       message.cdr);
}

void RecordingFile::flush() { writer_.flush(); }

void RecordingFile::finish() {
  if (writer_.finish()) sink_.sync();
}

std::string numbered(const std::string& path, std::uint32_t number) {
  const std::filesystem::path whole(path);
  char text[16];
  std::snprintf(text, sizeof text, "-%04u", number);
  return (whole.parent_path() / (whole.stem().string() + text + whole.extension().string())).string();
}

std::uint32_t next_number(const std::string& path) {
  const std::filesystem::path whole(path);
  const std::string stem = whole.stem().string() + "-";
  auto folder = whole.parent_path();
  if (folder.empty()) folder = ".";
  std::uint32_t highest = 0;
  std::error_code ignored;  // the creation of the file reports a directory that cannot be read
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const auto name = entry.path().stem().string();
    if (entry.path().extension() != whole.extension() || !name.starts_with(stem)) continue;
    std::uint32_t number = 0;
    const auto* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + stem.size(), end, number);
    if (error == std::errc() && rest == end) highest = std::max(highest, number);
  }
  return highest + 1;
}

}  // namespace trunnion::recorder
