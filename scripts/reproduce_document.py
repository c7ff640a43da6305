"""What the scripts behind scripts/reproduce share: the binary, the document and its sections."""
import csv
import io
import os
import pathlib
import re
import subprocess
import sys

BINARY = os.environ.get("ANTIGRASP_BINARY", "build/release/bin/antigrasp")
DOCUMENT = pathlib.Path("docs/reproduction.md")
IMAGES = pathlib.Path("docs/images")
SETS = ("cylinders", "prisms", "bottles")


def call(*arguments, allowed=(0,)):
    """Runs the binary in silence and returns what it printed; ends the script with its error at another exit code."""
    done = subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in allowed:
        sys.exit(f"antigrasp {' '.join(map(str, arguments))}: exit {done.returncode}\n{done.stderr[-2000:]}")
    return done.stdout


def made(target):
    """Whether a call has made this. What an interrupted trial left the same call goes on with."""
    constants = target.parent / "trial.toml"
    return target.exists() and not (target.name == "trials.csv" and constants.exists() and "\n[unfinished]\n" in constants.read_text())


def means(path, *flags):
    """The rows of `antigrasp info PATH --csv`: means with their half widths, computed by the binary."""
    return list(csv.DictReader(io.StringIO(call("info", path, "--csv", *flags))))


def commit():
    return subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()


def pyplot():
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    return plt


def save_figure(figure, path, bottom=0.0):
    """bottom: share of the height that is left for what is not an axis."""
    figure.tight_layout(rect=(0, bottom, 1, 1))
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110, metadata={"Software": None})


def write_section(name, text, document=DOCUMENT):
    """Replaces what stands between the section's marks in the document, or adds it."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    old = document.read_text() if document.exists() else "# Reproduction\n"
    section = f"{begin}\n{text.strip()}\n{end}\n"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end) + "\n", re.S)
    new = pattern.sub(lambda _: section, old) if begin in old else old.rstrip() + "\n\n" + section
    temporary = document.with_suffix(".md.part")
    temporary.write_text(new)
    temporary.replace(document)
