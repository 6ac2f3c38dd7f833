// SPDX-License-Identifier: Apache-2.0
#include "storage/kept_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "storage/file.hpp"

namespace trunnion::storage {
namespace {

std::string temporary(const std::string& path) { return path + ".new"; }
std::string previous(const std::string& path) { return path + previous_suffix; }
bool exists(const std::string& path) { return access(path.c_str(), F_OK) == 0; }

std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }
std::string directory_of(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash);
}

std::optional<std::string> bytes_of(const std::string& path) {
  if (!exists(path)) return std::nullopt;
  const File file(path, O_RDONLY);
  std::string bytes(file.size(), '\0');
  bytes.resize(file.read(0, {reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()}));
  return bytes;
}

void write_new(const std::string& path, const std::string& text) {
  try {
    const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    File out(path, O_WRONLY | O_CREAT | O_TRUNC);
    out.append(0, bytes);
    out.sync();
  } catch (const StorageError&) {
    unlink(path.c_str());
    throw;
  }
}

}  // namespace

Kept read_kept(const std::string& path) {
  return decide(name_of(path), bytes_of(path), bytes_of(previous(path)), exists(temporary(path)));
}

void prepare_kept(const std::string& path, const std::string& content) {
  const auto name = name_of(path);
  std::string problem;
  std::uint64_t generation = 0;
  for (const auto& file : {path, previous(path)})
    if (const auto text = bytes_of(file))
      if (const auto old = unseal(name, *text, problem)) generation = std::max(generation, old->generation);
  write_new(temporary(path), seal(name, generation + 1, content));
}

void publish_kept(const std::string& path) {
  const auto name = name_of(path), before = previous(path);
  const auto old = read_kept(path);
  std::string problem;
  if (old.state == KeptState::good && old.generation > 0) {
    // Linked, not renamed: a crash between the two steps leaves the file where it was.
    unlink(before.c_str());
    if (link(path.c_str(), before.c_str()) != 0)
      throw StorageError(before + ": cannot be linked: " + std::strerror(errno));
  } else if (old.state == KeptState::good) {
    write_new(before, seal(name, 0, old.content));  // of the version before, which had no generations
  } else {
    if (exists(path)) rename_over(path, path + damaged_suffix);
    // Of the first generation there is a copy, which shows that there was a file, should the file be lost.
    const auto fresh = unseal(name, bytes_of(temporary(path)).value_or(""), problem);
    if (fresh && old.state != KeptState::previous) write_new(before, seal(name, 0, fresh->content));
  }
  rename_over(temporary(path), path);
}

void discard_kept(const std::string& path) { unlink(temporary(path).c_str()); }

void write_kept(const std::string& path, const std::string& content) {
  prepare_kept(path, content);
  publish_kept(path);
  sync_directory(directory_of(path));
}

void repair_kept(const std::string& path, const Kept& kept) {
  if (exists(path)) rename_over(path, path + damaged_suffix);
  write_kept(path, kept.content);
}

std::string damage_text(const std::string& path, const Kept& kept, const std::string& loss) {
  const auto file = name_of(path);
  // Of two files the problem names the one that is damaged.
  const auto what =
      kept.problem.starts_with(file) ? kept.problem : file + " is damaged (" + kept.problem + ")";
  if (kept.state == KeptState::unusable)
    return what + ": the " + loss + " are lost. 'trunnion restore' a backup, or enter them again";
  const auto generation =
      kept.generation > 0 ? " of generation " + std::to_string(kept.generation) : std::string(" kept before");
  return what + ": the " + loss + generation +
         " are used, the newest changes are lost. Check them, or 'trunnion restore' a backup";
}

}  // namespace trunnion::storage
