// SPDX-License-Identifier: Apache-2.0
// new service: the sources of a stage to begin with; new machine: the folder of a machine
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "bus/json.hpp"
#include "cluster/cluster_files.hpp"
#include "commands.hpp"
#include "machine/services.hpp"
#include "machine/yaml.hpp"
#include "machine_check/machine_check.hpp"
#include "trunnion/version.hpp"

namespace trunnion::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::map<std::string, std::string>;

// Beside the installed command, or in the sources it was built from.
fs::path template_directory() {
  for (fs::path up = cluster::binary_directory(); up.has_relative_path(); up = up.parent_path())
    for (const auto* place : {"share/trunnion/templates/stage", "deploy/cli/templates/stage"})
      if (fs::exists(up / place / "main.cpp.in")) return up / place;
  throw std::runtime_error("the templates are not here: install the package trunnion-dev");
}

std::string filled(std::string text, const Words& words) {
  for (const auto& [word, value] : words)
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
      text.replace(at, word.size(), value);
  return text;
}

void require_name(const std::string& name) {
  const bool valid = !name.empty() && name.size() <= 32 && name.front() >= 'a' && name.front() <= 'z' &&
                     name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
  if (!valid)
    throw std::runtime_error(
        "'" + name + "': a name has 1 .. 32 small letters, digits, - and _, and begins with a letter");
}

void require_empty(const std::string& directory) {
  if (fs::exists(directory) && !fs::is_empty(directory))
    throw std::runtime_error(directory + " exists and is not empty: name another directory");
}

Words words_for(const std::string& name, const std::string& stage) {
  require_name(name);
  if (machine::find_service(name) != nullptr)
    throw std::runtime_error("'" + name + "' is a service of Trunnion: choose another name");
  auto identifier = name;
  std::replace(identifier.begin(), identifier.end(), '-', '_');
  auto enumerator = stage;
  std::transform(stage.begin(), stage.end(), enumerator.begin(),
                 [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  const auto& definition = *machine::find_service(stage);
  const std::string version = trunnion::version;
  return {{"@NAME@", name},
          {"@IDENTIFIER@", identifier},
          {"@STAGE@", stage},
          {"@STAGE_ENUM@", enumerator},
          {"@INPUT@", std::string(definition.input)},
          {"@OUTPUT@", std::string(definition.output)},
          {"@VERSION@", version.substr(0, version.rfind('.'))}};
}

int new_service(const Common& common, const std::string& name, const std::string& stage,
                std::string directory) {
  const auto words = words_for(name, stage);
  if (directory.empty()) directory = name;
  require_empty(directory);
  fs::create_directories(directory);
  std::vector<std::string> written;
  for (const auto& entry : fs::directory_iterator(template_directory())) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto file = filled(entry.path().stem().string(), words);
    std::ofstream out(fs::path(directory) / file, std::ios::binary);
    out << filled(text, words);
    if (!out.flush()) {
      for (const auto& earlier : written) fs::remove(fs::path(directory) / earlier);
      fs::remove(fs::path(directory) / file);
      throw std::runtime_error((fs::path(directory) / file).string() +
                               ": cannot be written; the files before it were removed");
    }
    if (file.ends_with(".sh"))
      fs::permissions(fs::path(directory) / file,
                      fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
    written.push_back(file);
  }
  std::sort(written.begin(), written.end());
  if (common.json) {
    std::printf("%s\n", bus::text_of({{"directory", directory}, {"files", written}}).c_str());
    return 0;
  }
  std::printf(
      "%s: a stage in the place of %s, which passes the setpoints on. README.md says what is where.\n",
      directory.c_str(), stage.c_str());
  std::printf(
      "cd %s && cmake -B build && cmake --build build && ctest --test-dir build --output-on-failure\n",
      directory.c_str());
  return 0;
}

// Relative to the machine, also those behind links. Its recordings are of its own name.
std::vector<fs::path> files_of(const fs::path& machine) {
  if (const auto broken = machine_check::broken_links(machine.string()); !broken.empty())
    throw std::runtime_error(machine_check::to_string(broken.front()));
  std::vector<fs::path> files;
  const fs::recursive_directory_iterator end{};
  for (fs::recursive_directory_iterator entry(machine, fs::directory_options::follow_directory_symlink);
       entry != end; ++entry) {
    if (entry->path() == machine / "recordings")
      entry.disable_recursion_pending();
    else if (entry->is_regular_file())
      files.push_back(entry->path().lexically_relative(machine));
  }
  return files;
}

// Comments and everything else of machine.yaml stay.
void rename_machine(const fs::path& file, const std::string& name) {
  auto text = machine::read_text(file.string());
  const std::string key = "name:";
  const auto at = text.starts_with(key) ? 0 : text.find("\n" + key);
  if (at == std::string::npos) throw std::runtime_error(file.string() + ": error: it has no line 'name:'");
  const auto begin = text.find(key, at), end = std::min(text.find('\n', begin), text.size());
  text.replace(begin, end - begin, key + " " + name);
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

int new_machine(const Common& common, const std::string& name, const std::string& from,
                std::string directory) {
  require_name(name);
  if (directory.empty()) directory = name;
  require_empty(directory);
  const fs::path source = cluster::find_machine(from), target = directory;
  const auto files = files_of(source);  // before the new folder is there, which may be in the other one
  try {
    for (const auto& file : files) {
      fs::create_directories((target / file).parent_path());
      fs::copy_file(source / file, target / file);
    }
    rename_machine(target / "machine.yaml", name);
  } catch (...) {
    fs::remove_all(target);
    throw;
  }
  if (common.json) {
    std::printf("%s\n", bus::text_of({{"directory", directory}, {"files", files.size()}}).c_str());
    return 0;
  }
  std::printf("%s: a copy of %s with the same domain and port: change them in machine.yaml to run both\n",
              directory.c_str(), from.c_str());
  std::printf("trunnion check-machine %s && trunnion up %s\n", directory.c_str(), directory.c_str());
  return 0;
}

void add_new_machine(CLI::App& group, Common& common) {
  auto name = std::make_shared<std::string>(), from = std::make_shared<std::string>(),
       directory = std::make_shared<std::string>();
  auto* command = add_command(
      group, common, "machine",
      "Copy the folder of a machine, with the files that its links lead to and without its recordings",
      [&common, name, from, directory] { return new_machine(common, *name, *from, *directory); });
  command->add_option("name", *name, "Name of the new machine")->required();
  command->add_option("--from", *from, "Name under configs/machines, or a directory with machine.yaml")
      ->required();
  command->add_option("--directory", *directory, "Where to (default: the name)");
}

}  // namespace

void add_new_command(CLI::App& app, Common& common) {
  auto* group = app.add_subcommand("new", "Sources or a machine to begin with");
  group->require_subcommand(1);
  add_new_machine(*group, common);
  auto name = std::make_shared<std::string>(), directory = std::make_shared<std::string>();
  auto stage = std::make_shared<std::string>("compensation");
  auto* command = add_command(
      *group, common, "service",
      "Write the sources of a stage in C++, with a test and a comparison with a recording; needs the package "
      "trunnion-dev",
      [&common, name, stage, directory] { return new_service(common, *name, *stage, *directory); });
  command->add_option("name", *name, "Name of the executable")->required();
  command
      ->add_option("--stage", *stage,
                   "Stage in whose place it is: compensation or gantry (default: compensation)")
      ->check(CLI::IsMember({"compensation", "gantry"}));
  command->add_option("--directory", *directory, "Where to (default: the name)");
}

}  // namespace trunnion::cli
