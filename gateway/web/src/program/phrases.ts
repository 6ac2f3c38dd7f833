// SPDX-License-Identifier: Apache-2.0
// The words of the editor's own search field.
import type { Language } from "../state/preferences";

const german = {
  Find: "Suchen", Replace: "Ersetzen durch", next: "weiter", previous: "zurück", all: "alle", "match case": "Groß/klein", "by word": "ganze Wörter",
  regexp: "Muster", replace: "ersetzen", "replace all": "alle ersetzen", close: "schließen", "current match": "Fundstelle", "on line": "in Zeile",
  "replaced match on line $": "in Zeile $ ersetzt", "replaced $ matches": "$ Stellen ersetzt", "$ unchanged lines": "$ gleiche Zeilen",
};
const chinese: Record<keyof typeof german, string> = {
  Find: "查找", Replace: "替换为", next: "下一个", previous: "上一个", all: "全部", "match case": "区分大小写", "by word": "全词",
  regexp: "正则", replace: "替换", "replace all": "全部替换", close: "关闭", "current match": "当前匹配", "on line": "在行",
  "replaced match on line $": "已替换第 $ 行", "replaced $ matches": "已替换 $ 处", "$ unchanged lines": "$ 行相同",
};

export const phrases: Record<Language, Record<string, string>> = { en: {}, de: german, zh: chinese };
