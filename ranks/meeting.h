#pragma once

#include <torch/csrc/distributed/c10d/TCPStore.hpp>

#include "antigrasp/core/launch.h"
#include "antigrasp/ranks/rank_group.h"
#include "antigrasp/ranks/signs_of_life.h"

namespace antigrasp {

// How the ranks of a job find each other: by the store alone, before they are connected.

// A connection to the store, which rank 0 serves itself where it `serve`s; tried again until it
// stands. RuntimeFailure where rank 0 does not answer in time or cannot listen.
c10::intrusive_ptr<c10d::TCPStore> ConnectToStore(const Launch& launch, bool serve,
                                                  const JoinOptions& options);

// Returns when all have come and have what rank 0 has (JoinOptions::same), which rank 0 finds out.
// SaidElsewhere where they have not, or where one begins with a failure: that one, or the first of
// them, has said why. Where nobody new comes for too long rank 0 ends all.
void MeetAll(const Launch& launch, c10d::Store* store, const JoinOptions& options,
             SignsOfLife* life);

}  // namespace antigrasp
