// SPDX-License-Identifier: Apache-2.0
#include "couple_command.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <iostream>
#include <stdexcept>

#include "bus/json.hpp"
#include "canonical/program_dialect.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/operating_station.hpp"
#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "mdi_line.hpp"
#include "spindle_orders.hpp"
#include "spindle_status.hpp"

namespace trunnion::cli {
namespace {

constexpr double longest_order = 60;     // s, of one line
constexpr double longest_coupling = 60;  // s, behind the last one
// The drive may not have taken the order when the line has ended, and says what was before: as many messages
// of it in a row must agree with the order.
constexpr int agreeing_messages = 10;

SpindleStatus await_coupling(cluster::Client& client, const CouplingOrder& order,
                             const std::vector<machine::AxisInfo>& machine_spindles) {
  auto feedbacks = client.reader_from_now(topics::feedback);
  const double until = service::monotonic_seconds() + longest_coupling;
  idl::stream::Feedback feedback;
  int agreeing = 0;
  while (agreeing < agreeing_messages && service::monotonic_seconds() < until) {
    client.bus().signal().wait(0.02);
    while (agreeing < agreeing_messages && feedbacks.take(feedback))
      agreeing = is_carried_out(order, feedback) ? agreeing + 1 : 0;
  }
  const auto shown = spindle_status(machine_spindles, feedback);
  if (shown.size() <= order.slave) throw std::runtime_error("the drive says nothing of the spindle");
  if (agreeing < agreeing_messages)
    throw std::runtime_error(
        fmt::format("the order was given, and after {:.0f} s it is not carried out: {}. See "
                    "'trunnion alarms'",
                    longest_coupling, shown[order.slave].line()));
  return shown[order.slave];
}

}  // namespace

int couple_spindles(const Common& common, const std::string& word, const std::vector<std::string>& arguments,
                    std::uint16_t channel, bool take_over) {
  const auto cluster = cluster::find_cluster(common.domain);
  cluster::Client client(cluster.run.domain);
  const auto parameters = machine::parameters_of(client.newest(topics::parameter_set));
  const auto machine_spindles = machine::spindles(parameters);
  const auto order = coupling_order(word, arguments, machine_spindles);
  const auto dialect =
      static_cast<canonical::ProgramDialect>(parameters.integer(parameter::program_dialect, channel));
  const bool num = dialect == canonical::ProgramDialect::num;
  const bool other = !num && dialect != canonical::ProgramDialect::iso;
  auto lines = order_lines(order, num);
  for (auto& line : lines) line.insert(0, other ? canonical::iso_head : "");
  const cluster::OperatingStation station(cluster.run.domain, take_over);
  for (const auto& line : lines) run_line(client, channel, line, longest_order);
  const auto slave = await_coupling(client, order, machine_spindles);
  if (common.json)
    std::cout << bus::text_of(slave.json()) << "\n";
  else
    std::printf("%s\n", slave.line().c_str());
  return 0;
}

}  // namespace trunnion::cli
