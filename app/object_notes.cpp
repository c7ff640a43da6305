#include "antigrasp/app/object_notes.h"

#include <spdlog/spdlog.h>

namespace antigrasp {

void WarnOfNotes(const std::vector<InputObject>& objects) {
  for (const InputObject& object : objects) {
    if (!object.note.empty()) spdlog::warn("{}: {}", object.name, object.note);
  }
}

}  // namespace antigrasp
