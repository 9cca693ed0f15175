#!/usr/bin/env python3
"""The line of a terminal that says what takes over a second: progress.py, in a folder that has graph.g2o.

Every command waits for its input (sg-gen for its reader) until its line stands there; all of them at once, since each takes a
second to say so.
"""

import os
import pty
import subprocess
import sys

CALLS = ["sg-bayes", "sg-check", "sg-convert", "sg-cut --largest", "sg-dec -r 2", "sg-ec", "sg-ecgreedy -r 2", "sg-elim", "sg-gen sine", "sg-info",
         "sg-isam2", "sg-kf -r 2", "sg-order", "sg-plot map", "sg-predict -r 2 -", "sg-rand -r 2", "sg-report", "sg-score", "sg-solve",
         "sg-tgreedy -r 2"]


def start(call, stderr):
    return subprocess.Popen(call.split(), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=stderr)


def read_until(descriptor, wanted):
    text = ""
    while wanted is None or wanted not in text:
        try:
            chunk = os.read(descriptor, 4096)
        except OSError:  # a terminal that nobody has open any more
            break
        if not chunk:
            break
        text += chunk.decode()
    return text


def main():
    with open("graph.g2o", "rb") as file:
        graph = file.read()
    watched = []
    for call in CALLS:
        ours, theirs = pty.openpty()
        quiet_ours, quiet_theirs = pty.openpty()
        watched.append((call, start(call, theirs), ours, start(call + " -q", quiet_theirs), quiet_ours,
                        start(call, subprocess.PIPE)))
        os.close(theirs)
        os.close(quiet_theirs)
    for call, process, terminal, quiet, quiet_terminal, piped in watched:
        name = call.split()[0]
        stage = "generate" if name == "sg-gen" else "read"
        text = read_until(terminal, f"\r{name}: {stage}, 1 s\x1b[K")
        assert text.endswith("\x1b[K"), (call, text)
        process.communicate(graph)
        assert process.returncode == 0, call
        rest = read_until(terminal, None)
        assert (text + rest).rindex("\r\x1b[K") > (text + rest).rindex(f"\r{name}: {stage},"), (call, text, rest)
        quiet.communicate(graph)
        assert read_until(quiet_terminal, None) == "", call
        said = piped.communicate(graph)[1]
        assert said == b"", (call, said)
    return 0


if __name__ == "__main__":
    sys.exit(main())
