// SPDX-License-Identifier: Apache-2.0
// One station operates, as far as orders come through the gateway or from the command line.
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "access/operating_right.hpp"
#include "access_control.hpp"
#include "answer.hpp"
#include "src/router.hpp"

namespace trunnion::gateway {

class OperatingControl {
 public:
  /// Of a browser without a login.
  static constexpr const char* cookie = "trunnion_station";

  OperatingControl(bool on, AccessControl& access) : on_(on), access_(access) {}
  bool on() const { return on_; }

  /// Who sends a request: the session or token of a login, else the cookie of the browser, else the address.
  access::Station station_of(std::string_view cookies, const std::string& peer,
                             const std::optional<access::Identity>& user) const;
  /// 409 when another station operates and `match` is an order. An order takes the right when it is free.
  std::optional<Answer> refusal(const access::Station& station, const Match& match);
  /// The station's page is open.
  void present(const access::Station& station);
  /// GET, POST {"action": "take", "hand_over", "refuse" or "release"}.
  Answer handle(const Match& match, const RequestText& request);

  /// Of the command line: empty, or the name of who holds the right.
  std::string take_for_command(const access::Station& station, bool take_over);
  void release(const access::Station& station);
  /// {"holder", "asking"} for the stream, those that there are; null when every station operates.
  bus::Json document();

 private:
  Answer state(const access::Station& station);
  void note(const access::Station& station, const std::string& what) { access_.note(station.name, what); }

  const bool on_;
  AccessControl& access_;
  std::mutex mutex_;
  access::OperatingRight right_;
};

}  // namespace trunnion::gateway
