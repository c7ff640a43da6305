"""What every command's time grows with: bench/growth.py ANTIGRASP [COMMAND].
A row is a command and one quantity, which is given a value and then four times as much while all else stays: processor seconds of both (medians of
three calls in turn, all threads added up), their ratio, the power of the quantity that they follow when what the least call takes ("less") is
off both, and the ratio of the peaks of memory. N objects are four prisms under N names, so that all rows work on the same shapes; faces are
those of an ellipsoid. With COMMAND only the rows that begin with it. From the repository's root."""
import math
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile

PROGRAM = os.path.abspath(sys.argv[1])
ONLY = sys.argv[2] if len(sys.argv) > 2 else ""
TIMES, ROUNDS = 4, 3
TRAIN = ("train CONFIG --fine-tune --set run.threads=1 cem.episodes=0 cem.control=false cem.prior_scored=4 prior.count=8 cem.keep=4 cem.samples=8 "
         "gan.batch=8 cem.prior_iterations=N --overwrite --out RUN")

# Command, quantity, its first value, the value that is "less" (None: nothing is taken off). MESHES, GRIDS, BALL, CONTACTS: made for N.
ROWS = [
    ("dataset make cylinders --count N --out F.h5", "objects", 12, 1),
    ("dataset make cylinders --count 4 --resolution N --out F.h5", "nodes along an edge", 16, None),
    ("dataset import MESHES --out F.h5", "objects", 6, 1),
    ("dataset import BALL --out F.h5", "faces", 8192, 512),
    ("dataset pair MESHES MESHES --num-grasps 2 --draws 1 --overwrite --out D", "pairs", 3, 1),
    (TRAIN, "updates", 40, 2),
    ("sample prisms-solids --count N --out F.h5", "grids", 100, 1),
    ("remesh GRIDS --overwrite --out D", "grids", 16, 1),
    ("evaluate MESHES --num-grasps 100 --out F.csv", "objects", 12, 1),
    ("evaluate BALL --out F.csv", "faces", 32768, 512),
    ("evaluate MESHES4 --num-grasps N --max-attempts 100000 --out F.csv", "grasps", 800, 1),
    ("evaluate MESHES4 --num-grasps 200 --num-draws N --out F.csv", "draws", 100, 1),
    ("evaluate MESHES4 --judge settled --num-grasps N --max-attempts 100000 --out F.csv", "grasps, settled", 400, 1),
    ("compare MESHES MESHES --count 1000", "objects of both sets", 12, 2),
    ("compare MESHES16 MESHES16 --points N", "points", 1024, 16),
    ("quality CONTACTS --out F.csv", "contacts", 40000, 1),
    ("perturb random MESHES --overwrite --out D", "objects", 1, None),
    ("perturb random BALL --overwrite --out D", "faces", 8192, 512),
    ("perturb rotation BALL --overwrite --out D", "faces", 2048, 512),
    ("perturb search MESHES --steps 8 --overwrite --out D", "objects", 1, None),
    ("perturb search BALL --steps 8 --overwrite --out D", "faces", 2048, 512),
    ("perturb search MESHES1 --steps N --overwrite --out D", "steps", 16, 1),
    ("shape icosahedron --phi 10 --moves N --out F.stl", "moves", 100, 1),
    ("poses MESHES --out F.csv", "objects", 16, 1),
    ("poses BALL --out F.csv", "faces", 8192, 512),
    ("trial MESHES --num-grasps 2 --draws 1 --replays 0 --overwrite --out D", "objects", 4, None),
    ("trial MESHES1 --num-grasps N --draws 2 --replays 0 --overwrite --out D", "grasps", 8, 1),
    ("trial MESHES1 --num-grasps 8 --draws N --replays 0 --overwrite --out D", "draws", 2, 1),
    ("sheet MESHES --out F.png", "objects", 8, 1),
    ("sheet BALL --out F.png", "faces", 32768, 512),
    ("report MESHES --per-stage 0 --num-grasps 25 --out F.html", "objects", 8, 1),
    ("report BALL --num-grasps 25 --out F.html", "faces", 32768, 512),
    ("figure 2 BALL --out F.svg", "faces", 32768, 512),
    ("export MESHES --overwrite --out D", "objects", 8, 1),
    ("export BALL --overwrite --out D", "faces", 8192, 512),
    ("bundle MESHES --overwrite --out D", "objects", 1, None),
    ("bundle BALL --overwrite --out D", "faces", 2048, 512),
    ("info BALL", "faces", 131072, 512),
]


def call(words, folder):
    """Processor seconds and peak of memory, MB, of one call."""
    with open(os.path.join(folder, "said"), "w+", encoding="utf-8") as said:
        process = subprocess.Popen([PROGRAM, *words], cwd=folder, stdout=said, stderr=said, env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        _, status, used = os.wait4(process.pid, 0)
        if status != 0:
            said.seek(0)
            sys.exit(f"{' '.join(words)}: {said.read()[-300:]}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1000


def ellipsoid(path, faces):
    """An octahedron whose faces were cut in four, on an ellipsoid: OFF, 8 * 4^k faces."""
    points, index = [], {}

    def point(p):
        length = math.sqrt(sum(x * x for x in p))
        key = tuple(round(x / length, 9) for x in p)
        if key not in index:
            index[key] = len(points)
            points.append(key)
        return index[key]

    def middle(a, b):
        return point([x + y for x, y in zip(points[a], points[b])])

    tip = [[point([s if i == k else 0 for i in range(3)]) for s in (1, -1)] for k in range(3)]
    triangles = []
    for i in range(8):
        a, b, c = (tip[k][i >> k & 1] for k in range(3))
        triangles.append((a, b, c) if bin(i).count("1") % 2 == 0 else (a, c, b))
    while len(triangles) < faces:
        cut = []
        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            cut += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = cut
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines(f"{0.03 * x!r} {0.025 * y!r} {0.02 * z!r}\n" for x, y, z in points)
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


class Inputs:
    """Made when a row asks for them."""

    def __init__(self, folder):
        self.folder = folder
        call(["dataset", "make", "prisms", "--count", "4", "--seed", "11", "--out", "four.h5"], folder)
        call(["remesh", "four.h5", "--format", "stl", "--out", "four"], folder)
        self.four = sorted(name for name in os.listdir(self.path("four")) if name.endswith(".stl"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def word(self, word, value):
        if word.startswith("MESHES"):
            return self.meshes(int(word[6:] or value))
        makers = {"GRIDS": self.grids, "BALL": self.ball, "CONTACTS": self.contacts}
        if word in makers:
            return makers[word](value)
        if word == "CONFIG":
            return os.path.abspath("configs/retrain.toml")
        return str(value) if word == "N" else re.sub("=N$", f"={value}", word)

    def meshes(self, count):
        name = f"meshes-{count}"
        if not os.path.exists(self.path(name)):
            os.mkdir(self.path(name))
            for i in range(count):
                os.link(self.path(f"four/{self.four[i % 4]}"), self.path(f"{name}/object-{i:06d}.stl"))
        return name

    def grids(self, count):
        name = f"grids-{count}.h5"
        if not os.path.exists(self.path(name)):
            call(["dataset", "make", "prisms", "--count", str(count), "--seed", "11", "--out", name], self.folder)
        return name

    def ball(self, faces):
        name = f"ball-{faces}.off"
        if not os.path.exists(self.path(name)):
            ellipsoid(self.path(name), faces)
        return name

    def contacts(self, count):
        name = f"contacts-{count}.csv"
        with open(self.path(name), "w", encoding="utf-8") as out:
            out.write("id,p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,comx,comy,comz\n")
            out.writelines(f"{i},0.02,0,0,1,0,0,-0.02,{1e-8 * i:.9f},0,-1,0,0,0,0,0\n" for i in range(count))
        return name


def said(command):
    """`evaluate`, 4 objects."""
    name = re.sub(r" (MESHES|BALL|GRIDS|CONTACTS|CONFIG).*", "", command.split(" --")[0])
    of = re.search(r"MESHES(\d+)", command)
    return f"`{name}`" + (f", {of[1]} object{'s' if of[1] != '1' else ''}" if of else "")


def row(inputs, command, quantity, first, least):
    def once(value):
        return call([inputs.word(word, value) for word in command.split()], inputs.folder)

    many = TIMES * first
    took = [(once(first), once(many)) for _ in range(ROUNDS)]
    (low, low_peak), (high, high_peak) = (tuple(statistics.median(one[i][k] for one in took) for k in (0, 1)) for i in (0, 1))
    # A cost of a + b n^p: what the least call takes is a, and the b of a few.
    off = statistics.median(once(least)[0] for _ in range(ROUNDS)) if least is not None else 0.0
    span = TIMES if least is None else (many - least) / (first - least)
    power = f"{math.log((high - off) / (low - off)) / math.log(span):.2f}" if low > off and high > off else ""
    print(f"| {said(command)} | {quantity} x {TIMES}, {first:,} to {many:,} | {low:.2f} s, {high:.2f} s | x {high / low:.1f} | {power} | "
          f"x {high_peak / low_peak:.2f} |", flush=True)


def main():
    print("| command | grows with | processor time | | power | memory |\n| --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        inputs = Inputs(folder)
        for one in ROWS:
            if one[0].startswith(ONLY):
                row(inputs, *one)
    print(f"in all {sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2]):.0f} s of processor time")


main()
