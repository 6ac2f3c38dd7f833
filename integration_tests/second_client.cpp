// SPDX-License-Identifier: Apache-2.0
// Takes part in a running cluster twice: a first client lives for `--first-lives-ms` and asks nothing, then a
// second one waits for the state of channel 0 and for the list of programs. Exit status 1 when one of them
// never came.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <thread>

#include "cluster/client.hpp"
#include "service/node.hpp"

int main(int argc, char** argv) {
  using namespace trunnion;
  CLI::App app("second-client");
  std::uint32_t domain = 0;
  int first_lives = 0;
  double seconds = 20;
  app.add_option("--domain", domain)->required();
  app.add_option("--first-lives-ms", first_lives);
  app.add_option("--seconds", seconds, "how long the second one waits");
  CLI11_PARSE(app, argc, argv);
  {
    const cluster::Client first(domain);
    std::this_thread::sleep_for(std::chrono::milliseconds(first_lives));
  }
  cluster::Client client(domain);
  auto states = client.bus().reader(topics::channel_state);
  auto lists = client.bus().reader(topics::program_list);
  idl::channel::ChannelState state;
  idl::program::ProgramList list;
  bool have_state = false, have_list = false;
  const double end = service::monotonic_seconds() + seconds;
  while (!(have_state && have_list) && service::monotonic_seconds() < end) {
    have_state = states.take(state) || have_state;
    have_list = lists.take(list) || have_list;
    client.bus().signal().wait(0.01);
  }
  std::printf("state of channel 0: %s, list of programs: %s\n", have_state ? "received" : "never came",
              have_list ? "received" : "never came");
  return have_state && have_list ? 0 : 1;
}
