// SPDX-License-Identifier: Apache-2.0
#include "program_cache.hpp"

#include <algorithm>

namespace trunnion::channel {
namespace {

/// Whether the file `stored` is the program `name`, with an extension or without one. O9990.9 is another
/// program than O9990: an extension begins with a letter.
bool is_program(std::string_view stored, std::string_view name) {
  if (!stored.starts_with(name)) return false;
  const auto extension = stored.substr(name.size());
  if (extension.empty()) return true;
  const bool digit = extension.size() > 1 && extension[1] >= '0' && extension[1] <= '9';
  return extension[0] == '.' && !digit;
}

}  // namespace

language::TextSource& ProgramCache::open(const idl::program::ProgramEntry& program) {
  subprograms_.clear();
  main_ = std::make_unique<ProgramText>(program);
  return *main_;
}

language::TextSource* ProgramCache::call(const idl::program::ProgramList& stored, std::string_view name) {
  for (const auto& entry : stored.programs) {
    if (!is_program(entry.name, name)) continue;
    subprograms_.push_back(std::make_unique<ProgramText>(entry));
    return subprograms_.back().get();
  }
  return nullptr;
}

std::optional<ChunkWanted> ProgramCache::wanted() const {
  if (main_)
    if (auto chunk = main_->wanted()) return chunk;
  for (const auto& text : subprograms_)
    if (auto chunk = text->wanted()) return chunk;
  return std::nullopt;
}

std::optional<std::uint8_t> ProgramCache::role() const {
  std::optional<std::uint8_t> least;
  const auto take = [&](const ProgramText& text) {
    least = std::min(least.value_or(text.role()), text.role());
  };
  if (main_) take(*main_);
  for (const auto& text : subprograms_) take(*text);
  return least;
}

// Several texts may have one name: a program that is called from two others.
void ProgramCache::deliver(const std::string& name, std::uint64_t offset,
                           const std::vector<std::uint8_t>& data) {
  const auto give = [&](ProgramText& text) {
    const auto chunk = text.wanted();
    if (text.name() == name && chunk && chunk->offset == offset) text.deliver(offset, data);
  };
  if (main_) give(*main_);
  for (const auto& text : subprograms_) give(*text);
}

void ProgramCache::fail(const std::string& name) {
  if (main_ && main_->name() == name) main_->fail();
  for (const auto& text : subprograms_)
    if (text->name() == name) text->fail();
}

}  // namespace trunnion::channel
