"""What 1 to 512 ranks would give for one episode of the paper (configs/paper.toml: 16,000 updates at width 32, 2,500 objects scored):
bench/job_scale.py [UPDATE_SECONDS SCORING_SECONDS]. Computed, not run: the two numbers are those of one core, by default docs/performance.md's and
docs/cluster.md's; a rank is a core with a network card of its own; what rank 0 does alone is left out."""
import math
import sys

UPDATE, SCORING = (float(word) for word in sys.argv[1:3]) if len(sys.argv) > 2 else (0.87, 28.0)
UPDATES, OBJECTS = 16000, 2500
GRADIENTS = 23.7e6  # bytes of both networks' gradients, from what rank 0 says that it sent
SAMPLE, MESH = 131e3, 72e3
# Between programs by TCP: 20 us (Hurwitz and Feng, Hot Interconnects 2003, 10 Gbit/s); 10 us (Larsen et al., SBAC-PAD 2007).
NETWORKS = {"10 Gbit/s, 20 us": (1.25e9, 20e-6), "100 Gbit/s, 10 us": (12.5e9, 10e-6)}


def update(ranks, parts, bandwidth, latency):
    """Seconds: the parts of the rank that has most of them, two all-to-alls and two gathers, each of k - 1 steps."""
    k = min(ranks, parts)
    each = math.ceil(parts / k)
    sent = GRADIENTS * (k - 1) / k * (each + 1)
    return UPDATE * each / parts + sent / bandwidth + 4 * (k - 1) * latency


def scoring(ranks, bandwidth):
    """Seconds: a core's share, grids to every rank along a ring, meshes back to rank 0's one card."""
    if ranks == 1:
        return SCORING
    return SCORING / ranks + OBJECTS * (SAMPLE + MESH) / bandwidth


print("| ranks | parts | network | an update | 16,000 updates | 2,500 objects | times as fast as one rank |\n| --- | --- | --- | --- | --- | --- | --- |")
alone = UPDATES * UPDATE + SCORING
for name, (bandwidth, latency) in NETWORKS.items():
    for ranks, parts in ((1, 8), (2, 8), (8, 8), (64, 8), (8, 32), (32, 32), (64, 32), (512, 32)):
        step, score = update(ranks, parts, bandwidth, latency), scoring(ranks, bandwidth)
        print(f"| {ranks} | {parts} | {name} | {1e3 * step:.0f} ms | {step * UPDATES / 3600:.2f} h | {score:.1f} s | "
              f"{alone / (UPDATES * step + score):.1f} |")
