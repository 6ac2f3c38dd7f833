// SPDX-License-Identifier: Apache-2.0
#include "core/plc_requests.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

using idl::plc::OnlineAction;
using idl::plc::TraceCondition;

/// The field that is refused; empty when nothing is.
template <class Make>
std::string refused(Make make, const char* body) {
  try {
    make(parse_body(body));
    return {};
  } catch (const BadRequest& bad) {
    return bad.field;
  }
}

TEST(PlcRequests, AForceNamesPathsAndLiterals) {
  const auto request = force_request(
      parse_body(R"({"values": [{"path": "main.n", "value": "5"}, {"path": "%X0.3", "value": "TRUE"}]})"));
  EXPECT_EQ(request.action, OnlineAction::FORCE);
  EXPECT_EQ(std::vector<std::string>(request.paths.begin(), request.paths.end()),
            (std::vector<std::string>{"main.n", "%X0.3"}));
  EXPECT_EQ(std::vector<std::string>(request.values.begin(), request.values.end()),
            (std::vector<std::string>{"5", "TRUE"}));
  EXPECT_FALSE(request.permanent);
  EXPECT_EQ(refused(force_request, "{}"), "values");
  EXPECT_EQ(refused(force_request, R"({"values": []})"), "values");
  EXPECT_EQ(refused(force_request, R"({"values": [{"path": "a"}]})"), "value");
  EXPECT_EQ(refused(force_request, R"({"values": [{"path": "a", "value": 5}]})"), "value");
  EXPECT_EQ(refused(force_request, R"({"values": [{"path": "a", "value": "5"}], "permanent": 1})"),
            "permanent");
}

TEST(PlcRequests, AReleaseWithoutPathsIsOfAll) {
  EXPECT_TRUE(release_request(parse_body("")).paths.empty());
  EXPECT_EQ(release_request(parse_body(R"({"paths": ["a"]})")).paths.size(), 1u);
  EXPECT_EQ(refused(release_request, R"({"paths": []})"), "paths") << "an empty choice is not everything";
  EXPECT_EQ(refused(release_request, R"({"path": "a"})"), "path");
}

TEST(PlcRequests, AWatchHas256PathsAtMost) {
  bus::Json body = {{"paths", bus::Json::array()}};
  for (int i = 0; i < 256; ++i) body["paths"].push_back("main.n");
  EXPECT_EQ(watch_request(body).paths.size(), 256u);
  body["paths"].push_back("main.n");
  EXPECT_THROW(watch_request(body), BadRequest);
  EXPECT_THROW(watch_request({{"paths", {std::string(241, 'x')}}}), BadRequest) << "240 bytes are the bound";
}

TEST(PlcRequests, ATraceBeginsAtOnceOrWithACondition) {
  const auto at_once = trace_request(parse_body(R"({"paths": ["a"]})"));
  EXPECT_EQ(at_once.scans, 1000u);
  EXPECT_EQ(at_once.condition, TraceCondition::AT_ONCE);
  const auto later = trace_request(
      parse_body(R"({"paths": ["a"], "scans": 7, "when": {"path": "b", "is": "<", "value": "3"}})"));
  EXPECT_EQ(later.scans, 7u);
  EXPECT_EQ(later.condition, TraceCondition::LESS);
  EXPECT_EQ(later.condition_path, "b");
  EXPECT_EQ(later.condition_value, "3");
  EXPECT_EQ(
      trace_request(parse_body(R"({"paths": ["a"], "when": {"path": "b", "is": "changed"}})")).condition,
      TraceCondition::CHANGED);
  EXPECT_EQ(refused(trace_request, R"({"paths": ["a"], "scans": 0})"), "scans");
  EXPECT_EQ(refused(trace_request, R"({"paths": ["a"], "when": {"path": "b", "is": "~", "value": "3"}})"),
            "is");
  EXPECT_EQ(refused(trace_request, R"({"paths": ["a"], "when": {"path": "b", "is": "="}})"), "value");
  EXPECT_EQ(refused(trace_request, R"({"paths": ["a"], "when": 3})"), "when");
}

TEST(PlcRequests, ALoadIsItsFilesInPartsAndTheirTranslation) {
  const std::string text(70000, 'x');
  const auto files =
      load_files({{"files", {{{"name", "main.st"}, {"text", text}}, {{"name", "a.st"}, {"text", ""}}}}});
  const auto requests = load_requests(files);
  // BEGIN_LOAD, 70000 bytes in parts of 30000, one part of the empty file, COMPILE.
  ASSERT_EQ(requests.size(), 1u + 3u + 1u + 1u);
  EXPECT_EQ(requests.front().action, OnlineAction::BEGIN_LOAD);
  EXPECT_EQ(requests.back().action, OnlineAction::COMPILE);
  std::string sent;
  for (const auto& request : requests)
    if (request.action == OnlineAction::WRITE_SOURCE && request.file == "main.st")
      sent.append(request.data.begin(), request.data.end());
  EXPECT_EQ(sent, text);
  EXPECT_EQ(requests[4].file, "a.st");
  EXPECT_EQ(refused(load_files, R"({"files": [{"name": "main.st"}]})"), "text");
  EXPECT_EQ(refused(load_files, R"({"files": ["main.st"]})"), "files");
}

}  // namespace
}  // namespace trunnion::gateway
