#include "stream/copy_watch.hpp"

#include <algorithm>

namespace trunnion::stream {
namespace {

auto place(const CopyWatch::Copy& copy) { return std::pair(copy.epoch, copy.next); }

}  // namespace

CopyWatch::CopyWatch(const std::vector<machine::ServiceEntry>& services, double now) {
  for (const auto& entry : services) {
    const auto stage = stage_of(entry.service);
    const auto copies = std::count_if(services.begin(), services.end(),
                                      [&](const auto& other) { return other.service == entry.service; });
    if (!stage || copies < 2) continue;
    Copy copy;
    copy.stage = *stage;
    copy.copy = static_cast<std::uint8_t>(entry.copy);
    copy.lagging_since = now;
    copies_.push_back(copy);
  }
}

void CopyWatch::heard(const idl::stream::StageProgress& progress, double now) {
  for (auto& copy : copies_) {
    if (copy.stage != progress.stage || copy.copy != progress.copy) continue;
    const bool further = std::pair(progress.epoch, progress.next) > place(copy);
    copy.heard = now;
    copy.reports_in_step = progress.in_step;
    copy.epoch = progress.epoch;
    copy.next = progress.next;
    if (further && progress.in_step && copy.lags()) copy.lagging_since = now;
  }
}

bool CopyWatch::behind(const Copy& copy) const {
  return std::any_of(copies_.begin(), copies_.end(), [&](const Copy& other) {
    return other.stage == copy.stage && other.standing == Standing::in_step && place(other) > place(copy);
  });
}

bool CopyWatch::far_behind(const Copy& copy, std::uint64_t distance) const {
  return std::any_of(copies_.begin(), copies_.end(), [&](const Copy& other) {
    return other.stage == copy.stage && other.standing == Standing::in_step &&
           (other.epoch > copy.epoch || (other.epoch == copy.epoch && other.next > copy.next + distance));
  });
}

std::vector<CopyWatch::Change> CopyWatch::judge(std::uint64_t lead, double now) {
  std::vector<Change> changes;
  for (auto& copy : copies_) {
    const bool silent = copy.heard == 0 || now - copy.heard > sign_patience;
    const bool late = silent || !copy.reports_in_step;
    if (!late && !behind(copy))
      copy.lagging_since = 0;
    else if (!copy.lags())
      copy.lagging_since = now;
    const bool overdue = copy.lags() && now - copy.lagging_since > progress_patience;
    const auto before = copy.standing;
    if (!late && !overdue && (before == Standing::in_step || !far_behind(copy, 2 * lead)))
      copy.standing = Standing::in_step;
    else if (overdue && copy.heard != 0)
      copy.standing = Standing::dropped;
    else if (late && before == Standing::in_step)
      copy.standing = Standing::joining;
    if (before == Standing::dropped && copy.standing == Standing::in_step)
      changes.push_back({copy.stage, copy.copy, false});
    if (before != Standing::dropped && copy.standing == Standing::dropped)
      changes.push_back({copy.stage, copy.copy, true});
  }
  return changes;
}

bool CopyWatch::may_start(double now) const {
  return std::all_of(copies_.begin(), copies_.end(), [&](const Copy& copy) {
    return copy.standing == Standing::in_step || (copy.lags() && now - copy.lagging_since > start_patience);
  });
}

std::uint64_t CopyWatch::floor() const {
  std::uint64_t result = everywhere;
  for (const auto& copy : copies_)
    if (copy.standing == Standing::in_step) result = std::min(result, copy.next);
  return result;
}

}  // namespace trunnion::stream
