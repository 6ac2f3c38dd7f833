// SPDX-License-Identifier: Apache-2.0
#include "interrupt_watch.hpp"

#include <atomic>
#include <csignal>

namespace trunnion::cli {
namespace {

std::atomic<bool> interrupt_requested{false};

void note(int) { interrupt_requested = true; }

void handle(bool hangup, void (*handler)(int)) {
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, handler);
  if (hangup) std::signal(SIGHUP, handler);
}

}  // namespace

InterruptWatch::InterruptWatch(bool hangup) : hangup_(hangup) {
  interrupt_requested = false;
  handle(hangup_, &note);
}
InterruptWatch::~InterruptWatch() { handle(hangup_, SIG_DFL); }
bool InterruptWatch::requested() { return interrupt_requested; }

}  // namespace trunnion::cli
