// Every comparison in one run, or those named: `ratio NAME VALUE`, above 1 = better than the peer
// or the simple way.
#include "bench/compare.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  using namespace antigrasp::bench;
  const std::vector<std::pair<std::string, void (*)()>> comparisons = {
      {"contacts", CompareContacts},     {"epsilon", CompareEpsilon},
      {"evaluation", CompareEvaluation}, {"files", CompareFiles},
      {"perturb", ComparePerturb},       {"poses", ComparePoses},
      {"similarity", CompareSimilarity}, {"trials", CompareTrials}};
  const std::vector<std::string> named(argv + 1, argv + argc);
  std::size_t known = 0;
  for (const auto& [name, compare] : comparisons) {
    const auto times = std::count(named.begin(), named.end(), name);
    known += static_cast<std::size_t>(times);
    if (named.empty() || times > 0) compare();
  }
  if (known == named.size()) return 0;
  std::fprintf(
      stderr,
      "bench_compare [contacts] [epsilon] [evaluation] [files] [perturb] [poses] [similarity] "
      "[trials]\n");
  return 2;
}
