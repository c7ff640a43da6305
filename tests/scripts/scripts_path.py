"""Puts scripts/ on the path, and reads the tables that the scripts write."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))


def markdown_rows(table):
    """The rows below the header, each a map from column to cell."""
    lines = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in table.strip().split("\n")]
    header, rule, *rows = lines
    assert len(rule) == len(header) and all(cell == "---" for cell in rule), rule
    for row in rows:
        assert len(row) == len(header), row
    return [dict(zip(header, row)) for row in rows]


def write_statistics(folder, rows):
    """statistics.csv with zeros where a row says nothing."""
    columns = ("stage", "samples", "ok", "non_finite", "empty", "touches_border", "gaps", "non_manifold", "non_orientable",
               "self_intersecting", "disjoint", "scored", "without_grasps", "graspability", "half_width_95", "count",
               "elite_threshold", "coverage", "nna", "duplicates", "diversity")
    folder.mkdir(parents=True, exist_ok=True)
    lines = [",".join(columns)] + [",".join(str(row.get(column, 0)) for column in columns) for row in rows]
    (folder / "statistics.csv").write_text("\n".join(lines) + "\n")


# Every measure another number, in an order of its own; samples and reference differ.
COMPARE = """measure,samples,reference
near_duplicates,0.07,0.02
coverage,0.41,
roughness,9.26,8.14
nna,0.63,
vendi,44.4,60.8
matching,0.0428,
diversity,0.91,
nearest_reference,0.0407,0.0425
crease_share,0.09,0.1
flat_share,0.3,0.6
nna_normals,0.71,
"""
CELLS = {"COV": "41%", "1-NNA": "0.63", "with normals": "0.71", "MMD": "0.043", "near-duplicates": "7%", "diversity": "0.91",
         "Vendi score": "44", "roughness, degrees": "9.3", "flat edges, of the prior's": "0.50", "creases, of the prior's": "0.90"}


def write_compare(folder, episode):
    place = folder / f"episode_{episode}"
    place.mkdir(parents=True, exist_ok=True)
    (place / "compare.csv").write_text(COMPARE)
