"""Files damaged at random, for every reader of scripts/soak."""
import re
import shutil

NUMBERS = ["nan", "inf", "-inf", "1e309", "-1", "0", "1e-320", "99999999999999999999", "2147483648", "0x10", "1,5", "", "-0"]


def damaged(data, rng):
    """`data` after one to four mutations, text or binary."""
    for _ in range(rng.randint(1, 4)):
        data = rng.choice(MUTATIONS)(data, rng)
    return data


def place(data, rng):
    return rng.randrange(len(data) + 1)


def flip(data, rng):
    data = bytearray(data)
    for _ in range(rng.randint(1, 8)):
        if data:
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(data)


def cut(data, rng):
    return data[: place(data, rng)]


def drop(data, rng):
    at = place(data, rng)
    return data[:at] + data[at + rng.randint(1, 400):]


def insert(data, rng):
    at = place(data, rng)
    return data[:at] + rng.randbytes(rng.randint(1, 60)) + data[at:]


def double(data, rng):
    at, length = place(data, rng), rng.randint(1, 2000)
    return data[:at] + data[at:at + length] * 2 + data[at + length:]


def blank(data, rng):
    at, length = place(data, rng), rng.randint(1, 300)
    return data[:at] + bytes(len(data[at:at + length])) + data[at + length:]


def number(data, rng):
    """One of the numbers of a text becomes an odd one."""
    found = list(re.finditer(rb"-?\d+\.?\d*(e-?\d+)?", data[:200000]))
    if not found:
        return flip(data, rng)
    one = rng.choice(found)
    return data[: one.start()] + rng.choice(NUMBERS).encode() + data[one.end():]


def lines(data, rng):
    """Two lines change places."""
    rows = data.split(b"\n")
    a, b = rng.randrange(len(rows)), rng.randrange(len(rows))
    rows[a], rows[b] = rows[b], rows[a]
    return b"\n".join(rows)


MUTATIONS = [flip, flip, cut, drop, insert, double, blank, number, number, lines]


def ascii_stl(obj):
    """The text STL of a triangle mesh in OBJ text."""
    rows = [line.split() for line in obj.splitlines()]
    corners = [row[1:4] for row in rows if row and row[0] == "v"]
    out = ["solid s"]
    for row in rows:
        if row and row[0] == "f":
            out += ["facet normal 0 0 0", "outer loop"]
            out += ["vertex " + " ".join(corners[int(word.split("/")[0]) - 1]) for word in row[1:4]]
            out += ["endloop", "endfacet"]
    return "\n".join(out + ["endsolid s"]) + "\n"


def corpus(bench):
    """(file, commands that read it): {} stands for the damaged copy, {out} for a place to write to. A file inside a
    folder is (folder, name in it) and {} the copy of the folder."""
    folder, run = bench.folder / "corpus", bench.reference / "train"
    meshes = [["poses", "{}"], ["evaluate", "{}"], ["dataset", "import", "{}", "--out", "{out}"], ["export", "{}", "--out", "{out}"],
              ["perturb", "random", "{}", "--out", "{out}"], ["info", "{}"]]
    sets = [["info", "{}"], ["evaluate", "{}"], ["remesh", "{}", "--out", "{out}"], ["sheet", "{}", "--out", "{out}"]]
    networks = [["info", "{}"], ["sample", "{}", "--count", "2", "--out", "{out}"], ["generator", "{}", "--out", "{out}"]]
    folders = [["info", "{}"], ["info", "{}", "--csv"], ["report", "{}", "--out", "{out}"]]
    if not (folder / "part.off").exists():  # the last that is made
        folder.mkdir(exist_ok=True)
        obj = sorted((bench.inputs / "others").glob("*.obj"))[0]
        (folder / "text.stl").write_text(ascii_stl(obj.read_text()))
        shutil.copy(obj, folder / "part.obj")
        shutil.copy(sorted((bench.inputs / "meshes").glob("*.stl"))[0], folder / "part.stl")
        for kind in ("ply", "off"):
            bench.must("shape", "cuboctahedron", "--phi", "15", "--out", folder / f"part.{kind}")
    files = [(folder / name, meshes) for name in ("text.stl", "part.stl", "part.obj", "part.ply", "part.off")]
    files += [(bench.inputs / "set.h5", sets), (run / "checkpoint.pt", networks), (bench.reference / "generator.pt", networks),
              (run / "config.toml", [["train", "{}", "--out", "{out}"]]), (run / "episode_1/scores.csv", [["info", "{}"]]),
              (bench.reference / "grasps.csv", [["quality", "{}"]])]
    files += [((run, name), folders) for name in ("statistics.csv", "config.toml", "episode_1/scores.csv", "episode_1/losses.csv",
                                                  "episode_1/elites.h5", "prior.h5", "checkpoint.pt", "provenance.toml")]
    files += [((run, name), [["train", "--resume", "{}"]]) for name in ("checkpoint.pt", "config.toml", "statistics.csv", "prior.h5")]
    files += [((bench.reference / "perturb", name), folders) for name in ("perturb.csv", "perturb.toml")]
    return files
