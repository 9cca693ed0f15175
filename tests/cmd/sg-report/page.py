#!/usr/bin/env python3
"""What is on a page: page.py CHECK FILE. Its calls are run, and have to print what it shows."""

import json
import re
import subprocess
import sys


def data_of(path):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)[1])


def printed(call):
    """The rows of a table that a call prints, the header of those that have one taken off."""
    text = subprocess.run(["bash", "-o", "pipefail", "-c", call], check=True, capture_output=True, text=True).stdout
    return [line.split("\t") for line in text.rstrip("\n").split("\n")]


def near(a, b, bound=1e-9):
    assert abs(float(a) - float(b)) <= bound * (1 + abs(float(b))), (a, b)


def equal(got, wanted, of):
    assert got == wanted, f"{of}: {got} instead of {wanted}"


def column(sheet, name):
    k = [column["name"] for column in sheet["columns"]].index(name)
    return [row[k] for row in sheet["rows"]]


def sheets(graph):
    """Every table but those of seconds is what its call prints."""
    facts = {row[0]: row[1] for row in printed(graph["facts"]["call"])[1:]}
    for key, value, _ in graph["facts"]["rows"]:
        equal(value, facts[key], key)
    call = graph["findings"]["call"] + " -f severity,line,cause || true"
    equal(graph["findings"]["rows"], [row for row in printed(call)[1:]], call)
    call, timed = graph["orderings"]["call"].split("\n")
    rows = printed(call)
    equal([row[:len(rows[0])] for row in graph["orderings"]["rows"]], rows[1:], call)
    equal(column(graph["orderings"], "order"), [row[0] for row in printed(timed)[1:]], timed)
    for row, nnz in zip(column(graph["orderings"], "bytes"), column(graph["orderings"], "nnz")):
        equal(int(row), 8 * int(nnz), "bytes")
    for name in "variables", "cliques", "edges":
        equal(graph[name]["rows"], printed(graph[name]["call"]), graph[name]["call"])
        assert graph[name]["rows"]
    assert printed(graph["map"]["call"])[0][0].startswith("<?xml")


def variants(graph):
    """EC, sigma and ATE are what the calls print; seconds are there."""
    for call in graph["first"]:
        subprocess.run(["sh", "-c", call], check=True)
    sheet = graph["variants"]
    ec, sigma, ate = (column(sheet, name) for name in ("ec", "sigma_mean", "ate_rmse"))
    seen = set()
    for k, calls in enumerate(graph["calls"]):
        equal(printed(calls["prints"][0])[1], [ec[k]], calls["prints"][0])
        if not sigma[k] or calls["prints"][3] in seen:
            continue
        seen.add(calls["prints"][3])
        got = printed(calls["prints"][3])[1]
        near(got[0], sigma[k], 1e-6)
        near(got[1], ate[k], 1e-6)
        assert float(printed(calls["prints"][1])[1][0]) > 0
        assert float(printed(calls["prints"][2])[0][0]) > 0
    assert len(seen) >= 2, sheet


def advice(graph):
    """The recommended pipe makes a graph of the EC that is told."""
    subprocess.run(["bash", "-o", "pipefail", "-c", graph["advice"]["pipe"] + " >faster.g2o"], check=True)
    equal(printed("sg-ec -f ec faster.g2o")[1], [graph["advice"]["ec"]], graph["advice"]["pipe"])
    equal(printed(graph["advice"]["check"])[1], [graph["advice"]["ec"]], graph["advice"]["check"])
    assert graph["advice"]["ec"] in graph["advice"]["sentence"]


def main():
    for graph in data_of(sys.argv[2])["graphs"]:
        globals()[sys.argv[1]](graph)


if __name__ == "__main__":
    main()
