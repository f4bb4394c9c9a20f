"""Sparse regression on the discrepancy: pysindy's sequentially thresholded least squares, its threshold chosen on
every fourth of the training runs."""

import numpy as np
import pysindy
from discrepancy import discrepancy, write


def main():
    given, segments, training, residual, library = discrepancy()
    names = [effect for effect, columns in library.items() for _ in columns]
    matrix = np.stack([column.ravel() for columns in library.values() for column in columns], axis=1)
    length = np.linalg.norm(matrix[np.repeat(training, 3)], axis=0)
    matrix = matrix / np.where(length > 0, length, 1.0)
    validating = training & (segments.run % 4 == 3)
    learning = training & ~validating

    def factors(rows, threshold):
        mask = np.repeat(rows, 3)
        optimizer = pysindy.STLSQ(threshold=threshold, alpha=1e-6)
        optimizer.fit(matrix[mask], residual.ravel()[mask][:, None])
        return np.asarray(optimizer.coef_).ravel()

    def misfit(threshold):
        mask = np.repeat(validating, 3)
        left = residual.ravel()[mask] - matrix[mask] @ factors(learning, threshold)
        return np.mean(left**2)

    # Columns have unit length: a factor is the z of its column.
    threshold = min((1.5, 2, 3, 4, 5, 7, 10, 15, 20), key=misfit)
    found = factors(training, threshold)
    named = sorted({name for name, factor in zip(names, found) if factor != 0.0})
    write(given, training, residual, residual - (matrix @ found).reshape(residual.shape), named)


main()
