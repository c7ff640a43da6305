"""The package as a whole: what it loads, what its stubs and help() say."""
import ast
import inspect
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import support  # skips without NumPy

import antigrasp

FOLDER = pathlib.Path(antigrasp.__file__).parent


def members(value):
    return {name for name in vars(value) if not name.startswith("_")}


def stub_of(module):
    """{name: set of members, or None} of a stub."""
    tree = ast.parse((FOLDER / f"{module}.pyi").read_text())
    found = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            names = {one.name for one in node.body if isinstance(one, ast.FunctionDef)}
            names |= {one.target.id for one in node.body if isinstance(one, ast.AnnAssign)}
            found[node.name] = {name for name in names if not name.startswith("_")}
        elif isinstance(node, ast.FunctionDef):
            found[node.name] = None
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = None
    return found


class Package(unittest.TestCase):
    def test_the_geometry_half_loads_no_libtorch(self):
        maps = subprocess.run([sys.executable, "-c", "import antigrasp; antigrasp.evaluate; print(open('/proc/self/maps').read())"],
                              check=True, capture_output=True, text=True).stdout
        self.assertIn("_geometry", maps)
        for library in ("libtorch", "libc10", "_networks"):
            self.assertNotIn(library, maps)

    def test_stubs_name_all_that_there_is_and_nothing_else(self):
        module = antigrasp._geometry
        stub = stub_of("_geometry")
        self.assertEqual(set(stub), members(module))
        for name, names in stub.items():
            if names is not None:
                self.assertEqual(names, members(getattr(module, name)), name)
        self.assertTrue((FOLDER / "py.typed").exists())

    def test_everything_public_has_help(self):
        for name in antigrasp.__all__:
            value = getattr(antigrasp, name)
            self.assertTrue(inspect.getdoc(value), name)
            if inspect.isclass(value) and not issubclass(value, BaseException):
                for member in members(value):
                    attribute = vars(value)[member]
                    if callable(attribute):
                        self.assertGreater(len(inspect.getdoc(attribute)), 40, f"{name}.{member}")

    def test_the_version_is_that_of_the_program(self):
        said = subprocess.run([support.BINARY, "--version"], check=True, capture_output=True, text=True).stdout
        self.assertEqual(said, f"antigrasp {antigrasp.__version__} ({antigrasp._geometry.commit})\n")

    def test_the_code_of_the_document_runs(self):
        document = (pathlib.Path(__file__).parents[2] / "docs/python.md").read_text()
        code, of_networks = re.findall(r"```python\n(.*?)```", document, re.S)
        shorter = {"hausdorff=5": "hausdorff=5, starts=1, descent_steps=3, generations=1",
                   "mass=0.05": "metric=Metric(num_grasps=3), mass=0.05"}
        for given, put in shorter.items():
            self.assertIn(given, code)
            code = code.replace(given, put)
        self.assertIn('antigrasp.train("configs/demo.toml", {"cem.control": False}, judge=judge)', of_networks)
        with tempfile.TemporaryDirectory() as folder:
            antigrasp.Mesh(support.corners(), support.FACES).save(pathlib.Path(folder) / "mug.stl")
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue((pathlib.Path(folder) / "harder.stl").exists())

    def test_ctrl_c_stops_work_without_the_gil(self):
        script = """
import os, signal, threading, time, antigrasp
from support import FACES, corners
meshes = [antigrasp.Mesh(corners() + i, FACES, name=f"m{i}") for i in range(2000)]
threading.Timer(.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    antigrasp.evaluate(meshes, threads=2)
    print("finished")
except KeyboardInterrupt:
    print("interrupted")
"""
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120,
                              cwd=pathlib.Path(__file__).parent)
        self.assertEqual(done.stdout, "interrupted\n", done.stderr)

    def test_other_threads_of_python_run_meanwhile(self):
        script = """
import threading, antigrasp
from support import FACES, corners
turns, done = [], threading.Event()
def count():
    while not done.wait(.001):
        turns.append(1)
thread = threading.Thread(target=count)
thread.start()
antigrasp.evaluate(antigrasp.Mesh(corners(), FACES))
done.set()
thread.join()
print(len(turns) > 5)
"""
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120,
                              cwd=pathlib.Path(__file__).parent)
        self.assertEqual(done.stdout, "True\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
