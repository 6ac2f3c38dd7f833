// SPDX-License-Identifier: Apache-2.0
// collision: the planned path of a program against the bodies of the machine
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "analysis/file_source.hpp"
#include "analysis/program_folders.hpp"
#include "analysis/program_run.hpp"
#include "bus/json.hpp"
#include "canonical/axes.hpp"
#include "collision_machine.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "machine_directory.hpp"
#include "report/bodies_picture.hpp"
#include "storage/file.hpp"

namespace trunnion::cli {
namespace {

constexpr double table_range = 50;  // mm: pairs farther apart are not listed

struct CollisionOptions {
  std::string machine, program, tool, picture, pose;
  std::vector<std::string> set;
  std::optional<double> clearance;
};

double option_number(const std::string& text, const std::string& option) {
  std::istringstream in(text);
  double value = 0;
  char more = 0;
  if (!(in >> value) || in >> more || !(value >= 0 && value <= 1e4))
    throw std::runtime_error("--tool " + option +
                             ": expected the number of a tool, or LENGTH,DIAMETER in mm");
  return value;
}

// The number of a tool of the table, or LENGTH,DIAMETER.
CylinderTool tool_of(const std::string& option, const tool_tables::MachineTables& tables) {
  const auto comma = option.find(',');
  if (comma != std::string::npos) {
    const CylinderTool tool{option_number(option.substr(0, comma), option),
                            option_number(option.substr(comma + 1), option) / 2};
    if (!(tool.length > 0 && tool.radius > 0))
      throw std::runtime_error("--tool " + option + ": length and diameter must be above 0 mm");
    return tool;
  }
  const double number = option_number(option, option);
  for (const auto& tool : tables.tools.tools)
    if (tool.number == number) {
      if (!(tool.length > 0 && tool.radius > 0))
        throw std::runtime_error("--tool " + option +
                                 ": its length and radius must be above 0 mm in tools.yaml");
      return {tool.length, tool.radius};
    }
  throw std::runtime_error("--tool " + option + ": there is no such tool in tools.yaml");
}

// "A30 C45": axes that are not named are at zero.
collision::AxisPosition pose_of(const std::string& text, const collision::Travel& travel) {
  collision::AxisPosition position{};
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    const auto axis = canonical::axis_letters.find(word[0]);
    std::istringstream value(word.substr(1));
    char more = 0;
    if (axis == std::string_view::npos || !travel[axis].present || !(value >> position[axis]) ||
        value >> more || !(std::abs(position[axis]) <= 1e6))
      throw std::runtime_error("--pose " + text + ": expected axis words of the machine, as in \"X10 A30\"");
  }
  return position;
}

struct Follower {
  const collision::CollisionModel& model;
  double clearance;
  std::optional<collision::AxisPosition> before;
  std::optional<collision::FirstContact> contact;
  std::uint32_t contact_line = 0;
  collision::ClearanceTable table;

  void follow(const collision::AxisPosition& position, std::uint32_t line) {
    if (!before) before = position;
    if (!contact) {
      contact = model.first_contact(*before, position, clearance);
      contact_line = line;
    }
    model.note(position, line, table_range, table);
    before = position;
  }
};

int report(const Follower& follower, const CollisionOptions& o, const collision::Travel& travel, bool json) {
  const auto& bodies = follower.model.bodies();
  auto rows = follower.table.rows();
  std::erase_if(rows, [](const auto& row) { return row.distance >= table_range; });
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  if (json) {
    bus::Json out = {{"program", o.program},
                     {"clearance_mm", follower.clearance},
                     {"free", !follower.contact},
                     {"pairs_checked", follower.model.pair_count()},
                     {"clearances", bus::Json::array()}};
    if (const auto& c = follower.contact)
      out["first_contact"] = {{"line", follower.contact_line},
                              {"bodies", {bodies[c->pair.first].name, bodies[c->pair.second].name}},
                              {"distance_mm", c->pair.distance},
                              {"axes", c->position},
                              {"on_first_mm", vector_json(c->pair.on_first)},
                              {"on_second_mm", vector_json(c->pair.on_second)}};
    for (const auto& row : rows)
      out["clearances"].push_back({{"bodies", {bodies[row.first].name, bodies[row.second].name}},
                                   {"distance_mm", row.distance},
                                   {"line", row.at}});
    std::cout << bus::text_of(out, 2) << "\n";
    return follower.contact ? 1 : 0;
  }
  if (const auto& c = follower.contact)
    std::printf("%s:%u: %s (clearance %.3f mm) at %s\n", o.program.c_str(), follower.contact_line,
                follower.model.text_of(c->pair).c_str(), follower.clearance,
                collision::text_of(c->position, travel).c_str());
  else
    std::printf("%s: no contact, clearance %.3f mm, %zu pairs of bodies\n", o.program.c_str(),
                follower.clearance, follower.model.pair_count());
  if (!rows.empty()) std::printf("%-28s %-28s %12s %8s\n", "body", "body", "least, mm", "line");
  for (const auto& row : rows)
    std::printf("%-28s %-28s %12.3f %8zu\n", bodies[row.first].name.c_str(), bodies[row.second].name.c_str(),
                row.distance, row.at);
  return follower.contact ? 1 : 0;
}

int run_collision(const CollisionOptions& o, const Common& common) {
  const auto directory = machine_directory(o.machine);
  const auto machine = load_true_machine(o.machine, 0, o.set);
  auto tables = tool_tables::load_machine_tables(directory);
  tables.parameters = machine.model;
  auto bodies = load_bodies(machine, o.machine, 0);
  if (!o.tool.empty()) put_tool(bodies, tool_of(o.tool, tables));
  if (o.program.empty() && o.picture.empty())
    throw std::runtime_error("give --program FILE or --picture FILE");
  const collision::CollisionModel model(std::move(bodies.links), std::move(bodies.set));
  if (!o.picture.empty()) {
    const auto pose = pose_of(o.pose, machine.outline.axes);
    storage::replace_file(
        o.picture, report::bodies_picture(
                       model, pose, machine.name + ", " + collision::text_of(pose, machine.outline.axes)));
    if (o.program.empty()) return 0;
  }
  channel_setup::ChannelSetup setup(tables);
  const std::string own = std::filesystem::path(o.program).parent_path().string();
  analysis::ProgramFolders programs(
      {own.empty() ? "." : own, directory + "/programs", directory + "/cycles"});
  setup.resolve = [&programs](std::string_view name) { return programs.find(name); };
  analysis::FileSource text(o.program);
  Follower follower{model, o.clearance.value_or(model.clearance()), {}, {}, 0, {}};
  follower.follow(setup.reference_position(), 0);
  const auto result = analysis::run_program(
      text, setup, setup.reference_position(),
      [&](const analysis::PlannedCycle& cycle) { follower.follow(cycle.machine, cycle.setpoint->line); }, {});
  if (!result.good) throw std::runtime_error(o.program + ":" + result.alarm);
  return report(follower, o, machine.outline.axes, common.json);
}

}  // namespace

void add_collision_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<CollisionOptions>();
  auto& o = *options;
  auto* command = add_command(app, common, "collision",
                              "Follow the planned path of a program among the bodies of the machine "
                              "(docs/collision.md): first contact, and least clearance of each pair; 1 when "
                              "there is a contact",
                              [options, &common] { return run_collision(*options, common); });
  command->add_option("machine", o.machine, "Name under configs/machines, or a directory with machine.yaml")
      ->required();
  command->add_option("--program", o.program, "The program's file");
  command->add_option("--picture", o.picture, "Write the bodies seen from three sides (SVG)");
  command->add_option("--pose", o.pose, "Of --picture: axis words, as in \"X10 A30\" (default: all at zero)");
  command->add_option("--tool", o.tool,
                      "Number of a tool in tools.yaml, or LENGTH,DIAMETER in mm: a cylinder in place of the "
                      "bodies on the tool of bodies.yaml");
  command->add_option("--clearance", o.clearance, "mm, in place of that of bodies.yaml")
      ->check(CLI::Range(0.0, 100.0));
  command->add_option("--set", o.set, "As of `trunnion truth`; may be repeated")->take_all();
}

}  // namespace trunnion::cli
