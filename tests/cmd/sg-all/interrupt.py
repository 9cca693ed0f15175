#!/usr/bin/env python3
"""What interruptions do: interrupt.py CASE, in a folder of its own that has graph.g2o. No case depends on the clock (held.py)."""

import os
import signal
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from held import Held  # noqa: E402

SOMETHING_TO_KEEP = ["sg-solve", "sg-tgreedy -r 2", "sg-ecgreedy -r 2", "sg-order -m best --budget 1000000000t"]
NOTHING_TO_KEEP = ["sg-bayes", "sg-check", "sg-convert", "sg-cut --largest", "sg-dec -r 2", "sg-ec", "sg-elim",
                   "sg-info", "sg-isam2", "sg-kf -r 2",
                   "sg-order", "sg-plot map", "sg-predict -r 2", "sg-rand -r 2", "sg-score"]


def equal(got, wanted, of):
    assert got == wanted, f"{of}: {got!r} instead of {wanted!r}"


def out(call):
    return "out.svg" if call.startswith("sg-plot") else "out"


def at_work(call):
    """The call with -o, held where it has read its graph; sg-solve, where it has told the start's chi-square."""
    with open(out(call), "w", encoding="ascii") as file:
        file.write("before\n")
    words = [*call.split(), "-v", "graph.g2o"]
    room = 0
    if call == "sg-solve":
        said = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=True).stderr
        room = said.index(b"\n0\t") + 1
    return Held([*words, "-o", out(call)], "stderr", room)


def lines(file):
    with open(file, encoding="ascii") as text:
        return text.read().splitlines()


def left_alone(call):
    equal(lines(out(call)), ["before"], call)
    os.remove(out(call))
    equal(os.listdir(), ["graph.g2o"], call)


def nothing_to_keep():
    for call in NOTHING_TO_KEEP:
        for number in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
            held = at_work(call)
            held.interrupt(number)
            equal(held.process.wait(), -number, call)
            left_alone(call)


def best_so_far():
    graph = [line for line in lines("graph.g2o") if line[:1] != "#"]
    edges = sum(line.startswith("EDGE") for line in graph)
    for call in SOMETHING_TO_KEEP:
        for number in signal.SIGINT, signal.SIGTERM:
            held = at_work(call)
            held.interrupt(number)
            status, said, _ = held.release()
            equal(status, -number, call)
            written = [line for line in lines(out(call)) if line[:1] != "#"]
            if call == "sg-solve":  # the iteration at hand
                assert "sg-solve: interrupted: not converged after 1 iterations" in said, said
                equal(len(written), len(graph), call)
                assert written != graph
            elif call.startswith("sg-order"):
                equal(sorted(written), sorted(graph), call)
            else:  # the first of the candidates
                kept = sum(line.startswith("EDGE") for line in written)
                assert 1 <= kept < edges, kept
            os.remove(out(call))
            equal(os.listdir(), ["graph.g2o"], call)


def twice():
    for call in SOMETHING_TO_KEEP:
        held = at_work(call)
        held.interrupt()
        assert held.process.poll() is None, call
        held.interrupt()
        equal(held.process.wait(), -signal.SIGINT, call)
        left_alone(call)


def rows():
    """Of a table whose reader is slow: all rows that are finished, each whole."""
    for call in "sg-ec --trace -f step,ec", "sg-isam2 -f step,ec_bt,variables,factors":
        wanted = os.popen(f"{call} graph.g2o").read()
        held = Held([*call.split(), "graph.g2o"], "stdout")
        held.interrupt()
        status, got, said = held.release()
        equal(status, -signal.SIGINT, call)
        equal(said, "", call)
        assert wanted.startswith(got) and got.endswith("\n") and len(got) > 0, (call, got[-80:])


def rows_in_file():
    """What the table has by then takes the file's name. Who has opened the second graph has a row of the first."""
    os.mkfifo("second")
    wanted = os.popen("sg-ec -f order,ec graph.g2o").read()
    with subprocess.Popen("sg-ec -f order,ec -o out graph.g2o second".split()) as process:
        with open("second", "wb"):
            process.send_signal(signal.SIGINT)
            equal(process.wait(), -signal.SIGINT, "sg-ec")
    equal("\n".join(lines("out")) + "\n", wanted, "sg-ec")
    equal(sorted(os.listdir()), ["graph.g2o", "out", "second"], "sg-ec")


def half_a_graph():
    """A reader of half a graph is told: no graph has such a line."""
    for call in ["sg-gen sine"], ["sg-cut", "--largest", "graph.g2o"]:
        held = Held(call[0].split() + call[1:], "stdout")
        held.process.send_signal(signal.SIGINT)
        status, got, _ = held.release()
        equal(status, -signal.SIGINT, call)
        assert got.endswith("\nINTERRUPTED\n"), got[-80:]


def input_that_shrinks():
    for call in "sg-cut --largest", "sg-dec -r 2", "sg-kf -r 2", "sg-rand -r 2", "sg-convert":
        held = at_work(call)
        size = os.path.getsize("graph.g2o")
        with open("graph.g2o", "rb+") as file:
            text = file.read()
            file.truncate(0)
        status, said, _ = held.release()
        equal(status, 1, call)
        said = [line for line in said.splitlines() if " CPU" not in line]
        equal(said, [f"{call.split()[0]}: graph.g2o: it became shorter while it was read"], call)
        with open("graph.g2o", "wb") as file:
            file.write(text)
        equal(os.path.getsize("graph.g2o"), size, call)
        left_alone(call)


def main():
    globals()[sys.argv[1]]()


if __name__ == "__main__":
    main()
