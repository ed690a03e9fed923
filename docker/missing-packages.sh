#!/bin/sh
# Says which of the Debian packages in the lists given are not installed, and the one command that adds them.
# Exit 1 if any is missing. On another system than Debian it cannot tell, says so, and lets the caller go on.
set -eu
if ! command -v dpkg-query >/dev/null 2>&1; then
    echo "Not a Debian system: can't check the libraries; what is needed is listed in: $*"
    exit 0
fi
missing=""
for package in $(sed 's/#.*//' "$@"); do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing="$missing $package"
done
[ -z "$missing" ] && exit 0
echo "Debian packages are missing:$missing"
echo "Add them, then run the same command again:"
if [ "$(id -u)" = 0 ]; then sudo=""; else sudo="sudo "; fi
echo "    ${sudo}apt-get update && ${sudo}apt-get install -y --no-install-recommends$missing"
exit 1
