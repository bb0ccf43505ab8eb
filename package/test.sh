#!/usr/bin/env bash
# package/test.sh FILE.deb: installs the package into a bare Debian root, runs the first command of
# the README there, looks for what else it should hold, and removes it: nothing may be left.
# Needs root, debootstrap and the network. The bare root is made once and kept as a tar file.
set -euo pipefail
[ $# -eq 1 ] && [ "$(id -u)" = 0 ] || { echo "usage, as root: $0 FILE.deb" >&2; exit 2; }
deb=$(readlink -f "$1")
project=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
bare=${XDG_CACHE_HOME:-$HOME/.cache}/irido/bookworm.tar
work=$(mktemp -d)
root=$work/root
trap 'rm -rf "$work"' EXIT

fail() { echo "package: $*" >&2; exit 1; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"; }
files() {
    (cd "$root" && find . \( -path ./var/cache -o -path ./var/log -o -path ./var/lib/apt \
        -o -path ./var/lib/dpkg -o -path ./tmp \) -prune -o -print | sort)
}

if [ ! -f "$bare" ]; then
    mkdir -p "$(dirname "$bare")"
    debootstrap --variant=minbase bookworm "$root" >"$work/log" 2>&1 || { cat "$work/log"; fail "debootstrap"; }
    tar -C "$root" -cf "$bare.new" .
    mv "$bare.new" "$bare"
else
    mkdir "$root"
    tar -C "$root" -xf "$bare"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp "$deb" "$root/tmp/irido.deb"
inside apt-get update >"$work/log" 2>&1 || { cat "$work/log"; fail "package lists"; }
files >"$work/before"

inside apt-get install -y --no-install-recommends /tmp/irido.deb >"$work/log" 2>&1 ||
    { cat "$work/log"; fail "it cannot be installed"; }
# the README's paths are those of a checkout
command=$(sed -n 's/^ *\$ \(irido .*\)/\1/p' "$project/README.md" | head -n 1)
head=$(grep -A 1 -m 1 '^ *\$ irido ' "$project/README.md" | sed -n '2s/^ *//p')
inside sh -c "mkdir /tmp/try && cd /tmp/try && ln -s /usr/share/irido schemas && $command" >"$work/out" ||
    fail "failed: $command"
[ "$(head -n 1 "$work/out")" = "$head" ] || { cat "$work/out"; fail "prints something else: $command"; }
for file in man/man1/irido.1.gz man/man1/irido-spectrum.1.gz bash-completion/completions/irido \
    zsh/vendor-completions/_irido fish/vendor_completions.d/irido.fish irido/stack.schema.json \
    irido/examples/soap-bubble.json doc/irido/copyright doc/irido/changelog.gz \
    doc/irido/shaders.MIT-0; do
    # minimal roots leave out documentation
    [ -f "$root/usr/share/$file" ] || dpkg-deb -c "$deb" | grep -q "/usr/share/$file$" ||
        fail "has no /usr/share/$file"
done

inside apt-get purge -y --auto-remove irido >"$work/log" 2>&1 || { cat "$work/log"; fail "removal"; }
files >"$work/after"
diff "$work/before" "$work/after" >"$work/diff" || { cat "$work/diff"; fail "leaves files behind"; }
echo "$(basename "$deb"): $(stat -c %s "$deb") bytes; installed, ran '$command', removed: ok"
