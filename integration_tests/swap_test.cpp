// SPDX-License-Identifier: Apache-2.0
// Services of a running cluster are replaced by others; a program on the machine notices nothing.
#include <nlohmann/json.hpp>

#include "bus/contract.hpp"
#include "cluster/swap_ticket.hpp"
#include "cluster_harness.hpp"
#include "machine/services.hpp"
#include "machine_copy.hpp"

namespace trunnion::integration {
namespace {

using idl::service::SwapOutcome;
using idl::service::SwapReply;

// `rounds` of 0.4 m with both rotary axes: about 10 s of motion each.
std::string sweep(int rounds) {
  std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  for (int i = 0; i < rounds; ++i) text += "X60 Y30 A20 C40 F6000\nX-60 Y-30 A-10 C-20\n";
  return text + "X0 Y0 A0 C0\nG49\nM30\n";
}

// Short moves with an M code and an order to the spindle between them.
std::string functions(int rounds) {
  std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nM3 S1000\n";
  for (int i = 0; i < rounds; ++i)
    text += "M8\nG1 X6 Y3 A2 C4 F6000\nS" + std::to_string(900 + i % 7 * 20) + "\nX-6 Y-3 A-2 C-4\nM9\nX0\n";
  return text + "M5\nM30\n";
}

class Swapping : public testing::Test {
 protected:
  // As `trunnion swap` does.
  static SwapReply swap(Cluster& cluster, const std::string& service, const std::string& executable = "",
                        const std::string& vendor = "", std::uint32_t cycles = 500) {
    idl::service::SwapRequest request;
    request.service = service, request.executable = executable, request.vendor = vendor,
    request.cycles = cycles;
    service::RequestClient<idl::service::SwapRequest, idl::service::SwapReply> client(
        cluster.client().bus(), topics::swap_request, topics::swap_reply);
    cluster::put_ticket(cluster.running().run.path(), request);
    client.send(request);
    std::optional<SwapReply> reply;
    EXPECT_TRUE(cluster.until([&] { return (reply = client.poll()).has_value(); }, 60)) << cluster.told();
    if (reply)
      std::printf("%s: %s, %u cycles compared, %.3f s, gap %.3f s %s\n", service.c_str(),
                  reply->accepted ? "swapped" : "kept", reply->compared, reply->seconds, reply->gap,
                  reply->reason.c_str());
    return reply.value_or(SwapReply{});
  }
  // Moving, or waiting for an M function.
  static bool runs(Cluster& cluster) {
    return cluster.state() == RunState::RUNNING || cluster.state() == RunState::WAITING;
  }
  static int pid(Cluster& cluster, const std::string& service) { return cluster.service(service)->pid; }
  static nlohmann::json last_line(const Cluster& cluster) {
    std::ifstream in(cluster.running().state_directory + "/" + cluster::swap_journal_file);
    std::string line, last;
    while (std::getline(in, line)) last = line;
    return nlohmann::json::parse(last, nullptr, false);
  }
  static std::string variant(const std::string& name) { return cluster::binary_directory() + "/" + name; }

  // The first `count` cycles of the program on a machine that nothing happens to.
  static Rows reference(const std::string& program, std::size_t count,
                        const std::string& machine = "ac-table") {
    Cluster cluster(machine);
    cluster.keep_rows = true;
    cluster.start_text(program);
    EXPECT_TRUE(cluster.until([&] { return cluster.rows.size() >= count; }, 100)) << cluster.told();
    cluster.rows.resize(count);
    return cluster.rows;
  }
};

TEST_F(Swapping, StagesAreSwappedInMotionAndNoBitChanges) {
  const auto program = sweep(3000);
  Rows rows;
  {
    Cluster cluster("ac-table");
    cluster.keep_rows = true;
    cluster.start_text(program);
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > 500; }));
    for (const auto& stage : machine::transforming_stages())
      for (const std::string vendor : {"fastdds", "cyclonedds"}) {
        const auto before = pid(cluster, stage);
        const auto reply = swap(cluster, stage, "", vendor);
        ASSERT_TRUE(reply.accepted) << stage << " " << reply.reason;
        EXPECT_GE(reply.compared, 500u);
        EXPECT_EQ(reply.gap, 0);
        EXPECT_NE(kill(before, 0), 0) << "the old one is gone";
        EXPECT_TRUE(cluster.until([&] { return pid(cluster, stage) != before && cluster.ready(); }));
        EXPECT_EQ(cluster.service(stage)->vendor, vendor);
        const auto line = last_line(cluster);
        EXPECT_EQ(line["service"], stage);
        EXPECT_EQ(line["new"]["vendor"], vendor);
        EXPECT_EQ(line["new"]["contract"], bus::contract_of(stage));
        EXPECT_EQ(line["old"]["crc32"], line["new"]["crc32"]) << "the same executable";
        EXPECT_EQ(line["cycle"], reply.cycle);
      }
    const auto after = cluster.expected_cycle + 500;
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > after; })) << cluster.told();
    EXPECT_EQ(cluster.state(), RunState::RUNNING) << cluster.told();
    EXPECT_EQ(cluster.feedback.starved, 0u);
    EXPECT_TRUE(cluster.history.empty()) << cluster.told();
    rows = std::move(cluster.rows);
  }
  EXPECT_EQ(first_difference(rows, reference(program, rows.size())), "")
      << "over " << rows.size() << " cycles";
}

TEST_F(Swapping, AStageThatComputesOtherwiseIsNotTaken) {
  Cluster cluster("ac-table");
  cluster.start_text(sweep(3000));
  for (const auto& stage : machine::transforming_stages()) {
    const auto before = pid(cluster, stage);
    // It is wrong in the last bit of one cycle in a thousand.
    const auto reply = swap(cluster, stage, variant(stage + "_one_bit"), "", 100000);
    EXPECT_FALSE(reply.accepted);
    EXPECT_EQ(reply.outcome, SwapOutcome::DIFFERENT);
    EXPECT_TRUE(reply.difference.starts_with("cycle ")) << reply.difference;
    EXPECT_NE(reply.difference.find("column 0: "), std::string::npos) << reply.difference;
    EXPECT_NE(reply.reason.find("differs in " + reply.difference), std::string::npos) << reply.reason;
    EXPECT_EQ(pid(cluster, stage), before);
    EXPECT_EQ(cluster.state(), RunState::RUNNING) << cluster.told();
  }
  EXPECT_TRUE(cluster.history.empty()) << cluster.told();
  EXPECT_FALSE(std::filesystem::exists(cluster.running().state_directory + "/" + cluster::swap_journal_file));
}

// With errors to compensate: backlash on X and Y, a pitch table for each direction on X, a table that repeats
// on C.
class MachineWithErrors : public MachineCopy {
 public:
  MachineWithErrors() : MachineCopy("ac-table") {
    auto out = append("parameters.yaml");
    const auto set = [&](unsigned number, double value) { out << '"' << number << "\": " << value << "\n"; };
    for (const unsigned axis : {300000u, 301000u}) set(axis, 1), set(axis + 1, 0.013), set(axis + 2, 0.0007);
    set(300020, 2), set(300021, -400), set(300022, 81), set(300023, 10), set(300026, 700000);
    for (unsigned i = 0; i < 162; ++i) set(700000 + i, 0.00131 * (i % 17) - 0.007);
    set(304020, 1), set(304021, 0), set(304022, 36), set(304023, 10), set(304024, 1), set(304026, 700200);
    for (unsigned i = 0; i < 36; ++i) set(700200 + i, 0.0003 * (i % 5));
  }
};

TEST_F(Swapping, TheCompensationInCTakesOverInMotionAndComputesTheSameBits) {
  const auto program = sweep(3000);
  const MachineWithErrors machine;
  Rows rows;
  {
    Cluster cluster(machine.path());
    cluster.keep_rows = true;
    cluster.start_text(program);
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > 500; }));
    const auto original = pid(cluster, "compensation");
    const auto reply = swap(cluster, "compensation", variant("compensation-in-c"), "", 5000);
    ASSERT_TRUE(reply.accepted) << reply.reason << cluster.told();
    EXPECT_GE(reply.compared, 5000u);
    const auto line = last_line(cluster);
    EXPECT_EQ(line["new"]["build"], "c-example-1");
    EXPECT_NE(line["old"]["crc32"], line["new"]["crc32"]);
    ASSERT_TRUE(cluster.until([&] { return pid(cluster, "compensation") != original; }));
    auto after = cluster.expected_cycle + 5000;
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > after; })) << cluster.told();
    EXPECT_EQ(cluster.state(), RunState::RUNNING) << cluster.told();
    EXPECT_TRUE(cluster.history.empty()) << cluster.told();
    rows = std::move(cluster.rows);
    cluster.keep_rows = false;

    // It is a stage like any other: killed, it comes back and goes on from the cut.
    const auto before = pid(cluster, "compensation");
    ASSERT_EQ(kill(before, SIGKILL), 0);
    ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(100, "compensation"); }));
    ASSERT_TRUE(cluster.until([&] { return cluster.ready() && pid(cluster, "compensation") != before; }))
        << cluster.told();
    ASSERT_TRUE(cluster.until([&] {
      return cluster.state() == RunState::INTERRUPTED || cluster.state() == RunState::HELD;
    })) << cluster.told();
    ASSERT_TRUE(cluster.go_on()) << cluster.told();
    after = cluster.expected_cycle + 2000;
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > after; })) << cluster.told();
    // And it is replaced by ours again, which also says that the two are the same to the bit.
    EXPECT_TRUE(swap(cluster, "compensation", variant("trunnion-compensation"), "", 2000).accepted);
  }
  EXPECT_EQ(first_difference(rows, reference(program, rows.size(), machine.path())), "")
      << "over " << rows.size() << " cycles";
}

TEST_F(Swapping, ThePlcIsComparedTickByTickOverMCodesAndItsSwapChangesNoBitOfTheMotion) {
  const auto program = functions(4000);
  Rows rows;
  {
    Cluster cluster("ac-table");
    cluster.keep_rows = true;
    cluster.start_text(program);
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > 500; }));
    for (const std::string vendor : {"fastdds", "cyclonedds"}) {
      const auto before = pid(cluster, "plc");
      const auto line = cluster.channels[0].line;
      const auto reply = swap(cluster, "plc", "", vendor, 5000);
      ASSERT_TRUE(reply.accepted) << reply.reason << cluster.told();
      EXPECT_GE(reply.compared, 5000u);
      EXPECT_GT(reply.gap, 0);
      EXPECT_LT(reply.gap, 1) << "s without a PLC";
      EXPECT_NE(kill(before, 0), 0) << "the old one is gone";
      // 5000 ticks are more than five moves of 12 mm at 100 mm/s with the functions between them.
      EXPECT_GT(cluster.channels[0].line, line + 10);
      EXPECT_EQ(last_line(cluster)["service"], "plc");
      ASSERT_TRUE(cluster.until([&] { return pid(cluster, "plc") != before && cluster.ready(); }));
    }
    const auto after = cluster.expected_cycle + 2000;
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > after; })) << cluster.told();
    EXPECT_TRUE(runs(cluster)) << cluster.told();
    EXPECT_TRUE(cluster.history.empty()) << cluster.told();
    rows = std::move(cluster.rows);
  }
  EXPECT_EQ(first_difference(rows, reference(program, rows.size())), "")
      << "over " << rows.size() << " cycles";
}

TEST_F(Swapping, InRealTimeThePlcIsComparedAtTheTicksTheClockGaveTheOldOne) {
  const MachineCopy machine("ac-table");
  machine.set_lead(lead_beyond_stalls);
  Cluster cluster(machine.path(), Time::real);
  cluster.start_text(functions(4000));
  ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].line > 4; })) << cluster.told();
  const auto before = pid(cluster, "plc");
  const auto reply = swap(cluster, "plc");
  ASSERT_TRUE(reply.accepted) << reply.reason << cluster.told();
  EXPECT_GE(reply.compared, 500u);
  ASSERT_TRUE(cluster.until([&] { return cluster.ready() && pid(cluster, "plc") != before; }));
  const auto line = cluster.channels[0].line;
  ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].line > line + 4; })) << cluster.told();
  EXPECT_TRUE(runs(cluster)) << cluster.told();
  EXPECT_TRUE(cluster.history.empty()) << cluster.told();
  cluster.client().panel(
      idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP);  // emergency stop: the PLC that has taken over is
                                                          // the machine's
  EXPECT_TRUE(cluster.until([&] {
    return cluster.feedback.mode == DriveMode::OFF && cluster.has_alarm(130);
  })) << cluster.told();
}

TEST_F(Swapping, APlcAndKeepersThatWouldDoOtherwiseAreNotTaken) {
  const MachineCopy machine("ac-table");
  Cluster cluster(machine.path());
  cluster.start_text(functions(40000));
  ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > 500; }));
  const auto refused = [&](const std::string& service, const std::string& executable,
                           const std::string& what) {
    const auto before = pid(cluster, service);
    const auto reply = swap(cluster, service, executable, "", 100000);
    EXPECT_FALSE(reply.accepted);
    EXPECT_NE(reply.reason.find(what), std::string::npos) << reply.reason;
    EXPECT_EQ(pid(cluster, service), before);
    EXPECT_TRUE(runs(cluster)) << cluster.told();
    return reply.reason;
  };
  // It is wrong in one bit of one tick in a thousand.
  EXPECT_NE(refused("plc", variant("plc_one_bit"), ", register R500: 0 and 1 (the first is")
                .find("differs in tick "),
            std::string::npos);
  // The same executable with another program: a lamp that the next M code switches on.
  machine.replace("plc/main.st",
                  "alarm_lamp :=", "IF m_strobe_0 THEN %Y31.0 := TRUE; END_IF;\nalarm_lamp :=");
  refused("plc", "", ", register Y31: 0 and 1 (the first is");
  machine.replace("plc/main.st", "END_PROGRAM", "nothing_of_that_name := 1;\nEND_PROGRAM");
  refused("plc", "", "main.st:");
  // What the machine delivers has changed behind the back of the running ones.
  machine.append("parameters.yaml") << "\"000010\": 0.004\n";
  refused("parameters", "", "differs in parameter 000010, which waits");
  machine.append("programs/other.nc") << "M30\n";
  refused("program", "", "differs in program other.nc");
  const auto after = cluster.expected_cycle + 500;
  EXPECT_TRUE(cluster.until([&] { return cluster.expected_cycle > after; })) << cluster.told();
  EXPECT_TRUE(cluster.history.empty()) << cluster.told();
  EXPECT_FALSE(std::filesystem::exists(cluster.running().state_directory + "/" + cluster::swap_journal_file));
  EXPECT_FALSE(std::filesystem::exists(cluster.running().state_directory + "/plc.rounds"));
}

TEST_F(Swapping, WhatCannotBeStartedOrDoesNotExistIsRefused) {
  Cluster cluster("ac-table");
  const auto nowhere = swap(cluster, "kinematics", "/nowhere/at/all");
  EXPECT_EQ(nowhere.outcome, SwapOutcome::REFUSED);
  EXPECT_NE(nowhere.reason.find("No such file"), std::string::npos) << nowhere.reason;
  EXPECT_EQ(swap(cluster, "kinematics", variant("trunnion")).outcome, SwapOutcome::ENDED)
      << "it ends at once";
  const auto unknown = swap(cluster, "lathe");
  EXPECT_EQ(unknown.outcome, SwapOutcome::REFUSED);
  EXPECT_NE(unknown.reason.find("has no lathe"), std::string::npos) << unknown.reason;
  EXPECT_TRUE(cluster.ready());
  cluster.start_text("G90 G0 X5\nM30\n");
  EXPECT_TRUE(cluster.finish()) << cluster.told();
}

TEST_F(Swapping, AGatewayThatShowsAnotherPositionIsNotTakenAndOneThatShowsTheSameIs) {
  Cluster cluster("ac-table", Time::virtual_, "", true);
  cluster.start_text("G90 G0 X5\nM30\n");
  ASSERT_TRUE(cluster.finish()) << cluster.told();
  const auto before = pid(cluster, "gateway");
  // It shows the actual position of the first axis two micrometres beside where it is.
  const auto wrong = swap(cluster, "gateway", variant("gateway_wrong_position"));
  EXPECT_FALSE(wrong.accepted);
  EXPECT_NE(wrong.reason.find("differs in axes/0/actual: "), std::string::npos) << wrong.reason;
  EXPECT_EQ(pid(cluster, "gateway"), before);
  EXPECT_EQ(http_client::request(cluster.running().port, "GET", "/api/status").status, 200);
  const auto right = swap(cluster, "gateway", "", "fastdds");
  EXPECT_TRUE(right.accepted) << right.reason;
  EXPECT_TRUE(cluster.until([&] {
    return cluster.ready() && cluster.service("gateway")->vendor == "fastdds";
  })) << cluster.told();
}

struct HandedOver {
  const char* service;
  double gap;  // s in which nobody may serve at most, on a machine that does other things too
};

class SwappingInMotion : public Swapping, public testing::WithParamInterface<HandedOver> {};

TEST_P(SwappingInMotion, TheMotionGoesOnAndTheNewOneAnswers) {
  const std::string service = GetParam().service;
  Cluster cluster("ac-table", Time::virtual_, "", service == "gateway");
  cluster.start_text(sweep(3000));
  ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > 500; }));
  const auto before = pid(cluster, service);
  for (const std::string vendor : {"fastdds", "cyclonedds"}) {
    const auto reply = swap(cluster, service, "", vendor);
    ASSERT_TRUE(reply.accepted) << reply.reason << cluster.told();
    EXPECT_GT(reply.gap, 0);
    EXPECT_LT(reply.gap, GetParam().gap);
    ASSERT_TRUE(cluster.until([&] { return cluster.ready() && cluster.service(service)->vendor == vendor; }));
    EXPECT_EQ(last_line(cluster)["service"], service);
  }
  EXPECT_NE(kill(before, 0), 0);
  const auto after = cluster.expected_cycle + 500;
  ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > after; })) << cluster.told();
  EXPECT_EQ(cluster.state(), RunState::RUNNING) << cluster.told();
  EXPECT_TRUE(cluster.history.empty()) << cluster.told();
  if (service == "gateway") {
    EXPECT_EQ(http_client::request(cluster.running().port, "GET", "/api/status").status, 200);
  } else if (service == "program") {
    cluster.client().upload("late.nc", "G0 X1\nM30\n");
    EXPECT_EQ(cluster.client().download("late.nc"), "G0 X1\nM30\n");
  } else {
    idl::parameters::ParameterRequest request;
    request.role = 2;  // a builder's
    request.operation = idl::parameters::Operation::SET;
    request.values = {{10, 0.004, ""}};
    EXPECT_TRUE(cluster.client().parameter(request).accepted);
  }
}

// A request that falls into the gap is sent again by its client, every 200 ms, and answered by the new one.
INSTANTIATE_TEST_SUITE_P(Services, SwappingInMotion,
                         testing::Values(HandedOver{"gateway", 1.0}, HandedOver{"program", 1.0},
                                         HandedOver{"parameters", 1.0}),
                         [](const auto& service) { return std::string(service.param.service); });

// In the simulation the spindle of a new drive is at rest at once.
TEST_F(Swapping, TheDriveIsNotSwappedWhileASpindleTurnsAndOtherServicesAre) {
  Cluster cluster("ac-table");
  const auto order = [&](const std::string& block) {
    return cluster.until([&] {
      try {
        cluster.client().mdi(0, block);
        return true;
      } catch (const std::exception&) {
        return false;  // the channel has not heard yet that all are ready
      }
    });
  };
  const auto speed = [&] {
    return cluster.feedback.spindle_speed.empty() ? 0 : cluster.feedback.spindle_speed[0];
  };
  cluster.client().set_mode(0, Mode::MDI);
  ASSERT_TRUE(order("S1000 M3")) << cluster.told();
  // Virtual time passes until the PLC has the speed within its window, 5 %.
  ASSERT_TRUE(cluster.until([&] { return speed() > 900; })) << speed() << cluster.told();
  ASSERT_TRUE(cluster.finish()) << cluster.told();
  const auto before = pid(cluster, "drive");
  const auto reply = swap(cluster, "drive");
  EXPECT_FALSE(reply.accepted);
  EXPECT_EQ(reply.outcome, SwapOutcome::REFUSED);
  EXPECT_TRUE(reply.reason.starts_with("The drive can be swapped at rest only: spindle 1 turns at "))
      << reply.reason;
  EXPECT_TRUE(
      reply.reason.ends_with(" 1/min; stop it (M5) first, the new drive begins with its spindles at rest"))
      << reply.reason;
  EXPECT_EQ(pid(cluster, "drive"), before);
  for (const std::string service : {"kinematics", "plc", "parameters"}) {
    const auto other = swap(cluster, service);
    ASSERT_TRUE(other.accepted) << service << " " << other.reason << cluster.told();
    ASSERT_TRUE(cluster.until([&] { return cluster.ready(); })) << cluster.told();
  }
  EXPECT_GT(speed(), 900) << "no service that was swapped has stopped it";

  ASSERT_TRUE(order("M5")) << cluster.told();
  ASSERT_TRUE(cluster.until([&] { return speed() <= 5; })) << speed() << cluster.told();
  ASSERT_TRUE(cluster.finish()) << cluster.told();
  const auto stopped = swap(cluster, "drive");
  EXPECT_TRUE(stopped.accepted) << stopped.reason << cluster.told();
}

TEST_F(Swapping, ChannelAndDriveAreSwappedAtRestWithTheirStateAndNotInMotion) {
  Cluster cluster("ac-table");
  cluster.client().set_mode(0, Mode::MDI);
  cluster.client().mdi(0, "G91 G55 G1 X12.5 F3000");
  ASSERT_TRUE(cluster.finish()) << cluster.told();
  cluster.until([] { return false; }, 0.3);
  const auto before = cluster.channels[0];
  for (const std::string service : {"drive", "channel", "drive"}) {
    const auto reply = swap(cluster, service);
    ASSERT_TRUE(reply.accepted) << service << " " << reply.reason << cluster.told();
    ASSERT_TRUE(cluster.until([&] { return cluster.ready(); })) << cluster.told();
  }
  ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].modal == before.modal; })) << cluster.told();
  EXPECT_EQ(cluster.channels[0].mode, Mode::MDI);
  EXPECT_EQ(cluster.channels[0].work_offset, before.work_offset);
  EXPECT_NEAR(cluster.channels[0].machine[0], before.machine[0], 1e-6);
  // G91 still holds: it is 12.5 mm farther on. The channel may hear later than this process that all are
  // ready.
  ASSERT_TRUE(cluster.until([&] {
    try {
      cluster.client().mdi(0, "X12.5");
      return true;
    } catch (const std::exception&) {
      return false;
    }
  })) << cluster.told();
  ASSERT_TRUE(cluster.finish()) << cluster.told();
  EXPECT_TRUE(cluster.until([&] {
    return std::abs(cluster.channels[0].machine[0] - before.machine[0] - 12.5) < 0.01;
  })) << cluster.channels[0].machine[0];

  cluster.start_text(sweep(3000));
  ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].line >= 8; }));
  for (const std::string service : {"drive", "channel"}) {
    const auto reply = swap(cluster, service);
    EXPECT_FALSE(reply.accepted);
    EXPECT_EQ(reply.outcome, SwapOutcome::REFUSED);
    EXPECT_NE(reply.reason.find("at rest only"), std::string::npos) << reply.reason;
  }
  EXPECT_EQ(cluster.state(), RunState::RUNNING) << cluster.told();

  // Held in the middle of the program: the place in it is kept.
  cluster.client().channel(0, CommandKind::FEED_HOLD);
  ASSERT_TRUE(cluster.until([&] { return cluster.state() == RunState::HELD; })) << cluster.told();
  cluster.until([] { return false; }, 0.3);
  const auto held = cluster.channels[0];
  ASSERT_TRUE(swap(cluster, "channel").accepted);
  ASSERT_TRUE(cluster.until([&] { return cluster.ready() && cluster.state() == RunState::INTERRUPTED; }))
      << cluster.told();
  EXPECT_EQ(cluster.channels[0].program, held.program);
  EXPECT_EQ(cluster.channels[0].line, held.line);
  ASSERT_TRUE(cluster.go_on()) << cluster.told();
  EXPECT_TRUE(cluster.until([&] { return cluster.channels[0].line > held.line + 4; })) << cluster.told();
}

}  // namespace
}  // namespace trunnion::integration
