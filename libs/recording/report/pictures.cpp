// SPDX-License-Identifier: Apache-2.0
// The report's pictures: the path with its error magnified, and feed and error over time.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "report/plot.hpp"
#include "report/report.hpp"

namespace trunnion::report {
namespace {

constexpr const char* programmed_style = "stroke=\"#57606a\" stroke-width=\"1.4\"";
constexpr const char* rapid_style = "stroke=\"#afb8c1\" stroke-width=\"1\" stroke-dasharray=\"5 4\"";
constexpr const char* commanded_style = "stroke=\"#0969da\" stroke-width=\"1.2\"";
constexpr const char* actual_style = "stroke=\"#cf222e\" stroke-width=\"1.2\"";
constexpr std::size_t most_points = 6000;
constexpr double margin = 0.08;
constexpr double largest_drawn_error = 0.05;  // of the view

struct Legend {
  double x, y;
  std::string svg;
  void add(const char* style, const std::string& words) {
    svg += line(x, y - 4.5, x + 26, y - 4.5, style);
    svg += text(x + 33, y, words);
    x += 33 + 7.7 * static_cast<double>(words.size()) + 22;
  }
};

struct Extent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

// What is cut, in workpiece coordinates; without cutting all there is.
Extent extent_of(const Report& report) {
  Extent extent;
  for (const bool rapids : {false, true}) {
    const auto& path = report.programmed.path;
    for (std::size_t i = 0; i < path.pieces().size(); ++i)
      if (rapids || !path.pieces()[i].rapid) {
        extent.add(path.begin_of(i) - report.programmed.zero);
        extent.add(path.pieces()[i].end - report.programmed.zero);
      }
    for (const auto& sample : report.samples)
      if (rapids || !sample.rapid) extent.add(sample.commanded - report.programmed.zero);
    if (extent.low.x() <= extent.high.x()) return extent;
  }
  extent.low = Vec3::Zero();
  extent.high = Vec3::Ones();
  return extent;
}

class PathView {
 public:
  PathView(const Report& report, const Extent& extent, int across, int up, double left, double top,
           double size, double span)
      : report_(report),
        across_(across),
        up_(up),
        plot_(left, top, size, size, range(extent, across, span), range(extent, up, span)) {
    const char* letters = "XYZ";
    plot_.title(std::string(1, letters[across]) + letters[up] + " view");
    plot_.labels(std::string(1, letters[across]) + " [mm]", std::string(1, letters[up]) + " [mm]");
  }

  void programmed() {
    const auto& path = report_.programmed.path;
    std::vector<PlotPoint> run;
    bool rapid = false;
    const std::size_t stride = std::max<std::size_t>(1, path.pieces().size() / most_points);
    const auto end_run = [&] {
      plot_.curve(run, rapid ? rapid_style : programmed_style);
      run.clear();
    };
    for (std::size_t i = 0; i < path.pieces().size(); ++i) {
      const auto& piece = path.pieces()[i];
      if (run.empty() || piece.rapid != rapid) {
        end_run();
        rapid = piece.rapid;
        run.push_back(point(path.begin_of(i)));
      }
      const bool last = i + 1 == path.pieces().size() || path.pieces()[i + 1].rapid != rapid;
      if (last || i % stride == 0) run.push_back(point(piece.end));
    }
    end_run();
  }

  void executed(double magnification) {
    std::vector<PlotPoint> run;
    const std::size_t bucket = std::max<std::size_t>(1, report_.samples.size() / most_points);
    for (std::size_t i = 0; i < report_.samples.size(); i += bucket) {
      // Of neighbours the one that is farthest off is drawn, so that no peak is lost.
      const Sample* worst = nullptr;
      for (std::size_t k = i; k < std::min(i + bucket, report_.samples.size()); ++k) {
        const auto& s = report_.samples[k];
        if (s.has_actual && !s.rapid &&
            (worst == nullptr ||
             (s.actual - s.actual_foot).squaredNorm() > (worst->actual - worst->actual_foot).squaredNorm()))
          worst = &s;
      }
      if (worst != nullptr) {
        run.push_back(point(worst->actual_foot + magnification * (worst->actual - worst->actual_foot)));
      } else {
        plot_.curve(run, actual_style);
        run.clear();
      }
    }
    plot_.curve(run, actual_style);
  }

  std::string svg() const { return plot_.svg(); }

 private:
  static Range range(const Extent& extent, int axis, double span) {
    const double middle = (extent.low[axis] + extent.high[axis]) / 2;
    return {middle - span / 2, middle + span / 2};
  }
  PlotPoint point(const Vec3& p) const {
    return {p[across_] - report_.programmed.zero[across_], p[up_] - report_.programmed.zero[up_]};
  }

  const Report& report_;
  int across_, up_;
  Plot plot_;
};

// Smallest and largest value in every bucket, so that a long run keeps its peaks.
std::vector<PlotPoint> envelope(const Report& report, const std::function<double(const Sample&)>& value) {
  std::vector<PlotPoint> points;
  const std::size_t bucket = std::max<std::size_t>(1, report.samples.size() / (most_points / 4));
  for (std::size_t i = 0; i < report.samples.size(); i += bucket) {
    PlotPoint low{0, std::numeric_limits<double>::infinity()}, high{0, -low.y};
    for (std::size_t k = i; k < std::min(i + bucket, report.samples.size()); ++k) {
      const auto& s = report.samples[k];
      const PlotPoint p{static_cast<double>(s.cycle - report.samples.front().cycle) * report.period,
                        value(s)};
      if (p.y < low.y) low = p;
      if (p.y > high.y) high = p;
    }
    if (low.x > high.x) std::swap(low, high);
    points.push_back(low);
    if (high.x > low.x) points.push_back(high);
  }
  return points;
}

double largest_of(const std::vector<PlotPoint>& a, const std::vector<PlotPoint>& b) {
  double largest = 0;
  for (const auto* points : {&a, &b})
    for (const auto& p : *points) largest = std::max(largest, p.y);
  return largest;
}

std::string heading(const Report& report, const std::string& what) {
  return text(40, 34, report.program + (report.machine.empty() ? "" : " on " + report.machine) + ": " + what,
              "font-size=\"18\" font-weight=\"bold\"") +
         (report.problem.empty() ? "" : text(40, 92, report.problem, "fill=\"#cf222e\""));
}

std::string micrometres(double mm) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.3g µm", mm * 1e3);
  return buffer;
}

}  // namespace

std::string path_picture(const Report& report) {
  const Extent extent = extent_of(report);
  const double span = std::max(1e-3, (extent.high - extent.low).maxCoeff()) * (1 + 2 * margin);
  const double error = report.actual_feed.largest;
  const double magnification = error > 0 ? std::max(1.0, round_down(largest_drawn_error * span / error)) : 1;

  constexpr double size = 500, top = 120;
  PathView xy(report, extent, 0, 1, 90, top, size, span), xz(report, extent, 0, 2, 700, top, size, span);
  for (auto* view : {&xy, &xz}) {
    view->programmed();
    view->executed(magnification);
  }
  Legend legend{40, 66, ""};
  char times[40];
  std::snprintf(times, sizeof times, "%.0f", magnification);
  legend.add(programmed_style, "programmed");
  legend.add(rapid_style, "rapid");
  legend.add(actual_style,
             std::string("executed (encoders), distance from the programmed path drawn ") + times + " times");
  // What a drawn distance means.
  const double bar = round_down(0.1 * span / magnification);
  const double pixels = bar * magnification / span * size;
  const double x = 1200 - pixels, y = top - 16;
  const char* dark = "stroke=\"#cf222e\" stroke-width=\"2\"";
  legend.svg +=
      line(x, y, 1200, y, dark) + line(x, y - 4, x, y + 4, dark) + line(1200, y - 4, 1200, y + 4, dark);
  legend.svg += text(x - 8, y + 4.5, "error of " + micrometres(bar), "text-anchor=\"end\"");
  return document(
      1240, 690,
      heading(report, "path of the tool tip on the workpiece, largest contour error " + micrometres(error)) +
          legend.svg + xy.svg() + xz.svg());
}

std::string feed_picture(const Report& report) {
  const double duration = report.samples.empty()
                              ? 1
                              : std::max(report.period, static_cast<double>(report.samples.back().cycle -
                                                                            report.samples.front().cycle) *
                                                            report.period);
  const auto commanded = envelope(report, [](const Sample& s) { return s.commanded_feed; });
  const auto actual = envelope(report, [](const Sample& s) { return s.actual_feed; });
  const auto commanded_error = envelope(
      report, [](const Sample& s) { return s.rapid ? 0.0 : (s.commanded - s.commanded_foot).norm() * 1e3; });
  const auto actual_error = envelope(report, [](const Sample& s) {
    return s.rapid || !s.has_actual ? 0.0 : (s.actual - s.actual_foot).norm() * 1e3;
  });
  // Rapids would press the feeds to the bottom; they leave the frame instead.
  double fastest = 0;
  for (const auto& s : report.samples)
    if (!s.rapid) fastest = std::max({fastest, s.commanded_feed, s.actual_feed});
  if (fastest == 0) fastest = largest_of(commanded, actual);
  fastest = std::max(1.0, fastest * 1.25);
  const double worst = std::max(1e-6, largest_of(commanded_error, actual_error) * 1.08);
  Plot feed(110, 120, 1080, 250, {0, duration}, {0, fastest});
  feed.title("Feed of the tool tip over the workpiece (rapids exceed the scale)");
  feed.labels("time [s]", "feed [mm/min]");
  feed.curve(actual, actual_style);
  feed.curve(commanded, commanded_style);
  Plot error(110, 470, 1080, 200, {0, duration}, {0, worst});
  error.title("Contour error at feed");
  error.labels("time [s]", "distance [µm]");
  error.curve(actual_error, actual_style);
  error.curve(commanded_error, commanded_style);
  Legend legend{40, 66, ""};
  legend.add(commanded_style, "commanded");
  legend.add(actual_style, "executed (encoders)");
  return document(
      1240, 740, heading(report, "feed and contour error over time") + legend.svg + feed.svg() + error.svg());
}

}  // namespace trunnion::report
