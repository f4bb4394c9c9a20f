#!/usr/bin/env bash
# Run a peer benchmark in its own virtual environment. The first argument names the script, peers.py,
# identify.py or one of baselines (default: peers.py); further arguments go to it.
# PYTHON names the interpreter (3.11 or newer); default: python3.
set -euo pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
venv="$(cd "$here/../.." && pwd)/target/peers-venv"

script=peers.py
case "${1:-}" in
*.py)
    script="$1"
    shift
    ;;
esac

[ -x "$venv/bin/python" ] || "${PYTHON:-python3}" -m venv "$venv"
if [ "$here/requirements.txt" -nt "$venv/installed" ]; then
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check \
        --requirement "$here/requirements.txt"
    touch "$venv/installed"
fi
exec "$venv/bin/python" "$here/$script" "$@"
