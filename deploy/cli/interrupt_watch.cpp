// SPDX-License-Identifier: Apache-2.0
#include "interrupt_watch.hpp"

#include <atomic>
#include <csignal>

namespace trunnion::cli {
namespace {
std::atomic<bool> interrupt_requested{false};
}  // namespace

InterruptWatch::InterruptWatch() {
  interrupt_requested = false;
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, [](int) { interrupt_requested = true; });
}
InterruptWatch::~InterruptWatch() {
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, SIG_DFL);
}
bool InterruptWatch::requested() { return interrupt_requested; }

}  // namespace trunnion::cli
