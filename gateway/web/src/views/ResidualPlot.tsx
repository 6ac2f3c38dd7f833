// SPDX-License-Identifier: Apache-2.0
// Deviations of X, Y and Z of every pose: a stem from zero with a mark, of another shape and colour for each axis.
import type { MeasurementPose } from "../contract";
import { largest, micrometres, plotRange, poseName, type Shown } from "../measurement/result";
import { text } from "../text/texts";

const left = 46, top = 10, height = 170, least = 40;  // px; `least` of a pose

function Mark({ component, x, y }: { component: number; x: number; y: number }) {
  if (component === 0) return <circle cx={x} cy={y} r={4.5} />;
  if (component === 1) return <rect x={x - 4} y={y - 4} width={8} height={8} />;
  return <path d={`M${x} ${y - 5.5} l5 9 h-10 z`} />;
}

const colours = ["var(--axis-x)", "var(--axis-y)", "var(--axis-z)"];

interface Props {
  poses: MeasurementPose[];
  letters: string[];
  shown: Shown;
  /** um, of a touch */
  deviation: number;
}

export function ResidualPlot({ poses, letters, shown, deviation }: Props) {
  const t = text.value;
  const range = plotRange(poses, shown);
  const place = Math.max(least, Math.floor(680 / poses.length));
  const width = left + place * poses.length + 8;
  const yOf = (um: number) => top + height / 2 - (um / range) * (height / 2);
  const top1 = largest(poses, shown);
  const title = shown === "residual" ? t.shownResidual : t.shownDifference;
  const about = top1 ? t.residualPlot(title, poses.length, micrometres(top1.value), "XYZ"[top1.component]!, poseName(top1.pose, letters)) : t.noResult;
  const ticks = [-1, -0.5, 0, 0.5, 1].map((part) => part * range);
  return (
    <div class="residual-plot scroll" tabIndex={0} role="region" aria-label={t.residuals}>
      <svg width={width} height={top + height + 58} role="img" aria-label={about}>
        {ticks.map((um) => (
          <g key={um}>
            <line x1={left} x2={width} y1={yOf(um)} y2={yOf(um)} class={um === 0 ? "zero" : "grid"} />
            <text x={left - 6} y={yOf(um) + 4} text-anchor="end">{um === 0 ? "0" : micrometres(um / 1000).replace(/\.0$/, "")}</text>
          </g>
        ))}
        {shown === "residual" && deviation > 0 && deviation < range && [deviation, -deviation].map((um) => (
          <line key={um} x1={left} x2={width} y1={yOf(um)} y2={yOf(um)} class="deviation" />
        ))}
        {poses.map((pose, i) => {
          const middle = left + place * (i + 0.5);
          return (
            <g key={i}>
              {pose[shown].map((value, component) => {
                const x = middle + (component - 1) * Math.min(12, place / 4);
                const y = yOf(value * 1000);
                return (
                  <g key={component} style={{ color: colours[component] }}>
                    <title>{`${poseName(pose, letters)} ${"XYZ"[component]} ${micrometres(value)} um`}</title>
                    <line x1={x} x2={x} y1={yOf(0)} y2={y} class="stem" />
                    <Mark component={component} x={x} y={y} />
                  </g>
                );
              })}
              <text x={middle} y={top + height + 16} text-anchor="middle">
                {poseName(pose, letters).split(" ").map((part, line) => <tspan key={line} x={middle} dy={line === 0 ? 0 : 15}>{part}</tspan>)}
              </text>
            </g>
          );
        })}
      </svg>
      <div class="legend" aria-hidden="true">
        um
        {[..."XYZ"].map((letter, component) => (
          <span key={letter}>
            <svg width={14} height={14} style={{ color: colours[component] }}><Mark component={component} x={7} y={7} /></svg>{letter}
          </span>
        ))}
        {shown === "residual" && deviation > 0 && <span class="dim">– – {t.deviationOfTouch(micrometres(deviation / 1000).replace("+", "±"))}</span>}
      </div>
    </div>
  );
}
