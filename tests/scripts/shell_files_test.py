"""Manual pages and completion of scripts/shell_files.py, read by groff and bash."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from scripts_path import ROOT  # noqa: F401

import shell_files

BINARY = os.environ["ANTIGRASP_BINARY"]


class ShellFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.share = pathlib.Path(temporary.name, "share")
        shell_files.main(BINARY, temporary.name)
        cls.bash = cls.share / "bash-completion/completions/antigrasp"

    def completed(self, *words):
        script = f'. {self.bash}; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _antigrasp; printf "%s\\n" "${{COMPREPLY[@]}}"'
        return subprocess.run(["bash", "-c", script, "_", *words], check=True, capture_output=True, text=True).stdout.split()

    def test_a_help_of_every_shape_is_taken_apart(self):
        page = shell_files.parse("About it\nUsage: antigrasp x [OPTIONS] IN...\n\nOptions:\n"
                                 "  -h,--help                   Print this\n"
                                 "  --scale TEXT:{set,each}=set set: one\n"
                                 "  --long-one TEXT:{auto,csv}=auto Needs: --grasps\n                              of  --grasps\n")
        self.assertEqual((page["about"], page["usage"]), ("About it", "antigrasp x [OPTIONS] IN..."))
        self.assertEqual(page["Options:"], [["-h,--help", "Print this"], ["--scale TEXT:{set,each}=set", "set: one"],
                                            ["--long-one TEXT:{auto,csv}=auto Needs: --grasps", "of  --grasps"]])

    def test_every_option_of_every_command_is_in_its_page_and_in_the_completion(self):
        for command in ((), ("evaluate",), ("perturb", "search"), ("dataset", "import"), ("train",)):
            text = subprocess.run([BINARY, "help", *command], check=True, capture_output=True, text=True).stdout
            heads = re.findall(r"^  (-\S+)", text, re.M)
            options = {name.partition("{")[0] for head in heads for name in head.split(",")} - {"-h"}
            page = (self.share / "man/man1" / ("-".join(("antigrasp", *command)) + ".1")).read_text().replace("\\-", "-")
            self.assertTrue(options)
            self.assertEqual({option for option in options if option not in page}, set())
            self.assertEqual(set(self.completed("antigrasp", *command, "--")) - {"-h"}, options)

    def test_commands_choices_and_files_are_completed(self):
        self.assertEqual(self.completed("antigrasp", "eva"), ["evaluate"])
        self.assertEqual(self.completed("antigrasp", "dataset", ""), ["make", "import", "pair"])
        self.assertEqual(self.completed("antigrasp", "evaluate", "x.stl", "--frame", ""), ["metres", "mesh"])
        self.assertEqual(self.completed("antigrasp", "help", "rem"), ["remesh"])
        self.assertIn(str(self.share / "man"), self.completed("antigrasp", "info", str(self.share) + "/"))

    @unittest.skipUnless(shutil.which("groff"), "groff is missing")
    def test_groff_has_nothing_to_say_of_any_page(self):
        for name in ("antigrasp", "antigrasp-evaluate", "antigrasp-dataset-import"):
            page = self.share / "man/man1" / (name + ".1")
            done = subprocess.run(["groff", "-man", "-Tascii", "-ww", str(page)], capture_output=True, text=True, check=True)
            warnings = [line for line in done.stderr.splitlines() if "break" not in line and "adjust" not in line]
            self.assertEqual(warnings, [], page.name)
            self.assertIn("SYNOPSIS", re.sub("\x1b\\[[0-9;]*m|.\x08", "", done.stdout))


if __name__ == "__main__":
    unittest.main()
