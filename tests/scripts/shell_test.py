"""scripts/setup with an apt that only writes down what it is asked for, and scripts/format in a folder of its own."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from scripts_path import ROOT


class Scripts(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def fake(self, name, body):
        program = self.folder / "bin" / name
        program.parent.mkdir(exist_ok=True)
        program.write_text(f"#!/bin/bash\n{body}\n")
        program.chmod(0o755)

    def setup(self, missing, npm=True, apt=True, extra=None, user=0):
        """Exit code, output and the calls of apt-get; no program is found but these."""
        pattern = "|".join(missing) or "no-package"
        self.fake("dpkg-query", f'[ "$#" = 4 ] || exit 9\ncase "$4" in {pattern}) exit 1;; removed) echo -n "deinstall ok config-files";; '
                                '*) echo -n "install ok installed";; esac')
        self.fake("id", f"echo {user}")
        self.fake("sudo", f'echo "sudo" >> {self.folder}/calls; exec "$@"')
        if apt:
            self.fake("apt-get", f'echo "$*" >> {self.folder}/calls')
        if npm:
            self.fake("npm", "exit 0")
        environment = {"PATH": str(self.folder / "bin")} | ({"SETUP_EXTRA": extra} if extra else {})
        done = subprocess.run(["/bin/bash", ROOT / "scripts/setup"], env=environment, text=True, capture_output=True)
        calls = self.folder / "calls"
        return done.returncode, done.stdout + done.stderr, calls.read_text().split("\n")[:-1] if calls.exists() else []

    def test_setup_asks_for_nothing_when_all_is_there(self):
        self.assertEqual(self.setup([]), (0, "", []))

    def test_setup_asks_apt_only_for_what_is_missing(self):
        code, output, calls = self.setup(["libcgal-dev", "removed", "clang-format"], extra="removed clang-format chromium")
        self.assertEqual(code, 0, output)
        self.assertEqual(output, "Installing from Debian: libcgal-dev removed clang-format\n")
        self.assertEqual(calls, ["update -qq", "install -y -qq --no-install-recommends libcgal-dev removed clang-format"])

    def test_setup_brings_npm_where_there_is_none(self):
        _, _, calls = self.setup(["nodejs", "npm"], npm=False)
        self.assertEqual(calls[-1], "install -y -qq --no-install-recommends nodejs npm")

    def test_setup_becomes_root_by_sudo(self):
        _, _, calls = self.setup(["cmake"], user=1000)
        self.assertEqual(calls, ["sudo", "update -qq", "sudo", "install -y -qq --no-install-recommends cmake"])

    def test_setup_names_what_is_missing_where_there_is_no_apt(self):
        code, output, _ = self.setup(["cmake"], apt=False)
        self.assertEqual((code, output), (1, "scripts/setup: this is not Debian; please install: cmake\n"))

    @unittest.skipUnless(shutil.which("clang-format") and shutil.which("git"), "needs clang-format and git")
    def test_format_tells_of_a_badly_formatted_file_and_mends_it(self):
        (self.folder / "scripts").mkdir()
        for name in ("scripts/format", ".clang-format"):
            shutil.copy(ROOT / name, self.folder / name)
        good, bad = "int Good() { return 1; }\n", "int   Bad( ){return 1 ;}\n"
        (self.folder / "good.h").write_text(good)
        environment = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null"}

        def call(*command):
            return subprocess.run(command, cwd=self.folder, env=environment, text=True, capture_output=True)

        call("git", "init", "-q")
        call("git", "add", "good.h")
        fine = call("scripts/format", "--check")
        self.assertEqual((fine.returncode, fine.stdout), (0, "format: 1 files\n"))
        for name in ("bad.cpp", "untracked.cpp"):
            (self.folder / name).write_text(bad)
        call("git", "add", "bad.cpp")
        told = call("scripts/format", "--check")
        self.assertNotEqual(told.returncode, 0)
        self.assertIn("bad.cpp:1", told.stderr)
        self.assertEqual((self.folder / "bad.cpp").read_text(), bad)
        self.assertEqual(call("scripts/format").returncode, 0)
        self.assertEqual((self.folder / "bad.cpp").read_text(), "int Bad() { return 1; }\n")
        self.assertEqual((self.folder / "untracked.cpp").read_text(), bad)


if __name__ == "__main__":
    unittest.main()
