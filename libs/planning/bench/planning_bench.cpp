// Prints the reference motions: times, bounds, ratios to the limits and deviations; and planning speed.
#include <cstdio>

#include "planning/reference_paths.hpp"

int main() {
  using namespace trunnion::planning;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  std::printf("%-26s %9s %9s %9s %7s %7s %7s %9s %9s\n", "path", "time", "feed", "bound", "v", "a", "j",
              "contour", "orient");
  for (const ReferencePath& p : {single_line(), corner(0), corner(0.01), corner(0.1), circle(500),
                                 circle(100), wavy_cap(), dense_three_axis()}) {
    const RunReport r = run_commands(p.machine, p.start, p.transformation, p.tool_length, p.program);
    const double bound = command_bound(p.machine, p.start, p.transformation, p.tool_length, p.program);
    std::printf("%-26s %9.4f %9.4f %9.4f %7.4f %7.4f %7.4f %9.6f %9.6f%s\n", p.name.c_str(), r.motion_time,
                p.feed_time, bound, r.worst.velocity, r.worst.acceleration, r.worst.jerk, r.deviation.contour,
                r.deviation.orientation, r.stopped ? "" : "  NOT STOPPED");
  }
}
