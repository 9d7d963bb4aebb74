#!/usr/bin/env bash
# Proves MARS on a bare Debian 12. Needs root, debootstrap and a network:
#   tests/bare/bare_debian.sh [--base FILE.tar] [--keep-build] [test]
# In one bare system: ./bootstrap demo, test, test later and deb. In a second: the .deb, installed by apt, used by root and
# by an ordinary user, removed. With the word test: without deb and the second. No test may be skipped there but those
# of tests/bare/skips.txt, and building what demo builds may not take longer than it should. What is committed is what is
# tested. --base keeps the bare system itself: FILE is written where it is missing, and spares the next run debootstrap.
# --keep-build leaves what was built there as this checkout's build folder, where it has none: a Debian 12 need not build
# it again. Takes about 4 GB below TMPDIR (/tmp). Ends with a line for each step and for each of its parts; exit code 0 if
# all went well, 3 where no bare system can be made.
set -euo pipefail

suite=bookworm
# A multiple of the processors' seconds that host/json_code.cpp takes to compile, so that slow machines pass, too.
most_for_demo=75
checkout=$(cd "$(dirname "$0")/../.." && pwd -P)

give_up() { printf 'bare_debian: %s\n' "$*" >&2; exit 3; }

# What apt on this machine fetches the suite from, as lines for sources.list; nothing where there is no apt.
debian_sources() {
  command -v apt-get >/dev/null || return 0
  # shellcheck disable=SC2016  # apt's own variables
  apt-get indextargets --format '$(ORIGIN) $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    awk -v suite="$suite" '$1 == "Debian" && index($3, suite) == 1 && !seen[$0]++ { print "deb", $2, $3, $4 }'
}

make_base() {
  local mirror
  mirror=$(debian_sources | awk -v suite="$suite" '$3 == suite && !found++ { print $2 }')
  # shellcheck disable=SC2086  # nothing where debootstrap's own mirror is taken
  debootstrap --variant=minbase --include=ca-certificates "$suite" "$work/base" $mirror || give_up "debootstrap failed"
  tar -C "$work/base" --numeric-owner -cf "$base.part" .
  mv "$base.part" "$base"
  rm -rf "$work/base"
}

# A fresh system in $work/$1 that fetches packages as this machine does.
unpack_system() {
  local root=$work/$1 lines
  mkdir "$root"
  tar -C "$root" --numeric-owner -xpf "$base"
  mount --bind "$root" "$root"  # tests that mount want a root that is a mount point
  lines=$(debian_sources)
  [ -z "$lines" ] || echo "$lines" >"$root/etc/apt/sources.list"
  if command -v apt-config >/dev/null; then
    apt-config dump | grep -E '^Acquire::https?::' >"$root/etc/apt/apt.conf.d/90machine" || true
  fi
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
  mount -t proc proc "$root/proc"
  mount -t sysfs -o ro sysfs "$root/sys"
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
  mount -t tmpfs tmpfs "$root/dev/shm"
}

# within SYSTEM USER SCRIPT: as that user at home, knowing nothing of this machine's environment but proxies.
within() {
  local home=/root
  [ "$2" = root ] || home=/home/$2
  env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME="$home" TERM=dumb LANG=C.UTF-8 \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    chroot --userspec="$2" "$work/$1" bash -euo pipefail -c "cd
$3" </dev/null
}

# step NAME SYSTEM USER SCRIPT: the same, with a line in the summary.
step() {
  local name=$1 verdict=ok
  shift
  printf '\n==== %s\n' "$name"
  local TIMEFORMAT='%0R %0U %0S'
  { time within "$@" >&3 2>&4; } 2>"$work/times" || verdict=FAILED
  read -r seconds user system <"$work/times"
  [ "$verdict" = ok ] || failed=$((failed + 1))
  sum_up "$verdict" "$seconds" $((user + system)) "$name"
}

sum_up() { summary+=("$(printf '%-6s %5d s  %5d s of processors  %s' "$@")"); }

# bootstrap WORDS: a step that executes ./bootstrap, and a line for each of its parts.
bootstrap() {
  local what seconds processors
  step "./bootstrap $*" build root "mars/bootstrap $*"
  while read -r what; do
    processors=${what##* } what=${what% *}
    seconds=${what##* } what=${what% *}
    sum_up "" "$seconds" "$processors" "  $what"
  done < <(cat "$work/build$checkout/build/took.txt" 2>/dev/null)
}

unpack_build() {
  unpack_system build
  # Where the checkout itself is: a build folder knows its place.
  mkdir -p "$work/build${checkout%/*}"
  git -c safe.directory='*' clone -q --no-hardlinks "$checkout" "$work/build$checkout"
  ln -s "$checkout" "$work/build/root/mars"
}

keep_build() { [ -e "$checkout/build" ] || cp -a "$work/build$checkout/build" "$checkout/build"; }

# Needs nothing but what demo needs.
prove_demo() {
  local built yardstick
  bootstrap demo
  built=$(awk '/^building/ { sum += $NF } END { print sum }' "$work/build$checkout/build/took.txt") || true
  step "the demo's frames" build root '
    cd mars/build
    release/bin/mars verify demo
    [ "$(ls demo/frame-*.png | wc -l)" -ge 24 ]
    # Rendering needs none of these.
    states=$(dpkg-query -W -f "\${db:Status-Status}\n" libassimp-dev libgtest-dev mpich 2>/dev/null) || true
    if grep -x installed <<<"$states"; then exit 1; fi'
  step "a yardstick for the seconds of a build" build root '
    cd mars
    TIMEFORMAT="%U %S $(nproc)"
    compile_everywhere() {
      for _ in $(seq "$(nproc)"); do c++ -std=c++20 -O3 -I. -c host/json_code.cpp -o /dev/null & done
      wait
    }
    { time compile_everywhere; } 2>/root/yardstick'
  yardstick=$(awk '{ print ($1 + $2) / $3 }' "$work/build/root/yardstick") || true
  summary+=("building what demo builds: ${built:-?} s of processors; host/json_code.cpp alone: ${yardstick:-?} s")
  if awk "BEGIN { exit !(${built:-1} > $most_for_demo * ${yardstick:-0}) }"; then
    failed=$((failed + 1))
    summary+=("FAILED that is more than $most_for_demo such compilations: ./bootstrap costs shows where the time goes")
  fi
}

prove_tests() {
  local results=mars/build/release/tests.xml
  bootstrap test
  within build root "mv $results quick.xml" || true
  bootstrap test later
  step "none skipped but those of tests/bare/skips.txt" build root "
    mars/tests/totals.py --skips mars/tests/bare/skips.txt quick.xml $results"
}

prove_bootstrap() {
  prove_demo
  step "./bootstrap demo, again" build root 'mars/bootstrap demo'
  prove_tests
  step "./bootstrap deb" build root 'mars/bootstrap deb'
}

# What both kinds of user do with the installed package.
use_mars='
  mkdir film; cd film
  mars --version
  mars info /usr/share/doc/mars/examples/robot-arm.json
  for backend in mpi threads; do
    mars render /usr/share/doc/mars/examples/robot-arm.json --backend $backend --frames 0-11 --nodes 2 -o $backend
    mars verify $backend | tee $backend.txt
  done
  cmp mpi.txt threads.txt
  if mars --help | grep -q doctor; then mars doctor; fi'

read_manuals='
  for page in mars mars-render mars-host mars-node mars-ranks mars-threads mars-simulated mars-nx nx csend _gdsum; do
    MANWIDTH=80 man --warnings "$page" >page.txt 2>troubles.txt
    grep -q NAME page.txt
    [ ! -s troubles.txt ] || { cat troubles.txt; false; }
  done
  man mars-render | grep -A 3 -e --backend'

run_nx='
  pkg-config --modversion mars-nx
  cat >sum.c <<END
#include <cube.h>
#include <stdio.h>
int main(void) {
  double x = mynode(), work;
  gdsum(&x, 1, &work);
  if (mynode() == 0) printf("%g by %ld\\n", x, numnodes());
  return 0;
}
END
  gcc sum.c -o sum $(pkg-config --cflags --libs mars-nx)
  [ "$(mars-nx run --nodes 4 ./sum)" = "6 by 4" ]
  [ "$(mpirun --oversubscribe -n 3 ./sum)" = "3 by 3" ]
  [ "$(./sum)" = "0 by 1" ]'

complete_words='
  set +u
  . /usr/share/bash-completion/bash_completion
  _completion_loader mars || [ $? = 124 ]
  COMP_WORDS=(mars render --backend ""); COMP_CWORD=3; COMP_LINE="mars render --backend "; COMP_POINT=${#COMP_LINE}
  $(complete -p mars | sed "s/.*-F \([^ ]*\).*/\1/") mars "" --backend
  echo "${COMPREPLY[@]}"
  [ "${COMPREPLY[*]}" = "auto mpi threads" ]'

prove_package() {
  unpack_system user
  cp "$work/build$checkout"/build/release/mars*.deb "$work/user/root/"
  step "apt-get install the .deb" user root '
    apt-get update -q
    DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends ./mars_*.deb
    ! command -v g++'
  step "mars, by root" user root "$use_mars"
  step "an ordinary user" user root 'useradd -m -s /bin/bash person'
  step "mars, by an ordinary user" user person "$use_mars"
  step "man-db and bash-completion" user root '
    DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends man-db bash-completion'
  step "apt-get install the .debs of NX, and a C compiler" user root '
    DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends ./mars-nx*.deb gcc libc6-dev pkg-config'
  step "a program of NX, by an ordinary user" user person "$run_nx"
  step "man mars and its others" user person "$read_manuals"
  step "completion in bash" user person "$complete_words"
  step "apt-get purge" user root '
    apt-get purge -q -y mars mars-nx mars-nx-dev
    [ -z "$(ls -d /usr/bin/mars* /usr/share/doc/mars /usr/share/mars /usr/include/mars-nx /usr/lib/*mars-nx* 2>/dev/null)" ]'
}

run() {
  [ -f "$base" ] || make_base
  unpack_build
  if [ "$only" = test ]; then
    prove_demo
    prove_tests
  else
    prove_bootstrap
    if ls "$work/build$checkout"/build/release/mars_*.deb >/dev/null 2>&1; then prove_package; fi
  fi
  [ -z "$keep" ] || keep_build
  printf '\n==== Summary\n'
  printf '%s\n' "${summary[@]}"
  [ "$failed" = 0 ]
}

summary=()
failed=0

# The work is done in mount and process namespaces of its own: whatever ends it, nothing stays mounted or running.
if [ "${1:-}" = --within ]; then
  work=$2 base=$3 only=$4 keep=$5
  exec 3>&1 4>&2
  run
  exit
fi

kept=""
if [ "${1:-}" = --base ]; then
  [ $# -ge 2 ] || give_up "--base needs a file"
  kept=$2
  shift 2
fi
keep=""
if [ "${1:-}" = --keep-build ]; then
  keep=yes
  shift
fi
case "$#:${1:-}" in
  0: | 1:test) only=${1:-} ;;
  *) sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 2 ;;
esac
[ "$(id -u)" = 0 ] || give_up "needs root"
unshare --mount --pid --fork mount -t tmpfs none /mnt || give_up "may not mount here"
command -v debootstrap >/dev/null || give_up "needs debootstrap (apt-get install debootstrap)"
work=$(mktemp -d "${TMPDIR:-/tmp}/mars-bare.XXXXXX")
trap 'rm -rf --one-file-system "$work"' EXIT
base=$(realpath -m "${kept:-$work/base.tar}")
chmod 755 "$work"
# In the background: bash takes a signal only when what it waits for in the foreground has ended.
unshare --mount --propagation private --pid --fork --kill-child "$0" --within "$work" "$base" "$only" "$keep" &
trap 'kill -KILL $!; exit 130' INT TERM HUP
wait $!
