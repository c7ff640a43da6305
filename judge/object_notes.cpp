#include "antigrasp/judge/object_notes.h"

#include "antigrasp/quality/object_size.h"

namespace antigrasp {

void WarnOfNotes(const std::vector<InputObject>& objects, const WarnFn& warn) {
  for (const InputObject& object : objects) {
    if (!object.note.empty()) warn(object.name + ": " + object.note);
  }
}

void WarnOfSizes(const std::vector<InputObject>& objects, const MetricOptions& metric,
                 const WarnFn& warn) {
  UnlikelySizes sizes(metric);
  for (const InputObject& object : objects) {
    if (object.ok()) sizes.Add(object.name, Bounds(object.mesh).Extent());
  }
  for (const std::string& text : sizes.Texts()) warn(text);
}

}  // namespace antigrasp
