// SPDX-License-Identifier: Apache-2.0
#include "core/site.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "text/utf8.hpp"

namespace trunnion::gateway {
namespace {

bool is_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  if (host.starts_with('[') && host.ends_with(']'))
    return inet_pton(AF_INET6, host.substr(1, host.size() - 2).c_str(), address.data()) == 1;
  return inet_pton(AF_INET, host.c_str(), address.data()) == 1;
}

/// Without ":80"; empty when what follows the name is no port.
std::string_view without_port(std::string_view host) {
  const auto end = host.starts_with('[') ? host.find(']') + 1 : std::min(host.find(':'), host.size());
  auto port = host.substr(end);
  if (!port.empty() && port.front() != ':') return {};
  if (!port.empty()) port.remove_prefix(1);
  const bool digits = std::ranges::all_of(port, [](unsigned char c) { return std::isdigit(c) != 0; });
  return digits && port.size() <= 5 ? host.substr(0, end) : std::string_view();
}

}  // namespace

Site::Site(std::vector<std::string> names) : names_(std::move(names)) {
  for (auto& name : names_) name = text::lower_case(name);
}

bool Site::is_named(std::string_view host) const {
  if (host.empty()) return true;
  auto name = text::lower_case(std::string(without_port(host)));
  if (is_address(name)) return true;
  if (name.ends_with('.')) name.pop_back();
  return name == "localhost" || std::ranges::find(names_, name) != names_.end();
}

bool foreign_origin(std::string_view origin, std::string_view host, bool secure) {
  if (origin.empty()) return false;
  if (secure && !origin.starts_with("https://")) return true;
  const auto scheme = origin.find("://");
  return scheme == std::string_view::npos || origin.substr(scheme + 3) != host;
}

}  // namespace trunnion::gateway
