"""The Python module says what the commands say, and takes and gives numpy arrays."""

import os
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings
from pathlib import Path

import numpy as np
import sgtools as sg

BIN = Path(os.environ["BIN"])
TESTDATA = Path(__file__).parents[2] / "testdata"


def command(*words, text=""):
    return subprocess.run([BIN / words[0], *map(str, words[1:])], input=text, text=True, capture_output=True, check=True).stdout


def world(*words):
    return command("sg-gen", *words)


class Reading(unittest.TestCase):
    def test_ids_tags_and_numbers(self):
        graph = sg.parse("VERTEX_SE2 5 1 2 3\nVERTEX_SE2 1 0 0 0.5\nVERTEX_XY 7 4 4\nFIX 5\nEDGE_SE2 1 5 1 2 3 1 0 0 2 0 3\n")
        self.assertEqual(graph.ids.tolist(), [1, 5, 7])
        self.assertEqual(graph.fixed.tolist(), [5])
        self.assertEqual(graph.vertex_tags, {"VERTEX_SE2": 2, "VERTEX_XY": 1})
        ids, numbers = graph.vertices("VERTEX_SE2")
        self.assertEqual((ids.tolist(), numbers.tolist()), ([1, 5], [[0, 0, 0.5], [1, 2, 3]]))
        ends, numbers = graph.edges("EDGE_SE2")
        self.assertEqual((ends.tolist(), numbers.tolist()), ([[1, 5]], [[1, 2, 3, 1, 0, 0, 2, 0, 3]]))
        self.assertEqual(graph.vertices("VERTEX_CAM")[0].size, 0)

    def test_arrays_make_the_same_graph(self):
        for words in (["manhattan", "-n", 60], ["sphere", "-n", 80], ["sine", "-n", 12, "--sensor", "disparity"], ["city", "-n", 40]):
            graph = sg.parse(world(*words))
            again = sg.from_arrays(
                {tag: graph.vertices(tag) for tag in graph.vertex_tags},
                {tag: graph.edges(tag) for tag in graph.edge_tags},
                fixed=graph.fixed,
                params=self.params(graph),
            )
            self.assertEqual(again.ids.tolist(), graph.ids.tolist())
            self.assertEqual(sg.ec(again), sg.ec(graph))
            self.assertAlmostEqual(sg.chi2(again) / sg.chi2(graph), 1, delta=1e-12)

    @staticmethod
    def params(graph):
        lines = [line.split() for line in graph.text.splitlines() if line.startswith("PARAMS")]
        return {line[0]: ([int(line[1])], [[float(x) for x in line[2:]]]) for line in lines}

    def test_a_file_and_its_path(self):
        graph = sg.read(TESTDATA / "walk.g2o")
        with tempfile.TemporaryDirectory() as folder:
            graph.write(Path(folder) / "copy.g2o")
            self.assertEqual((Path(folder) / "copy.g2o").read_bytes(), (TESTDATA / "walk.g2o").read_bytes())

    def test_errors_name_file_and_line(self):
        with self.assertRaisesRegex(sg.InputError, r"^<text>:2: "):
            sg.parse("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0\n")
        with self.assertRaisesRegex(sg.InputError, "no.g2o"):
            sg.read("no.g2o")
        with self.assertRaisesRegex(ValueError, "did you mean colamd"):
            sg.order(sg.read(TESTDATA / "walk.g2o"), "colmd")
        with self.assertRaisesRegex(ValueError, "3 rows of ids, 2 of numbers"):
            sg.from_arrays({"VERTEX_XY": ([1, 2, 3], np.zeros((2, 2)))}, {})

    def test_warnings(self):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "new.g2o"
                path.write_text("VERTEX_SE2 0 0 0 0\nVERTEX_NEW 1 2\n")
                sg.read(path, skip_unknown=True)
        self.assertEqual([str(one.message).split(": ")[1] for one in told], ["left out 1 VERTEX_NEW"])


class Eliminating(unittest.TestCase):
    def test_ec_is_the_commands(self):
        for words in (["manhattan", "-n", 300], ["sine", "-n", 30], ["torus", "-n", 200]):
            text = world(*words)
            graph = sg.parse(text)
            for method in ("colamd", "amd", "wmf", "metis"):
                said = command("sg-ec", "-m", method, "-f", "ec,nnz,fill,ec_bt,cliques,height", "--no-header", text=text).split()
                one = sg.elimination(graph, method)
                self.assertEqual([one[name] for name in ("ec", "nnz", "fill", "ec_bt", "cliques", "height")], list(map(int, said)))
                self.assertEqual(sg.ec(graph, sg.order(graph, method)), one["ec"])

    def test_more_than_64_bits(self):
        n = 3_000_000  # one clique of poses would be larger; a dense row of this many scalars is enough
        text = "".join(f"VERTEX_BIG {k} 0\n" for k in range(3)) + "EDGE_ALL 0 1 2\n"
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "big.g2o"
            path.write_text(text)
            graph = sg.read(path, vertex=[f"VERTEX_BIG:{n}:pose"], edge=["EDGE_ALL:3"])
        self.assertEqual(sg.ec(graph), n**3 * (9 + 4 + 1))

    def test_an_order_of_ids(self):
        graph = sg.parse(world("manhattan", "-n", 50))
        variables = sorted(set(graph.ids.tolist()) - set(graph.fixed.tolist()))
        self.assertEqual(sorted(sg.order(graph, last=variables[:2]).tolist()), variables)
        self.assertEqual(set(sg.order(graph, last=variables[:2])[-2:].tolist()), set(variables[:2]))
        for wrong in (variables[1:], variables + variables[:1], [10**9]):
            with self.assertRaisesRegex(ValueError, "order: "):
                sg.ec(graph, wrong)

    def test_growth_is_the_trace(self):
        text = world("sine", "-n", 40)
        said = command("sg-ec", "--trace", "--every", 7, "--min-obs", 3, "-f", "step,edges,ec", "--no-header", text=text)
        grown = sg.growth(sg.parse(text), every=7, min_obs=3)
        rows = np.column_stack([grown["step"], grown["edges"], grown["ec"]])
        np.testing.assert_array_equal(rows, np.loadtxt(said.splitlines()))

    def test_bayes_tree_adds_up(self):
        graph = sg.parse(world("sphere", "-n", 120))
        tree = sg.bayes_tree(graph, "wmf")
        frontals = np.concatenate(tree["frontals"])
        self.assertEqual(len(set(frontals.tolist())), len(frontals))
        ec_bt = sum(int(f) * int(t) ** 2 for f, t in zip(tree["frontal_dim"], tree["total_dim"]))
        self.assertEqual(ec_bt, sg.elimination(graph, "wmf")["ec_bt"])
        for parent, separator in zip(tree["parent"], tree["separators"]):
            if parent >= 0:
                above = set(tree["frontals"][parent].tolist()) | set(tree["separators"][parent].tolist())
                self.assertLessEqual(set(separator.tolist()), above)
            else:
                self.assertEqual(separator.size, 0)


class Pruning(unittest.TestCase):
    def same(self, graph, *words, text):
        said = sg.parse(command(*words, "--no-trace-comment", text=text))
        self.assertEqual(graph.text, said.text)
        self.assertLess(len(graph.text), len(text))

    def test_policies_are_the_commands(self):
        text = world("sine", "-n", 60)
        graph = sg.parse(text)
        count = sg.candidates(graph)
        self.same(sg.decimate(graph, 4, min_obs=3), "sg-dec", "-r", 4, "--min-obs", 3, text=text)
        self.same(sg.decimate(graph, 4, offset="random", seed=5), "sg-dec", "-r", 4, "--offset", "random", "--seed", 5, text=text)
        self.same(sg.keyframes(graph, rate=3), "sg-kf", "-r", 3, text=text)
        self.same(sg.sample(graph, count // 2, seed=3), "sg-rand", "-k", count // 2, "--seed", 3, text=text)
        self.same(sg.tgreedy(graph, count // 3), "sg-tgreedy", "-k", count // 3, text=text)
        self.same(sg.ecgreedy(graph, ec=1e6, min_obs=3), "sg-ecgreedy", "--ec", "1e6", "--min-obs", 3, text=text)

    def test_loops(self):
        text = world("manhattan", "-n", 300)
        graph = sg.parse(text)
        self.same(sg.ecgreedy(graph, keep=40), "sg-ecgreedy", "-k", 40, text=text)
        self.same(sg.keyframes(graph, distance=3.0, fuse=True), "sg-kf", "--dist", 3, "--fuse", text=text)

    def test_wrong_calls(self):
        graph = sg.read(TESTDATA / "walk.g2o")
        for call in (
            lambda: sg.decimate(graph, 0),
            lambda: sg.decimate(graph, 2, offset="none"),
            lambda: sg.decimate(graph, 2, candidates="all"),
            lambda: sg.keyframes(graph),
            lambda: sg.ecgreedy(graph),
            lambda: sg.ecgreedy(graph, ec=5, keep=3),
            lambda: sg.tgreedy(graph, 3, weights="none"),
            lambda: sg.trajectory_error(graph, graph, "all"),
            lambda: sg.joint_covariance(graph, 0, 12345),
        ):
            with self.assertRaises(ValueError):
                call()


class Solving(unittest.TestCase):
    def test_solve_is_the_command(self):
        text = world("manhattan", "-n", 400)
        solution = sg.solve(sg.parse(text))
        said = float(command("sg-solve", "--chi2", text=command("sg-solve", text=text)))
        self.assertTrue(solution.converged)
        self.assertLess(solution.chi2, solution.initial_chi2)
        self.assertAlmostEqual(solution.chi2 / said, 1, delta=1e-9)
        self.assertAlmostEqual(sg.chi2(solution.graph) / said, 1, delta=1e-9)

    def test_what_does_not_converge(self):
        graph = sg.parse(world("manhattan", "-n", 400))
        self.assertFalse(sg.solve(graph, iterations=1).converged)
        with self.assertRaisesRegex(sg.ComputationError, "undetermined"):
            sg.solve(sg.parse("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_XY 2 1 1\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"))

    def test_covariances(self):
        graph = sg.solve(sg.parse(world("city", "-n", 60))).graph
        blocks = sg.covariances(graph)
        self.assertEqual(sorted(blocks), graph.ids.tolist())
        ids, sigma = sg.sigmas(graph)
        for vertex, of in zip(ids.tolist(), sigma):
            self.assertAlmostEqual(np.sqrt(np.trace(blocks[vertex][:2, :2])), of, delta=1e-9)
        a, b = ids[5], ids[40]
        joint = sg.joint_covariance(graph, a, b)
        np.testing.assert_allclose(joint[:3, :3], blocks[a], rtol=1e-9, atol=1e-15)
        np.testing.assert_allclose(joint, joint.T, rtol=1e-9, atol=1e-15)

    def test_trajectory_error(self):
        graph = sg.solve(sg.parse(world("sphere", "-n", 100))).graph
        error = sg.trajectory_error(graph, graph)
        self.assertEqual(error["matched"], 100)
        self.assertAlmostEqual(error["ate"], 0, delta=1e-9)

    def test_the_example(self):
        figure4 = Path(__file__).parents[2] / "python" / "examples" / "figure4.py"
        with tempfile.TemporaryDirectory() as folder:
            graph = Path(folder) / "sine.g2o"
            graph.write_text(world("sine", "-n", 60))
            said = subprocess.run([sys.executable, figure4, graph, "--every", "20"], text=True, capture_output=True, check=True).stdout
            last = said.splitlines()[-1].split("\t")
            self.assertEqual(said.splitlines()[0], "step\tfull\tdec\trand\tkf\tdec, predicted\tkf, predicted")
            self.assertEqual(int(float(last[1])), sg.ec(sg.parse(world("sine", "-n", 60))))

    def test_other_threads_go_on(self):
        graph = sg.parse(world("manhattan", "-n", 20000))
        done = threading.Event()
        work = threading.Thread(target=lambda: (sg.solve(graph, iterations=3), done.set()))
        work.start()
        turns = 0
        while not done.is_set():
            turns += 1
        work.join()
        self.assertGreater(turns, 1000)


if __name__ == "__main__":
    unittest.main()
