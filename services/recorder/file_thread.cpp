// SPDX-License-Identifier: Apache-2.0
#include "file_thread.hpp"

#include <sys/resource.h>

#include <iostream>
#include <utility>

#include "bus/bus.hpp"
#include "bus/json.hpp"
#include "flight_recorder.hpp"
#include "part_files.hpp"
#include "recording/disk_space.hpp"
#include "service/node.hpp"

namespace trunnion::recorder {
namespace {

constexpr int priority = 10;  // the recorder can wait, the stream cannot

std::unique_ptr<Destination> make_destination(const Options& options, const FileHeader& header) {
  if (options.last <= 0)
    return std::make_unique<PartFiles>(options.output, header, options.parts, service::monotonic_seconds());
  return std::make_unique<FlightRecorder>(
      options.output, header,
      FlightLimits{options.last, options.after, options.memory_mebibytes << 20, options.severity},
      bus::source_time());
}

}  // namespace

FileThread::FileThread(const Options& options, const FileHeader& header, MessageQueue& queue)
    : json_(options.json),
      path_(options.output),
      topics_(header.topics),
      queue_(queue),
      destination_(make_destination(options, header)),
      watch_(recording::free_space(path_) ? options.free_space : 0) {
  thread_ = std::thread([this] { run(); });
}

void FileThread::join() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

std::vector<SpaceWatch::Finding> FileThread::take_findings() {
  const std::lock_guard lock(mutex_);
  return std::exchange(findings_, {});
}

void FileThread::run() {
  // Compression can wait, the stream cannot. Whoever takes the messages must come in time and has little to
  // do. In Linux the priority is that of the calling thread.
  setpriority(PRIO_PROCESS, 0, priority);
  std::vector<Message> messages;
  while (queue_.pop_all(messages, 0.2)) {
    const double now = service::monotonic_seconds();
    for (auto& message : messages) {
      tally_.add(topics_[message.topic]->handle, message.cdr);
      destination_->take(message, now);
    }
    started_ = destination_->started();
    destination_->idle(now);
    watch_space(now);
    ended_ = destination_->ended();
    report_files();
  }
  destination_->finish(service::monotonic_seconds());
  report_files();
}

void FileThread::watch_space(double now) {
  if (!watch_.due(now) || destination_->ended()) return;
  const auto free = recording::free_space(path_);
  if (!free) return;
  std::uint64_t written = 0;
  for (const auto& file : destination_->files()) written += file.bytes;
  auto finding = watch_.look(path_, *free, written, now);
  if (finding.kind == SpaceWatch::Kind::unchanged) return;
  if (finding.kind == SpaceWatch::Kind::full) destination_->end(finding.text);
  if (destination_->ended()) return;
  const std::lock_guard lock(mutex_);
  findings_.push_back(std::move(finding));
}

void FileThread::report_files() {
  for (; reported_files_ < destination_->files().size(); ++reported_files_) {
    const auto& file = destination_->files()[reported_files_];
    if (file.why.empty()) continue;
    if (json_)
      std::cout << bus::Json{{"saved", file.path}, {"bytes", file.bytes}, {"because", file.why}}.dump()
                << std::endl;
    else
      std::cout << "saved " << file.path << ": " << file.why << std::endl;
  }
  if (reported_ || destination_->problem().empty()) return;
  reported_ = true;
  std::cerr << "trunnion-recorder: error: " + destination_->problem() + "\n";
}

}  // namespace trunnion::recorder
