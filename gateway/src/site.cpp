// SPDX-License-Identifier: Apache-2.0
#include "src/site.hpp"

#include <algorithm>
#include <cctype>

namespace trunnion::gateway {
namespace {

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// No name of a computer ends in a label of digits alone, so digits and dots are an address.
bool is_address(std::string_view host) {
  return host.starts_with('[') ||
         std::ranges::all_of(host, [](unsigned char c) { return std::isdigit(c) != 0 || c == '.'; });
}

std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.find(':'));
}

}  // namespace

Site::Site(std::vector<std::string> names) : names_(std::move(names)) {
  for (auto& name : names_) name = lower_case(name);
}

bool Site::is_named(std::string_view host) const {
  if (host.empty()) return true;
  auto name = lower_case(without_port(host));
  if (is_address(name) && !name.empty()) return true;
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
