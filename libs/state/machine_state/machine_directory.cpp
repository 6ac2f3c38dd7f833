// SPDX-License-Identifier: Apache-2.0
#include "machine_state/machine_directory.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "storage/file.hpp"
#include "text/utf8.hpp"

namespace trunnion::machine_state {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t longest_name = 255;
constexpr int most_folders = 8;  // one within the other; a link that leads upwards has no end
constexpr std::array keys_and_certificates = {".pem", ".key", ".crt", ".csr", ".srl", ".p12", ".p7s"};

bool is_key_or_certificate(const fs::path& path) {
  const auto extension = path.extension().string();
  return std::find(keys_and_certificates.begin(), keys_and_certificates.end(), extension) !=
         keys_and_certificates.end();
}

// One part of a name between two '/'.
bool is_plain(std::string_view part) {
  return !part.empty() && part.front() != '.' &&
         std::none_of(part.begin(), part.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\\'; });
}

}  // namespace

bool is_machine_file(const std::string& name) {
  if (name.size() > longest_name || text::valid_utf8_prefix(name) != name.size()) return false;
  std::string_view rest = name;
  for (int folders = 0; folders <= most_folders; ++folders) {
    const auto slash = rest.find('/');
    if (!is_plain(rest.substr(0, slash))) return false;
    if (slash == std::string_view::npos) return true;
    rest.remove_prefix(slash + 1);
  }
  return false;
}

FileSet machine_files(const std::string& directory) {
  FileSet files;
  fs::recursive_directory_iterator entry(directory, fs::directory_options::follow_directory_symlink), end;
  for (; entry != end; ++entry) {
    const auto name = entry->path().lexically_relative(directory).generic_string();
    const bool hidden = entry->path().filename().string().front() == '.';
    if (hidden || name == "recordings") {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file()) {
      if (is_key_or_certificate(entry->path())) continue;
      auto bytes = read_file(entry->path().string());
      if (bytes.find("PRIVATE KEY-----") != std::string::npos) continue;
      if (!is_machine_file(name))
        throw std::runtime_error(entry->path().string() + ": a file of this name cannot be in a backup");
      files[name] = std::move(bytes);
    } else if (entry.depth() > most_folders) {
      throw std::runtime_error(entry->path().string() + ": more than " + std::to_string(most_folders) +
                               " folders one within the other");
    }
  }
  return files;
}

std::vector<std::string> differing_files(const FileSet& a, const FileSet& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a)
    if (const auto other = b.find(name); other == b.end() || other->second != bytes) names.push_back(name);
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

void make_machine(const FileSet& files, const std::string& directory) {
  auto place = fs::absolute(directory).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  if (fs::exists(place) && !(fs::is_directory(place) && fs::is_empty(place)))
    throw std::runtime_error(place.string() + " is there already: name a new directory");
  const fs::path fresh = place.string() + ".restoring";
  fs::create_directories(place.parent_path());
  try {
    write_files(fresh.string(), files);
    fs::rename(fresh, place);
  } catch (const std::exception&) {
    std::error_code ignored;
    fs::remove_all(fresh, ignored);
    throw;
  }
  storage::sync_directory(place.parent_path().string());
}

}  // namespace trunnion::machine_state
