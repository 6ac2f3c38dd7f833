// SPDX-License-Identifier: Apache-2.0
// The login in place of the views: the state bar with its keys that stop stays.
import { useState } from "preact/hooks";
import { logIn, logOut, session, sessionOver } from "../state/session";
import { roleName } from "../state/rights";
import { text } from "../text/texts";

export function Login() {
  const t = text.value;
  const [name, setName] = useState("");
  const [password, setPassword] = useState("");
  const [reason, setReason] = useState("");
  return (
    <form
      class="lost"
      aria-label={t.loginTitle}
      onSubmit={(event) => {
        event.preventDefault();
        void logIn(name, password).then((why) => (setReason(why), setPassword("")));
      }}
    >
      <div class="login">
        <h1>{t.loginTitle}</h1>
        {sessionOver.value && <p role="status">{t.sessionOver}</p>}
        <label><span>{t.userName}</span><input autocomplete="username" value={name} onInput={(event) => setName(event.currentTarget.value)} /></label>
        <label><span>{t.password}</span><input type="password" autocomplete="current-password" value={password} onInput={(event) => setPassword(event.currentTarget.value)} /></label>
        <button class="primary" type="submit">{t.login}</button>
        {reason && <p role="alert">{reason}</p>}
        <p class="dim">{t.loginAbout}</p>
      </div>
    </form>
  );
}

/** Who is logged in, and that nobody needs to. */
export function WhoIsThere() {
  const t = text.value;
  const one = session.value;
  if (!one) return null;
  if (!one.auth) return <small class="dim" title={t.authOffAbout}>{t.authOff}</small>;
  return one.name === "" ? null : <button title={`${one.name}, ${roleName(one.role, t)}`} onClick={() => void logOut()}>{t.logout} {one.name}</button>;
}
