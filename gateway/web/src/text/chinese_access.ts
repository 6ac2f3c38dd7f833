// SPDX-License-Identifier: Apache-2.0
import type { englishAccess } from "./english_access";
import type { Translation } from "./translation";

export const chineseAccess: Translation<typeof englishAccess> = {
  loginTitle: "登录",
  loginAbout: "急停和进给保持无需登录。",
  userName: "用户",
  password: "密码",
  login: "登录",
  logout: "退出登录",
  authOff: "无需登录",
  authOffAbout: "本计算机上的任何人都可以操作机床：machine.yaml 中 auth 为 off。",
  needsRole: (needed, name, has) => `此操作需要${needed}权限；${name} 的权限是${has}。`,
  roleOperator: "操作员",
  roleSetter: "调整员",
  roleBuilder: "机床制造商",
  roleAdministrator: "管理员",
  sessionOver: "会话已结束，请重新登录。",
  youOperate: "本站操作",
  otherOperates: (name) => `${name} 正在操作`,
  nobodyOperates: "无人操作",
  operateHere: "在此操作",
  takeOverRight: "接管",
  askForRight: "请求操作权",
  asking: "已请求…",
  askedFor: (name) => `已向 ${name} 请求操作权。`,
  giveBack: "归还",
  othersAsk: (name) => `${name} 请求操作本机床。`,
  handOver: "移交",
  keepRight: "保留",
  watchOnly: (name) => `${name} 正在操作：本站仅可查看。急停和进给保持在此仍有效。`,
};
