#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace antigrasp {

// Why candidates were not kept; their sum and the grasps are the attempts.
struct RejectedGrasps {
  struct Reason {
    std::string name;
    int count = 0;
  };
  std::vector<Reason> reasons;  // the grasp model's, in its order; empty before there was a model
  int copies = 0;               // of a grasp already kept

  int Of(std::string_view reason) const;  // 0 for a reason that is not there
  void Add(const RejectedGrasps& other);  // reasons that are not there yet follow at the end
};

}  // namespace antigrasp
