#!/usr/bin/env bash
# A program for `trackdyn trial run --program`: constant_icrs.py in the peers' virtual environment.
exec "$(dirname "${BASH_SOURCE[0]}")/../run.sh" baselines/constant_icrs.py "$@"
