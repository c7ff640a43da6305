#!/usr/bin/env bash
# MuJoCo's default integrator (Euler) takes a joint's damping in implicitly, as documented, but after the contacts were solved without
# it: of the acceleration that the contact solver found, to stop a finger of mass m and damping d in a step h, only the share
# m / (m + h d) arrives. The contact is that much softer than its solref says, and the finger goes in deeper. The same damping as an
# applied force, -d v in qfrc_applied, does not do that.
#
# Debian 12: libmujoco2.2.2 and libmujoco-dev 2.2.2-3. Seen here, for m = 0.2 kg, h = 1 ms and a finger driven by 15 N against a wall:
# with d = 300 N s/m the velocity changes in the first step of contact by 1 / 2.500 of h times the acceleration that mj_step leaves
# in qacc (1 + h d / m = 2.5); deepest 0.46 mm instead of 0.23. With the damping as a force the ratio is 1.000.
set -euo pipefail

version=2.2.2-3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq "libmujoco2.2.2=$version" "libmujoco-dev=$version" libccd2 liblodepng0 libqhull-r8.0 libtinyxml2-9 >/dev/null 2>&1
for package in ./*.deb; do dpkg-deb -x "$package" .; done
libraries=$(dirname "$(find . -name 'libmujoco.so.2.2.2' | head -1)")

cat >press.c <<'C'
#include <mujoco/mujoco.h>
#include <stdio.h>

int main(void) {
  for (int k = 0; k < 4; ++k) {
    const double damping = k < 2 ? 90 : 300;
    const int of_joint = k % 2;
    FILE* const file = fopen("press.xml", "w");
    fprintf(file,
            "<mujoco><option timestep='0.001' gravity='0 0 0' tolerance='1e-12'/><worldbody>"
            "<geom type='plane' size='1 1 1' zaxis='-1 0 0' pos='0.11 0 0'/>"
            "<body><joint type='slide' axis='1 0 0' damping='%g'/><inertial pos='0 0 0' mass='0.2' diaginertia='1 1 1'/>"
            "<geom type='sphere' size='0.1' solref='0.004 1' solimp='0.99 0.999 0.0001'/></body></worldbody></mujoco>",
            of_joint ? damping : 0.0);
    fclose(file);
    char error[300] = "";
    mjModel* const m = mj_loadXML("press.xml", NULL, error, sizeof error);
    if (m == NULL) return puts(error), 2;
    mjData* const d = mj_makeData(m);
    double deepest = 0, ratio = 0;
    for (int i = 0; i < 2000; ++i) {
      const double before = d->qvel[0];
      d->qfrc_applied[0] = 15 - (of_joint ? 0 : damping * before);
      mj_step(m, d);
      if (ratio == 0 && d->ncon > 0) ratio = m->opt.timestep * d->qacc[0] / (d->qvel[0] - before);
      if (d->qpos[0] - 0.01 > deepest) deepest = d->qpos[0] - 0.01;
    }
    printf("%s d = %g as %s | %.3f | %.2f mm\n", mj_versionString(), damping, of_joint ? "a joint's" : "a force", ratio,
           1000 * deepest);
    mj_deleteData(d);
    mj_deleteModel(m);
  }
  return 0;
}
C
gcc -O1 -I usr/include press.c -o press -L "$libraries" -lmujoco -Wl,-rpath-link,"$libraries"
LD_LIBRARY_PATH=$libraries ./press >seen
cat >expected <<'TEXT'
2.2.2 d = 90 as a force | 1.000 | 0.72 mm
2.2.2 d = 90 as a joint's | 1.450 | 0.99 mm
2.2.2 d = 300 as a force | 1.000 | 0.23 mm
2.2.2 d = 300 as a joint's | 2.500 | 0.46 mm
TEXT
echo "MuJoCo, damping | acceleration of the contact solver over the one that arrives | deepest"
cat seen
diff expected seen >/dev/null || { echo "changed: expected"; cat expected; exit 1; }
echo "as described: a joint's damping softens its contacts by 1 + h d / m"
