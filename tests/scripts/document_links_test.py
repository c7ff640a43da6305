"""README.md and docs/: every relative link and anchor leads somewhere, docs/README.md leads to every page, README.md is three screens, and the
numbers with an interval that it repeats are those of the pages."""
import math
import pathlib
import re
import textwrap
import unittest

from scripts_path import ROOT

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), ROOT / "findings/README.md"]
PICTURE, SCREEN, COLUMNS = 14, 45, 150  # lines of a picture and of a screen, and their width, as GitHub shows them


def text_of(page):
    """Without code, in which brackets are no links."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", lambda code: "`" * len(code.group()), re.sub(r"^    .*$", "", text, flags=re.M))


def anchors(page):
    """Those that GitHub gives to the headings."""
    found = []
    for heading in re.findall(r"^#+ (.*)$", page.read_text(), re.M):
        name = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        found.append(name if name not in found else f"{name}-{found.count(name)}")
    return found


def links(page):
    """(path, anchor) of the links into the repository."""
    for target in re.findall(r"\]\(([^)\s]+)\)", text_of(page)):
        if not target.startswith(("http:", "https:")):
            path, _, anchor = target.partition("#")
            yield (page.parent / path).resolve() if path else page, anchor


def shown_lines(text):
    """How many lines a page takes."""
    lines = 0
    for block in re.split(r"\n\n+", text):
        if block.startswith("!["):
            lines += PICTURE
        elif block.startswith(("|", "    ", "- ")):
            parts = re.split(r"\n(?=[|\- ])", block)
            lines += sum(max(1, math.ceil(len(re.sub(r"\]\([^)]*\)", "]", part)) / COLUMNS)) for part in parts)
        else:
            lines += len(textwrap.wrap(re.sub(r"\]\([^)]*\)", "]", block), COLUMNS))
        lines += 1
    return lines


def numbers(text):
    return re.findall(r"[-+]?\d*\.?\d+", text.replace("+-", " ").replace("±", " "))


def rows(page, begin="", end=None):
    """Cells of the tables' rows between two texts."""
    text = (ROOT / page).read_text()
    text = text[text.index(begin) + len(begin):]
    lines = (text if end is None else text[:text.index(end)]).split("\n")
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| ")]


def of_sets(method, begin, column):
    """Of docs/trials.md (What we ship): numbers of a column, prisms, cylinders, bottles."""
    found = {row[0]: row for row in rows("docs/trials.md", begin, "Friction 0") if row[1] == method}
    return [number for kind in ("prisms", "cylinders", "bottles") for number in numbers(found[kind][column])]


class DocumentLinks(unittest.TestCase):
    def test_every_link_and_anchor_leads_somewhere(self):
        for page in PAGES:
            for path, anchor in links(page):
                with self.subTest(page=page.name, path=str(path), anchor=anchor):
                    self.assertTrue(path.exists())
                    self.assertTrue(not anchor or anchor in anchors(path))

    def test_the_index_leads_to_every_page_and_the_readme_to_the_index(self):
        index = ROOT / "docs/README.md"
        self.assertEqual({page for page in (ROOT / "docs").glob("*.md") if page != index} - {path for path, _ in links(index)}, set())
        self.assertIn(index, [path for path, _ in links(ROOT / "README.md")])

    def test_every_picture_is_shown(self):
        shown = {path for page in PAGES for path, _ in links(page)}
        self.assertEqual(set((ROOT / "docs/images").iterdir()) - shown, set())

    def test_the_readme_is_three_screens(self):
        what, *others = re.split(r"^## ", (ROOT / "README.md").read_text(), flags=re.M)
        self.assertEqual([section.split("\n")[0] for section in others], ["What falls", "Commands", "Licence"])
        for screen in (what, others[0], others[1] + others[2]):
            self.assertLessEqual(shown_lines(screen), SCREEN, screen)

    def check_rounded(self, shown, exact):
        self.assertEqual(len(shown), len(exact), shown)
        for short, long in zip(shown, exact):
            decimals = len(short.partition(".")[2])
            self.assertLessEqual(abs(float(short) - float(long)), 0.5 * 10**-decimals + 1e-9, f"{shown}, {exact}")

    def test_the_numbers_of_the_readme_are_rounded_from_the_pages(self):
        table = [" ".join(row[1:]) for row in rows("README.md", "## What falls", "## Commands")][2:]
        for kind, shown in zip(("prisms", "cylinders", "bottles"), table):
            home = next(row for row in rows("docs/perturbation.md") if row[0].startswith(f"50 {kind}, `--hausdorff 5`"))
            self.check_rounded(numbers(shown), numbers(" ".join((home[1], home[2], home[4]))))
        low, high = "Friction 0.25, fingertip sphere", "Friction 0.5, fingertip sphere"
        for method, shown in zip(("search 20", "random 20"), table[3:]):
            hausdorff = sum(map(float, of_sets(method, low, 3))) / 3
            self.check_rounded(numbers(shown), [hausdorff, *("-" + fall for fall in of_sets(method, low, 2)), *of_sets(method, low, 4), *of_sets(method, low, 6)])
        readme = (ROOT / "README.md").read_text()
        at_high = re.search(r"at friction 0\.5 the search .* is held by (.*) points", readme).group(1)
        self.check_rounded(numbers(at_high), of_sets("search 20", high, 6))
        loop = re.search(r"loop\*\* lowers .* by (.*) % of the prior set's", readme).group(1)
        page = (ROOT / "docs/reproduction.md").read_text()
        falls = [re.search(rf"begin gan {kind} -.*?kappa is lower by (\d+ ±\d+) %", page, re.S).group(1) for kind in ("cylinders", "prisms", "bottles")]
        self.check_rounded(numbers(loop), numbers(" ".join(falls)))


if __name__ == "__main__":
    unittest.main()
