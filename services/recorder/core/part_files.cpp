// SPDX-License-Identifier: Apache-2.0
#include "part_files.hpp"

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace trunnion::recorder {
namespace {
constexpr double flush_seconds = 1.0;  // what a crash of the recorder may cost
}

PartFiles::PartFiles(std::string path, FileHeader header, PartLimits limits, double now)
    : path_(std::move(path)), header_(std::move(header)), limits_(limits), states_(header_.topics) {
  if (limits_.any()) number_ = next_number(path_) - 1;
  begin_part(now);
}

void PartFiles::begin_part(double now) {
  recording::StringMap part;
  if (limits_.any()) {
    ++number_;
    part = {{"part", std::to_string(number_)}};
    if (!files_.empty()) part.emplace("previous", std::filesystem::path(files_.back().path).filename());
  }
  file_ = std::make_unique<RecordingFile>(limits_.any() ? numbered(path_, number_) : path_, header_, part);
  files_.push_back({file_->path(), 0, 0, ""});
  began_ = flushed_ = now;
  ++started_;
  for (const auto* message : states_.states()) write(*message);
}

void PartFiles::end_part() {
  file_->finish();
  files_.back().bytes = file_->bytes();
  note_problem();
}

void PartFiles::note_problem() {
  if (!problem_.empty() || file_->problem().empty()) return;
  files_.back().bytes = file_->bytes();
  problem_ = file_->problem() + "; the file ends at byte " + std::to_string(file_->bytes());
}

void PartFiles::end(const std::string& why) {
  if (ended()) return;
  end_part();
  if (problem_.empty()) problem_ = why;
}

void PartFiles::write(const Message& message) {
  if (!ended() && file_->write(message))
    ++files_.back().messages;
  else
    ++unwritten_;
  note_problem();
}

void PartFiles::take(Message& message, double now) {
  const bool full = (limits_.bytes != 0 && file_->bytes() >= limits_.bytes) ||
                    (limits_.seconds > 0 && now - began_ >= limits_.seconds);
  if (full && !ended()) {
    end_part();
    // The oldest part is removed before the new one needs space.
    while (limits_.keep != 0 && files_.size() >= limits_.keep && files_.size() > 1) {
      std::error_code ignored;
      std::filesystem::remove(files_.front().path, ignored);
      files_.erase(files_.begin());
    }
    try {
      begin_part(now);
    } catch (const std::runtime_error& error) {
      problem_ = error.what();
    }
  }
  if (limits_.any()) states_.see(message);
  write(message);
}

void PartFiles::idle(double now) {
  if (ended()) return;
  if (now - flushed_ > flush_seconds) {
    file_->flush();
    flushed_ = now;
  }
  files_.back().bytes = file_->bytes();
  note_problem();
}

void PartFiles::finish(double) {
  if (!ended()) end_part();
}

}  // namespace trunnion::recorder
