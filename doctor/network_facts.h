#pragma once

#include <string>
#include <vector>

#include "antigrasp/doctor/self_test.h"

namespace antigrasp {

// LibTorch and what it computes with, devices, the networks that ship; a line each.
std::string NetworkFacts();

// A small GAN takes three updates from balls ("updated") and is sampled ("sampled"), on one thread.
// Bytes are known for LibTorch 1.13 with OpenBLAS. Less than a second.
std::vector<SelfTestStep> RunNetworkSelfTest();

}  // namespace antigrasp
