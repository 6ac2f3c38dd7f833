// SPDX-License-Identifier: Apache-2.0
#include "core/recording_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>

namespace trunnion::gateway {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t part_bytes = 256u << 10, longest_name = 100;
constexpr std::string_view ending = ".mcap";

class FilePart final : public BodySource {
 public:
  FilePart(int file, const ByteRange& range) : file_(file), at_(range.first), left_(range.count) {}
  ~FilePart() override { ::close(file_); }
  std::optional<std::string> next() override {
    std::string part(static_cast<std::size_t>(std::min<std::uint64_t>(left_, part_bytes)), '\0');
    if (part.empty()) return part;
    const auto got = ::pread(file_, part.data(), part.size(), static_cast<off_t>(at_));
    if (got <= 0) return {};
    part.resize(static_cast<std::size_t>(got));
    at_ += part.size();
    left_ -= part.size();
    return part;
  }

 private:
  int file_;
  std::uint64_t at_, left_;
};

}  // namespace

bool is_recording_name(std::string_view name) {
  constexpr std::string_view permitted = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  return name.size() > ending.size() && name.size() <= longest_name && name.ends_with(ending) &&
         !name.starts_with('.') && name.find_first_not_of(permitted) == std::string_view::npos;
}

std::string RecordingFile::etag() const {
  char text[48];
  std::snprintf(text, sizeof text, "\"%" PRIx64 "-%" PRIx64 "\"", size, static_cast<std::uint64_t>(modified));
  return text;
}

std::optional<RecordingFile> recording_file(const fs::path& directory, std::string_view name) {
  if (!is_recording_name(name)) return {};
  struct stat status {};
  if (::lstat((directory / name).c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return RecordingFile{std::string(name), static_cast<std::uint64_t>(status.st_size),
                       std::int64_t{status.st_mtim.tv_sec} * 1000000000 + status.st_mtim.tv_nsec};
}

std::vector<RecordingFile> recording_files(const fs::path& directory) {
  std::vector<RecordingFile> files;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
    if (auto file = recording_file(directory, entry->path().filename().string()))
      files.push_back(std::move(*file));
  std::ranges::sort(files, {}, &RecordingFile::name);
  return files;
}

std::shared_ptr<BodySource> file_part(const fs::path& path, const ByteRange& range) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0) return nullptr;
  return std::make_shared<FilePart>(file, range);
}

}  // namespace trunnion::gateway
