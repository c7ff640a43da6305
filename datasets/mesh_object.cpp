#include "antigrasp/datasets/mesh_object.h"

#include "antigrasp/mesh/repair.h"

namespace antigrasp {
namespace {

// A unit that was named, not the default, and is not the file's deserves a word.
std::string UnitNote(const std::optional<FileUnit>& of_file, std::optional<LengthUnit> into) {
  if (!of_file || !into || *into == LengthUnit::kM || ChoiceName(*into) == of_file->name) return "";
  return "turned into " + ChoiceName(*into) + ": the file says that it is in " + of_file->name;
}

}  // namespace

InputObject ObjectOf(MeshFile file, std::optional<LengthUnit> into) {
  std::vector<std::string> notes = file.notes;
  const std::string unit = UnitNote(file.unit, into);
  if (!unit.empty()) notes.push_back(unit);
  RepairResult repaired = Repair(into ? InUnit(std::move(file), *into) : std::move(file.mesh));
  notes.insert(notes.begin(), repaired.actions.begin(), repaired.actions.end());
  InputObject object;
  object.mesh = std::move(repaired.mesh);
  object.status = repaired.accepted() ? "ok" : repaired.refusal;
  for (const std::string& note : notes) object.note += (object.note.empty() ? "" : "; ") + note;
  return object;
}

}  // namespace antigrasp
