// SPDX-License-Identifier: Apache-2.0
// One recording on the disk, written message by message; and the names of several in a row.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/registry.hpp"
#include "message_queue.hpp"
#include "recording/file_stream.hpp"
#include "recording/mcap_writer.hpp"

namespace trunnion::recorder {

/// What every file of one recorder has in common.
struct FileHeader {
  std::vector<const bus::TopicEntry*> topics;  ///< by the number that messages name
  recording::StringMap metadata;
  recording::Compression compression = recording::Compression::zstd;
};

class RecordingFile {
 public:
  /// Creates or overwrites `path`; `more` is added to the header's metadata. Throws std::runtime_error naming
  /// the path and the reason.
  RecordingFile(const std::string& path, const FileHeader& header, const recording::StringMap& more = {});

  /// False when the message is not in the file: see problem().
  bool write(const Message& message);
  /// What has been written survives a crash of this process.
  void flush();
  /// Ends the file and waits until it is on the disk.
  void finish();

  const std::string& path() const { return path_; }
  std::uint64_t bytes() const { return writer_.bytes(); }
  const std::string& problem() const { return sink_.problem(); }

 private:
  std::string path_;
  recording::FileSink sink_;
  recording::Writer writer_;
};

/// FILE.mcap and 12: FILE-0012.mcap.
std::string numbered(const std::string& path, std::uint32_t number);
/// One more than the highest number a file numbered() after `path` has; 1 when there is none.
std::uint32_t next_number(const std::string& path);

}  // namespace trunnion::recorder
