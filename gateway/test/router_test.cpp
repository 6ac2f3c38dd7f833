// SPDX-License-Identifier: Apache-2.0
#include "core/router.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/rights.hpp"
#include "core/site.hpp"

namespace trunnion::gateway {
namespace {

using testing::ElementsAre;

TEST(Router, FindsTheOperationAndTheParts) {
  const auto found = match("POST", "/api/channels/3/cycle-start");
  EXPECT_EQ(found.result, RouteResult::found);
  EXPECT_EQ(found.operation, Operation::channel_command);
  EXPECT_EQ(found.command, "cycle-start");
  EXPECT_THAT(found.parts, ElementsAre("3"));
}

TEST(Router, DecodesAPartAndKeepsASlashThatWasEncodedInIt) {
  EXPECT_THAT(match("GET", "/api/programs/A%20B%2fC.nc").parts, ElementsAre("A B/C.nc"));
}

TEST(Router, TellsAnUnknownPathFromAnUnknownMethod) {
  EXPECT_EQ(match("GET", "/api/nothing").result, RouteResult::no_path);
  EXPECT_EQ(match("GET", "/api/channels/0/reset").result, RouteResult::no_method);
  EXPECT_EQ(match("GET", "/api/status/").result, RouteResult::no_path);
  EXPECT_EQ(match("GET", "/api/channels/").result, RouteResult::no_path);
  EXPECT_EQ(match("GET", "/api/programs/%zz").result, RouteResult::no_path);
  EXPECT_EQ(match("GET", "").result, RouteResult::no_path);
}

TEST(Router, QueryValuesAreDecodedAndOthersAreNotTakenForThem) {
  EXPECT_EQ(query_value("class=axis&search=jog+feed%21", "search"), "jog feed!");
  EXPECT_EQ(query_value("research=1", "search"), "");
  EXPECT_EQ(query_value("search", "search"), "");
}

TEST(Router, EveryDocumentedOperationIsRoutedAndEveryRouteDocumented) {
  std::ifstream file(OPENAPI_FILE);
  const auto document = nlohmann::json::parse(file);
  std::set<std::string> documented, routed;
  for (const auto& [path, operations] : document["paths"].items())
    for (const auto& [method, operation] : operations.items()) {
      std::string upper;
      for (const unsigned char c : method) upper.push_back(static_cast<char>(std::toupper(c)));
      documented.insert(upper.append(" ").append(path));
      EXPECT_FALSE(operation["summary"].get<std::string>().empty());
      // Each {part} of the path is described, and nothing else claims to be one.
      std::set<std::string> described;
      for (const auto& parameter : operation.value("parameters", nlohmann::json::array()))
        if (parameter["in"] == "path") described.insert(parameter["name"]);
      std::set<std::string> named;
      for (std::size_t at = path.find('{'); at != std::string::npos; at = path.find('{', at + 1))
        named.insert(path.substr(at + 1, path.find('}', at) - at - 1));
      EXPECT_EQ(described, named) << path;
    }
  for (const auto& route : routes())
    routed.insert(std::string(route.method) + " " + std::string(route.pattern));
  EXPECT_EQ(documented, routed);
}

TEST(Router, EveryReferenceOfTheDocumentLeadsSomewhere) {
  std::ifstream file(OPENAPI_FILE);
  const auto document = nlohmann::json::parse(file);
  int references = 0;
  const std::function<void(const nlohmann::json&)> walk = [&](const nlohmann::json& node) {
    if (node.is_object() && node.contains("$ref")) {
      const auto target = node["$ref"].get<std::string>();
      ASSERT_TRUE(target.starts_with("#"));
      EXPECT_TRUE(document.contains(nlohmann::json::json_pointer(target.substr(1)))) << target;
      ++references;
    }
    if (node.is_structured())
      for (const auto& child : node) walk(child);
  };
  walk(document);
  EXPECT_GT(references, 50);
}

TEST(Site, IsNamedByAddressesLocalhostAndItsOwnNamesOnly) {
  const Site site({"Mill-3", "mill-3.local"});
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:8080", "[::1]:8080", "[fe80::1]", "localhost:8080",
                           "LOCALHOST", "localhost.", "mill-3", "MILL-3:8080", "mill-3.local"})
    EXPECT_TRUE(site.is_named(host)) << host;
  // Names that may lead here by the will of somebody else, also those that begin or end like ours.
  for (const char* host :
       {"evil.example", "evil.example:8080", "mill-3.evil.example", "localhost.evil.example",
        "127.0.0.1.evil.example", "evilmill-3", ":8080", "10.0.0.1x", "1.2.3.4:80@evil", "[evil]",
        "[::1]evil", "[::1", "1.2.3", "1.2.3.4.5", "...", "localhost:80evil", "localhost:123456"})
    EXPECT_FALSE(site.is_named(host)) << host;
}

TEST(Router, WhatEverybodyMaySendIsShort) {
  for (const auto& route : routes()) {
    Match found;
    found.operation = route.operation, found.command = route.command;
    if (needed_role(found) || route.method == "GET") continue;
    EXPECT_LE(largest_body(route.operation), 4096u) << route.pattern;
  }
}

TEST(Site, TakesAPageOfAnotherHostOrPortForForeign) {
  EXPECT_FALSE(foreign_origin("", "mill-3", true));
  EXPECT_FALSE(foreign_origin("http://mill-3:8080", "mill-3:8080", false));
  EXPECT_TRUE(foreign_origin("http://mill-3:8081", "mill-3:8080", false));
  EXPECT_TRUE(foreign_origin("null", "mill-3:8080", false));
  EXPECT_TRUE(foreign_origin("http://mill-3:8080", "mill-3:8080", true));
  EXPECT_FALSE(foreign_origin("https://mill-3:8080", "mill-3:8080", true));
}

}  // namespace
}  // namespace trunnion::gateway
