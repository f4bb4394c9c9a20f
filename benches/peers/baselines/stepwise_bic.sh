#!/usr/bin/env bash
# A program for `trackdyn trial run --program`: stepwise_bic.py in the peers' virtual environment.
exec "$(dirname "${BASH_SOURCE[0]}")/../run.sh" baselines/stepwise_bic.py "$@"
