"""What tests of fleets share: runs over the logs of a folder, and an executor without workers."""

from concurrent.futures import Executor, Future

import pyarrow.parquet as pq

import trackdyn as td


def rows(path):
    return {row["log"]: row for row in pq.read_table(path).to_pylist()}


def run(out, **keywords):
    return td.fleet.run("logs/*/*", "auriga-alpha", out, diagnose=False, **keywords)


def status_of(main, words):
    """The exit status of a program, also where its parser ends it."""
    try:
        return main(words)
    except SystemExit as ended:
        return ended.code


class Inline(Executor):
    """Does at once what it is given."""

    def __init__(self, change=lambda result: result, after=10**9):
        self.change, self.left, self.jobs = change, after, []

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        self.jobs.append(args[0])
        self.left -= 1
        try:
            if self.left < 0:
                raise OSError("no worker is left")
            future.set_result(self.change(fn(*args, **kwargs)))
        except Exception as error:
            future.set_exception(error)
        return future
