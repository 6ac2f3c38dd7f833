// SPDX-License-Identifier: Apache-2.0
#include "core/rights.hpp"

#include <gtest/gtest.h>

#include <set>

namespace trunnion::gateway {
namespace {

using access::Role;

std::optional<Role> role_for(std::string_view method, std::string_view path) {
  const auto found = match(method, path);
  EXPECT_EQ(found.result, RouteResult::found) << path;
  return needed_role(found);
}

TEST(Rights, StopsAreEverybodys) {
  for (const char* path :
       {"/api/panel/emergency-stop", "/api/channels/0/feed-hold", "/api/channels/0/jog-stop", "/api/session"})
    EXPECT_FALSE(role_for("POST", path)) << path;
}

TEST(Rights, NothingElseIsDoneWithoutALogin) {
  std::set<std::string> free;
  for (const auto& route : routes()) {
    Match found;
    found.operation = route.operation;
    found.command = route.command;
    if (!needed_role(found)) free.insert(std::string(route.method) + " " + route.pattern);
  }
  EXPECT_EQ(free, (std::set<std::string>{
                      "POST /api/panel/emergency-stop", "POST /api/channels/{channel}/feed-hold",
                      "POST /api/channels/{channel}/jog-stop", "GET /api/session", "POST /api/session",
                      "DELETE /api/session", "GET /api/openapi.json", "POST /api/measurement/abort"}));
}

TEST(Rights, EveryRouteStatesItsRole) {
  for (const auto& route : routes()) {
    Match found;
    found.operation = route.operation;
    found.command = route.command;
    EXPECT_NE(needed_role(found), Role::administrator) << route.method << " " << route.pattern;
  }
}

TEST(Rights, OperatorsRunTheMachineAndSettersChangeWhatItWorksWith) {
  EXPECT_EQ(role_for("POST", "/api/channels/0/cycle-start"), Role::machine_operator);
  EXPECT_EQ(role_for("GET", "/api/status"), Role::machine_operator);
  EXPECT_EQ(role_for("GET", "/api/stream"), Role::machine_operator);
  EXPECT_EQ(role_for("POST", "/api/panel/release"), Role::machine_operator);
  for (const char* path :
       {"/api/tools/3", "/api/work-offsets", "/api/parameters/100034", "/api/parameters", "/api/programs/A"})
    EXPECT_EQ(role_for("PUT", path), Role::setter) << path;
  EXPECT_EQ(role_for("DELETE", "/api/recordings/a.mcap"), Role::setter);
}

TEST(Rights, OrdersToTheMachineNeedTheRightToOperateAndStopsAndFilesDoNot) {
  const auto needs = [](std::string_view method, std::string_view path) {
    const auto found = match(method, path);
    EXPECT_EQ(found.result, RouteResult::found) << path;
    return needs_operating_right(found);
  };
  for (const char* path :
       {"/api/channels/0/cycle-start", "/api/channels/0/jog", "/api/channels/0/jog-renew",
        "/api/channels/0/mdi", "/api/panel/release", "/api/alarms/reset", "/api/plc/force",
        "/api/plc/release", "/api/plc/load/take-over", "/api/measurement/start", "/api/measurement/continue",
        "/api/measurement/confirm", "/api/measurement/discard", "/api/measurement/undo",
        "/api/measurement/manual/write"})
    EXPECT_TRUE(needs("POST", path)) << path;
  for (const char* path : {"/api/tools/3", "/api/work-offsets", "/api/parameters/11", "/api/parameters"})
    EXPECT_TRUE(needs("PUT", path)) << path;
  for (const char* path :
       {"/api/panel/emergency-stop", "/api/channels/0/feed-hold", "/api/channels/0/jog-stop", "/api/session",
        "/api/operating-right", "/api/recordings", "/api/check/0", "/api/plc/trace", "/api/measurement/abort",
        "/api/measurement/manual"})
    EXPECT_FALSE(needs("POST", path)) << path;
  EXPECT_FALSE(needs("PUT", "/api/programs/A"));
  for (const auto& route : routes())
    if (route.method == "GET") {
      Match found;
      found.operation = route.operation;
      EXPECT_FALSE(needs_operating_right(found)) << route.pattern;
    }
}

TEST(Rights, TheMachineBuilderChangesWhatThePlcDoes) {
  for (const char* path : {"/api/plc/force", "/api/plc/release", "/api/plc/load", "/api/plc/load/take-over"})
    EXPECT_EQ(role_for("POST", path), Role::builder) << path;
  EXPECT_EQ(role_for("GET", "/api/plc/variables"), Role::machine_operator);
  EXPECT_EQ(role_for("GET", "/api/plc/watch"), Role::machine_operator);
}

TEST(Rights, WhatAPageAsksByItselfDoesNotProlongASession) {
  for (const char* path : {"/api/session", "/api/stream", "/api/plc/image", "/api/operating-right"})
    EXPECT_FALSE(prolongs_session(match("GET", path).operation)) << path;
  EXPECT_TRUE(prolongs_session(match("POST", "/api/channels/0/mdi").operation));
  EXPECT_TRUE(prolongs_session(match("GET", "/api/programs").operation));
}

TEST(Rights, ACookieIsFoundByItsWholeName) {
  EXPECT_EQ(cookie_value("trunnion_session=abc", "trunnion_session"), "abc");
  EXPECT_EQ(cookie_value("a=1; trunnion_session=x=y; b=2", "trunnion_session"), "x=y");
  for (const char* header : {"", ";", "=", "xtrunnion_session=1", "trunnion_session", "a=trunnion_session=1"})
    EXPECT_EQ(cookie_value(header, "trunnion_session"), "") << header;
  EXPECT_EQ(bearer_token("Bearer abc"), "abc");
  EXPECT_EQ(bearer_token("Basic abc"), "");
  EXPECT_TRUE(is_loopback("127.0.0.1"));
  EXPECT_TRUE(is_loopback("::1"));
  EXPECT_FALSE(is_loopback("0.0.0.0"));
  EXPECT_FALSE(is_loopback("::"));
}

}  // namespace
}  // namespace trunnion::gateway
