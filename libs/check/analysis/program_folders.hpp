// SPDX-License-Identifier: Apache-2.0
// Subprograms as files of folders.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/file_source.hpp"

namespace trunnion::analysis {

/// Finds the text a program calls: the file of that name, or of that name with an extension, in the first
/// folder that has one; the program number may be written with or without O or %, and with fewer or more
/// leading zeros. O9990.9 of the NUM dialect is another program than O9990. Letters in either case. Of
/// several files in a folder the first in the order of names counts.
class ProgramFolders {
 public:
  explicit ProgramFolders(std::vector<std::string> folders) : folders_(std::move(folders)) {}

  /// `name` as language::Environment::subprogram gets it; nullptr when there is none. What was found is kept.
  language::TextSource* find(std::string_view name);
  /// The path of a text that was found, or its name.
  std::string path(std::string_view name) const;

 private:
  std::vector<std::string> folders_;
  std::map<std::string, std::unique_ptr<FileSource>, std::less<>> found_;
};

}  // namespace trunnion::analysis
