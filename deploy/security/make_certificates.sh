#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_certificates.sh DIRECTORY [DAYS]: a certificate authority, and for every service on every vendor a key, a certificate
# and signed permissions, for `security: DIRECTORY` in machine.yaml. What each may write and read comes from idl/topics.yaml.
# Of an existing authority (DIRECTORY/ca.pem with ca.key) everything else is made anew, so run it again when topics.yaml
# has changed or certificates end. Keep ca.key elsewhere; a host needs the sub-directories of its own services only.
set -euo pipefail
[ $# -ge 1 ] || { sed -n 2,5p "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
directory=$1
days=${2:-3650}
umask 077
mkdir -p "$directory"
cd "$directory"

key() { openssl ecparam -name prime256v1 -genkey -noout -out "$1"; }
sign() { openssl smime -sign -text -in "$1" -out "$2" -signer ca.pem -inkey ca.key 2>/dev/null; }

if [ ! -e ca.pem ]; then
  key ca.key
  openssl req -x509 -new -key ca.key -sha256 -days "$days" -subj "/CN=Trunnion cluster" -out ca.pem
elif [ ! -e ca.key ]; then
  echo "make_certificates.sh: $directory has ca.pem and no ca.key: bring the key of the authority" >&2
  exit 1
fi
python=$(command -v /usr/bin/python3 || command -v python3)
# Installed, the tables are beside this script.
topics=$here/topics.yaml
[ -f "$topics" ] || topics=$here/../../idl/topics.yaml
"$python" "$here/documents.py" "$topics" . --days "$days"
sign governance.xml governance.p7s
for identity in */; do
  name=$(cat "$identity/name")
  key "$identity/key.pem"
  openssl req -new -key "$identity/key.pem" -sha256 -subj "/CN=$name" -out "$identity/request.pem"
  openssl x509 -req -in "$identity/request.pem" -CA ca.pem -CAkey ca.key -CAcreateserial -sha256 -days "$days" \
    -out "$identity/certificate.pem" 2>/dev/null
  sign "$identity/permissions.xml" "$identity/permissions.p7s"
  rm "$identity/request.pem" "$identity/name"
done
echo "Made the certificates of $(ls -d */ | wc -l) identities in $directory"
