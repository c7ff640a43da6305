#pragma once

namespace antigrasp::bench {

void CompareEpsilon();
void CompareEvaluation();
void ComparePerturb();

}  // namespace antigrasp::bench
