#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>

namespace antigrasp {

// Short work of one caller at a time, as a training step is made of: threads that are kept and take
// the next piece when they have a core, so that one whose core is busy holds up no other. Those
// that find nothing to do sleep after a few microseconds.

// Threads of all calls below, the caller among them; 1 at first. Not while one runs.
void SetPieceThreads(int threads);
int PieceThreads();

// Runs body(i) for every i in [0, count), in any order and on any thread; what is a piece must not
// depend on the number of threads where numbers are summed. Returns when all are done; the first
// exception is rethrown. From within a piece, from a second caller meanwhile and in a forked copy
// of the process it runs on the caller's thread alone.
void ForPieces(std::int64_t count, const std::function<void(std::int64_t)>& body);

// The same for the ranges [0, size), [size, 2 size), ... of [0, count): body(begin, end).
template <typename Body>
void ForRanges(std::int64_t count, std::int64_t size, const Body& body) {
  ForPieces((count + size - 1) / size,
            [&](std::int64_t i) { body(i * size, std::min(count, (i + 1) * size)); });
}

}  // namespace antigrasp
