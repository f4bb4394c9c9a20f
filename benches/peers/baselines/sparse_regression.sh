#!/usr/bin/env bash
# A program for `trackdyn trial run --program`: sparse_regression.py in the peers' virtual environment.
exec "$(dirname "${BASH_SOURCE[0]}")/../run.sh" baselines/sparse_regression.py "$@"
