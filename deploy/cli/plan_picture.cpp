// SPDX-License-Identifier: Apache-2.0
#include "plan_picture.hpp"

#include <algorithm>

#include "report/plot.hpp"

namespace trunnion::cli {
namespace {

constexpr std::size_t most_shown = 8192;
constexpr double frame_height = 440, path_left = 85, time_left = 650, time_width = 620, frame_top = 60;
constexpr const char* motion_style = "stroke=\"#0969da\" stroke-width=\"1.2\"";
constexpr const char* programmed_feed_style =
    "stroke=\"#57606a\" stroke-width=\"1.2\" stroke-dasharray=\"5 4\"";
constexpr const char* place_style = "stroke=\"#cf222e\" stroke-width=\"3\"";

// `low` to `high` in the middle of a range of `span`.
report::Range around(double low, double high, double span) {
  const double middle = (low + high) / 2;
  return {middle - span / 2, middle + span / 2};
}

std::string number_at(double x, double y, std::size_t number) {
  return report::text(x + 5, y - 5, std::to_string(number), "fill=\"#cf222e\" font-weight=\"bold\"");
}

}  // namespace

void PlanPicture::add(const analysis::PlannedCycle& cycle) {
  if (cycle.cycle % stride_ != 0) return;
  if (shown_.size() == most_shown) {
    thin_out();
    if (cycle.cycle % stride_ != 0) return;
  }
  const motion::Setpoint& now = *cycle.setpoint;
  shown_.push_back({static_cast<double>(cycle.cycle) * period_, cycle.tip[0], cycle.tip[1], now.feed * 60,
                    now.programmed_speed * 60});
}

void PlanPicture::thin_out() {
  for (std::size_t i = 0; 2 * i < shown_.size(); ++i) shown_[i] = shown_[2 * i];
  shown_.resize((shown_.size() + 1) / 2);
  stride_ *= 2;
}

// At least one: a place may be shorter than the distance of the cycles that are kept.
std::vector<PlanPicture::Shown> PlanPicture::between(double begin, double end) const {
  const auto before = [](const Shown& shown, double time) { return shown.time < time; };
  const auto from = std::lower_bound(shown_.begin(), shown_.end(), begin, before);
  const auto to = std::lower_bound(from, shown_.end(), end, before);
  if (from == to) return {from == shown_.end() ? shown_.back() : *from};
  return {from, to};
}

std::string PlanPicture::svg(const std::string& title,
                             const std::vector<analysis::CostlyPlace>& places) const {
  Shown low{}, high{};
  if (!shown_.empty()) low = high = shown_.front();
  for (const Shown& s : shown_) {
    low.x = std::min(low.x, s.x), low.y = std::min(low.y, s.y);
    high.x = std::max(high.x, s.x), high.y = std::max(high.y, s.y);
    high.feed = std::max({high.feed, s.feed, s.programmed});
    high.time = s.time;
  }
  const double span = std::max({1e-3, 1.1 * (high.x - low.x), 1.1 * (high.y - low.y)});
  report::Plot path(path_left, frame_top, frame_height, frame_height, around(low.x, high.x, span),
                    around(low.y, high.y, span));
  path.title(title);
  path.labels("X mm", "Y mm");
  report::Plot feed(time_left, frame_top, time_width, frame_height, {0, std::max(high.time, period_)},
                    {0, std::max(1.0, 1.05 * high.feed)});
  feed.title("Feed, and as programmed");
  feed.labels("s", "mm/min");

  std::vector<report::PlotPoint> points, feeds, programmed;
  for (const Shown& s : shown_) {
    points.push_back({s.x, s.y});
    feeds.push_back({s.time, s.feed});
    programmed.push_back({s.time, s.programmed});
  }
  path.curve(points, motion_style);
  feed.curve(programmed, programmed_feed_style);
  feed.curve(feeds, motion_style);
  std::string words;
  double line = frame_top + frame_height + 75;
  words += report::text(path_left, line,
                        places.empty() ? "The programmed feed is kept everywhere."
                                       : "The places that lose most time (lines of the program):");
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto& place = places[k];
    points.clear(), feeds.clear();
    for (const Shown& s : between(place.begin, place.end)) {
      points.push_back({s.x, s.y});
      feeds.push_back({s.time, s.feed});
    }
    words += number_at(path.pixel_x(points.front().x), path.pixel_y(points.front().y), k + 1);
    words += number_at(feed.pixel_x(feeds.front().x), feed.pixel_y(feeds.front().y), k + 1);
    path.curve(points, place_style);
    feed.curve(feeds, place_style);
    words += report::text(path_left, line += 20, std::to_string(k + 1) + ". " + to_text(place));
  }
  return report::document(time_left + time_width + 40, line + 30, path.svg() + feed.svg() + words);
}

}  // namespace trunnion::cli
