#pragma once

#include <string>

#include "antigrasp/core/parallel.h"
#include "antigrasp/report/page/report.h"

namespace antigrasp {

struct PayloadOptions {
  std::size_t max_triangles = 6000;  // of one mesh; larger ones are simplified for display
  int threads = 0;                   // 0 = all; no byte depends on it
};

// A report as the page reads it (docs/formats.md, "Report").
struct ReportPayload {
  std::string json;  // ASCII without <, > and &: fit for a script element
  std::string blob;  // meshes, grasps and displacements, which the JSON refers to
};
ReportPayload EncodeReport(const Report& report, const PayloadOptions& options,
                           const ProgressFn& progress = nullptr);

}  // namespace antigrasp
