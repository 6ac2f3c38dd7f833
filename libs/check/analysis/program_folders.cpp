// SPDX-License-Identifier: Apache-2.0
#include "analysis/program_folders.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace trunnion::analysis {
namespace {

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// The digits of a program's name without leading zeros; empty when it is no number.
std::string number_of(std::string name) {
  if (!name.empty() && (name[0] == 'O' || name[0] == '%')) name.erase(0, 1);
  if (name.empty() || name.find_first_not_of("0123456789") != std::string::npos) return {};
  name.erase(0, std::min(name.find_first_not_of('0'), name.size() - 1));
  return name;
}

bool matches(const std::filesystem::path& file, const std::string& name) {
  const std::string whole = capitals(file.filename().string());
  if (whole == name) return true;
  const std::string stem = whole.substr(0, whole.find('.'));
  const std::string number = number_of(name);
  return stem == name || (!number.empty() && number_of(stem) == number);
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
