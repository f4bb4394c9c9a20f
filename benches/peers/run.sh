#!/usr/bin/env bash
# Run the peer benchmark in its own virtual environment; arguments go to peers.py.
# PYTHON names the interpreter (3.11 or newer); default: python3.
set -euo pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
venv="$(cd "$here/../.." && pwd)/target/peers-venv"

[ -x "$venv/bin/python" ] || "${PYTHON:-python3}" -m venv "$venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check \
    --requirement "$here/requirements.txt"
exec "$venv/bin/python" "$here/peers.py" "$@"
