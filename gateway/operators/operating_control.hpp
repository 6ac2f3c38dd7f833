// SPDX-License-Identifier: Apache-2.0
// One station operates, as far as orders come through the gateway or from the command line.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "access/operating_right.hpp"
#include "answer.hpp"
#include "core/router.hpp"
#include "operators/access_control.hpp"

namespace trunnion::gateway {

struct SharedRight {
  std::mutex mutex;
  access::OperatingRight right;
};

/// An order under way, with the right that it has reserved.
class OrderUnderWay {
 public:
  OrderUnderWay(std::shared_ptr<SharedRight> right, access::Station station, std::uint64_t reservation)
      : right_(std::move(right)), station_(std::move(station)), reservation_(reservation) {}
  OrderUnderWay(const OrderUnderWay&) = delete;
  OrderUnderWay& operator=(const OrderUnderWay&) = delete;
  ~OrderUnderWay() { end(false); }
  /// Once. True when the station has got the right by it.
  bool end(bool accepted);
  const access::Station& station() const { return station_; }

 private:
  std::shared_ptr<SharedRight> right_;  ///< null when it has ended
  access::Station station_;
  std::uint64_t reservation_;
};

class OperatingControl {
 public:
  /// Of a browser without a login.
  static constexpr const char* cookie = "trunnion_station";

  OperatingControl(bool on, AccessControl& access) : on_(on), access_(access) {}
  bool on() const { return on_; }

  /// Who sends a request: the session or token of a login, else the cookie of the browser, else the address.
  access::Station station_of(std::string_view cookies, const std::string& peer,
                             const std::optional<access::Identity>& user) const;
  /// 409 when another station operates and `match` is an order. When the right is free, `order` reserves it
  /// until it is answered or destroyed.
  std::optional<Answer> refusal(const access::Station& station, const Match& match,
                                std::shared_ptr<OrderUnderWay>& order);
  /// Ends `order`, if there is one: one that is accepted takes the right.
  void answered(const std::shared_ptr<OrderUnderWay>& order, unsigned status);
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
  /// Shared with orders under way, which may live longer.
  const std::shared_ptr<SharedRight> shared_ = std::make_shared<SharedRight>();
  std::mutex& mutex_ = shared_->mutex;
  access::OperatingRight& right_ = shared_->right;
};

}  // namespace trunnion::gateway
