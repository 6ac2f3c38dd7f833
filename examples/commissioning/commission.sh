#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# commission.sh DIRECTORY [DOMAIN [PORT]]: makes a good machine of a bad one. DIRECTORY becomes a copy of the AC trunnion machine
# with the errors of a worn one. Its cluster is started, measured and compensated; then the copy itself.
# TRUNNION is the command (default: trunnion in PATH).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
trunnion=${TRUNNION:-trunnion}
machine=$1 domain=${2:-11} port=${3:-8080}

echo "1. A bad machine: $machine"
cp -r "$here/../../configs/machines/ac-table" "$machine"
cp "$here/../worn-trunnion/truth.yaml" "$machine"
"$trunnion" truth "$machine" --tool-length 100 --summary 500

echo "2. Its cluster runs; instruments measure, the parameters are written into the cluster"
"$trunnion" up "$machine" --domain "$domain" --port "$port" --time virtual --state "$machine/state"
trap '"$trunnion" down --domain "$domain"' EXIT
"$trunnion" measure geometry "$machine" --plan "$here/plan.yaml" --write --domain "$domain"
"$trunnion" channel reset --domain "$domain"
"$trunnion" param get 040951 --domain "$domain"

echo "3. The same parameters become part of the machine"
"$trunnion" measure geometry "$machine" --plan "$here/plan.yaml" --output "$machine/compensation.yaml" > "$machine/report.txt"
cat "$machine/compensation.yaml" >> "$machine/parameters.yaml"
"$trunnion" truth "$machine" --tool-length 100 --summary 500
