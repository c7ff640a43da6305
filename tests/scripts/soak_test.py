"""The checks of scripts/soak see what a faulty program would leave behind."""
import os
import pathlib
import random
import stat
import tempfile
import unittest

import scripts_path  # noqa: F401: finds the modules below

import soak
import soak_bench
from soak_bench import Bench, Fault, files_of, refuses_well, same_bytes, whole_or_absent
from soak_damage import damaged


class Checks(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)

    def tree(self, name, **files):
        (self.root / name).mkdir()
        for file, text in files.items():
            (self.root / name / file).write_text(text)
        return self.root / name

    def test_other_bytes_a_missing_file_and_one_too_many_are_faults(self):
        right = self.tree("right", a="1", b="2")
        same_bytes(self.tree("same", a="1", b="2"), right)
        for name, files in {"other": {"a": "1", "b": "3"}, "fewer": {"a": "1"}, "more": {"a": "1", "b": "2", "c": ""}}.items():
            with self.assertRaises(Fault, msg=name):
                same_bytes(self.tree(name, **files), right)

    def test_the_seconds_of_a_table_are_not_compared_and_its_other_columns_are(self):
        right = self.tree("right", **{"a.csv": "object,seconds,score\ncube,0.5,1\n"})
        same_bytes(self.tree("same", **{"a.csv": "object,seconds,score\ncube,0.7,1\n"}), right)
        with self.assertRaises(Fault):
            same_bytes(self.tree("other", **{"a.csv": "object,seconds,score\ncube,0.5,2\n"}), right)

    def test_the_time_of_day_is_not_compared(self):
        self.assertEqual(set(files_of(self.tree("run", **{"provenance.toml": "now", "scores.csv": "1"}))), {"scores.csv"})

    def test_a_half_written_file_is_a_fault_and_a_missing_or_hidden_one_is_not(self):
        right = self.tree("right", a="12", b="34")
        whole_or_absent(self.tree("some", a="12"), right)
        whole_or_absent(self.tree("hidden", **{".a.7.tmp": "1"}), right)
        whole_or_absent(self.root / "nothing", right)
        with self.assertRaises(Fault):
            whole_or_absent(self.tree("half", a="1"), right)

    def test_a_signal_silence_and_a_foreign_message_are_faults(self):
        refuses_well(0, "")
        refuses_well(2, "antigrasp: a.stl: no facets, expected a mesh")
        for code, err in ((-11, ""), (2, " \n"), (1, "terminate called after throwing"), (2, "std::bad_alloc"), (134, "x")):
            with self.assertRaises(Fault, msg=err):
                refuses_well(code, err)

    def test_damage_is_the_same_for_the_same_seed_and_hits_text_and_bytes(self):
        text = b"v 1.0 2 3\nv 4 5 6\nf 1 2 3\n" * 9
        some = {damaged(text, random.Random(seed)) for seed in range(50)}
        self.assertEqual(some, {damaged(text, random.Random(seed)) for seed in range(50)})
        self.assertGreater(len(some), 45)
        for seed in range(200):
            damaged(b"", random.Random(seed))

    def test_a_program_that_hangs_and_one_that_dies_are_faults(self):
        program = self.root / "program"
        soak_bench.BINARY = str(program)
        for script, word in (("sleep 60", "not done"), ("kill -SEGV $$", "exit -11")):
            program.write_text(f"#!/bin/sh\n{script}\n")
            program.chmod(program.stat().st_mode | stat.S_IXUSR)
            with self.assertRaisesRegex(Fault, word):
                Bench(self.root).must("info", limit=1)

    def test_a_program_that_writes_in_place_is_caught_by_a_kill(self):
        program = self.root / "program"
        soak_bench.BINARY = str(program)
        program.write_text("#!/bin/sh\nfor last; do :; done\nprintf 1 >$last\nsleep 3\nprintf 2 >>$last\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        bench = Bench(self.root / "bench")
        bench.reference.mkdir(parents=True)
        (bench.reference / "x").write_text("12")
        bench.writers = lambda: {"x": ["write"]}
        bench.seconds = {"x": 1.0}
        with self.assertRaisesRegex(Fault, "half-written"):
            for seed in range(9):
                soak.kill_writer(bench, random.Random(seed))


if __name__ == "__main__":
    os.chdir(pathlib.Path(__file__).parent)
    unittest.main()
