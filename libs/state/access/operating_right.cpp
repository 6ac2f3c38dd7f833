// SPDX-License-Identifier: Apache-2.0
#include "access/operating_right.hpp"

#include <utility>

#include "access/secrets.hpp"

namespace trunnion::access {

ShownStation shown(const Station& station) {
  return {static_cast<std::uint32_t>(std::stoul(digest(station.key).substr(0, 7), nullptr, 16)),
          station.name};
}

std::optional<ShownStation> OperatingRight::current(const std::optional<Present>& one, double now) {
  if (!one || now - one->seen > lease) return {};
  return shown(one->station);
}

void OperatingRight::expire(double now) {
  if (holder_ && now - holder_->seen > lease) holder_.reset();
  if (asking_ && now - asking_->seen > lease) asking_.reset();
}

std::string OperatingRight::order(const Station& station, double now) {
  expire(now);
  if (holder_ && holder_->station.key != station.key) return holder_->station.name;
  if (holder_) {
    holder_ = {station, now};
    return {};
  }
  if (reserved_ && reserved_->key != station.key) return reserved_->name;
  if (!reserved_) orders_ = 0, ++reservation_;
  reserved_ = station;
  ++orders_;
  return {};
}

bool OperatingRight::answered(std::uint64_t reservation, bool accepted, double now) {
  if (!reserved_ || reservation != reservation_) return false;
  if (!accepted) {
    if (--orders_ == 0) reserved_.reset();
    return false;
  }
  give_to(*std::exchange(reserved_, {}), now);
  return true;
}

void OperatingRight::give_to(const Station& station, double now) {
  holder_ = {station, now};
  reserved_.reset();
  if (asking_ && asking_->station.key == station.key) asking_.reset();
}

void OperatingRight::present(std::string_view key, double now) {
  expire(now);
  for (auto* one : {&holder_, &asking_})
    if (*one && (*one)->station.key == key) (*one)->seen = now;
}

OperatingRight::Taken OperatingRight::take(const Station& station, double now) {
  expire(now);
  if (holder_ && holder_->station.key != station.key && !station.may_take_over) {
    asking_ = {station, now};
    return Taken::asked;
  }
  give_to(station, now);
  return Taken::yes;
}

bool OperatingRight::hand_over(std::string_view key, double now) {
  expire(now);
  if (!asking_ || !is_held_by(key, now)) return false;
  holder_ = std::move(asking_);
  asking_.reset();
  return true;
}

bool OperatingRight::refuse(std::string_view key, double now) {
  expire(now);
  if (!asking_ || !is_held_by(key, now)) return false;
  asking_.reset();
  return true;
}

void OperatingRight::release(std::string_view key) {
  for (auto* one : {&holder_, &asking_})
    if (*one && (*one)->station.key == key) one->reset();
}

}  // namespace trunnion::access
