// SPDX-License-Identifier: Apache-2.0
// The recordings of the machine over HTTP: list, read, delete, start and stop.
#pragma once

#include <filesystem>
#include <vector>

#include "answer.hpp"
#include "cluster/child_process.hpp"
#include "core/recording_files.hpp"
#include "core/router.hpp"
#include "core/worker.hpp"

namespace trunnion::gateway {

struct RecordingSettings {
  std::filesystem::path directory;
  /// The recorder and its arguments, without what the request says: file, duration, topics.
  std::vector<std::string> recorder;
  std::uint64_t free_space = 0;  ///< bytes that must be free for a start
};

class Recordings {
 public:
  explicit Recordings(RecordingSettings settings) : settings_(std::move(settings)) {}
  ~Recordings() { stop(); }
  /// Operations on recordings; answers later, on the thread of the files.
  void handle(const Match& match, const RequestText& request, const Respond& respond);
  Worker& worker() { return worker_; }
  /// Ends a recording under way: its file is whole.
  void stop();

 private:
  Answer answer(const Match& match, const RequestText& request);
  Answer list(const std::string& query);
  Answer start(const std::string& body);
  Answer end(const std::string& name);
  Answer remove(const RecordingFile& file, const std::string& if_match);
  Answer read(const RecordingFile& file, const RequestText& request) const;
  Answer table(const RecordingFile& file) const;
  /// Of the recording under way, empty = none.
  std::string running();
  void notice_end();

  const RecordingSettings settings_;
  // Only the thread of the files uses what follows; it also is the parent whose end ends the recorder.
  std::string name_;
  std::string problem_;     // why the file of that name is not complete
  bool is_broken_ = false;  // by its disk or its recorder; messages may be missing otherwise, too
  bool noticed_ = true;     // its end
  cluster::ChildProcess recorder_;
  Worker worker_{"gateway-files"};  ///< the last member: its thread ends before the others are destroyed
};

}  // namespace trunnion::gateway
