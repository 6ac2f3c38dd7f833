// SPDX-License-Identifier: Apache-2.0
#include "verification/verify_gateway.hpp"

#include <future>
#include <map>
#include <set>

#include "bus/bus.hpp"
#include "bus/json.hpp"
#include "cluster/child_process.hpp"
#include "contracts/topics.hpp"
#include "http_client/client.hpp"
#include "service/node.hpp"
#include "storage/crc32.hpp"
#include "text/utf8.hpp"
#include "verification/gateway_plan.hpp"
#include "verification/repetitions.hpp"
#include "verification/shown_state.hpp"
#include "verification/verify_place.hpp"

namespace trunnion::verification {
namespace {

using bus::Json;
using idl::gateway::Sender;

constexpr double short_wait = 0.005;  // s
constexpr std::size_t shown_text = 204;

// A client of /api/stream: the first message is the state, the others change it.
class StateStream {
 public:
  explicit StateStream(std::uint16_t port) : client_(port, "/api/stream") {}
  bool open() const { return client_.open(); }
  const Json& state() const { return state_; }
  // False when nothing came in time, or nothing that can be meant.
  bool take(double timeout) {
    const auto text = client_.next(timeout);
    if (!text) return false;
    auto message = Json::parse(*text, nullptr, false);
    if (!message.is_object()) return false;
    if (message.contains("state"))
      state_ = std::move(message["state"]);
    else if (message.contains("changes"))
      state_.merge_patch(message["changes"]);
    return true;
  }

 private:
  http_client::WebSocketClient client_;
  Json state_;
};

class Verification {
 public:
  Verification(const VerifyOptions& options, const GatewayPlan& plan, bus::Bus& bus,
               cluster::ChildProcess& process, std::uint16_t port)
      : options_(options), plan_(plan), bus_(bus), process_(process), port_(port) {
    for (const auto& handle : plan.outputs.topics) read(*bus::find_topic(handle));
    read(*bus::find_topic("alarm"));
    // Made before the gateway is heard of, so that it finds them all at once.
    for (const auto& step : plan.steps)
      if (step.message != nullptr) writer(*step.message->topic);
    for (const auto& handle : plan.outputs.topics)
      if (const auto* reply = reply_topic(*bus::find_topic(handle))) writer(*reply);
  }

  // Empty when everything was as recorded but for the outputs on the bus, else what was not.
  std::string run() {
    auto problem = connect();
    began_ = service::monotonic_seconds();
    for (auto step = plan_.steps.begin(); problem.empty() && step != plan_.steps.end(); ++step)
      problem = go(*step);
    if (problem.empty()) problem = compare_answers();
    ended_ = service::monotonic_seconds();
    while (service::monotonic_seconds() - ended_ < final_messages) {
      bus_.signal().wait(short_wait);
      drain();
    }
    const auto end = process_.ended();
    return end.empty() ? problem : end;
  }

  double seconds() const { return ended_ - began_; }
  std::size_t samples() const { return samples_; }
  std::vector<StoredMessage>& produced() { return produced_; }
  const std::vector<OperatorLine>& lines() const { return lines_; }

 private:
  void read(const bus::TopicEntry& topic) {
    const bus::EndpointQos all{bus::reader_qos(topic.qos).transient_local, 0};
    readers_.emplace_back(&topic, bus_.backend().reader(topic.description, all, &bus_.signal()));
  }
  bus::RawWriter& writer(const bus::TopicEntry& topic) {
    auto& writer = writers_[&topic];
    if (!writer)
      writer = bus_.backend().writer(topic.description, bus::writer_qos(topic.qos, {stream_batches}));
    return *writer;
  }

  // Calls `ready` until it holds; false when the gateway has ended or the time is over.
  template <class Ready>
  bool wait_for(Ready ready) {
    const double until = service::monotonic_seconds() + options_.timeout;
    while (!ready()) {
      if (!process_.ended().empty() || service::monotonic_seconds() > until) return false;
      bus_.signal().wait(short_wait);
      drain();
    }
    return true;
  }

  std::string connect() {
    const bool open = wait_for([&] {
      stream_ = std::make_unique<StateStream>(port_);
      return stream_->open();
    });
    if (!open) return "the gateway does not serve /api/stream";
    // What it writes is not kept for late readers.
    for (const auto& [topic, reader] : readers_)
      if (topic->handle != "swap_request" && topic->handle != "alarm" &&
          !wait_for([&, &r = reader] { return r->matched() > 0; }))
        return "the gateway does not write " + topic->handle;
    return "";
  }

  std::string go(const GatewayStep& step) {
    switch (step.kind) {
      case GatewayStep::Kind::feed:
        writer(*step.message->topic).write(step.message->cdr);
        shown_.observe(*step.message);
        ++fed_;
        drain();
        return "";
      case GatewayStep::Kind::ask:
        return ask(*step.request);
      case GatewayStep::Kind::sample:
        return sample();
    }
    return "";
  }

  std::string ask(const OperatorRequest& request) {
    current_ = &request;
    answered_ = 0;
    const auto& line = request.line;
    const std::string origin = line.sender == Sender::PAGE
                                   ? "Origin: http://127.0.0.1:" + std::to_string(port_) + "\r\n"
                               : line.sender == Sender::FOREIGN_PAGE ? "Origin: http://elsewhere.invalid\r\n"
                                                                     : "";
    auto answering = std::async(std::launch::async, [&] {
      const auto user = line.user.empty()
                            ? ""
                            : "Authorization: Bearer " + std::to_string(line.role) + " " + line.user + "\r\n";
      return http_client::request(port_, line.method, line.target, request.body, origin + user);
    });
    while (answering.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      bus_.signal().wait(short_wait);
      drain();
    }
    const auto answer = answering.get();
    if (answer.status != line.status || answer.body.size() != line.answer_size ||
        storage::crc32(answer.body) != line.answer_crc32)
      return name_of(line) + " was answered " + std::to_string(answer.status) + " " +
             text::shortened(answer.body, shown_text) + "; recorded is " + std::to_string(line.status) + " " +
             (line.answer.size() == line.answer_size ? text::shortened(line.answer, shown_text)
                                                     : std::to_string(line.answer_size) + " bytes");
    return await_line(request);
  }

  static std::string name_of(const OperatorLine& line) { return line.method + " " + line.target; }

  std::string await_line(const OperatorRequest& request) {
    ++wanted_lines_;
    if (wait_for([&] { return lines_.size() >= wanted_lines_; })) return "";
    return "the gateway's journal has no line of " + name_of(request.line);
  }

  std::string sample() {
    ++samples_;
    auto expected = shown_.document();
    take_out_clock(expected, plan_.outputs.instance);
    std::string off;
    const double until = service::monotonic_seconds() + options_.timeout;
    do {
      const bool news = stream_->take(samples_ == 1 && stream_->state().is_null() ? options_.timeout : 0.1);
      drain();
      if (!news && !process_.ended().empty()) return process_.ended();
      auto shown = stream_->state();
      take_out_clock(shown, plan_.outputs.instance);
      off = shown_difference(expected, shown);
    } while (!off.empty() && service::monotonic_seconds() < until);
    return off.empty() ? "" : "what it shows after " + std::to_string(fed_) + " messages: " + off;
  }

  // What is read over HTTP at the end.
  std::string compare_answers() {
    for (const auto& [target, expected] : shown_.answers()) {
      std::string off;
      if (!wait_for([&, &path = target, &wanted = expected] {
            const auto answer = http_client::request(port_, "GET", path);
            off = answer.status == 200 ? shown_difference(wanted, Json::parse(answer.body, nullptr, false))
                                       : "status " + std::to_string(answer.status);
            return off.empty();
          }))
        return std::string("GET ").append(target).append(": ").append(off);
    }
    return "";
  }

  void drain() {
    bus::SampleInfo info;
    for (auto& [topic, reader] : readers_)
      while (reader->take(bytes_, info)) {
        produced_.push_back({topic, static_cast<std::uint64_t>(info.source_timestamp), 0, bytes_});
        OperatorLine line;
        if (topic->handle == "operator_request" && bus::decode(bytes_, line)) lines_.push_back(line);
        answer(produced_.back());
      }
  }

  // In the place of the service that was asked.
  void answer(const StoredMessage& request) {
    const auto asker = asker_of(request);
    if (!asker || !asked_.insert(*asker).second || current_ == nullptr) return;
    const auto number = answered_++;
    const auto* topic = reply_topic(*request.topic);
    if (topic == nullptr || number >= current_->replies.size() || !current_->replies[number]) return;
    writer(*topic).write(addressed_to(*current_->replies[number], request));
  }

  const VerifyOptions& options_;
  const GatewayPlan& plan_;
  bus::Bus& bus_;
  cluster::ChildProcess& process_;
  const std::uint16_t port_;
  std::vector<std::pair<const bus::TopicEntry*, std::unique_ptr<bus::RawReader>>> readers_;
  std::map<const bus::TopicEntry*, std::unique_ptr<bus::RawWriter>> writers_;
  std::unique_ptr<StateStream> stream_;
  ShownState shown_;
  std::vector<StoredMessage> produced_;
  std::vector<OperatorLine> lines_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> asked_;
  const OperatorRequest* current_ = nullptr;  ///< whose replies are due
  std::size_t answered_ = 0, wanted_lines_ = 0, samples_ = 0, fed_ = 0;
  bus::Bytes bytes_;
  double began_ = 0, ended_ = 0;
};

}  // namespace

VerifyResult verify_gateway(const VerifyOptions& options, const StoredRecording& recording) {
  const auto plan = plan_gateway(recording);
  VerifyResult result;
  std::vector<StoredMessage> produced;
  {
    const VerifyPlace place(options.domain);
    const auto port = http_client::free_port();
    auto arguments = command_line(options, recording, plan.outputs, place);
    arguments.insert(arguments.end(), {"--port", std::to_string(port), "--verified"});
    bus::Bus bus(bus::Vendor::cyclonedds, {place.domain()}, {stream_batches});
    cluster::ChildProcess process(child_options(std::move(arguments), place));
    Verification verification(options, plan, bus, process, port);
    result.problem = verification.run();
    result.seconds = verification.seconds();
    result.samples = verification.samples();
    result.outputs = verification.produced().size();
    if (result.problem.empty())
      result.problem = unexpected_alarm(recording.messages, verification.produced(), options.service);
    drop_repetitions(verification.produced());
    produced = by_line(verification.produced(), verification.lines(), true);
  }
  result.inputs = plan.steps.size() - result.samples;
  result.requests = plan.requests.size();
  result.left_out = plan.left_out;
  result.cycles = plan.outputs.cycles;
  if (result.seconds > 0)
    result.times_real_time = static_cast<double>(result.cycles) * plan.outputs.cycle_seconds / result.seconds;
  auto comparison = options.comparison;
  comparison.topics = plan.outputs.topics;
  comparison.ignored.insert(plan.outputs.ignored.begin(), plan.outputs.ignored.end());
  result.difference = difference(plan.outputs.expected, produced, comparison);
  return result;
}

}  // namespace trunnion::verification
