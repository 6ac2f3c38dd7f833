// SPDX-License-Identifier: Apache-2.0
import type { englishAccess } from "./english_access";
import type { Texts } from "./texts";

export const chineseAccess: Pick<Texts, keyof typeof englishAccess> = {
  loginTitle: "登录",
  loginAbout: "急停和进给保持无需登录。",
  userName: "用户",
  password: "密码",
  login: "登录",
  logout: "退出登录",
  authOff: "无需登录",
  authOffAbout: "本计算机上的任何人都可以操作机床：machine.yaml 中 auth 为 off。",
};
