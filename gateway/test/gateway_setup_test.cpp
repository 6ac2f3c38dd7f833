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

TEST_F(Gateway, AnOrderIsAnsweredWhileAProgramIsChecked) {
  std::atomic<bool> checked = false;
  Response answer;
  std::thread waiting([&] {
    answer = http_client::request(port_, "POST", "/api/check/0", "N1 #1=1\nGOTO 1\n");
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

}  // namespace
}  // namespace trunnion::gateway
