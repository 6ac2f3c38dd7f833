// SPDX-License-Identifier: Apache-2.0
// Recordings that begin at random moments of random histories verify every service: programs, MDI, parameters
// and offsets by the command line, over HTTP and on the bus, losses and swaps of services, rests.
// TRUNNION_SEED chooses the history, TRUNNION_HISTORIES how many recordings are made; `make histories` sets
// both.
#include <cstdlib>
#include <random>

#include "http_client/client.hpp"
#include "recorded_machine.hpp"

namespace trunnion::integration {
namespace {

std::uint64_t number_from(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr && *text != 0 ? std::strtoull(text, nullptr, 10) : otherwise;
}

class History {
 public:
  explicit History(std::uint64_t seed)
      : random_(seed), machine_("ac-table", Time::virtual_, draw(2) == 0 ? "cyclonedds" : "mixed") {}

  /// What happened, a line each: the last one is the act that failed.
  const std::string& told() const { return told_; }
  void one_recording(const std::string& name);

 private:
  struct Act {
    const char* name;
    void (History::*act)();
  };
  std::uint64_t draw(std::uint64_t below) { return random_() % below; }
  void act(const std::vector<Act>& acts);

  void program() { machine_.run_programs(); }
  void values() { machine_.change_values(); }
  void reset() { machine_.reset(); }
  void rest() {
    machine_.cluster().until([] { return false; }, 0.2 + 0.2 * static_cast<double>(draw(6)));
  }
  void mdi();
  void parameter();
  void http();
  void lose();
  void swap();
  void command(std::vector<std::string> words);

  std::mt19937_64 random_;
  RecordedMachine machine_;
  std::string told_;
};

// A client that lives for one request.
void History::command(std::vector<std::string> words) {
  cluster::ChildOptions child;
  child.arguments = {cluster::binary_directory() + "/trunnion"};
  child.arguments.insert(child.arguments.end(), words.begin(), words.end());
  child.arguments.insert(child.arguments.end(),
                         {"--domain", std::to_string(machine_.cluster().running().run.domain)});
  child.log = machine_.file("command.log");
  cluster::ChildProcess process(child);
  ASSERT_TRUE(machine_.cluster().until([&] { return process.status().has_value(); }));
  ASSERT_EQ(process.status(), 0) << process.ended();
}

void History::mdi() {
  const auto x = std::to_string(draw(40)), a = std::to_string(draw(10));
  command({"mdi", "G1 X" + x + " A" + a + " F5000"});
}

void History::parameter() {
  command({"param", "set", "100034", std::to_string(20000 + draw(1000))});
  if (draw(2) == 0) reset();
}

void History::http() {
  const auto value = std::to_string(50 + draw(50));
  const auto reply =
      http_client::request(machine_.cluster().running().port, "POST", "/api/channels/0/override",
                           R"({"kind":"feed","value":0.)" + value + "}");
  EXPECT_EQ(reply.status, 200) << reply.body;
}

constexpr const char* services[] = {"drive",   "plc",        "channel", "parameters",
                                    "program", "kinematics", "gateway"};

void History::lose() { machine_.kill_service(services[draw(std::size(services))]); }

void History::swap() {
  machine_.swap(services[draw(std::size(services) - 1)]);
  // A channel that is restarted behind a program which ended with functions is interrupted there.
  machine_.reset();
}

void History::act(const std::vector<Act>& acts) {
  const auto& chosen = acts[draw(acts.size())];
  told_ += std::string(chosen.name) + "\n";
  (this->*chosen.act)();
}

void History::one_recording(const std::string& name) {
  const std::vector<Act> during{
      {"program", &History::program},     {"values", &History::values},        {"mdi", &History::mdi},
      {"parameter", &History::parameter}, {"order over HTTP", &History::http}, {"rest", &History::rest},
      {"reset", &History::reset}};
  auto before = during;
  before.insert(before.end(), {{"loss", &History::lose}, {"swap", &History::swap}});
  for (auto left = draw(4); left > 0; --left) ASSERT_NO_FATAL_FAILURE(act(before));
  told_ += "recording " + name + "\n";
  ASSERT_NO_FATAL_FAILURE(machine_.record(name));
  for (auto left = 1 + draw(4); left > 0; --left) ASSERT_NO_FATAL_FAILURE(act(during));
  machine_.stop_recording();
  machine_.expect_verified(name);
  std::filesystem::remove(machine_.file(name));
}

TEST(History, RecordingsFromAnyMomentVerifyEveryService) {
  const auto seed = number_from("TRUNNION_SEED", 7), count = number_from("TRUNNION_HISTORIES", 2);
  History history(seed);
  for (std::uint64_t i = 0; i < count && !testing::Test::HasFailure(); ++i)
    history.one_recording("history" + std::to_string(i) + ".mcap");
  if (testing::Test::HasFailure()) std::printf("seed %ju:\n%s", std::uintmax_t{seed}, history.told().c_str());
}

}  // namespace
}  // namespace trunnion::integration
