// SPDX-License-Identifier: Apache-2.0
#include "recorded_machine.hpp"

#include "cluster/swap_ticket.hpp"

#include <cstring>
#include <sstream>

#include "machine/parameter_constants.hpp"
#include "machine/services.hpp"
#include "storage/retained_pair.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;

std::string text_of_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Those beside the golden recording: moves of every axis, functions, a tool.
std::string program_file(std::uint16_t channel) {
  return channel == 0 ? "short.nc" : "short" + std::to_string(channel) + ".nc";
}

}  // namespace

RecordedMachine::RecordedMachine(std::string machine, Time time, std::string vendor)
    : machine_(std::move(machine)), vendor_(std::move(vendor)), time_(time) {
  std::string name = (fs::temp_directory_path() / "trunnion-recorded-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
  directory_ = name;
  fs::create_directory(directory_ / "state");
  const auto recordings = fs::path(cluster::find_machine(machine_)) / "recordings";
  while (fs::exists(recordings / program_file(channels_))) ++channels_;
  up();
}

RecordedMachine::~RecordedMachine() {
  recorder_.stop();
  cluster_.reset();
  std::error_code ignored;
  if (!testing::Test::HasFailure()) fs::remove_all(directory_, ignored);
}

void RecordedMachine::up() {
  cluster_ = std::make_unique<Cluster>(machine_, time_, vendor_, true, std::nullopt, file("state"));
  ASSERT_TRUE(cluster_->until([&] { return cluster_->channels.size() == channels_; })) << cluster_->told();
}

void RecordedMachine::set_counters(std::uint64_t cycle, std::uint64_t tick) {
  auto pair = storage::RetainedPair::of_files(file("state") + "/encoders.bin", "encoders");
  auto kept = pair.load();
  ASSERT_EQ(kept.state, storage::KeptState::good);
  // Of the drive's memory: a magic number, counts of axes and epochs (4 bytes each, aligned to 8), cycle,
  // tick.
  ASSERT_EQ(std::string(kept.content.begin(), kept.content.begin() + 4), "1NRT");
  std::memcpy(kept.content.data() + 16, &cycle, sizeof cycle);
  std::memcpy(kept.content.data() + 24, &tick, sizeof tick);
  pair.open(kept.content);
}

void RecordedMachine::record(const std::string& name, const std::vector<std::string>& more) {
  cluster::ChildOptions options;
  options.arguments = {cluster::binary_directory() + "/trunnion-recorder",
                       "--output",
                       file(name),
                       "--machine",
                       machine_,
                       "--domain",
                       std::to_string(cluster_->running().run.domain)};
  if (!vendor_.empty() && vendor_ != "mixed")
    options.arguments.insert(options.arguments.end(), {"--vendor", vendor_});
  options.arguments.insert(options.arguments.end(), more.begin(), more.end());
  options.log = file("recorder.log");
  options.ends_with_parent = true;
  recorder_ = cluster::ChildProcess(options);
  ASSERT_TRUE(cluster_->until([&] {
    return text_of_file(options.log).find("recording " + file(name)) != std::string::npos ||
           !recorder_.ended().empty();
  }));
  ASSERT_EQ(recorder_.ended(), "");
  // The recorder knows the services of the cluster, and has not waited for this client.
  cluster_->until([] { return false; }, 0.5);
}

void RecordedMachine::stop_recording() {
  // What the last cycles cause comes behind them.
  cluster_->until([] { return false; }, 0.3);
  recorder_.stop(10);
  EXPECT_EQ(recorder_.status(), 0) << text_of_file(file("recorder.log"));
}

void RecordedMachine::start_programs() {
  const auto recordings = fs::path(cluster::find_machine(machine_)) / "recordings";
  for (std::uint16_t channel = 0; channel < channels_; ++channel) {
    const auto name = "recorded" + std::to_string(channel) + ".nc";
    cluster_->client().upload(name, text_of_file(recordings / program_file(channel)));
    cluster_->start(name, channel);
  }
}

bool RecordedMachine::await_end() {
  bool ended = true;
  for (std::uint16_t channel = 0; channel < channels_; ++channel) ended = cluster_->finish(channel) && ended;
  return ended;
}

void RecordedMachine::run_programs() {
  start_programs();
  ASSERT_TRUE(await_end()) << cluster_->told();
}

void RecordedMachine::change_values() {
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.who = "test";
  request.operation = idl::parameters::Operation::SET;
  request.values = {{parameter::rapid_feed.number(0), 9000, ""}};
  ASSERT_TRUE(cluster_->client().parameter(request).accepted);
  request = {};
  request.who = "test";
  request.operation = idl::parameters::Operation::SET_WORK_OFFSET;
  request.offsets = {{0, 0, {1.25, -0.5, 2, 0, 0, 0, 0, 0, 0}}};
  ASSERT_TRUE(cluster_->client().parameter(request).accepted);
  reset();
}

void RecordedMachine::reset() {
  for (std::uint16_t channel = 0; channel < channels_; ++channel)
    cluster_->client().channel(channel, CommandKind::RESET);
}

void RecordedMachine::swap(const std::string& service) {
  idl::service::SwapRequest request;
  request.service = service;
  service::RequestClient<idl::service::SwapRequest, idl::service::SwapReply> client(
      cluster_->client().bus(), topics::swap_request, topics::swap_reply);
  cluster::put_ticket(cluster_->running().run.path(), request);
  client.send(request);
  std::optional<idl::service::SwapReply> reply;
  ASSERT_TRUE(cluster_->until([&] { return (reply = client.poll()).has_value(); }, 60)) << cluster_->told();
  EXPECT_TRUE(reply->accepted) << service << ": " << reply->reason << reply->difference;
  ASSERT_TRUE(cluster_->until([&] { return cluster_->ready(); }));
}

void RecordedMachine::kill_service(const std::string& service) {
  ASSERT_TRUE(cluster_->until([&] { return cluster_->service(service) != nullptr; }));
  const auto pid = cluster_->service(service)->pid;
  ASSERT_EQ(kill(pid, SIGKILL), 0);
  ASSERT_TRUE(cluster_->until([&] {
    const auto* now = cluster_->service(service);
    return now != nullptr && now->pid != 0 && now->pid != pid && now->ready && cluster_->ready();
  })) << service;
  ASSERT_TRUE(cluster_->until([&] {
    cluster_->reset_alarms();
    return cluster_->active_alarms().empty();
  })) << cluster_->active_alarms();
}

std::map<std::string, std::string> RecordedMachine::expect_verified(const std::string& name,
                                                                    const std::set<std::string>& excused) {
  std::map<std::string, std::string> said;
  const auto verify = [&](const std::string& service, std::uint16_t channel) {
    verification::VerifyOptions options;
    options.recording = file(name);
    options.service = service;
    options.channel = channel;
    options.timeout = 20;
    try {
      const auto result = verification::verify(options);
      cycles_[service] = result.cycles;
      EXPECT_TRUE(result.equal()) << name << ", " << service << " " << channel << ": " << result.problem
                                  << "\n"
                                  << text_of(result.difference, "recorded", "written now");
    } catch (const std::runtime_error& error) {
      said[service] = error.what();
      // A service that had nothing to do has nothing that can be compared.
      const bool idle = said[service].find("the recording has no output of service") != std::string::npos;
      const bool clocked = time_ == Time::real && (service == "drive" || service == "plc");
      EXPECT_TRUE(idle || clocked || excused.contains(service))
          << name << ", " << service << ": " << error.what();
    }
  };
  for (const auto& service : machine::service::all)
    for (std::uint16_t channel = 0; !service.not_verified && channel < (service.per_channel ? channels_ : 1);
         ++channel)
      verify(service.name, channel);
  return said;
}

}  // namespace trunnion::integration
