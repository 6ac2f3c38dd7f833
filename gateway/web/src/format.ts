// SPDX-License-Identifier: Apache-2.0
/** With so many decimals and an explicit minus; never "-0.000". */
export function fixed(value: number, decimals = 3): string {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "\u2212");
}

/** A number as it is typed, with comma or point; nothing when it is none. */
export function typedNumber(typed = ""): number | undefined {
  const text = typed.trim().replace(",", ".").replace("\u2212", "-");
  const value = Number(text);
  return text === "" || !Number.isFinite(value) ? undefined : value;
}

/** The numbers at an axis, `step` apart: with the decimals of the step, whatever its size. */
export function tickTexts(values: readonly number[], step: number): string[] {
  let decimals = 0;
  for (; decimals < 12; ++decimals) {
    const scaled = step * 10 ** decimals;
    if (Math.abs(scaled - Math.round(scaled)) <= 1e-6 * scaled) break;
  }
  return values.map((value) => fixed(value, decimals));
}

/** Four significant digits; a dash for what is no number. */
export function shortNumber(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(4))).replace("-", "\u2212") : "\u2013";
}

export function whole(value: number): string {
  return Math.round(value).toString();
}

/** 1234567 -> "1.23 M"; for rates and counts that are looked at, not read off. */
export function compact(value: number): string {
  if (value >= 1e6) return `${(value / 1e6).toFixed(2)} M`;
  if (value >= 1e4) return `${(value / 1e3).toFixed(1)} k`;
  return value.toFixed(value < 10 && value !== 0 ? 1 : 0);
}

export function bytes(value: number): string {
  if (value >= 1e6) return `${(value / 1e6).toFixed(1)} MB`;
  if (value >= 1e3) return `${(value / 1e3).toFixed(1)} kB`;
  return `${value} B`;
}

/** Seconds as h:mm:ss. */
export function duration(seconds: number): string {
  const s = Math.floor(seconds);
  const two = (n: number) => String(n).padStart(2, "0");
  return `${Math.floor(s / 3600)}:${two(Math.floor(s / 60) % 60)}:${two(s % 60)}`;
}

/** Date and time of day of an ISO 8601 instant, in the browser's zone. */
export function dateAndTime(iso: string): string {
  const date = new Date(iso);
  return Number.isNaN(date.getTime()) ? "" : date.toLocaleString("sv-SE");
}

/** The time of day of an ISO 8601 instant, in the browser's zone. */
export function timeOfDay(iso: string): string {
  const date = new Date(iso);
  return Number.isNaN(date.getTime()) ? "" : date.toLocaleTimeString("en-GB");
}

/** "rapid_feed" -> "Rapid feed". */
export function title(name: string): string {
  const words = name.replace(/_/g, " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Limits of a number; empty for what has none. */
export function limits(minimum: number | undefined, maximum: number | undefined): string {
  return minimum === undefined && maximum === undefined ? "" : `${minimum ?? ""} … ${maximum ?? ""}`;
}

/** "mm/min|deg/min" of the catalogue -> "mm/min or °/min". */
export function unit(text: string, or = "or"): string {
  return text.replace(/deg/g, "°").replace(/\|/g, ` ${or} `).replace(/2$|2(?= )/g, "²");
}

/** What was not done, and why; the channel names MDI, with line and column, in its reasons itself. */
export function refusal(what: string, reason: string): string {
  return reason.startsWith(`${what}:`) ? reason : `${what}: ${reason}`;
}
