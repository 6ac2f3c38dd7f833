// SPDX-License-Identifier: Apache-2.0
// Whether who sits at this page may do something, so that a key is dark with its reason before it is touched. The
// gateway decides the same again.
import type { Texts } from "../text/texts";
import type { Session } from "../contract";

/** As the gateway's: each has the rights of those before it. */
const roles = ["operator", "setter", "builder", "administrator"] as const;
export type Role = (typeof roles)[number];

export function roleName(role: string, t: Texts): string {
  const names: Record<Role, string> = { operator: t.roleOperator, setter: t.roleSetter, builder: t.roleBuilder, administrator: t.roleAdministrator };
  return names[role as Role] ?? role;
}

/** Empty when the session has the role or needs none, else why not. */
export function lackingRole(session: Session | null, needed: Role, t: Texts): string {
  if (!session?.auth || session.name === "") return "";
  const has = roles.indexOf(session.role as Role);
  return has >= roles.indexOf(needed) ? "" : t.needsRole(roleName(needed, t), session.name, roleName(session.role, t));
}
