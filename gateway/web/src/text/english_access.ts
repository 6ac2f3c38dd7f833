// SPDX-License-Identifier: Apache-2.0
// Who is logged in.
export const englishAccess = {
  loginTitle: "Log in",
  loginAbout: "Emergency stop and feed hold work without a login.",
  userName: "User",
  password: "Password",
  login: "Log in",
  logout: "Log out",
  authOff: "no login",
  authOffAbout: "Everyone at this computer may operate the machine: auth is off in machine.yaml.",
};
