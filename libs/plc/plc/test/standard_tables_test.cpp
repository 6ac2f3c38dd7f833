// SPDX-License-Identifier: Apache-2.0
// The rows of the tables of IEC 61131-3:2013: libs/plc/plc/conformance says what each is and has the program
// that tests it.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "checked_compilation.hpp"
#include "machine/yaml.hpp"
#include "plc/library/register_names.hpp"
#include "plcopen_documents.hpp"

namespace trunnion::st {
namespace {

struct StandardRow {
  std::string name;  ///< table 5, row 2a
  bool available = true;
  std::string remark, refused;
  std::string file, source;  ///< of the program; without one both are empty
  std::string test;          ///< Suite.Name of a test of this program
  int scans = 1;
  std::vector<std::pair<std::string, std::string>> values;  ///< of paths, behind the last scan
};

std::string scalar_of(const YAML::Node& row, const char* key) {
  const auto node = row[key];
  return node ? node.as<std::string>() : "";
}

/// PROGRAM main with `run`, or with one assignment of `value` to r.
std::string source_text(const YAML::Node& row) {
  if (row["source"]) return scalar_of(row, "source");
  const bool value = static_cast<bool>(row["value"]);
  return scalar_of(row, "before") + "PROGRAM main\nVAR\n" + scalar_of(row, "var") +
         (value ? " r : " + scalar_of(row, "type") + ";" : "") + "\nEND_VAR\n" +
         (value ? "r := " + scalar_of(row, "value") + ";" : scalar_of(row, "run")) + "\nEND_PROGRAM\n";
}

/// The program `main` with the instruction list, in PLCopen XML.
std::string document_of(const YAML::Node& row) {
  std::vector<std::pair<std::string, std::string>> locals;
  for (const auto& one : row["vars"]) {
    const auto type = one.second.as<std::string>();
    locals.emplace_back(one.first.as<std::string>(),
                        elementary(type) != nullptr ? "<" + type + "/>" : derived(type));
  }
  return project(pou("main", "program", variables("localVars", locals),
                     "<IL><xhtml xmlns=\"http://www.w3.org/1999/xhtml\"><![CDATA[" + scalar_of(row, "list") +
                         "]]></xhtml></IL>"));
}

StandardRow row_of(const YAML::Node& row, const std::string& table) {
  StandardRow result;
  result.name = "table " + table + ", row " + scalar_of(row, "row");
  const auto status = scalar_of(row, "status");
  if (!status.empty() && status != "partly" && status != "not")
    throw std::runtime_error(result.name + ": " + status);
  result.available = status != "not";
  result.remark = scalar_of(row, "remark"), result.refused = scalar_of(row, "refused"),
  result.test = scalar_of(row, "test");
  if (row["list"])
    result.file = "row.xml", result.source = document_of(row);
  else if (row["source"] || row["run"] || row["value"] || row["var"])
    result.file = "row.st", result.source = source_text(row);
  if (row["scans"]) result.scans = row["scans"].as<int>();
  if (row["value"])
    result.values.emplace_back("r", scalar_of(row, "is"));
  else
    for (const auto& one : row["is"])
      result.values.emplace_back(one.first.as<std::string>(), one.second.as<std::string>());
  return result;
}

/// The rows of every table by its number.
std::map<int, std::vector<StandardRow>> standard_tables() {
  std::map<int, std::vector<StandardRow>> tables;
  for (const auto& file : std::filesystem::directory_iterator(STANDARD_TABLES)) {
    if (file.path().extension() != ".yaml") continue;
    const auto document = machine::parse_yaml(machine::read_text(file.path()), file.path());
    for (const auto& table : document["tables"]) {
      const auto number = scalar_of(table, "table");
      auto& rows = tables[std::stoi(number)];
      if (!rows.empty()) throw std::runtime_error("table " + number + " is there twice");
      for (const auto& row : table["rows"]) rows.push_back(row_of(row, number));
    }
  }
  return tables;
}

std::vector<StandardRow> standard_rows() {
  std::vector<StandardRow> all;
  for (auto& [number, rows] : standard_tables())
    all.insert(all.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
  return all;
}

std::string value_of(const SourceRun& run, const std::string& path) {
  try {
    return run.get(path);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

/// The names of the tests of this program.
std::set<std::string> registered_tests() {
  std::set<std::string> names;
  const auto& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i)
    for (int j = 0; j < all.GetTestSuite(i)->total_test_count(); ++j)
      names.insert(std::string(all.GetTestSuite(i)->name()) + "." +
                   all.GetTestSuite(i)->GetTestInfo(j)->name());
  return names;
}

TEST(StandardTables, AreAllThereAndHaveEachRowOnce) {
  int next = 1;
  for (const auto& [number, rows] : standard_tables()) {
    EXPECT_EQ(number, next++);
    std::set<std::string> names;
    for (const auto& row : rows) EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(names.empty()) << "table " << number;
  }
  EXPECT_EQ(next, 77);  // the third edition has 76 tables
}

TEST(StandardTables, EveryAvailableRowHasATestAndEveryOtherARemark) {
  const auto tests = registered_tests();
  for (const auto& row : standard_rows()) {
    SCOPED_TRACE(row.name);
    if (!row.available) {
      EXPECT_FALSE(row.remark.empty()) << "what to do instead";
    } else if (row.source.empty()) {
      EXPECT_EQ(tests.count(row.test), 1u) << "neither a program nor a test: '" << row.test << "'";
    } else {
      EXPECT_FALSE(row.values.empty()) << "a program without a result";
    }
  }
}

TEST(StandardTables, EveryAvailableRowGivesItsValues) {
  for (const auto& row : standard_rows()) {
    if (!row.available || row.source.empty()) continue;
    SCOPED_TRACE(row.name + "\n" + row.source);
    const auto compilation = compile({{row.file, row.source}}, interface_registers());
    EXPECT_TRUE(compilation.good()) << testing::PrintToString(compilation.lines());
    if (!compilation.good()) continue;
    SourceRun run(checked(compilation));
    for (int i = 0; i < row.scans; ++i) {
      const auto fault = run.scan("");
      EXPECT_EQ(fault.kind, FaultKind::none) << fault_line(compilation, run.machine(), fault);
    }
    for (const auto& [path, value] : row.values) EXPECT_EQ(value_of(run, path), value) << path;
  }
}

TEST(StandardTables, EveryOtherRowIsRefused) {
  for (const auto& row : standard_rows()) {
    if (row.available || row.source.empty()) continue;
    SCOPED_TRACE(row.name + "\n" + row.source);
    const auto compilation = compile({{row.file, row.source}}, interface_registers());
    EXPECT_FALSE(compilation.good()) << "it is accepted: is it available?";
    std::string first;
    for (const auto& line : compilation.lines())
      if (first.empty() && line.find(": error: ") != std::string::npos) first = line;
    EXPECT_THAT(first, testing::HasSubstr(row.refused));
    EXPECT_THAT(first, testing::Not(testing::HasSubstr("\n")));
    EXPECT_FALSE(row.refused.empty()) << first;
  }
}

}  // namespace
}  // namespace trunnion::st
