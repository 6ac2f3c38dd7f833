// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS 0.10 receives on every interface of the host, whatever interface it is configured for
// (eclipse-cyclonedds/cyclonedds #1923): its sockets are bound to no address. The dynamic linker prefers this
// definition to the library's: an unsecured domain of one host is not reachable from others.
#include "loopback_bind.hpp"

#include <dds/ddsrt/sockets.h>
#include <dlfcn.h>
#include <netinet/in.h>

#include <atomic>
#include <cstring>

namespace trunnion::bus {
namespace {

std::atomic<bool> only_loopback{false};

bool receives_on_all(const sockaddr* address, socklen_t size) {
  if (size < sizeof(sockaddr_in) || address->sa_family != AF_INET) return false;
  sockaddr_in any{};
  std::memcpy(&any, address, sizeof any);
  return any.sin_addr.s_addr == htonl(INADDR_ANY);
}

}  // namespace

void bind_to_loopback(bool only) { only_loopback = only; }

}  // namespace trunnion::bus

extern "C" dds_return_t ddsrt_bind(ddsrt_socket_t socket, const struct sockaddr* address, socklen_t size) {
  using Bind = dds_return_t (*)(ddsrt_socket_t, const sockaddr*, socklen_t);
  static const auto bind = reinterpret_cast<Bind>(dlsym(RTLD_NEXT, "ddsrt_bind"));
  if (!trunnion::bus::only_loopback || !trunnion::bus::receives_on_all(address, size))
    return bind(socket, address, size);
  sockaddr_in loopback{};
  std::memcpy(&loopback, address, sizeof loopback);
  loopback.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return bind(socket, reinterpret_cast<const sockaddr*>(&loopback), sizeof loopback);
}
