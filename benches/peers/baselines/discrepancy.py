"""What a regression on the discrepancy of a kinematic model would name: the base of both baselines.

The discrepancy is the motion per segment of about 0.3 s less that of constant ICRs with alphas, fitted by least
squares with the clock offset that explains most. The library holds, for each effect, the columns by which it moves the
ICRs or the twist to first order, as a reader of its law would write them down.

Called as `trackdyn trial run --program` calls a program: RECORDING --vehicle FILE --held-out RUNS --out DIR.
"""

import argparse
import csv
import pathlib
import tempfile

import numpy as np

SEGMENT = 0.27  # s
COARSE, FINE = np.arange(-0.05, 0.25, 0.025), np.arange(-0.02, 0.021, 0.005)  # s


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("recording", type=pathlib.Path)
    parser.add_argument("--vehicle")
    parser.add_argument("--held-out", default="none")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    return parser.parse_args()


def runs_of(text):
    """Numbers of a list such as `9-11` or `1,4`."""
    if text == "none":
        return set()
    runs = set()
    for part in text.split(","):
        low, _, high = part.partition("-")
        runs |= set(range(int(low), int(high or low) + 1))
    return runs


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    values = np.array(rows[1:], dtype=float)
    return {name: values[:, k] for k, name in enumerate(rows[0])}


def wrapped(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


class Segments:
    """Motion per segment (forward, left, yaw), mean track speeds and their change, and where and when it was."""

    def __init__(self, recording, delay):
        tracks, poses = table(recording / "tracks.csv"), table(recording / "poses.csv")
        parts = []
        for run in np.unique(poses["run"]):
            of = lambda what: {key: value[what["run"] == run] for key, value in what.items()}
            parts.append(self.of_run(of(tracks), of(poses), run, delay))
        for key in parts[0]:
            setattr(self, key, np.concatenate([part[key] for part in parts]))

    @staticmethod
    def of_run(tracks, poses, run, delay):
        ends = [0]
        for k, t in enumerate(poses["t"]):
            if t >= poses["t"][ends[-1]] + SEGMENT:
                ends.append(k)
        first, last = np.array(ends[:-1]), np.array(ends[1:])
        t, x, y, yaw = (poses[key] for key in ("t", "x", "y", "yaw"))
        duration = t[last] - t[first]
        dx, dy, turn = x[last] - x[first], y[last] - y[first], wrapped(yaw[last] - yaw[first])
        middle = yaw[first] + turn / 2
        forward, left = np.cos(middle) * dx + np.sin(middle) * dy, np.cos(middle) * dy - np.sin(middle) * dx
        # A reading holds until the next one.
        steps = np.diff(tracks["t"], append=tracks["t"][-1] + np.median(np.diff(tracks["t"])))
        speed = {}
        for side in ("v_left", "v_right"):
            travel = np.concatenate([[0.0], np.cumsum(tracks[side] * steps)])
            stamps = np.concatenate([tracks["t"], [tracks["t"][-1] + steps[-1]]])
            at = lambda when: np.interp(when - delay, stamps, travel)
            speed[side] = (at(t[last]) - at(t[first])) / duration
            mid = (t[first] + t[last]) / 2
            speed["d" + side] = (at(t[last]) - 2 * at(mid) + at(t[first])) / (duration / 2) ** 2
        near = duration < 2 * SEGMENT
        values = dict(
            run=np.full(len(first), run), t=t[first], x=x[first], y=y[first], yaw=middle,
            left=speed["v_left"], right=speed["v_right"], dleft=speed["dv_left"], dright=speed["dv_right"],
            twist=np.stack([forward, left, turn], axis=1) / duration[:, None],
        )
        return {key: value[near] for key, value in values.items()}


def constant_icrs(segments, training):
    """The twist of constant ICRs with alphas, which is linear in the track speeds, and a fit of it."""
    speeds = np.stack([segments.left, segments.right], axis=1)
    weight = np.ones(training.sum())
    for _ in range(10):  # Huber
        factors = np.stack([
            np.linalg.lstsq(speeds[training] * weight[:, None], segments.twist[training, k] * weight, rcond=None)[0]
            for k in range(3)
        ], axis=1)
        residual = segments.twist - speeds @ factors
        scale = 1.4826 * np.median(np.abs(residual[training]), axis=0)
        length = np.linalg.norm(residual[training] / scale, axis=1)
        weight = np.sqrt(np.minimum(1.0, 3.4 / np.maximum(length, 1e-9)))
    return residual / scale, scale, factors


def library(s, scale, factors):
    """Columns of each effect: changes of the twist (forward, left, yaw), in units of the noise."""
    model = np.stack([s.left, s.right], axis=1) @ factors
    v, w = model[:, 0], model[:, 2]
    fastest = max(np.abs(s.left).max(), np.abs(s.right).max())
    speed = np.maximum(np.abs(s.left), np.abs(s.right)) / fastest
    way, turn = np.sign(s.left + s.right), np.sign(s.right - s.left)
    arc = (s.left * s.right > 0).astype(float)
    none = np.zeros_like(v)
    middle = lambda f: np.stack([-w * f, none, none], axis=1)
    ahead = lambda f: np.stack([none, -w * f, none], axis=1)
    gap = lambda f: np.stack([none, none, -w * f], axis=1)
    along = lambda f: np.stack([f, none, none], axis=1)
    yaw = lambda f: np.stack([none, none, f], axis=1)
    cos, sin = np.cos(s.yaw), np.sin(s.yaw)
    change, twist = (s.dleft + s.dright) / 2, s.dright - s.dleft
    x, y = s.x - s.x.mean(), s.y - s.y.mean()
    patches = [gap(np.exp(-((x - a * x.std()) ** 2 + (y - b * y.std()) ** 2) / 2))
               for a in (-1, 0, 1) for b in (-1, 0, 1)]
    effects = {
        "centripetal": [ahead(v * np.abs(w))],
        "load-transfer": [middle(v * w), ahead(v * v)],
        "viscous-friction": [gap(speed)],
        "stribeck-friction": [gap(np.exp(-((speed * fastest / 0.1) ** 2)))],
        "friction-creep": [gap(1 / (1 + speed * fastest / 0.03))],
        "motion-resistance": [gap(arc), along(way * arc)],
        "resistance-split": [middle(way), yaw(way * arc)],
        "hitch-drag": [ahead(way), gap(arc)],
        "belt-slip": [along(way * np.abs(w)), gap(np.abs(w))],
        "shear-displacement": [gap(1 / (1 + np.abs(w)))],
        "directional-lugs": [ahead(way), gap(way)],
        "slope": [ahead(cos), ahead(sin), middle(cos), middle(sin)],
        "tether": [ahead(x), ahead(y), middle(x), middle(y)],
        "terrain-patch": patches,
        "friction-drift": [gap(s.t)],
        "drivetrain-lag": [along(change), yaw(twist)],
        "yaw-inertia": [yaw(twist), ahead(turn * twist)],
        "heading-drift": [yaw(np.ones_like(v))],
        "sensor-yaw": [np.stack([-model[:, 1], model[:, 0], none], axis=1)],
    }
    return {effect: [column / scale for column in columns] for effect, columns in effects.items()}


def discrepancy():
    """Arguments, training mask, residual and library of a recording, with the clock offset that explains most."""
    given = arguments()
    held_out = runs_of(given.held_out)

    def at(delay):
        segments = Segments(given.recording, delay)
        training = ~np.isin(segments.run, list(held_out))
        residual, scale, factors = constant_icrs(segments, training)
        return np.log(scale).sum(), delay, segments, training, residual, scale, factors

    misfit = lambda found: found[0]
    near = min(map(at, COARSE), key=misfit)[1]
    _, _, segments, training, residual, scale, factors = min(map(at, near + FINE), key=misfit)
    # Outliers count no more than ten standard deviations.
    length = np.linalg.norm(residual, axis=1, keepdims=True)
    residual = residual * np.minimum(1.0, 10 / np.maximum(length, 1e-9))
    return given, segments, training, residual, library(segments, scale, factors)


def write(given, training, residual, after, named):
    """The part of `diagnosis.toml` that is scored."""
    judged = ~training if (~training).any() else training
    rms = lambda of: float(np.sqrt(np.mean(of[judged] ** 2)))
    status = "explained" if named else "nothing-missing"
    lines = ['schema = "trackdyn.diagnosis/1"', f'status = "{status}"']
    lines += ["[fit]", f"held_out_before = {rms(residual)}", f"held_out_after = {rms(after)}"]
    for effect in named:
        lines += ["[[missing]]", f'effect = "{effect}"', f'one_of = ["{effect}"]', "parameters = []"]
    given.out.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile("w", dir=given.out, delete=False) as file:
        file.write("\n".join(lines) + "\n")
    pathlib.Path(file.name).replace(given.out / "diagnosis.toml")
