"""Peer benchmark: stationary turns of a tracked robot, in numpy/scipy and in numba.

For every pair of track speeds (V_l, V_r) [m/s] on a grid, find the track ICRs
z = (x_l, x_r, y) [m] at which friction and centripetal force balance.
Frame: origin at the centre of both tracks' contact area, X right, Y forward,
counter-clockwise positive.

Exit code: 0 all maps agree, 1 they differ (or a solver or the quadrature fails
its check), 2 trackdyn could not be run.
"""

import argparse
import math
import os
import subprocess
import sys
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # one core for numpy and scipy

import numba
import numpy as np
from numba import njit, prange
from scipy.optimize import root

GRAVITY = 9.80665  # m/s^2
MASS = 258.0  # kg
TRACK = 0.42  # L, distance between the track centre lines, m
LENGTH = 0.70  # l, contact length of a track, m
WIDTH = 0.15  # b, width of a track, m
MU_X, MU_Y = 0.9, 0.7  # friction coefficients, lateral and longitudinal
X_C, Y_C = -0.015, 0.04  # centre of gravity, m
HEIGHT = 0.05  # h, height of the centre of gravity, m

START = np.array([-TRACK, TRACK, Y_C])  # cold start (x_l, x_r, y), m
# Both solvers stop at this step (hybr: relative, Newton: m). They converge faster than
# linearly, so the error left is much smaller than the step.
STEP = 1e-6
MAX_ITER = 50
TOLERANCE = 1e-6  # largest ICR difference between two maps, m

# Gauss-Legendre points across and along each track. 4 x 18 is the smallest rule in the
# convergence check below TOLERANCE; two more rows leave room for comparing two maps.
POINTS_X, POINTS_Y = 4, 20
REFERENCE_POINTS = 16, 96  # rule that stands for the exact integral
ROOT = Path(__file__).resolve().parents[2]


# --- model data ---------------------------------------------------------------


def rule(points_x, points_y):
    """Gauss-Legendre product rule with n points per track.

    Points x (2, n) of the left and right track and y (n) [m], weights (n) of sum 1.
    """
    t_x, w_x = np.polynomial.legendre.leggauss(points_x)
    t_y, w_y = np.polynomial.legendre.leggauss(points_y)
    x, y = np.meshgrid(t_x * WIDTH / 2, t_y * LENGTH / 2)
    x, y = x.ravel(), y.ravel()
    return np.stack([x - TRACK / 2, x + TRACK / 2]), y, np.outer(w_y, w_x).ravel() / 4


def speed_grid(n):
    """All (V_l, V_r) [m/s] of an n x n grid over [-1, 1], without V_l = V_r."""
    v = np.linspace(-1.0, 1.0, n)
    return np.array([(v[i], v[j]) for i in range(n) for j in range(n) if i != j])


# --- (a) numpy quadrature, scipy.optimize.root --------------------------------


def residual(z, v_l, v_r, x, y, weight):
    """Sums of forces X, Y [N] and of moments about the origin [N m] at z [m].

    x (2, n), y (n): belt points of the left and right track [m]; weight (n).
    """
    x_icr, y_icr = z[:2, None], z[2]
    # w = (V_r - V_l) / (x_r - x_l),  v_x = w y,  v_y = V_l - w x_l
    w = (v_r - v_l) / (z[1] - z[0])
    v_x, v_y = w * y_icr, v_l - w * z[0]
    # v_cog = (v_x - w y_c, v_y + w x_c),  a = (-w v_cog_y, w v_cog_x)
    a_x, a_y = -w * (v_y + w * X_C), w * (v_x - w * Y_C)
    # x_p = x_c - h a_x / g,  y_p = y_c - h a_y / g
    x_p, y_p = X_C - HEIGHT * a_x / GRAVITY, Y_C - HEIGHT * a_y / GRAVITY
    # N_l, N_r = m g (1/2 -+ x_p / L)
    load = MASS * GRAVITY * np.array([[0.5 - x_p / TRACK], [0.5 + x_p / TRACK]])
    # p dA = N (1 + 12 y_p y / l^2) weight
    p = load * ((1 + 12 * y_p / LENGTH**2 * y) * weight)
    # s = w (-(y - y_icr), x - x_icr)
    s_x, s_y = w * (y_icr - y), w * (x - x_icr)
    # tau = -diag(mu_x, mu_y) p s / |s|
    p_s = p / np.sqrt(s_x**2 + s_y**2)
    tau_x, tau_y = -MU_X * p_s * s_x, -MU_Y * p_s * s_y
    # sum tau - m a = 0,  sum (x tau_y - y tau_x) - m (x_c a_y - y_c a_x) = 0
    return (
        tau_x.sum() - MASS * a_x,
        tau_y.sum() - MASS * a_y,
        (x * tau_y - y * tau_x).sum() - MASS * (X_C * a_y - Y_C * a_x),
    )


def numpy_map(speeds, quadrature):
    """ICRs [m] and number of residual evaluations, for each pair of speeds [m/s]."""
    icr, count = np.empty((len(speeds), 3)), np.empty(len(speeds), int)
    for i, (v_l, v_r) in enumerate(speeds):
        found = root(residual, START, (v_l, v_r, *quadrature), "hybr", tol=STEP)
        icr[i] = found.x if found.success else np.nan
        count[i] = found.nfev
    return icr, count


# --- (b) numba, Newton with analytic Jacobian ---------------------------------


@njit(fastmath=True, error_model="numpy")
def balance(z, v_l, v_r, quadrature, f, jac):
    """Write the residuals f [N, N, N m] at z [m] and their Jacobian jac [N/m, N/m, N]."""
    x, y, weight = quadrature
    x_l, x_r, y_icr = z
    # w = (V_r - V_l) / (x_r - x_l)
    w = (v_r - v_l) / (x_r - x_l)
    dw = (w / (x_r - x_l), -w / (x_r - x_l), 0.0)
    # v_cog = (w (y - y_c), V_l - w (x_l - x_c)),  a = (-w v_cog_y, w v_cog_x)
    vc_x, vc_y = w * (y_icr - Y_C), v_l - w * (x_l - X_C)
    a_x, a_y = -w * vc_y, w * vc_x
    # x_p = x_c - h a_x / g,  y_p = y_c - h a_y / g
    x_p, y_p = X_C - HEIGHT * a_x / GRAVITY, Y_C - HEIGHT * a_y / GRAVITY
    # inertia: -m a,  -m (x_c a_y - y_c a_x)
    f[0], f[1] = -MASS * a_x, -MASS * a_y
    f[2] = X_C * f[1] - Y_C * f[0]
    da = np.empty((2, 3))
    for k in range(3):
        dvc_x = dw[k] * (y_icr - Y_C) + (w if k == 2 else 0.0)
        dvc_y = -dw[k] * (x_l - X_C) - (w if k == 0 else 0.0)
        da[0, k] = -dw[k] * vc_y - w * dvc_y
        da[1, k] = dw[k] * vc_x + w * dvc_x
        jac[0, k], jac[1, k] = -MASS * da[0, k], -MASS * da[1, k]
        jac[2, k] = X_C * jac[1, k] - Y_C * jac[0, k]

    slope = 12 * y_p / LENGTH**2  # p = N (1 + slope y) weight
    # tau / p = -diag(mu) s / |s| = c (-e, d) / r,  c = -sign(w) diag(mu),
    # d = x - x_j,  e = y - y_icr,  r^2 = d^2 + e^2
    c_x, c_y = -math.copysign(MU_X, w), -math.copysign(MU_Y, w)
    for j in range(2):
        side = 2 * j - 1
        load = MASS * GRAVITY * (0.5 + side * x_p / TRACK)
        # integrals of (tau_x, tau_y, moment) / p, of y times these,
        # and of p d(...)/dx_j and p d(...)/dy_icr
        f_x = f_y = f_m = g_x = g_y = g_m = 0.0
        jx_x = jx_y = jx_m = jy_x = jy_y = jy_m = 0.0
        for i in range(weight.size):
            d, e = x[j, i] - z[j], y[i] - y_icr
            r_2 = 1 / (d * d + e * e)
            q = weight[i] * math.sqrt(r_2)
            u_x, u_y = -c_x * e * q, c_y * d * q
            u_m = x[j, i] * u_y - y[i] * u_x
            f_x += u_x
            f_y += u_y
            f_m += u_m
            g_x += y[i] * u_x
            g_y += y[i] * u_y
            g_m += y[i] * u_m
            # d/dx_j (-e, d)/r = (-e d, -e^2)/r^3,  d/dy_icr (-e, d)/r = (d^2, d e)/r^3
            q *= r_2 * load * (1 + slope * y[i])
            u_x, u_y = -c_x * e * d * q, -c_y * e * e * q
            jx_x += u_x
            jx_y += u_y
            jx_m += x[j, i] * u_y - y[i] * u_x
            u_x, u_y = c_x * d * d * q, c_y * d * e * q
            jy_x += u_x
            jy_y += u_y
            jy_m += x[j, i] * u_y - y[i] * u_x
        sums = (f_x + slope * g_x, f_y + slope * g_y, f_m + slope * g_m)
        sums_y, jac_x, jac_y = (g_x, g_y, g_m), (jx_x, jx_y, jx_m), (jy_x, jy_y, jy_m)
        for i in range(3):
            f[i] += load * sums[i]
            jac[i, j] += jac_x[i]
            jac[i, 2] += jac_y[i]
            for k in range(3):
                # dN = -+ m h da_x / L,  d(slope) = -12 h da_y / (g l^2)
                d_load = -side * MASS * HEIGHT * da[0, k] / TRACK
                d_slope = -12 * HEIGHT * da[1, k] / (GRAVITY * LENGTH**2)
                jac[i, k] += d_load * sums[i] + load * d_slope * sums_y[i]


@njit(fastmath=True, error_model="numpy")
def cross(a, b):
    """Vector product of two rows."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@njit(fastmath=True, error_model="numpy")
def newton(v_l, v_r, quadrature, z):
    """Write the ICRs z [m]; return the number of iterations (MAX_ITER: failed)."""
    f, jac = np.empty(3), np.empty((3, 3))
    z[:] = START
    for iteration in range(1, MAX_ITER):
        balance(z, v_l, v_r, quadrature, f, jac)
        # jac dz = f, by Cramer's rule:  dz = sum f_i (row_j x row_k) / det
        c0, c1, c2 = cross(jac[1], jac[2]), cross(jac[2], jac[0]), cross(jac[0], jac[1])
        det = jac[0, 0] * c0[0] + jac[0, 1] * c0[1] + jac[0, 2] * c0[2]
        largest = 0.0
        for k in range(3):
            step = (f[0] * c0[k] + f[1] * c1[k] + f[2] * c2[k]) / det
            z[k] -= step
            largest = max(largest, abs(step))
        if largest < STEP:
            return iteration
    return MAX_ITER


@njit
def numba_map(speeds, quadrature):
    """ICRs [m] and number of Newton iterations, for each pair of speeds [m/s]."""
    icr, count = np.empty((len(speeds), 3)), np.empty(len(speeds), np.int64)
    for i in range(len(speeds)):
        count[i] = newton(speeds[i, 0], speeds[i, 1], quadrature, icr[i])
    return icr, count


@njit(parallel=True)
def numba_map_parallel(speeds, quadrature):
    """As numba_map, on all cores."""
    icr, count = np.empty((len(speeds), 3)), np.empty(len(speeds), np.int64)
    for i in prange(len(speeds)):
        count[i] = newton(speeds[i, 0], speeds[i, 1], quadrature, icr[i])
    return icr, count


# --- trackdyn -----------------------------------------------------------------


def trackdyn_map(n):
    """Run the Rust tool on an n x n grid.

    Seconds per solve (one core, cold start) and the ICRs [m] in the order of speed_grid.
    """
    command = "cargo run --release --quiet -p trackdyn-benches --bin solve_grid -- --grid"
    command = [*command.split(), str(n)]

    def fail(why):
        print(f"trackdyn: {why}\n  command: {' '.join(command)}", file=sys.stderr)
        sys.exit(2)

    try:
        run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    except OSError as error:
        fail(f"cannot start cargo ({error})")
    if run.returncode != 0:
        fail(f"exit code {run.returncode}\n{run.stderr.strip()}")
    try:
        head, *lines = run.stdout.strip().splitlines()
        name, seconds = head.split()
        rows = np.array([line.split() for line in lines], float).reshape(-1, 5)
        seconds = float(seconds)
    except ValueError as error:
        fail(f"unreadable output ({error})")
    if name != "seconds_per_solve":
        fail(f"the first line is {head!r}, not 'seconds_per_solve <float>'")
    place = np.rint((rows[:, :2] + 1) * (n - 1) / 2)  # grid indices of (V_l, V_r)
    rows = rows[np.lexsort((place[:, 1], place[:, 0]))]
    speeds = speed_grid(n)
    if len(rows) != len(speeds) or not np.allclose(rows[:, :2], speeds, rtol=0, atol=1e-12):
        fail(f"{len(rows)} points that are not the {len(speeds)} pairs of the grid")
    return seconds, rows[:, 2:]


# --- checks, timing, report ---------------------------------------------------


def largest_difference(a, b):
    """Largest difference of two maps [m]; inf when a solve failed."""
    difference = np.abs(a - b).max()
    return difference if np.isfinite(difference) else np.inf


def quadrature_error(points_x, points_y, speeds):
    """Largest ICR error of a rule against REFERENCE_POINTS [m]."""
    exact = numba_map(speeds, rule(*REFERENCE_POINTS))[0]
    return largest_difference(numba_map(speeds, rule(points_x, points_y))[0], exact)


def report_convergence(speeds):
    """Print the quadrature error [m] of several rules; True when the rule in use passes."""
    across, along = (2, 3, 4, 5, 6, 8), (8, 12, 16, 18, 20, 22, 24, 28, 32)
    print("Largest ICR error [m] on the coarse grid; columns: points across, rows: along")
    print("      " + "".join(f"{n:10d}" for n in across))
    for m in along:
        errors = (quadrature_error(n, m, speeds) for n in across)
        print(f"{m:6d}" + "".join(f"{e:10.1e}" for e in errors))
    error = quadrature_error(POINTS_X, POINTS_Y, speeds)
    print(f"In use: {POINTS_X} x {POINTS_Y} points, error {error:.1e} m\n")
    return error < TOLERANCE


def report_map(icr, n):
    """Print the quasi-static ICRs and the statistics of the n x n map [m]."""
    # As the speeds vanish, so does the acceleration: the quasi-static limit.
    limit = numba_map(np.array([[-1e-6, 1e-6]]), rule(POINTS_X, POINTS_Y))[0]
    print("                              x_l [m]     x_r [m]       y [m]")

    def line(name, values):
        print(f"{name:24s}" + "".join(f"{v:12.6f}" for v in values))

    line("quasi-static limit", limit[0])
    whole = np.vstack([icr, np.repeat(limit, n, axis=0)])
    for name, values in (("V_l = V_r left out", icr), ("V_l = V_r as the limit", whole)):
        print(f"{n} x {n} map, {name}:")
        line("  mean", values.mean(axis=0))
        line("  standard deviation", values.std(axis=0))
    print()


def main():
    parser = argparse.ArgumentParser(description="peer benchmark of trackdyn")
    parser.add_argument("--grid", type=int, default=101, help="points per speed axis")
    parser.add_argument("--coarse", type=int, default=11, help="the same for numpy + scipy")
    parser.add_argument("--repeats", type=int, default=15, help="timings per method, at least 5")
    parser.add_argument("--no-rust", action="store_true", help="leave trackdyn out")
    options = parser.parse_args()
    n, m = options.grid, options.coarse
    if m < 2 or (n - 1) % (m - 1) or options.repeats < 5:
        parser.error("need coarse >= 2, coarse - 1 a divisor of grid - 1, repeats >= 5")

    quadrature = rule(POINTS_X, POINTS_Y)
    fine = speed_grid(n)
    stride = (n - 1) // (m - 1)
    index = [(i * stride, j * stride) for i in range(m) for j in range(m) if i != j]
    # Position in speed_grid: row i holds n - 1 points, its diagonal point left out.
    in_fine = np.array([i * (n - 1) + j - (j > i) for i, j in index])
    coarse = fine[in_fine]

    print("Compiling\n", flush=True)
    numba_map(coarse, quadrature)
    numba_map_parallel(coarse, quadrature)
    good = report_convergence(coarse)

    # At the accuracy that a picture needs, and at that of the closed form.
    cores = f"numba Newton, {numba.get_num_threads()} cores"
    peers = {
        "numpy + scipy hybr": (numpy_map, coarse, (POINTS_X, POINTS_Y)),
        "numba Newton, 1 core": (numba_map, fine, (POINTS_X, POINTS_Y)),
        cores: (numba_map_parallel, fine, (POINTS_X, POINTS_Y)),
        "numpy + scipy, exact": (numpy_map, coarse, REFERENCE_POINTS),
        "numba, exact, 1 core": (numba_map, fine, REFERENCE_POINTS),
    }
    quadratures = {name: rule(*points) for name, (_, _, points) in peers.items()}
    times, maps, counts = {name: [] for name in peers}, {}, {}
    if not options.no_rust:
        trackdyn_map(m)  # builds
        times["trackdyn, 1 core"] = []
    # In turns, so that other load on the machine meets all methods alike.
    for _ in range(options.repeats):
        if not options.no_rust:
            seconds, maps["trackdyn, 1 core"] = trackdyn_map(n)
            times["trackdyn, 1 core"].append(seconds)
        for name, (solve, speeds, _) in peers.items():
            start = time.perf_counter()
            maps[name], counts[name] = solve(speeds, quadratures[name])
            times[name].append((time.perf_counter() - start) / len(speeds))

    report_map(maps["numpy + scipy hybr"], m)
    base = "numba Newton, 1 core" if options.no_rust else "trackdyn, 1 core"
    print(f"numpy + scipy on the {m} x {m} grid, the others on the {n} x {n} grid")
    print(f"us per solve: median (min-max) of {options.repeats}; ratio and difference to: {base}")
    print(f"{'method':24s}{'points':>8s}{'us per solve':>26s}{'ratio':>9s}{'difference [m]':>16s}")
    for name in sorted(times, key=lambda name: name != base):
        us = 1e6 * np.array(times[name])
        middle = np.median(us)
        spread = f"{middle:.2f} ({us.min():.2f}-{us.max():.2f})"
        points = math.prod(peers[name][2]) if name in peers else "-"
        reference = maps[base] if len(maps[name]) == len(fine) else maps[base][in_fine]
        difference = largest_difference(maps[name], reference)
        ratio = middle / (1e6 * np.median(times[base]))
        print(f"{name:24s}{points:>8}{spread:>26s}{ratio:9.2f}{difference:16.1e}")
        good = good and difference < TOLERANCE
    scipy_map, newton_map = maps["numpy + scipy hybr"], maps["numba Newton, 1 core"]
    difference = largest_difference(scipy_map, newton_map[in_fine])
    print(f"numpy + scipy against numba: difference {difference:.1e} m")
    good = good and difference < TOLERANCE
    for name, count in counts.items():
        what = "residual evaluations" if "scipy" in name else "Newton iterations"
        print(f"{name}: {what} mean {count.mean():.2f}, largest {count.max()}")
        good = good and (("scipy" in name) or count.max() < MAX_ITER)
    print("maps agree" if good else "MAPS DIFFER or a check failed")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
