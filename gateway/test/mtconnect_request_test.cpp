// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/request.hpp"

#include <gtest/gtest.h>

#include "mtconnect/documents.hpp"

namespace trunnion::gateway::mtconnect {
namespace {

Request parse(std::string_view target) { return parse_request("GET", target, "mill", "mill.host", 1000); }

std::string refusal(std::string_view target, std::string_view method = "GET") {
  try {
    parse_request(method, target, "mill", "mill.host", 1000);
  } catch (const RequestError& error) {
    return std::to_string(error.status) + " " + error.code;
  }
  return "accepted";
}

TEST(MtconnectRequest, NamesADeviceAndWhatIsAskedOfIt) {
  for (const char* target :
       {"/", "", "/probe", "/mill", "/mill/probe", "/mill.host/probe", "/probe?pretty=true"})
    EXPECT_EQ(parse(target).kind, Kind::probe) << target;
  EXPECT_EQ(parse("/mill/current").kind, Kind::current);
  EXPECT_EQ(parse("/sample").kind, Kind::sample);
  EXPECT_EQ(parse("/sample").count, 100) << "the standard's default";
  EXPECT_EQ(parse("/sample").heartbeat, 10000u) << "ms, the standard's default";
  EXPECT_EQ(parse("/assets/T1;T2").assets, (std::vector<std::string>{"T1", "T2"}));
  EXPECT_EQ(parse("/asset/T1").assets, std::vector<std::string>{"T1"});
}

TEST(MtconnectRequest, HasParametersWithLimits) {
  const auto request = parse("/sample?from=7&count=-5&path=//Axes%5B1%5D&heartbeat=500");
  EXPECT_EQ(request.from, 7u);
  EXPECT_EQ(request.count, -5);
  EXPECT_EQ(request.path, "//Axes[1]");
  EXPECT_EQ(request.heartbeat, 500u);
  EXPECT_EQ(parse("/sample?count=1000").count, 1000) << "the size of the buffer";
  EXPECT_EQ(parse("/current?at=3").at, 3u);
  EXPECT_EQ(parse("/current?interval=0").interval, 0u);
  for (const char* target :
       {"/sample?count=1001", "/sample?count=-1001", "/sample?count=0", "/sample?from=-1",
        "/sample?interval=3600001", "/sample?interval=1&heartbeat=0", "/assets?count=0"})
    EXPECT_EQ(refusal(target), "400 OUT_OF_RANGE") << target;
}

TEST(MtconnectRequest, IsRefusedWithTheStandardsCode) {
  EXPECT_EQ(refusal("/probe", "PUT"), "405 UNSUPPORTED");
  EXPECT_EQ(refusal("/lathe"), "404 NO_DEVICE");
  EXPECT_EQ(refusal("/lathe/current"), "404 NO_DEVICE");
  EXPECT_EQ(refusal("/mill/nothing"), "404 INVALID_URI");
  EXPECT_EQ(refusal("/current/x"), "404 INVALID_URI");
  EXPECT_EQ(refusal("/%4"), "404 INVALID_URI");
  for (const char* target :
       {"/sample?from", "/sample?=1", "/sample?from=%", "/sample?from=1&from=1", "/sample?from=1x",
        "/sample?from=", "/sample?at=1", "/current?from=1", "/probe?path=//Axes", "/current?at=1&interval=5",
        "/sample?count=-1&interval=5", "/sample?from=99999999999999999999"})
    EXPECT_EQ(refusal(target), "400 INVALID_REQUEST") << target;
  EXPECT_EQ(refusal("/current?path=" + std::string(1025, 'x')), "400 INVALID_PATH");
}

// 73 bytes of nested predicates took a core for ever.
TEST(MtconnectRequest, HasNoPathThatLooksAtAllNodesForEachNode) {
  for (const char* path :
       {"//*[count(//*[count(//*[count(//*[count(//*[count(//*)>1])>1])>1])>1])>1]", "//*[//*]", "//*[a/b]",
        "//*[.//*]", "//*[..]/*[../*]", "//*[descendant::*]", "//*[a|b]", "//*[@a[1]]", "count(//*)",
        "sum(//*)", "//*[string-length(@id)>1]", "//*[@id='x]", "//*[count%20(//*)]", "//*[count%09(@id)]"})
    EXPECT_EQ(refusal(std::string("/current?path=") + path), "400 INVALID_PATH") << path;
  for (const char* path :
       {"//Axes", "//Axes[1]", "//DataItem[@type=%22POSITION%22]", "//Linear[@name='X']//DataItem",
        "//Controller|//Axes", "//DataItem[@type='POSITION'%20and%20@subType='ACTUAL']", "//Axes/*[last()]",
        "//DataItem[not(@subType)]", "//*[@id='a/b[c]*']", "//DataItem[starts-with(@id,'x')]",
        "/MTConnectDevices/Devices/Device//Linear", "(//Linear)[2]",
        "//DataItem[@type='POSITION'%20and%20(@id='x')]"})
    EXPECT_EQ(parse(std::string("/current?path=") + path).kind, Kind::current) << path;
}

}  // namespace
}  // namespace trunnion::gateway::mtconnect
