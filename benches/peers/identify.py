"""Peer benchmark: ICRs and alphas of a tracked robot from a recording, in scipy and in pymoo.

The parameters (x_l, x_r, y, alpha_l, alpha_r) [m, 1] make the cost (17) smallest: the squared
distance between observed and predicted motion, yaw errors times a lever, summed over the
segments. trackdyn makes the recording; all methods see the same numbers.

Exit code: 0 least squares agree, 1 they differ, 2 trackdyn could not be run.
"""

import argparse
import math
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # too small to gain from more

import numba
import numpy as np
from numba import njit, prange
from pymoo.algorithms.soo.nonconvex.ga import GA
from pymoo.core.problem import Problem
from pymoo.optimize import minimize
from scipy.optimize import least_squares

GAUGE = 0.42  # m
LEVER = GAUGE / 2  # turns yaw errors into distances, m
START = np.array([-GAUGE / 2, GAUGE / 2, 0.0, 1.0, 1.0])  # ideal drive
# Ranges of trackdyn's genetic algorithm
LOW = np.array([-3 * GAUGE, GAUGE / 4, -GAUGE, 0.8, 0.8])
HIGH = np.array([-GAUGE / 4, 3 * GAUGE, GAUGE, 1.2, 1.2])
POPULATION, GENERATIONS = 100, 200
LANES = 32  # segments side by side in the vectorised kernel
SHORTEST = 1e-12  # shorter pieces are rounding of the stamps, s
TOLERANCE = 1e-6  # largest difference of a parameter, m or 1
ROOT = Path(__file__).resolve().parents[2]


# --- data ---------------------------------------------------------------------


def read_case(file):
    """Observed motions (n, 3) [m, m, rad] and pieces (n, k, 3): duration [s], V_l, V_r [m/s].

    Shorter segments are filled up with pieces of no duration.
    """
    rows = [np.array(line.split(), float) for line in Path(file).read_text().splitlines()]
    observed = np.array([row[:3] for row in rows])
    kept = [row[3:].reshape(-1, 3) for row in rows]
    kept = [pieces[pieces[:, 0] > SHORTEST] for pieces in kept]
    pieces = np.zeros((len(rows), max(map(len, kept)), 3))
    for row, of in zip(pieces, kept):
        row[: len(of)] = of
    return observed, pieces


def in_lanes(observed, pieces):
    """The same in blocks of LANES segments: (b, 3, LANES) and (b, k, 3, LANES).

    The last block is filled up with segments that stand still.
    """
    blocks = -(-len(observed) // LANES)
    fill = blocks * LANES - len(observed)
    observed = np.concatenate([observed, np.zeros((fill, 3))])
    pieces = np.concatenate([pieces, np.zeros((fill, *pieces.shape[1:]))])
    observed = observed.reshape(blocks, LANES, 3).transpose(0, 2, 1)
    pieces = pieces.reshape(blocks, LANES, -1, 3).transpose(0, 2, 3, 1)
    return np.ascontiguousarray(observed), np.ascontiguousarray(pieces)


# --- residuals ----------------------------------------------------------------


def numpy_residual(z, observed, pieces):
    """Residuals (3 n) [m] at z, in array expressions over the segments."""
    x_l, x_r, y, alpha_l, alpha_r = z
    time, v_l, v_r = pieces[..., 0].T, alpha_l * pieces[..., 1].T, alpha_r * pieces[..., 2].T
    # w = (V_r - V_l) / (x_r - x_l), forward speed V_l - w x_l, to the left -w y
    w = (v_r - v_l) / (x_r - x_l)
    angle = w * time
    # An arc's chord lies along the mean heading and is shorter by sinc(a/2)
    chord = np.sinc(angle / (2 * np.pi)) * time
    end = np.cumsum(angle, axis=0)
    middle = end - angle / 2
    cos, sin = np.cos(middle), np.sin(middle)
    ahead, aside = chord * (v_l - w * x_l), -chord * w * y
    forward, left = (ahead * cos - aside * sin).sum(0), (ahead * sin + aside * cos).sum(0)
    residual = observed - np.stack([forward, left, end[-1]], axis=1)
    residual[:, 2] *= LEVER
    return residual.ravel()


@njit(fastmath=True, error_model="numpy", inline="always")
def motion(z, pieces):
    """Forward, left [m] and yaw [rad] over the pieces (k, 3) of a segment."""
    x_l, x_r, y, alpha_l, alpha_r = z[0], z[1], z[2], z[3], z[4]
    per_gap = 1 / (x_r - x_l)
    forward = left = yaw = 0.0
    for k in range(len(pieces)):
        time, v_l = pieces[k, 0], alpha_l * pieces[k, 1]
        w = (alpha_r * pieces[k, 2] - v_l) * per_gap
        angle = w * time
        # sinc(a/2) to rounding for a < 0.1, to 1e-9 for a < 1
        q = angle * angle
        chord = time * (1 - q / 24 * (1 - q / 80 * (1 - q / 168)))
        middle = yaw + angle / 2
        cos, sin = math.cos(middle), math.sin(middle)
        ahead, aside = chord * (v_l - w * x_l), -chord * w * y
        forward += ahead * cos - aside * sin
        left += ahead * sin + aside * cos
        yaw += angle
    return forward, left, yaw


@njit(fastmath=True, error_model="numpy")
def numba_residual(z, observed, pieces):
    """Residuals (3 n) [m] at z, segment by segment."""
    residual = np.empty(3 * len(observed))
    for i in range(len(observed)):
        forward, left, yaw = motion(z, pieces[i])
        residual[3 * i] = observed[i, 0] - forward
        residual[3 * i + 1] = observed[i, 1] - left
        residual[3 * i + 2] = LEVER * (observed[i, 2] - yaw)
    return residual


@njit(fastmath=True, error_model="numpy", inline="always")
def block_residual(z, observed, pieces, state):
    """Residuals [m] of LANES segments into state[:3]; observed (3, LANES), pieces (k, 3, LANES).

    The compiler puts the lanes into vector registers: series for sine and cosine of the angle of
    a piece, and a turn of the heading in place of its sine and cosine.
    """
    x_l, x_r, y, alpha_l, alpha_r = z[0], z[1], z[2], z[3], z[4]
    per_gap = 1 / (x_r - x_l)
    for i in range(LANES):
        state[0, i], state[1, i], state[2, i] = observed[0, i], observed[1, i], observed[2, i]
        state[3, i], state[4, i] = 1.0, 0.0
    for k in range(len(pieces)):
        for i in range(LANES):
            time, v_l = pieces[k, 0, i], alpha_l * pieces[k, 1, i]
            w = (alpha_r * pieces[k, 2, i] - v_l) * per_gap
            angle = w * time
            # s = sin(a)/a, c = (1 - cos(a))/a
            q = angle * angle
            s = 1 - q * (1 / 6) * (1 - q * (1 / 20) * (1 - q * (1 / 42) * (1 - q * (1 / 72))))
            c = 1 - q * (1 / 12) * (1 - q * (1 / 30) * (1 - q * (1 / 56) * (1 - q * (1 / 90))))
            c *= angle * 0.5
            ahead, aside = time * (v_l - w * x_l), -time * w * y
            along, across = s * ahead - c * aside, c * ahead + s * aside
            cos, sin = state[3, i], state[4, i]
            state[0, i] -= cos * along - sin * across
            state[1, i] -= sin * along + cos * across
            state[2, i] -= angle
            sin_a, cos_a = s * angle, 1 - c * angle
            state[3, i] = cos * cos_a - sin * sin_a
            state[4, i] = sin * cos_a + cos * sin_a
    for i in range(LANES):
        state[2, i] *= LEVER


@njit(fastmath=True, error_model="numpy")
def lanes_residual(z, observed, pieces):
    """Residuals [m] at z, LANES segments at a time; places that none fills give zeros."""
    residual = np.empty(observed.shape)
    state = np.empty((5, LANES))
    for b in range(len(observed)):
        block_residual(z, observed[b], pieces[b], state)
        residual[b] = state[:3]
    return residual.ravel()


# --- cost (17) of a population --------------------------------------------------


@njit(fastmath=True, error_model="numpy", parallel=True)
def numba_costs(population, observed, pieces):
    """Costs [m^2] of a population (p, 5), in parallel over its individuals."""
    costs = np.empty(len(population))
    for p in prange(len(population)):
        cost = 0.0
        for i in range(len(observed)):
            forward, left, yaw = motion(population[p], pieces[i])
            x, y = observed[i, 0] - forward, observed[i, 1] - left
            turn = LEVER * (observed[i, 2] - yaw)
            cost += x * x + y * y + turn * turn
        costs[p] = cost
    return costs


@njit(fastmath=True, error_model="numpy", parallel=True)
def lanes_costs(population, observed, pieces):
    """As numba_costs, LANES segments at a time."""
    costs = np.empty(len(population))
    for p in prange(len(population)):
        state = np.empty((5, LANES))
        cost = 0.0
        for b in range(len(observed)):
            block_residual(population[p], observed[b], pieces[b], state)
            for i in range(LANES):
                cost += state[0, i] ** 2 + state[1, i] ** 2 + state[2, i] ** 2
        costs[p] = cost
    return costs


class Identification(Problem):
    """The cost (17) as pymoo wants it."""

    def __init__(self, costs, case):
        super().__init__(n_var=5, n_obj=1, xl=LOW, xu=HIGH)
        self.costs, self.case = costs, case

    def _evaluate(self, x, out, *args, **kwargs):
        out["F"] = self.costs(x, *self.case)


# --- methods ------------------------------------------------------------------


def fit(residual, case, method):
    """A least squares method: a call gives the parameters."""
    return lambda seed: least_squares(residual, START, "2-point", method=method, args=case).x


def evolve(costs, case):
    """A genetic algorithm: a call gives the parameters."""
    problem, end = Identification(costs, case), ("n_gen", GENERATIONS + 1)  # counts the first one
    return lambda seed: minimize(problem, GA(pop_size=POPULATION), end, seed=seed).X


def trackdyn(file, seed, threads):
    """Run the Rust tool: seconds and parameters, by method."""
    command = "cargo run --release --quiet -p trackdyn-benches --bin identify_case --"
    command = [*command.split(), "--case", str(file), "--seed", str(seed)]
    environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
    try:
        run = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
        run.check_returncode()
        lines = [line.split() for line in run.stdout.splitlines()]
        return {name: (float(s), np.array(z, float)) for name, s, _, *z in lines}
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        print(f"trackdyn: {error}\n{getattr(error, 'stderr', '')}", file=sys.stderr)
        sys.exit(2)


# --- report -------------------------------------------------------------------


def main():
    parser = argparse.ArgumentParser(description="peer benchmark of trackdyn's identification")
    parser.add_argument("--repeats", type=int, default=7, help="timings per method, at least 5")
    options = parser.parse_args()
    if options.repeats < 5:
        parser.error("need repeats >= 5")
    cores = numba.get_num_threads()
    with tempfile.TemporaryDirectory() as directory:
        good = compare(Path(directory) / "case.txt", options.repeats, cores)
    return 0 if good else 1


def compare(file, repeats, cores):
    """Time all methods in turns and print the tables; True when least squares agree."""
    trackdyn(file, 1, cores)  # builds
    case = read_case(file)
    lanes = in_lanes(*case)
    print(f"{len(case[0])} segments of at most {case[1].shape[1]} pieces", flush=True)
    squares = {
        "scipy lm, numpy residual": fit(numpy_residual, case, "lm"),
        "scipy lm, numba residual": fit(numba_residual, case, "lm"),
        "scipy trf, numba residual": fit(numba_residual, case, "trf"),
        "scipy lm, numba residual in lanes": fit(lanes_residual, lanes, "lm"),
    }
    genetic = {
        f"pymoo GA, numba cost, {cores} cores": evolve(numba_costs, case),
        f"pymoo GA, numba cost in lanes, {cores} cores": evolve(lanes_costs, lanes),
    }
    peers = squares | genetic
    numba_costs(START[None], *case), lanes_costs(START[None], *lanes)
    for method in squares.values():  # compiles
        method(1)
    own = {
        f"trackdyn {label}, {threads} core{'s' * (threads > 1)}": (name, threads)
        for name, label in (
            ("noise_huber", "LM, noise and Huber"),
            ("distance_squares", "LM, cost (17)"),
            ("genetic", "GA"),
        )
        for threads in sorted({cores, 1}, reverse=True)
    }
    times = {name: [] for name in (*own, *peers)}
    found = {name: [] for name in times}
    # In turns, so that other load on the machine meets all methods alike.
    for seed in range(1, repeats + 1):
        for threads in sorted({cores, 1}):
            results = trackdyn(file, seed, threads)
            for name, (key, of) in own.items():
                if of == threads:
                    times[name].append(results[key][0])
                    found[name].append(results[key][1])
        for name, method in peers.items():
            start = time.perf_counter()
            z = method(seed)
            times[name].append(time.perf_counter() - start)
            found[name].append(z)

    best = f"trackdyn LM, cost (17), {cores} core{'s' * (cores > 1)}"
    optimum = found[best][0]
    good = True
    print(f"\nLeast squares: ms, median (min-max) of {repeats}; ratio and difference to: {best}")
    print(f"{'method':48s}{'ms':>24s}{'ratio':>8s}{'difference':>12s}")
    for name in (*(name for name in own if " LM" in name), *squares):
        difference = max(np.abs(z - optimum).max() for z in found[name])
        row(name, times[name], times[best], f"{difference:12.1e}")
        good = good and (difference < TOLERANCE or "Huber" in name)  # it seeks another optimum
    best = f"trackdyn GA, {cores} core{'s' * (cores > 1)}"
    least = numba_costs(optimum[None], *case)[0]
    print(f"\nGenetic: seeds 1 to {repeats}; cost: above that of least squares, {least:.6e} m^2")
    print(f"{'method':48s}{'ms':>24s}{'ratio':>8s}  {'cost: median (min-max)'}")
    for name in (*(name for name in own if " GA" in name), *genetic):
        costs = numba_costs(np.array(found[name]), *case) / least - 1
        middle, low, high = np.median(costs), costs.min(), costs.max()
        row(name, times[name], times[best], f"  {middle:.1e} ({low:.1e}-{high:.1e})")
    print("\nleast squares agree" if good else "\nLEAST SQUARES DIFFER")
    return good


def row(name, seconds, base, rest):
    """Print a row of a table."""
    ms = 1e3 * np.array(seconds)
    spread = f"{np.median(ms):.2f} ({ms.min():.2f}-{ms.max():.2f})"
    print(f"{name:48s}{spread:>24s}{np.median(ms) / (1e3 * np.median(base)):8.2f}{rest}")


if __name__ == "__main__":
    sys.exit(main())
