// SPDX-License-Identifier: Apache-2.0
// completion: the names of commands and options, for the shell
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "cluster/cluster_files.hpp"
#include "commands.hpp"

namespace trunnion::cli {
namespace {

// A former name of a command has no group: it is understood, and not offered.
std::vector<const CLI::App*> offered(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

void collect(const CLI::App& app, const std::string& path, std::string& cases) {
  std::string words;
  for (const auto* sub : offered(app)) words += sub->get_name() + " ";
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) words += "--" + name + " ";
  cases += "    '" + path + "') words='" + words + "' ;;\n";
  for (const auto* sub : offered(app))
    collect(*sub, path + (path.empty() ? "" : " ") + sub->get_name(), cases);
}

}  // namespace

void add_completion_command(CLI::App& app, Common& common) {
  auto* command =
      app.add_subcommand("completion", "Print the completion for bash: source <(trunnion completion)");
  command->callback([&app, &common] {
    common.action = [&app] {
      std::string cases, commands = "'param '*|'topic '*";
      collect(app, "", cases);
      for (const auto* sub : offered(app)) commands += "|' " + sub->get_name() + "'";
      std::cout << "_trunnion() {\n  local path='' word words='' i\n  for ((i = 1; i < COMP_CWORD; i++)); "
                   "do\n    word=${COMP_WORDS[i]}\n"
                   "    [[ $word == -* ]] || case \"$path $word\" in\n"
                   "      "
                << commands
                << ") path=\"${path:+$path }$word\" ;;\n"
                   "    esac\n  done\n  case \"$path\" in\n"
                << cases
                << "  esac\n  COMPREPLY=($(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n"
                << "  [[ ${#COMPREPLY[@]} -gt 0 ]] || COMPREPLY=($(compgen -f -- "
                   "\"${COMP_WORDS[COMP_CWORD]}\"))\n}\ncomplete -F _trunnion trunnion\n";
      return 0;
    };
  });
}

}  // namespace trunnion::cli
