#include "service.hpp"

#include <ctime>

#include "machine/axes.hpp"

namespace trunnion::gateway {
namespace {

std::string time_of_day() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// Replaces `kept` by the newest sample; true when there was one.
template <class T>
bool keep_newest(bus::Reader<T>& reader, std::shared_ptr<const T>& kept) {
  T value;
  if (!reader.take_newest(value)) return false;
  kept = std::make_shared<const T>(std::move(value));
  return true;
}

std::vector<std::uint16_t> drive_columns(const idl::parameters::ParameterSet& set) {
  machine::Parameters parameters;
  for (const auto& value : set.values) parameters.values[value.number] = {value.value, value.text};
  std::vector<std::uint16_t> columns;
  for (const auto& axis : machine::drive_axes(parameters)) columns.push_back(axis.number);
  return columns;
}

}  // namespace

GatewayService::GatewayService(node::Node& node, const GatewayOptions& options)
    : mailbox_([&node] { node.bus().signal().notify(); }),
      links_(node.bus()),
      announcements_(node.bus().reader(topics::announcement)),
      service_states_(node.bus().reader(topics::service_state)),
      alarms_(node.bus().reader(topics::alarm)),
      cluster_(node.bus().reader(topics::cluster)),
      channel_states_(node.bus().reader(topics::channel_state)),
      feedback_(node.bus().reader(topics::feedback_frame)),
      outputs_(node.bus().reader(topics::plc_outputs)),
      image_(node.bus().reader(topics::plc_image)),
      parameters_(node.bus().reader(topics::parameter_set)),
      tools_(node.bus().reader(topics::tool_table)),
      offsets_(node.bus().reader(topics::work_offsets)),
      programs_(node.bus().reader(topics::program_list)),
      document_(topics::contract_hash) {
  const auto port = options.port != 0 ? options.port : node.options().machine.port;
  api_ = std::make_unique<Api>(mailbox_, topics::contract_hash, options.web);
  server_ = std::make_unique<HttpServer>(options.address, port, *api_);
  where_ = "http://" + options.address + ":" + std::to_string(port);
}

GatewayService::~GatewayService() { server_->stop(); }

double GatewayService::period() const { return links_.busy() ? 0.02 : snapshot_period; }

node::Health GatewayService::health() const {
  node::Health health;
  health.lifecycle = idl::service::Lifecycle::ACTIVE;
  health.detail = where_ + ", " + std::to_string(server_->clients()) + " viewing";
  health.frames_in = frames_;
  health.revision = next_.parameters ? next_.parameters->revision : 0;
  return health;
}

void GatewayService::drain(double now) {
  idl::service::Announcement announcement;
  while (announcements_.take(announcement)) document_.apply(announcement);
  idl::service::Alarm alarm;
  while (alarms_.take(alarm)) document_.apply(alarm, now, time_of_day());
  idl::service::ServiceState state;
  while (service_states_.take(state)) document_.apply(state, now);
  idl::service::Cluster cluster;
  if (cluster_.take_newest(cluster)) document_.apply(cluster);
  idl::channel::ChannelState channel;
  while (channel_states_.take(channel)) {
    document_.apply(channel);
    next_.channels[channel.channel] = channel;
  }
  idl::stream::FeedbackFrame frame;
  while (feedback_.take(frame)) {
    document_.apply(frame);
    ++frames_;
  }
  idl::plc::Outputs outputs;
  if (outputs_.take_newest(outputs)) document_.apply(outputs);
  keep_newest(image_, next_.image);
  if (keep_newest(parameters_, next_.parameters)) {
    document_.set_revision("parameters", next_.parameters->revision);
    document_.set_revision("pending", next_.parameters->pending.size());
    document_.set_drive_axes(drive_columns(*next_.parameters));
  }
  if (keep_newest(tools_, next_.tools)) document_.set_revision("tools", next_.tools->revision);
  if (keep_newest(offsets_, next_.offsets)) document_.set_revision("work_offsets", next_.offsets->revision);
  if (keep_newest(programs_, next_.programs)) document_.set_revision("programs", next_.programs->revision);
}

void GatewayService::publish(double now) {
  ++next_.sequence;
  next_.document = document_.document(now);
  mailbox_.publish(std::make_shared<const Snapshot>(next_));
  published_ = now;
}

void GatewayService::pump() {
  const double now = node::monotonic_seconds();
  drain(now);
  for (const auto& job : mailbox_.take()) job(links_, now);
  links_.pump(now);
  if (now - published_ >= snapshot_period) publish(now);
}

}  // namespace trunnion::gateway
