// SPDX-License-Identifier: Apache-2.0
// Requests to swap a service: which are served, and which are refused before anything is started.
#include <algorithm>
#include <cstdio>
#include <utility>

#include "cluster/instances.hpp"
#include "cluster/swap_ticket.hpp"
#include "launcher.hpp"
#include "machine/alarm_constants.hpp"
#include "service/node.hpp"
#include "storage/file.hpp"
#include "swap_journal.hpp"
#include "text/utf8.hpp"

namespace trunnion::launcher {

ServiceProcess* Launcher::whom_to_swap(const idl::service::SwapRequest& request) {
  const auto found = std::find_if(processes_.begin(), processes_.end(), [&](const ServiceProcess& p) {
    return p.entry.service == request.service && p.entry.replica == request.replica &&
           (p.entry.service != "channel" || p.entry.channel == request.channel);
  });
  return found == processes_.end() ? nullptr : &*found;
}

// Why the request is not believed or would start a foreign program; empty when it may be served. In a secured
// cluster a certificate shows who asks; in an open one every participant may ask for the same executable
// again.
std::string Launcher::refused(const idl::service::SwapRequest& request) const {
  const auto why = cluster::take_ticket(options_.run.path(), request);
  const bool believed =
      why.empty() || !options_.network.security.empty() || (options_.open() && request.executable.empty());
  if (!believed) return "Swap of the " + request.service + " refused: " + why;
  if (request.executable.empty()) return "";
  auto directories = options_.machine.swap_directories;
  directories.insert(directories.begin(), cluster::binary_directory());
  const auto executable = cluster::refused_executable(request.executable, directories);
  return executable.empty() ? "" : "Swap of the " + request.service + " refused: " + executable;
}

void Launcher::report_refused(const idl::service::SwapRequest& request, const std::string& why) {
  alarms_.raise(alarm::swap_unauthorized, 0, why);
  alarms_.release(alarm::swap_unauthorized, 0);
  // Who sends many requests does not fill the disk.
  ++refusals_;
  if (refusal_written_ >= 0 && time_.now() - refusal_written_ < 1) return;
  refusal_written_ = time_.now();
  try {
    append_swap(options_.state_directory,
                refusal_line(request, why, service::time_of_day(), std::exchange(refusals_, 0)));
  } catch (const storage::StorageError& e) {
    std::fprintf(stderr, "%s\n", e.what());
  }
}

void Launcher::serve_swaps() {
  idl::service::SwapRequest request;
  while (swaps_.take(request)) {
    const auto refuse = [&](const std::string& why) {
      idl::service::SwapReply reply;
      reply.outcome = idl::service::SwapOutcome::REFUSED;
      reply.reason = text::shortened(why, 256);
      swaps_.reply(request, reply);
    };
    auto* process = whom_to_swap(request);
    const bool ours = process != nullptr ? process->local : is_first_host();
    if (!ours) {
      // No other host answers.
      if (process != nullptr && process->pid == 0 && is_first_host())
        refuse("Host " + process->entry.host + ", where the " + request.service + " runs, is silent");
      continue;
    }
    if (const auto why = refused(request); !why.empty()) {
      report_refused(request, why);
      refuse(why);
    } else if (swap_)
      refuse("Another service is being swapped");
    else if (process == nullptr)
      refuse("The cluster has no " + request.service + " of this number");
    else if (process->pid == 0 || process->lifecycle != idl::service::Lifecycle::ACTIVE)
      refuse("The " + request.service + " that runs now is not active");
    else {
      swap_request_ = request;
      const auto instance =
          cluster::place_of(process->entry.instance) + ++generation_ * cluster::generation_step;
      swap_ = std::make_unique<Swap>(bus_, options_, *process, request, instance, announced_, time_.now());
    }
  }
  if (!swap_) return;
  if (auto reply = swap_->step(time_.now())) {
    swaps_.reply(swap_request_, std::move(*reply));
    swap_.reset();
  }
}

}  // namespace trunnion::launcher
