# Sourced by the other scripts: makes .venv with meshjig and its pinned dependencies, once.
# Usage: . scripts/environment.sh [EXTRA]   then use "$PYTHON".

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
extra=${1:-}
PYTHON=$top/.venv/bin/python

say() { printf 'meshjig: %s\n' "$*" >&2; }

find_python() {
    local name
    for name in python3 python3.13 python3.12 python3.11 python; do
        if command -v "$name" >/dev/null 2>&1 &&
            "$name" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            command -v "$name"
            return
        fi
    done
    say "Python 3.11 or later is needed and was not found; install it first"
    return 1
}

# pymeshlab needs OpenGL's libraries to be there, though it never draws.
install_system_packages() {
    "$PYTHON" -c 'import pymeshlab' >/dev/null 2>&1 && return
    local packages="libgl1 libopengl0 libglu1-mesa libegl1"
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
        say "installing $packages"
        # shellcheck disable=SC2086
        apt-get update -qq >&2 && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq $packages >&2
    fi
    "$PYTHON" -c 'import pymeshlab' || {
        say "pymeshlab can't be imported; install the system packages $packages, for example: sudo apt-get install $packages"
        return 1
    }
}

make_environment() {
    local wanted stamp python
    stamp=$top/.venv/.installed$extra
    wanted=$(cat "$top/pyproject.toml" "$top/scripts/constraints.txt" | cksum)
    if [ "$(cat "$stamp" 2>/dev/null)" != "$wanted" ]; then
        python=$(find_python) || return 1
        say "setting up $top/.venv (once)"
        "$python" -m venv "$top/.venv" || {
            say "no virtual environment could be made; on Debian install python3-venv"
            return 1
        }
        "$PYTHON" -m pip install --quiet --disable-pip-version-check -c "$top/scripts/constraints.txt" \
            -e "$top${extra:+[$extra]}" >&2 || {
            say "installing the dependencies failed; see above"
            return 1
        }
        printf '%s\n' "$wanted" >"$stamp"
    fi
    install_system_packages
}

make_environment || exit 1
