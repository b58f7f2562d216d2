#!/bin/bash
# test_bootstrap.sh - bootstrap installs what is missing, as whoever may, and
# does nothing twice.  The tools it calls are stand-ins that note their calls.
. "$(dirname "$0")/tap.sh"

tree=$scratch/tree
mkdir "$tree" "$scratch/bin"
cp "$srcdir/bootstrap" "$srcdir/packages.txt" "$tree"
export CALLS=$scratch/calls INSTALLED=$scratch/installed FAKE_UID=0

# stand_in NAME <<SCRIPT - a tool that notes its call and does SCRIPT.
stand_in() {
  {
    echo '#!/bin/bash'
    echo "echo \"$1 \$*\" >>\"\$CALLS\""
    cat
  } >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}
stand_in dpkg-query <<'END'
grep -qx "${!#}" "$INSTALLED" && echo installed
END
stand_in apt-get <<'END'
[ "$1" = install ] || exit 0
for name; do
  if [[ " $FAILING " == *" $name "* ]]; then exit 1; fi
done
printf '%s\n' "$@" >>"$INSTALLED"
END
stand_in sudo <<'END'
exec "$@"
END
stand_in id <<'END'
echo "$FAKE_UID"
END
stand_in autoreconf <<'END'
: >Makefile.in
printf '#!/bin/bash\necho "configure $*" >>"$CALLS"\n: >Makefile\n' >configure
chmod +x configure
END
stand_in make </dev/null

# boots STATUS [ARGUMENT...] - whether bootstrap exits so; CALLS is anew.
boots() {
  local expected=$1
  shift
  : >"$CALLS"
  PATH=$scratch/bin:$PATH "$tree/bootstrap" "$@" >"$scratch/out" 2>&1
  test $? -eq "$expected" || { say "$(tail -n 3 "$scratch/out")" && false; }
}
called() { grep -q "^$1" "$CALLS" || { say "no call of $1" && false; }; }
not_called() { ! grep "^$1" "$CALLS"; }
packages() { awk -v kind="$1" '$1 == kind { print $2 }' "$tree/packages.txt"; }

# ---- The first run --------------------------------------------------------

: >"$INSTALLED"
claim "a first run ends well" boots 0
installs_all() {
  local name
  for name in $(packages build) $(packages test); do
    grep -qx "$name" "$INSTALLED" || { say "not $name" && return 1; }
  done
}
claim "it installs what the build needs and the tests like" installs_all
installs_no_tools() {
  local name
  for name in $(packages dev); do
    ! grep -qx "$name" "$INSTALLED" || return 1
  done
}
claim "but not the developers' tools" installs_no_tools
asks_nothing() { ! grep '^apt-get install' "$CALLS" | grep -v -- ' -y '; }
claim "without a question" asks_nothing
claim "as root, without sudo" not_called sudo
in_order() {
  grep -oE '^(apt-get|autoreconf|configure|make)' "$CALLS" | uniq |
    tr '\n' ' ' | grep -qx 'apt-get autoreconf configure make '
}
claim "then autoreconf, configure, make" in_order

# ---- Later runs -----------------------------------------------------------

claim "a second run ends well" boots 0
claim "and installs nothing" not_called apt-get
claim "nor runs autoreconf" not_called autoreconf
claim "nor configure" not_called configure
claim "but make, which knows what has changed" called make
claim "arguments go to configure" boots 0 --without-cairo
claim "by name" called 'configure .*--without-cairo'

sed -i '/^libgmp-dev$/d' "$INSTALLED"
claim "a run with a package missing ends well" boots 0
claim "and installs that one alone" \
  grep -qx 'apt-get install -y --no-install-recommends libgmp-dev' "$CALLS"
claim "and configures again" called configure

# ---- Who may not ----------------------------------------------------------

sed -i '/^libgmp-dev$/d' "$INSTALLED"
FAKE_UID=1000
claim "another user uses sudo" boots 0
claim "to run apt-get" called 'sudo .*apt-get install .*libgmp-dev'

# What the tests would like may be missing, what the build needs may not.
sed -i '/^libxml2-utils$/d' "$INSTALLED"
export FAILING=libxml2-utils
claim "a package for tests that cannot be had is no failure" boots 0
claim "but is said" grep -q 'libxml2-utils' "$scratch/out"
sed -i '/^libgmp-dev$/d' "$INSTALLED"
FAILING=libgmp-dev
fails() { ! boots 0 2>/dev/null >&2; }
claim "a package for the build that cannot be had is" fails
claim "and nothing is built" not_called make
finish
