#!/bin/bash
# Installs the packages of packages.txt that are missing: scripts/setup.sh [--ci]. Needs root or sudo, and the network,
# only if something is missing. --ci: those of packages-ci.txt too, which only the checks of .ci/run need.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

lists=(scripts/packages.txt)
if [[ ${1:-} == --ci ]]; then
  lists+=(scripts/packages-ci.txt)
fi

installed=" $(dpkg-query -W -f='${binary:Package} ${db:Status-Status}\n' |
  sed -n 's/^\([^: ]*\)[^ ]* installed$/\1/p' | tr '\n' ' ') "

missing=()
while read -r entry _; do
  [[ -z $entry || $entry == \#* ]] && continue
  IFS='|' read -ra choices <<<"$entry"
  for package in "${choices[@]}"; do
    [[ $installed == *" $package "* ]] && continue 2
  done
  missing+=("${choices[0]}")
done < <(cat "${lists[@]}")

if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=(env)
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: these packages are missing and only root can install them:" >&2
    echo "    apt-get install --no-install-recommends ${missing[*]}" >&2
    echo "Run that as root, or install sudo, then start again." >&2
    exit 1
  fi
  as_root=(sudo env)
fi

echo "setup.sh: installing ${missing[*]}"
apt=("${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
"${apt[@]}" update
"${apt[@]}" install --yes --no-install-recommends --no-remove "${missing[@]}"
