// SPDX-License-Identifier: Apache-2.0
// Generated from libs/plc/library/registers.yaml by tools/generate_docs.py.

/** Names of input bits that every machine has, by their address. */
export const inputNames: Readonly<Record<string, string>> = {
  "X0.0": "emergency_stop_button",
  "X0.1": "reset_button",
  "X0.2": "feed_hold_button",
  "X4.5": "probe_contact",
};
