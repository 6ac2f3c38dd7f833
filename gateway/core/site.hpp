// SPDX-License-Identifier: Apache-2.0
// Which pages may operate the machine: those that the gateway itself has delivered, under a name that is its
// own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trunnion::gateway {

class Site {
 public:
  /// `names` of the gateway besides addresses and localhost, without port, in any case.
  explicit Site(std::vector<std::string> names = {});

  /// Whether the header Host names this gateway: an address, localhost, one of its names, or nothing, as
  /// programs may send. Another name is one whose owner lets it lead here, so that a browser takes his page
  /// for the gateway's (DNS rebinding).
  bool is_named(std::string_view host) const;

 private:
  std::vector<std::string> names_;
};

/// Whether a page of another site sent the request: `origin` as in the header of that name, `host` as in
/// Host. One that came in clear text is another site when the request is `secure`; the other way it is that
/// of a proxy that encrypts.
bool foreign_origin(std::string_view origin, std::string_view host, bool secure);

}  // namespace trunnion::gateway
