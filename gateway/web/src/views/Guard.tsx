// SPDX-License-Identifier: Apache-2.0
// Keys and fields that are dark while who is here may not use them, and the reason.
import type { ComponentChildren } from "preact";
import { otherStation } from "../state/operating";
import { lackingRole, type Role } from "../state/rights";
import { session } from "../state/session";
import { text } from "../text/texts";

/** Empty, or why files cannot be changed here, for which the role alone decides. */
export const lackingToStore = (): string => lackingRole(session.value, "setter", text.value);

/** Empty, or why an order that needs this role is not possible here. */
export function lacking(needed: Role): string {
  const t = text.value;
  return lackingRole(session.value, needed, t) || (otherStation.value && t.watchOnly(otherStation.value));
}

export function Guard({ needs, children }: { needs: Role; children: ComponentChildren }) {
  return <fieldset class="guard" disabled={lacking(needs) !== ""}>{children}</fieldset>;
}

export function Note({ why }: { why: string }) {
  return why === "" ? null : <span class="tag warn guard-note" role="note">{why}</span>;
}

export const GuardNote = ({ needs }: { needs: Role }) => <Note why={lacking(needs)} />;
