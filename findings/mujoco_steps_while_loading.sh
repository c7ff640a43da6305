#!/usr/bin/env bash
# MuJoCo's mj_loadXML simulates the model that it has just compiled, one step, before anybody else has seen it. A collision function
# of the program's own (mjCOLLISIONFUNC, global) and mjcb_control are called by it, on the thread that loads, with a model and data
# that are not the ones they were written for: what they look up by pointer, or in a variable of the thread, is not there yet.
#
# Debian 12: libmujoco2.2.2 and libmujoco-dev 2.2.2-3. Seen here: while the first model loads, before mj_makeData or mj_step was
# called, 1 call of either with Euler; with RK4 4 calls up to time 0.002, a whole step: a step is taken, not only a look at contacts.
set -euo pipefail

version=2.2.2-3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq "libmujoco2.2.2=$version" "libmujoco-dev=$version" libccd2 liblodepng0 libqhull-r8.0 libtinyxml2-9 >/dev/null 2>&1
for package in ./*.deb; do dpkg-deb -x "$package" .; done
libraries=$(dirname "$(find . -name 'libmujoco.so.2.2.2' | head -1)")

cat >load.c <<'C'
#include <mujoco/mujoco.h>
#include <stdio.h>

static int collisions, controls;
static double latest;

static int Collide(const mjModel* m, const mjData* d, mjContact* con, int g1, int g2, mjtNum margin) {
  (void)m, (void)con, (void)g1, (void)g2, (void)margin;
  ++collisions;
  latest = d->time;
  return 0;
}

static void Control(const mjModel* m, mjData* d) {
  (void)m, (void)d;
  ++controls;
}

int main(int argc, char** argv) {
  mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_SPHERE] = Collide;
  mjcb_control = Control;
  for (int i = 1; i < argc; ++i) {
    char error[300] = "";
    collisions = controls = 0;
    latest = -1;
    if (mj_loadXML(argv[i], NULL, error, sizeof error) == NULL) return puts(error), 2;
    printf("%s %s | %d | %d | %g\n", mj_versionString(), argv[i], collisions, controls, latest);
  }
  return 0;
}
C
for integrator in Euler RK4; do
  cat >"$integrator" <<XML
<mujoco><option timestep="0.002" integrator="$integrator"/><worldbody><geom type="plane" size="1 1 1"/>
 <body pos="0 0 0.09"><freejoint/><geom type="sphere" size="0.1"/></body></worldbody></mujoco>
XML
done
gcc -O1 -I usr/include load.c -o load -L "$libraries" -lmujoco -Wl,-rpath-link,"$libraries"
LD_LIBRARY_PATH=$libraries ./load Euler RK4 >seen
cat >expected <<'TEXT'
2.2.2 Euler | 1 | 1 | 0
2.2.2 RK4 | 4 | 4 | 0.002
TEXT
echo "MuJoCo, integrator | during mj_loadXML: calls of the collision function | of mjcb_control | latest time that they saw"
cat seen
diff expected seen >/dev/null || { echo "changed: expected"; cat expected; exit 1; }
echo "as described: mj_loadXML takes a step, and calls the program's functions in it"
