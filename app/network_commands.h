#pragma once

#include <filesystem>
#include <string>

namespace antigrasp {

// LibTorch takes 0.4 s and 170 MB to load. So there are two programs: `antigrasp`, which people
// call, knows the commands on meshes, and becomes `antigrasp-networks` for those that need
// networks. A program, not a library loaded on demand: nothing of LibTorch can slip into the first
// one, and a build without LibTorch is the same less the second.

// A command of `antigrasp-networks`, with its line in the list of commands.
struct NetworkCommand {
  const char* name;
  const char* description;
};
inline constexpr NetworkCommand kTrain{"train", "Run CEM + GAN episodes from a prior set"};
inline constexpr NetworkCommand kSample{"sample", "Sample SDF grids from a checkpoint"};
inline constexpr NetworkCommand kReport{"report",
                                        "Write a page to look at in a browser: one HTML file"};
inline constexpr NetworkCommand kFigure{
    "figure", "Draw the paper's figures 1 to 4 of your own objects and runs, and trials"};
inline constexpr NetworkCommand kGenerator{
    "generator", "Write the networks of a checkpoint alone, float16, to share and start from"};

// Whether this is a command whose work several processes share.
bool IsShared(const std::string& command);
// Whether the arguments of main() are such a command or ask for its help, or several processes are
// to share a command on meshes.
bool NeedsNetworks(int argc, char** argv);

// The process becomes the `antigrasp-networks` that lies beside its program, with the arguments of
// main(), which RememberArguments was told. RuntimeFailure when there is none.
void RememberArguments(char** argv);
[[noreturn]] void BecomeNetworks();
// Its path; what it looks for in the environment is there then.
std::filesystem::path PreparedNetworks();

}  // namespace antigrasp
