// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <malloc.h>

#include <ctime>
#include <iostream>

#include "machine/alarm_constants.hpp"

namespace trunnion::gateway {
namespace {

constexpr double alarms_heard_within = 5;  // s after the start: active ones are published to late readers
constexpr double write_again_after = 2;    // s
constexpr std::size_t largest_alarm_file = 2u << 20;  // bytes, then it is rewritten with what is kept

}  // namespace

GatewayService::GatewayService(service::Node& node, const GatewayOptions& options)
    : mailbox_([&node] { node.bus().signal().notify(); }),
      links_(node.bus()),
      view_(node.bus(), options.title, options.change),
      alarms_(node.alarms()) {
  if (options.tls.on()) certificate_.emplace(options.tls);
  if (!options.alarm_file.empty()) begin_alarm_history(options.alarm_file);
  api_ = std::make_unique<Api>(mailbox_, topics::contract_hash, options.web, options.recordings,
                               options.access, options.one_operates, options.measurement);
  server_ = std::make_unique<HttpServer>(options.address, options.port, *api_, Site(options.host_names),
                                         options.command_socket, certificate_ ? &*certificate_ : nullptr);
  where_ = (options.tls.on() ? "https://" : "http://") + options.address + ":" + std::to_string(options.port);
  if (options.mtconnect_port == 0) return;
  try {
    mtconnect_ = std::make_unique<mtconnect::Server>(options.address, options.mtconnect_port, mailbox_,
                                                     options.mtconnect);
  } catch (const std::runtime_error& error) {
    // The machine is operated without it: another machine of this computer may have the port.
    where_ += std::string(", no MTConnect: ") + error.what();
    std::cerr << "trunnion-gateway: MTConnect: " << error.what() << ": set mtconnect_port in machine.yaml\n";
  }
}

GatewayService::~GatewayService() {
  mtconnect_.reset();
  server_->stop();
  api_->stop();
}

double GatewayService::period() const { return links_.period().value_or(state_period); }

service::Health GatewayService::health() const {
  service::Health health;
  health.lifecycle = idl::service::Lifecycle::ACTIVE;
  health.detail = where_ + ", " + std::to_string(server_->clients()) + " viewing";
  health.messages_in = view_.batches();
  health.revision = view_.revision();
  return health;
}

void GatewayService::publish(double now, bool with_replies) {
  mailbox_.publish(view_.state(now, api_->operating().document(), with_replies));
  server_->show();
  published_ = now;
}

void GatewayService::watch_certificate(double now) {
  constexpr double looked_at_every = 2;  // s
  if (!certificate_ || now - watched_ < looked_at_every) return;
  watched_ = now;
  api_->files().post([this] { certificate_->refresh(); });
  const auto say = [this](const machine::AlarmDefinition& alarm, const std::string& text) {
    if (text.empty())
      alarms_.clear(alarm, 0);
    else
      alarms_.raise(alarm, 0, text);
  };
  say(alarm::certificate_ends, certificate_->ending(std::time(nullptr)));
  say(alarm::certificate_refused, certificate_->refused());
}

void GatewayService::give_memory_back(double now) {
  constexpr double given_back_every = 10;  // s
  if (now - given_back_ < given_back_every) return;
  given_back_ = now;
  api_->files().post([] { malloc_trim(0); });
}

void GatewayService::begin_alarm_history(const std::string& file) {
  alarm_file_ = std::make_shared<AlarmFile>(file);
  auto& history = view_.alarm_history();
  const auto lines = alarm_file_->read();
  const auto damaged = history.restore(lines);
  if (damaged > 0 || lines.size() > largest_alarm_file || (!lines.empty() && lines.back() != '\n'))
    alarm_file_->replace(history.lines());
  settles_ = service::monotonic_seconds() + alarms_heard_within;
}

void GatewayService::keep_alarm_history(double now) {
  if (!alarm_file_) return;
  auto& history = view_.alarm_history();
  if (settles_ > 0 && now >= settles_) {
    history.settle(service::time_of_day());
    settles_ = 0;
  }
  // What could not be written is written with the whole, as soon as that is possible.
  const bool again = alarm_file_->failed() && now >= written_again_;
  if (auto lines = history.take_lines(); !lines.empty() || again) {
    appended_ += lines.size();
    const bool replace = again || appended_ > largest_alarm_file;
    if (again) written_again_ = now + write_again_after;
    if (replace) {
      lines = history.lines();
      appended_ = 0;
    }
    api_->files().post([file = alarm_file_, lines = std::move(lines), replace] {
      replace ? file->replace(lines) : file->append(lines);
    });
  }
  if (alarm_file_->failed() == alarm_file_failed_) return;
  alarm_file_failed_ = !alarm_file_failed_;
  if (alarm_file_failed_)
    alarms_.raise(alarm::storage_failed, 0,
                  std::string(AlarmFile::name) +
                      " cannot be written: the history of the alarms ends with the "
                      "gateway");
  else
    alarms_.release(alarm::storage_failed, 0);
}

void GatewayService::pump() {
  const double now = service::monotonic_seconds();
  // Who has a reply is not shown an older state: services write it before they reply.
  bool replies = links_.receive();
  view_.drain(now);
  // A press that the drive holds is accepted, also when the PLC hangs.
  if (const auto& press = view_.press(); press.number != 0)
    replies = links_.panel.answer({press.client, press.number, true, ""}) || replies;
  if (replies) publish(now, true);
  for (const auto& job : mailbox_.take()) job(links_, now);
  links_.pump(now);
  watch_certificate(now);
  keep_alarm_history(now);
  give_memory_back(now);
  if (now - published_ >= state_period) publish(now, false);
}

}  // namespace trunnion::gateway
