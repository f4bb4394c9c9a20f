"""Stepwise regression by the Bayesian information criterion, forward and backward."""

import numpy as np
from discrepancy import discrepancy, write


def fitted(columns, residual, rows):
    if not columns:
        return np.zeros_like(residual)
    matrix = np.stack([column.ravel() for column in columns], axis=1)
    mask = np.repeat(rows, 3)
    factors = np.linalg.lstsq(matrix[mask], residual.ravel()[mask], rcond=None)[0]
    return (matrix @ factors).reshape(residual.shape)


def main():
    given, _, training, residual, library = discrepancy()
    count = 3 * training.sum()

    def bic(effects):
        columns = [column for effect in effects for column in library[effect]]
        left = (residual - fitted(columns, residual, training))[training]
        return count * np.log(np.mean(left**2)) + len(columns) * np.log(count)

    named = []
    while True:
        steps = [named + [effect] for effect in library if effect not in named]
        steps += [[other for other in named if other != effect] for effect in named]
        best = min(steps, key=bic)
        if bic(best) >= bic(named) - 1e-9:
            break
        named = best
    columns = [column for effect in named for column in library[effect]]
    write(given, training, residual, residual - fitted(columns, residual, training), sorted(named))


main()
