#include "antigrasp/app/object_notes.h"

#include <spdlog/spdlog.h>

#include "antigrasp/quality/object_size.h"

namespace antigrasp {

void WarnOfNotes(const std::vector<InputObject>& objects) {
  for (const InputObject& object : objects) {
    if (!object.note.empty()) spdlog::warn("{}: {}", object.name, object.note);
  }
}

void WarnOfSizes(const std::vector<InputObject>& objects, const MetricOptions& metric) {
  UnlikelySizes sizes(metric);
  for (const InputObject& object : objects) {
    if (object.ok()) sizes.Add(object.name, Bounds(object.mesh).Extent());
  }
  for (const std::string& text : sizes.Texts()) spdlog::warn("{}", text);
}

}  // namespace antigrasp
