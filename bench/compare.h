#pragma once

namespace antigrasp::bench {

void CompareContacts();
void CompareEpsilon();
void CompareEvaluation();
void CompareFiles();
void ComparePerturb();
void ComparePoses();
void CompareSimilarity();
void CompareTrials();

}  // namespace antigrasp::bench
