#pragma once

namespace antigrasp::bench {

void CompareEpsilon();
void CompareEvaluation();

}  // namespace antigrasp::bench
