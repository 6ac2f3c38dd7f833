// SPDX-License-Identifier: Apache-2.0
// The gateway alone against a golden recording with an operator added to it: as recorded, on either vendor;
// and not when it orders, answers or shows something else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "bus/codec.hpp"
#include "bus/json.hpp"
#include "cluster/cluster_files.hpp"
#include "contracts/topics.hpp"
#include "recording/file_stream.hpp"
#include "recording/mcap_writer.hpp"
#include "storage/crc32.hpp"
#include "verification/stored_recording.hpp"
#include "verification/verify.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;
using idl::channel::CommandKind;
using idl::gateway::Sender;

// Adds what the gateway and those it asks would have said, a millisecond after each other.
class Operator {
 public:
  explicit Operator(verification::StoredRecording& recording) : recording_(recording) {
    for (const auto& message : recording.messages) time_ = std::max(time_, message.time);
  }

  template <class T>
  void add(const bus::Topic<T>& topic, const T& value) {
    verification::StoredMessage message{bus::find_topic(topic.name), time_ += 1000000, 0, {}};
    bus::encode(value, message.cdr);
    recording_.messages.push_back(std::move(message));
  }

  void line(const std::string& method, const std::string& target, const std::string& body,
            std::uint16_t status, const std::string& answer, std::uint32_t requests,
            Sender sender = Sender::TOOL) {
    idl::gateway::OperatorRequest line{};
    line.line = ++lines_;
    line.sender = sender;
    line.user = user;
    line.role = 2;  // a builder's
    line.method = method;
    line.target = target;
    line.body = body.size() <= 1024 ? body : "";
    line.body_size = body.size();
    line.body_crc32 = storage::crc32(body);
    line.status = status;
    line.answer = answer;
    line.answer_size = answer.size();
    line.answer_crc32 = storage::crc32(answer);
    if (requests > 0) line.client = client, line.number = number_ + 1 - requests, line.requests = requests;
    add(topics::operator_request, line);
  }

  // One order to the channel, accepted at cycle 77.
  void order(const std::string& target, const std::string& body, idl::channel::ChannelRequest request,
             Sender sender = Sender::TOOL) {
    request.who = "hmi", request.role = 2;  // without users a builder's
    request.client = client;
    request.number = ++number_;
    add(topics::channel_request, request);
    idl::channel::ChannelReply reply{};
    reply.client = client;
    reply.number = number_;
    reply.accepted = true;
    reply.cycle = 77;
    add(topics::channel_reply, reply);
    line("POST", target, body, 200, R"({"accepted":true,"cycle":77})", 1, sender);
  }

  // An upload of one part.
  void upload(const std::string& name, const std::string& text) {
    using idl::program::Operation;
    idl::program::ProgramRequest request{};
    idl::program::ProgramReply reply{};
    reply.accepted = true;
    reply.entry = {name, 1, text.size(), storage::crc32(text), 1};
    for (const auto operation : {Operation::BEGIN_UPLOAD, Operation::WRITE, Operation::COMMIT_UPLOAD}) {
      request = {};
      request.client = reply.client = client;
      request.number = reply.number = ++number_;
      request.operation = operation;
      request.name = name;
      if (operation == Operation::WRITE) request.data.assign(text.begin(), text.end());
      if (operation == Operation::COMMIT_UPLOAD)
        request.size = text.size(), request.crc32 = storage::crc32(text), request.role = 2;
      add(topics::program_request, request);
      add(topics::program_reply, reply);
    }
    line("PUT", "/api/programs/" + name, text, 200,
         bus::text_of({{"accepted", true}, {"program", bus::to_json(reply.entry)}}), 3);
  }

  // The plan of a program that is not there: one request to the program service.
  void plan_missing(const std::string& name) {
    idl::program::ProgramRequest request{};
    request.client = client;
    request.number = ++number_;
    request.operation = idl::program::Operation::RESOLVE;
    request.name = name;
    add(topics::program_request, request);
    idl::program::ProgramReply reply{};
    reply.client = client;
    reply.number = number_;
    reply.alarm = 141;
    reply.reason = "program '" + name + "' is not in the store";
    add(topics::program_reply, reply);
    line("GET", "/api/programs/" + name + "/plan", "", 404,
         R"({"type":"about:blank","title":"Not Found","status":404,"detail":"no program )" + name +
             R"(, or it is larger than 8 MB"})",
         1);
  }

  // A change of a parameter by `name`, who was logged in, whatever the body says.
  void change(std::uint32_t parameter, double value, const std::string& name) {
    idl::parameters::ParameterRequest request{};
    request.role = 2;  // a builder's
    request.client = client;
    request.number = ++number_;
    request.operation = idl::parameters::Operation::SET;
    request.who = name;
    idl::parameters::Parameter changed{};
    changed.number = parameter;
    changed.value = value;
    request.values.push_back(changed);
    add(topics::parameter_request, request);
    idl::parameters::ParameterReply reply{};
    reply.client = client;
    reply.number = number_;
    reply.accepted = true;
    reply.revision = 5;
    add(topics::parameter_reply, reply);
    user = name;
    line("PUT", "/api/parameters/" + std::to_string(parameter),
         bus::text_of({{"value", value}, {"who", "hmi"}}), 200,
         bus::text_of({{"accepted", true}, {"revision", 5}, {"pending", 0}}), 1);
  }

  std::string user;  ///< logged in, of the lines that follow

 private:
  static constexpr std::uint64_t client = 4711;
  verification::StoredRecording& recording_;
  std::uint64_t time_ = 0, number_ = 0, lines_ = 0;
};

void write(const verification::StoredRecording& recording, const std::string& path) {
  recording::FileSink sink(path);
  recording::Writer writer(sink, {.library = "test"});
  writer.metadata("trunnion", {recording.metadata.begin(), recording.metadata.end()});
  std::map<const bus::TopicEntry*, std::pair<std::uint16_t, std::uint32_t>> channels;
  for (const auto& message : recording.messages) {
    const auto* topic = message.topic;
    if (!channels.contains(topic))
      channels[topic] = {writer.add_channel(topic->description.name, topic->type, topic->schema), 0};
    auto& [channel, sequence] = channels[topic];
    writer.write(channel, ++sequence, message.time, message.cdr);
  }
  ASSERT_TRUE(writer.finish());
}

class VerifyGateway : public testing::Test {
 protected:
  void SetUp() override {
    auto recording =
        verification::load_recording(cluster::find_machine("ac-table") + "/recordings/golden.mcap");
    // Whatever its operator did is taken out: the requests here are all.
    std::erase_if(recording.messages, [](const auto& m) { return m.topic->handle == "operator_request"; });
    Operator with(recording);
    with.order("/api/channels/0/override", R"({"kind":"feed","value":0.5})",
               {.command = CommandKind::FEED_OVERRIDE, .fraction = 0.5}, Sender::PAGE);
    with.line("POST", "/api/channels/0/cycle-start", "", 403,
              R"({"error":"a page of another site must not operate this machine"})", 0, Sender::FOREIGN_PAGE);
    with.upload("A.NC", std::string(3000, ';'));
    with.plan_missing("NONE.NC");
    with.line("POST", "/api/channels/0/mdi", "{}", 400,
              R"({"error":"the field line is missing","field":"line"})", 0);
    with.order("/api/channels/0/jog", R"({"axis":"X","speed":600,"press":9})",
               {.command = CommandKind::JOG_AXIS, .speed = 600, .press = 9});
    with.order("/api/channels/0/jog-renew", R"({"press":9})",
               {.command = CommandKind::JOG_RENEW, .press = 9});
    with.order("/api/channels/0/jog-stop", R"({"axis":0})", {.command = CommandKind::JOG_STOP});
    options_.recording =
        (fs::temp_directory_path() / ("trunnion-operator-" + std::to_string(getpid()) + ".mcap")).string();
    write(recording, options_.recording);
    options_.service = "gateway";
    options_.timeout = 20;
  }
  void TearDown() override { fs::remove(options_.recording); }

  verification::VerifyOptions options_;
};

TEST_F(VerifyGateway, DoesShowsAndAnswersWhatIsRecordedOnEitherVendor) {
  for (const char* vendor : {"cyclonedds", "fastdds"}) {
    options_.vendor = vendor;
    const auto result = verification::verify(options_);
    EXPECT_TRUE(result.equal()) << vendor << ": " << result.problem
                                << text_of(result.difference, "recorded", "written now");
    EXPECT_EQ(result.requests, 8u);
    EXPECT_EQ(result.left_out, 0u);
    EXPECT_GE(result.samples, 2u) << "before the first request and at the end at least";
    std::size_t compared = 0;
    for (const auto& topic : result.difference.topics) compared += topic.compared;
    EXPECT_EQ(compared, 8u + 4u + 4u) << "lines, orders to the channel, requests to the program service";
  }
}

TEST_F(VerifyGateway, ARecordingOfAMachineWithUsersAndTlsIsVerifiedWithoutThem) {
  const auto machine = fs::temp_directory_path() / ("trunnion-users-" + std::to_string(getpid()));
  fs::copy(cluster::find_machine("ac-table"), machine, fs::copy_options::recursive);
  std::ofstream(machine / "machine.yaml", std::ios::app) << "auth: on\ntls: on\n";
  options_.machine = machine.string();
  auto recording = verification::load_recording(options_.machine + "/recordings/golden.mcap");
  std::erase_if(recording.messages, [](const auto& m) { return m.topic->handle == "operator_request"; });
  Operator with(recording);
  with.change(100034, 24000, "anna");
  with.line("POST", "/api/channels/0/cycle-start", "", 401,
            R"({"error":"log in first: the session is over, or there was none"})", 0);
  with.line("PUT", "/api/parameters/000010", "", 403,
            R"({"error":"this needs the role builder, and sam is setter"})", 0);
  with.line(
      "POST", "/api/channels/0/cycle-start", "", 409,
      R"({"accepted":false,"alarm":0,"reason":"anna operates this machine: take over the right to operate, or ask for it"})",
      0);
  write(recording, options_.recording);
  const auto result = verification::verify(options_);
  EXPECT_TRUE(result.equal()) << result.problem << text_of(result.difference, "recorded", "written now");
  EXPECT_EQ(result.requests, 1u);
  EXPECT_EQ(result.left_out, 3u) << "another sender would have got another answer";
  fs::remove_all(machine);
}

TEST_F(VerifyGateway, AnOrderThatIsNotTheOneAskedForIsFoundAtItsField) {
  options_.executable = cluster::binary_directory() + "/gateway_wrong_order";
  const auto result = verification::verify(options_);
  EXPECT_EQ(result.problem, "") << "it answers everything";
  ASSERT_TRUE(result.difference.first.has_value());
  EXPECT_EQ(result.difference.first->topic, "channel_request");
  EXPECT_EQ(result.difference.first->field, "fraction");
  EXPECT_FALSE(result.equal());
}

TEST_F(VerifyGateway, APositionThatIsNotTheOneRecordedIsFoundWhereItIsShown) {
  options_.executable = cluster::binary_directory() + "/gateway_wrong_position";
  options_.timeout = 1;
  const auto result = verification::verify(options_);
  EXPECT_NE(result.problem.find("axes.0.actual: expected "), std::string::npos) << result.problem;
  EXPECT_FALSE(result.equal());
}

TEST_F(VerifyGateway, AnAnswerThatIsNotTheOneRecordedIsAProblemThatNamesBoth) {
  auto recording = verification::load_recording(options_.recording);
  Operator(recording).line("POST", "/api/channels/31/reset", "", 200, "{}", 0);
  write(recording, options_.recording);
  const auto result = verification::verify(options_);
  EXPECT_EQ(result.problem,
            "POST /api/channels/31/reset was answered 404 {\"error\":\"no channel 31\"}; recorded is 200 {}");
}

}  // namespace
}  // namespace trunnion::integration
