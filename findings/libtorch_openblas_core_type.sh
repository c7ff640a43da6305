#!/usr/bin/env bash
# LibTorch's matrix products on a CPU are OpenBLAS's, and OpenBLAS chooses its kernel by the processor. The variables that cap
# LibTorch and oneDNN (ATEN_CPU_CAPABILITY, DNNL_MAX_CPU_ISA) do not reach it: with both set, a product still has other last bits
# on another processor. Only OPENBLAS_CORETYPE, read when the library is loaded, makes them equal.
#
# Debian 12: libopenblas0-pthread 0.3.21+ds-4. Seen here: a 64 x 300 x 64 product of float32 on the kernels "Nehalem" (SSE4.2) and
# "Haswell" (AVX2, what a processor with AVX2 gets), with both caps set: 3,520 of 16,384 bytes of the result differ.
set -euo pipefail

version=0.3.21+ds-4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq "libopenblas0-pthread=$version" >/dev/null 2>&1
dpkg-deb -x libopenblas0-pthread_*.deb .
library=$(find . -name 'libopenblas-r*.so' -o -name 'libopenblasp-r*.so' | head -1)

cat >product.c <<'C'
#include <stdio.h>
#include <stdlib.h>

void cblas_sgemm(int, int, int, int, int, int, float, const float*, int, const float*, int, float, float*, int);

int main(void) {
  enum { kRows = 64, kInner = 300 };
  float* a = malloc(sizeof(float) * kRows * kInner);
  float* b = malloc(sizeof(float) * kRows * kInner);
  float* c = calloc(kRows * kRows, sizeof(float));
  unsigned state = 1;
  for (int i = 0; i < kRows * kInner; ++i) {
    state = 1664525u * state + 1013904223u;
    a[i] = (float)(state >> 8) / 16777216.0f - 0.5f;
    b[i] = (float)(state % 65521u) / 65521.0f - 0.5f;
  }
  cblas_sgemm(101, 111, 111, kRows, kRows, kInner, 1.0f, a, kInner, b, kRows, 0.0f, c, kRows);
  fwrite(c, sizeof(float), kRows * kRows, stdout);
  return 0;
}
C
gcc -O1 product.c -o product "$library" -Wl,-rpath,"$(dirname "$(realpath "$library")")" -lm

export ATEN_CPU_CAPABILITY=avx2 DNNL_MAX_CPU_ISA=AVX2 OPENBLAS_NUM_THREADS=1
OPENBLAS_CORETYPE=Nehalem ./product >nehalem
OPENBLAS_CORETYPE=Haswell ./product >haswell
OPENBLAS_CORETYPE=Haswell ./product >again

cmp -s haswell again || { echo "changed: one kernel gives two results"; exit 1; }
if cmp -s nehalem haswell; then
  echo "changed: both kernels give the same bits"
  exit 1
fi
echo "OpenBLAS $version: $(cmp -l nehalem haswell | wc -l) of $(stat -c %s haswell) bytes differ between two kernels"
