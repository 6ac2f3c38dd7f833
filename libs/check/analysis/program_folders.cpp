// SPDX-License-Identifier: Apache-2.0
#include "analysis/program_folders.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "machine/program_number.hpp"

namespace trunnion::analysis {
namespace {

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

bool matches(const std::filesystem::path& file, const std::string& name) {
  const std::string whole = capitals(file.filename().string());
  if (whole == name) return true;
  if (const auto number = machine::number_in_name(name)) return machine::number_in_name(whole) == number;
  return whole.substr(0, whole.find('.')) == name;
}

}  // namespace

language::TextSource* ProgramFolders::find(std::string_view name) {
  if (const auto found = found_.find(name); found != found_.end()) return found->second.get();
  const std::string wanted = capitals(std::string(name));
  for (const std::string& folder : folders_) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      if (entry.is_regular_file(error) && matches(entry.path(), wanted)) files.push_back(entry.path());
    }
    if (files.empty()) continue;
    const auto first = std::min_element(files.begin(), files.end());
    return found_.emplace(std::string(name), std::make_unique<FileSource>(first->string()))
        .first->second.get();
  }
  return nullptr;
}

std::string ProgramFolders::path(std::string_view name) const {
  const auto found = found_.find(name);
  return found == found_.end() ? std::string(name) : found->second->path();
}

}  // namespace trunnion::analysis
