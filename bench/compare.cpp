// Every comparison in one run: `ratio NAME VALUE`, above 1 = better than the peer or the simple
// way.
#include "bench/compare.h"

int main() {
  antigrasp::bench::CompareEpsilon();
  antigrasp::bench::CompareEvaluation();
  antigrasp::bench::ComparePerturb();
}
