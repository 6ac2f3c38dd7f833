// SPDX-License-Identifier: Apache-2.0
// CONFIGURATION, RESOURCE and TASK (IEC 61131-3:2013, 6.8).
#include "plc/syntax/parser.hpp"

namespace trunnion::st {

void DeclarationParser::configuration() {
  ConfigurationDeclaration configuration;
  if (!open_.empty())
    diagnostics_.error(now().at, "a CONFIGURATION is in no namespace: write it behind END_NAMESPACE");
  configuration.scope = scope_;
  take();
  const auto name = expect_name("the name of the configuration");
  configuration.text = name.text;
  configuration.at = name.at;
  try {
    bool found = false;
    while (!is_word("END_CONFIGURATION")) {
      if (!is_word("RESOURCE")) {
        resource(configuration, "END_CONFIGURATION");
        continue;
      }
      if (found) {
        diagnostics_.error(now().at,
                           "the PLC is one RESOURCE: put its programs into the tasks of the first one");
        throw Abandoned{};
      }
      found = true;
      take();
      expect_name("the name of the resource");
      expect_word("ON", "with the type of the resource");
      expect_name("the type of the resource");
      resource(configuration, "END_RESOURCE");
      expect_word("END_RESOURCE", "at the end of the resource");
      accept_symbol(";");
    }
  } catch (const Abandoned&) {
    // What follows would be taken for units.
    while (now().kind != TokenKind::end && !is_word("END_CONFIGURATION")) take();
  }
  take();
  accept_symbol(";");
  tree_.configurations.push_back(std::move(configuration));
}

// The parts of a resource, which a configuration without RESOURCE has itself.
void DeclarationParser::resource(ConfigurationDeclaration& configuration, std::string_view end) {
  while (!is_word(end)) {
    if (is_word("RESOURCE") && end != "END_RESOURCE") return;
    if (is_word("VAR_GLOBAL")) {
      tree_.globals.push_back(variable_block());
    } else if (is_word("TASK")) {
      task(configuration);
    } else if (is_word("PROGRAM")) {
      program_configuration(configuration);
    } else if (is_word("VAR_ACCESS")) {
      diagnostics_.error(now().at,
                         "VAR_ACCESS is not available: others read and write variables by their path, as "
                         "instance.variable");
      throw Abandoned{};
    } else if (is_word("VAR_CONFIG")) {
      diagnostics_.error(now().at, "VAR_CONFIG is not available: write the address behind AT in the program");
      throw Abandoned{};
    } else {
      fail("VAR_GLOBAL, TASK, PROGRAM or " + std::string(end));
    }
  }
}

void DeclarationParser::task(ConfigurationDeclaration& configuration) {
  TaskDeclaration task;
  take();
  const auto name = expect_name("the name of the task");
  task.name = name.upper;
  task.text = name.text;
  task.at = name.at;
  expect_symbol("(", "before INTERVAL and PRIORITY of the task");
  do {
    if (is_word("SINGLE")) {
      diagnostics_.error(now().at,
                         "a task begins by its INTERVAL; instead of SINGLE test for the edge in the program");
      throw Abandoned{};
    }
    const bool is_interval = is_word("INTERVAL");
    if (!is_interval && !is_word("PRIORITY")) fail("INTERVAL or PRIORITY");
    take();
    expect_symbol(":=", is_interval ? "behind INTERVAL" : "behind PRIORITY");
    (is_interval ? task.interval : task.priority) = expression();
  } while (accept_symbol(","));
  expect_symbol(")", "behind the task");
  expect_symbol(";", "behind the task");
  configuration.tasks.push_back(std::move(task));
}

void DeclarationParser::program_configuration(ConfigurationDeclaration& configuration) {
  ProgramConfiguration program;
  take();
  if (accept_word("RETAIN"))
    program.retain = true;
  else
    accept_word("NON_RETAIN");
  const auto name = expect_name("the name of the program's instance");
  program.name = name.upper;
  program.text = name.text;
  program.at = name.at;
  if (accept_word("WITH")) {
    const auto task = expect_name("the name of a task");
    program.task = task.upper;
    program.task_text = task.text;
    program.task_at = task.at;
  }
  expect_symbol(":", "before the name of the PROGRAM");
  const auto type = expect_whole_name("the name of a PROGRAM");
  program.type = type.upper;
  program.type_text = type.text;
  program.type_at = type.at;
  auto callee = std::make_unique<Expression>();
  callee->kind = Expression::Kind::name;
  callee->at = program.at;
  callee->name = program.name;
  callee->text = program.text;
  program.call = std::make_unique<Expression>();
  program.call->kind = Expression::Kind::call;
  program.call->at = program.at;
  if (is_symbol("(")) program.call->arguments = arguments();
  program.call->parts.push_back(std::move(callee));
  expect_symbol(";", "behind the program");
  configuration.programs.push_back(std::move(program));
}

}  // namespace trunnion::st
