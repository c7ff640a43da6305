#pragma once

#include <array>
#include <cstdint>

namespace antigrasp {

// Box-Muller for many pairs at once: out[2 i], out[2 i + 1] are sqrt(-2 log(1 - u)) times cosine
// and sine of 2 pi v, u = uniform[2 i] and v = uniform[2 i + 1] in [0, 1) with 53 bits. The bits
// are those of std::log, std::sin and std::cos: logarithm, sine and cosine are computed to a
// hundredth of their last bit, and where that leaves open what a library that is right to .55 of it
// returns, the library is asked. Half the library's time with AVX2 and FMA, else its own.
void BoxMuller(const double* uniform, int pairs, double* out);

// The uniform numbers of a stream's next `blocks` blocks of Philox, two a block: those of
// RngStream::Uniform.
void PhiloxUniforms(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key,
                    int blocks, double* out);

}  // namespace antigrasp
