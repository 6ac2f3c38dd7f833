#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# help_texts.sh TRUNNION PYTHON MANUAL_PAGE: the help shows every command in one of five groups; completion and manual
# page name the same commands.
set -euo pipefail
trunnion=$1 python=$2 manual_page=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*" >&2; exit 1; }
is() { [ "$2" = "$3" ] || fail "$1: expected '$3', there is '$2'"; }

"$trunnion" --help > "$work/help"
"$trunnion" completion > "$work/completion"
is groups "$(sed -n '/^Options:$/d; s/^\([A-Z].*\):$/\1/p' "$work/help" | paste -sd,)" \
  "Operate,Program,Commission,Record and verify,Develop"
# A line of the completion: the path of a command in quotes, and in quotes the words that follow it.
is commands "$(awk '/^[A-Z].*:$/ { heading = $0 } heading != "Options:" && /^  [a-z]/ { print $1 }' "$work/help" | sort)" \
  "$(awk -F"'" '/\) words=/ && $2 == "" { print $4 }' "$work/completion" | tr ' ' '\n' | grep '^[a-z]' | sort)"
is "names that differ by a minus" "$(awk -F"'" '/\) words=/ {
  split("", seen)
  count = split($4, words, " ")
  for (i = 1; i <= count; ++i) {
    word = words[i]
    if (word ~ /^--/) continue
    gsub(/-/, "", word)
    if (seen[word]++) print $2, words[i]
  }
}' "$work/completion")" ""

# A former name is understood and not shown.
"$trunnion" measure --help > "$work/measure"
grep -q '^  sensor-nest ' "$work/measure" || fail "$(cat "$work/measure")"
! grep -q '^  rtest ' "$work/measure" || fail "$(cat "$work/measure")"
options() { "$trunnion" measure "$1" --help | grep -v '^Usage'; }
is "options of the former name" "$(options rtest)" "$(options sensor-nest)"

"$python" "$manual_page" "$trunnion" 0 "$work/page"
is "manual page" "$(sed -n 's/^\.SH "TRUNNION \(.*\)"$/\1/p' "$work/page" | sort)" \
  "$(awk -F"'" '/\) words=/ && $2 != "" { print toupper($2) }' "$work/completion" | sort)"
