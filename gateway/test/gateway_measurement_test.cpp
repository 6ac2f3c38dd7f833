// SPDX-License-Identifier: Apache-2.0
// The undo of a calibration, the inputs that a machine offers, and its bodies, over HTTP.
#include "gateway_fixture.hpp"

namespace trunnion::gateway {
namespace {

constexpr const char* calibrated =
    R"({"time":"T1","who":"ann calibrate","what":"parameter","number":40433,"old":0.125,"new":0.25})"
    "\n"
    R"({"time":"T1","who":"ann calibrate","what":"parameter","number":40435,"old":0,"new":0.5})"
    "\n";

class CalibrationUndo : public Gateway {
 protected:
  void journal(const std::string& text) { std::ofstream(state_ + "/journal.jsonl") << text; }
  std::string refusal(const char* method) {
    const auto answer = http_client::request(port_, method, "/api/measurement/undo", "{}");
    EXPECT_EQ(answer.status, 409) << answer.body;
    return json::parse(answer.body).value("detail", "");
  }
  std::size_t asked() {
    std::size_t count = 0;
    cluster([&](auto& c) { count = c.parameter_requests.size(); });
    return count;
  }
};

TEST_F(CalibrationUndo, IsOneImportOfTheValuesBefore) {
  journal(calibrated);
  const auto last = json::parse(get("/api/measurement/undo").body);
  EXPECT_EQ(last["who"], "ann calibrate");
  EXPECT_EQ(last["changes"].size(), 2u);
  EXPECT_EQ(asked(), 0u) << "reading changes nothing";
  const auto answer = post("/api/measurement/undo");
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(json::parse(answer.body)["changes"], last["changes"]);
  cluster([](auto& c) {
    ASSERT_EQ(c.parameter_requests.size(), 1u);
    const auto& request = c.parameter_requests[0];
    EXPECT_EQ(request.operation, idl::parameters::Operation::IMPORT);
    EXPECT_EQ(request.who, "127.0.0.1 calibrate undo");
    ASSERT_EQ(request.values.size(), 2u);
    EXPECT_EQ(request.values[0].number, 40433u);
    EXPECT_EQ(request.values[0].value, 0.125);
    EXPECT_EQ(request.values[1].value, 0);
  });
}

TEST_F(CalibrationUndo, IsRefusedInOneLineWhenThereIsNoneOrAValueWasChangedSince) {
  for (const char* method : {"GET", "POST"}) {
    std::filesystem::remove(state_ + "/journal.jsonl");
    EXPECT_TRUE(refusal(method).starts_with("the journal of the parameters is not there")) << refusal(method);
    journal("");
    EXPECT_EQ(refusal(method), "the journal has no calibration");
    journal(std::string(calibrated) +
            R"({"time":"T2","who":"bob","what":"parameter","number":40433,"old":0.25,"new":1})" + "\n");
    EXPECT_EQ(refusal(method), "parameter 040433 was changed after the calibration of T1; nothing undone");
  }
  EXPECT_EQ(http_client::request(port_, "POST", "/api/measurement/undo", "{\"number\":1}").status, 400);
  EXPECT_EQ(asked(), 0u);
}

const json readings = {{"readings",
                        {{"x1", -250.3},
                         {"x2", -150.42},
                         {"y1", -240},
                         {"y2", -140.4},
                         {"offy_z1", 0.2},
                         {"zc_z1", -100},
                         {"zc_y1", -40},
                         {"zc_z2", -380},
                         {"tool_radius", 5}}}};

class ManualCalibration : public CalibrationUndo {
 protected:
  void SetUp() override {
    CalibrationUndo::SetUp();
    // An AC table: A about -X, C about -Z, both through machine X0 Y0 Z-400.
    json values = json::array();
    for (const auto& [number, value] : {std::pair(40425, 35), {40426, -1}, {40431, -1}, {40437, -400}})
      values.push_back({{"number", number}, {"value", value}});
    const auto written =
        http_client::request(port_, "PUT", "/api/parameters", json({{"values", values}}).dump());
    ASSERT_EQ(written.status, 200) << written.body;
    ASSERT_TRUE(eventually([&] { return get("/api/measurement/manual").status == 200; }));
    cluster([](auto& c) { c.parameter_requests.clear(); });
  }
};

TEST_F(ManualCalibration, ReadingsOfADialAreEvaluatedAndWrittenAsACalibration) {
  const auto steps = get("/api/measurement/manual?language=de");
  ASSERT_EQ(steps.status, 200) << steps.body;
  const auto guide = json::parse(steps.body);
  EXPECT_EQ(guide["kind"], "ac-table") << guide;
  const auto evaluated = post("/api/measurement/manual", readings);
  ASSERT_EQ(evaluated.status, 200) << evaluated.body;
  EXPECT_EQ(asked(), 0u) << "an evaluation changes nothing";
  const auto written = post("/api/measurement/manual/write", readings);
  ASSERT_EQ(written.status, 200) << written.body;
  EXPECT_EQ(json::parse(written.body)["after"], json::parse(evaluated.body)["after"]);
  cluster([&](auto& c) {
    ASSERT_EQ(c.parameter_requests.size(), 1u);
    const auto& request = c.parameter_requests[0];
    EXPECT_EQ(request.operation, idl::parameters::Operation::IMPORT);
    EXPECT_EQ(request.who, "127.0.0.1 calibrate");
    EXPECT_EQ(request.values.size(), json::parse(written.body)["changes"].size());
    EXPECT_GE(request.values.size(), 4u);
  });
}

TEST_F(ManualCalibration, ReadingsThatAreMissingOrWrongWriteNothing) {
  for (const json& body : {json::object(), json({{"readings", {{"x1", 1}}}}), json({{"displacements", {1}}})})
    EXPECT_EQ(post("/api/measurement/manual/write", body).status, 400) << body;
  auto nowhere = readings;
  nowhere["channel"] = 7;
  EXPECT_EQ(post("/api/measurement/manual/write", nowhere).status, 404);
  EXPECT_EQ(get("/api/measurement/manual?language=fr").status, 400);
  EXPECT_EQ(get("/api/measurement/manual?alpha=91").status, 400);
  EXPECT_EQ(asked(), 0u);
}

class MachineOfThreeAxes : public Gateway {
 protected:
  void SetUp() override {
    machine_directory_ = testing::TempDir() + "/gateway_three_axes_" + std::to_string(getpid());
    std::filesystem::copy(MACHINE, machine_directory_, std::filesystem::copy_options::recursive);
    std::ofstream(machine_directory_ + "/parameters.yaml") << "\"040000\": MILL\n";
    Gateway::SetUp();
  }
  void TearDown() override {
    Gateway::TearDown();
    std::filesystem::remove_all(machine_directory_);
  }
};

TEST_F(MachineOfThreeAxes, OffersNoInputsOfAMeasurementAndSaysWhy) {
  const auto answer = get("/api/measurement/inputs");
  EXPECT_EQ(answer.status, 409) << answer.body;
  EXPECT_EQ(json::parse(answer.body).value("detail", ""),
            "gateway-test has 0 rotary axes in its transformation: 1 or 2 can be measured");
  EXPECT_EQ(get("/api/measurement/inputs?channel=7").status, 404);
  EXPECT_EQ(get("/api/measurement/inputs?channel=x").status, 404);
}

TEST_F(MachineOfThreeAxes, HasNoManualCalibrationAndSaysWhy) {
  for (const auto& answer : {get("/api/measurement/manual"), post("/api/measurement/manual", readings)}) {
    EXPECT_EQ(answer.status, 409) << answer.body;
    EXPECT_NE(answer.body.find("measure this machine with the probe"), std::string::npos) << answer.body;
  }
}

TEST_F(MachineOfThreeAxes, HasTheBodiesOfItsFileAsItIsNow) {
  const auto bodies = [&] { return json::parse(get("/api/bodies/0").body); };
  const auto file = machine_directory_ + "/bodies.yaml";
  const auto derived = bodies();
  EXPECT_EQ(derived["derived"], true) << derived;
  EXPECT_EQ(derived["structure"], "[w b X Y Z (S) t]");
  EXPECT_EQ(derived["tool_side"][2]["axis"], "Z");

  std::ofstream(file) << "bodies:\n- {name: nose, on: spindle, sphere: {diameter_mm: 80}}\n";
  const auto described = bodies();
  EXPECT_EQ(described["derived"], false) << described;
  EXPECT_EQ(described["channel"], 0);
  ASSERT_EQ(described["bodies"].size(), 1u) << described;
  EXPECT_EQ(described["bodies"][0]["name"], "nose");

  std::ofstream(file) << "bodies:\n- {name: nose, on: spindle, sphere: {diameter_mm: -1}}\n";
  const auto refused = get("/api/bodies/0");
  EXPECT_EQ(refused.status, 409);
  EXPECT_NE(refused.body.find("bodies.yaml:2:"), std::string::npos) << refused.body;
  EXPECT_EQ(get("/api/bodies/7").status, 404);
}

}  // namespace
}  // namespace trunnion::gateway
