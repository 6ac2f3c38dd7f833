// SPDX-License-Identifier: Apache-2.0
// Tools, several parameters, revisions of programs and checks of texts over HTTP.
#include "gateway_fixture.hpp"

namespace trunnion::gateway {
namespace {

TEST_F(Gateway, AToolReachesTheParametersServiceWithItsRevision) {
  const json tool = {{"length", 80.5},   {"length_wear", 0}, {"radius", 4},
                     {"radius_wear", 0}, {"name", "drill"},  {"revision", 3}};
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/tools/7", tool.dump()).status, 200);
  EXPECT_EQ(http_client::request(port_, "DELETE", "/api/tools/7?revision=4").status, 200);
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/tools/0", tool.dump()).status, 404);
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/tools/7", "{\"length\":1}").status, 400);
  cluster([](auto& c) {
    ASSERT_EQ(c.parameter_requests.size(), 2u) << "what is not whole never reaches the bus";
    EXPECT_EQ(c.parameter_requests[0].operation, idl::parameters::Operation::SET_TOOL);
    EXPECT_EQ(c.parameter_requests[0].revision, 3u);
    EXPECT_EQ(c.parameter_requests[0].tools.at(0).length, 80.5);
    EXPECT_EQ(c.parameter_requests[1].operation, idl::parameters::Operation::REMOVE_TOOL);
    EXPECT_EQ(c.parameter_requests[1].revision, 4u);
  });
}

TEST_F(Gateway, SeveralParametersAreOneRequest) {
  const json values = {{"values", {{{"number", 100034}, {"value", 1}}, {{"number", 101034}, {"value", 2}}}}};
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/parameters", values.dump()).status, 200);
  EXPECT_EQ(
      http_client::request(port_, "PUT", "/api/parameters", "{\"values\":[{\"number\":999,\"value\":1}]}")
          .status,
      400);
  cluster([](auto& c) {
    ASSERT_EQ(c.parameter_requests.size(), 1u);
    EXPECT_EQ(c.parameter_requests[0].operation, idl::parameters::Operation::IMPORT);
    EXPECT_EQ(c.parameter_requests[0].values.size(), 2u);
  });
}

TEST_F(Gateway, ParametersAreChangedOnlyWhileNothingElseHasChangedThem) {
  const auto tag = [&] { return get("/api/parameters/100034").headers["etag"]; };
  const auto put = [&](const std::string& condition) {
    return http_client::request(port_, "PUT", "/api/parameters/100034", R"({"value": 7})",
                                condition.empty() ? "" : "If-Match: " + condition + "\r\n")
        .status;
  };
  const auto first = tag();
  EXPECT_EQ(get("/api/parameters?limit=1").headers["etag"], first) << "of the whole set";
  EXPECT_EQ(put("\"0.0\""), 412);
  EXPECT_EQ(put(first), 200);
  EXPECT_EQ(put(first), 412) << "at once, before the set is published";
  ASSERT_TRUE(eventually([&] { return tag() != first; }));
  EXPECT_EQ(put(first), 412);
  const json values = {{"values", {{{"number", 100034}, {"value", 1}}}}};
  const auto import = [&](const std::string& condition) {
    return http_client::request(port_, "PUT", "/api/parameters", values.dump(),
                                "If-Match: " + condition + "\r\n")
        .status;
  };
  EXPECT_EQ(import(first), 412);
  EXPECT_EQ(import(tag()), 200);
  EXPECT_EQ(put(""), 200) << "without a condition";
  EXPECT_EQ(cluster([](auto& c) { return c.parameter_requests.size(); }), 3u);
}

TEST_F(Gateway, ToolsAndWorkOffsetsAreChangedOnlyWhileTheirTablesAreTheSame) {
  const json tool = {
      {"length", 80.5}, {"length_wear", 0}, {"radius", 4}, {"radius_wear", 0}, {"name", "drill"}};
  const json offset = {{"channel", 0}, {"index", 1}, {"values", {1, 2, 3, 0, 0, 0, 0, 0, 0}}};
  const auto ask = [&](const char* method, const char* target, const json& body, const std::string& tag) {
    return http_client::request(port_, method, target, body.dump(), "If-Match: " + tag + "\r\n").status;
  };
  EXPECT_EQ(get("/api/tools").headers["etag"], "\"1\"");
  EXPECT_EQ(ask("PUT", "/api/tools/7", tool, "\"2\""), 412);
  EXPECT_EQ(ask("DELETE", "/api/tools/7", json::object(), "\"2\""), 412);
  EXPECT_EQ(ask("PUT", "/api/tools/7", tool, "\"1\""), 200);
  EXPECT_EQ(ask("PUT", "/api/tools/7", tool, "*"), 200);
  const auto offsets = get("/api/work-offsets").headers["etag"];
  EXPECT_EQ(ask("PUT", "/api/work-offsets", offset, "\"77\""), 412);
  EXPECT_EQ(ask("PUT", "/api/work-offsets", offset, offsets), 200);
  EXPECT_TRUE(eventually([&] { return get("/api/work-offsets").headers["etag"] != offsets; }));
  cluster([](auto& c) {
    ASSERT_EQ(c.parameter_requests.size(), 3u);
    EXPECT_EQ(c.parameter_requests[0].revision, 1u) << "the service compares, too";
    EXPECT_EQ(c.parameter_requests[1].revision, 0u) << "any";
    EXPECT_EQ(c.parameter_requests[2].revision, 1u);
  });
}

TEST_F(Gateway, ListsComeByPages) {
  const auto all = json::parse(get("/api/tools").body)["tools"];
  ASSERT_EQ(all.size(), 2u);
  const auto second = get("/api/tools?offset=1&limit=5");
  EXPECT_EQ(json::parse(second.body)["tools"], json::array({all[1]}));
  EXPECT_EQ(second.headers.at("x-total-count"), "2");
  for (const auto& [path, member, total] : {std::tuple{"/api/programs", "programs", "1"},
                                            {"/api/alarms", "alarms", "1"},
                                            {"/api/recordings", "recordings", "0"}}) {
    const auto none = get(std::string(path) + "?limit=0");
    EXPECT_EQ(json::parse(none.body)[member], json::array()) << path;
    EXPECT_EQ(none.headers.at("x-total-count"), total) << path;
    EXPECT_EQ(get(std::string(path) + "?offset=x").status, 400) << path;
  }
}

TEST_F(Gateway, AProgramIsStoredOnlyInPlaceOfTheRevisionThatIsNamed) {
  const auto put = [&](const std::string& text, const std::string& header) {
    return http_client::request(port_, "PUT", "/api/programs/PART", text, header).status;
  };
  EXPECT_EQ(put("G0 X1\n", "If-Match: \"1\"\r\n"), 412) << "there is none";
  EXPECT_EQ(put("G0 X1\n", "If-None-Match: *\r\n"), 200);
  EXPECT_EQ(put("G0 X2\n", "If-None-Match: *\r\n"), 412) << "at once, before the list has it";
  EXPECT_EQ(put("G0 X3\n", "If-Match: \"99\"\r\n"), 412);
  cluster([](auto& c) {
    const auto& stored = c.programs.at("PART");
    EXPECT_EQ(std::string(stored.begin(), stored.end()), "G0 X1\n");
  });
}

// A loop that reads the clock is not found to repeat for ever: it may wait for a time.
TEST_F(Gateway, AnOrderIsAnsweredWhileAProgramIsChecked) {
  std::atomic<bool> checked = false;
  Response answer;
  std::thread waiting([&] {
    answer = http_client::request(port_, "POST", "/api/check/0", "N1 IF [#3001 LT 1] GOTO 1\n");
    checked = true;
  });
  EXPECT_EQ(post("/api/panel/emergency-stop").status, 200);
  const bool before = checked;
  waiting.join();
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(json::parse(answer.body)["complete"], false) << "the endless program was stopped";
  EXPECT_FALSE(before) << "the order did not wait for it";
  EXPECT_EQ(http_client::request(port_, "POST", "/api/check/9", "M30").status, 404);
}

TEST_F(Gateway, AStoredProgramIsPlannedAndPlannedAnewWhenItsTextHasChanged) {
  const auto put = [&](const std::string& text) {
    return http_client::request(port_, "PUT", "/api/programs/PLANNED", text).status;
  };
  ASSERT_EQ(put("G4 P1000\nM30\n"), 200);
  const auto plan = [&] { return json::parse(get("/api/programs/PLANNED/plan?channel=0").body); };
  const auto first = plan();
  ASSERT_TRUE(first.contains("seconds")) << first;
  // The channel of the test has no axes: dwells of 1 s and of 3 s.
  EXPECT_NEAR(first["seconds"].get<double>(), 1, 0.1) << first;
  EXPECT_EQ(first["program"], "PLANNED");
  EXPECT_EQ(plan(), first);
  ASSERT_EQ(put("G4 P3000\nM30\n"), 200);
  EXPECT_TRUE(eventually([&] { return std::abs(plan()["seconds"].get<double>() - 3) < 0.1; }));
  EXPECT_EQ(get("/api/programs/MISSING/plan").status, 404);
  EXPECT_EQ(get("/api/programs/PLANNED/plan?channel=9").status, 404);
}

}  // namespace
}  // namespace trunnion::gateway
