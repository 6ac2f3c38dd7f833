// SPDX-License-Identifier: Apache-2.0
import type { englishPlc } from "./english_plc";
import type { Texts } from "./texts";

export const chinesePlc: Pick<Texts, keyof typeof englishPlc> = {
  plcPrograms: "PLC 程序",
  plcBack: "寄存器与服务",
  plcFile: "文件",
  plcInstance: "实例",
  plcSource: "源程序",
  plcDelivered: "机床自带",
  plcLoadedOnline: (changes) => `在线加载，已更改 ${changes} 次`,
  plcVariables: "变量",
  plcFind: "查找变量",
  plcFound: (shown, total) => `${shown} / ${total}`,
  plcWatch: (path) => `监视 ${path}`,
  plcWatched: "监视的变量",
  plcNothingWatched: "请在列表中选择变量。",
  plcForce: "强制",
  plcForceValue: (path) => `${path} 的强制值`,
  plcRelease: (path) => `取消强制 ${path}`,
  plcReleaseAll: "全部取消强制",
  plcForced: "已强制",
  plcForces: (count) => `已强制 ${count} 个`,
  plcForceQuestion: (path, value) => `将 ${path} 强制为 ${value}？程序将无法再改变它，输出会直接作用于机床。`,
  plcTrace: "跟踪",
  plcTraceAbout: "每次扫描后监视变量的值",
  plcScans: "扫描次数",
  plcTraceStart: "记录",
  plcTraceRows: (rows, scans) => `${rows} / ${scans} 次扫描`,
};
