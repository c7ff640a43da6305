#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/render/contact_sheet.h"

namespace antigrasp {
namespace {

struct SheetFlags {
  std::vector<std::string> inputs;
  std::string out;
  int columns = 8, rows = 4, threads = 0;
  View view;
};

// One row an input; a single input fills several rows.
void Sheet(const SheetFlags& flags) {
  const AtomicFile probe(flags.out);  // refuses an unwritable target before the work
  ObjectSource(flags.inputs).RequireNotRead({flags.out});
  const bool single = flags.inputs.size() == 1;
  const auto columns = static_cast<std::size_t>(flags.columns);
  const std::size_t limit = columns * static_cast<std::size_t>(single ? flags.rows : 1);
  ConsoleObserver console;
  std::vector<std::vector<InputObject>> objects;
  for (const std::string& input : flags.inputs) {
    objects.push_back(LoadObjects({input}, flags.threads, console.Phase("reading"), limit));
  }
  std::vector<std::vector<const TriangleMesh*>> rows;
  int drawn = 0, left_white = 0;
  for (const auto& of_input : objects) {
    for (std::size_t i = 0; i < of_input.size(); ++i) {
      if (i % columns == 0) rows.emplace_back();
      const TriangleMesh& mesh = of_input[i].mesh;
      rows.back().push_back(mesh.faces.empty() ? nullptr : &mesh);
      ++(mesh.faces.empty() ? left_white : drawn);
    }
  }
  if (drawn == 0) {
    throw InputError("no object with a surface", flags.inputs.front(), "at least one");
  }
  const Image sheet = ContactSheet(rows, flags.view, flags.threads, console.Phase("drawing"));
  WritePng(flags.out, sheet);
  std::printf("%s: %d objects in %zu rows, %d x %d pixels", flags.out.c_str(), drawn, rows.size(),
              sheet.width, sheet.height);
  std::printf(left_white > 0 ? ", %d without a surface left white\n" : "\n", left_white);
}

}  // namespace

void AddSheetCommand(CLI::App* app) {
  const auto flags = std::make_shared<SheetFlags>();
  CLI::App* command = app->add_subcommand("sheet", "Draw objects in rows, as a PNG picture");
  command
      ->add_option("OBJECT", flags->inputs,
                   "meshes, folders of meshes, SDF files: a row each; one alone fills several rows")
      ->required();
  command->add_option("--out", flags->out, "the picture (PNG)")->required();
  command->add_option("--columns", flags->columns, "objects in a row")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--rows", flags->rows, "most rows of a single OBJECT")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  View& view = flags->view;
  command->add_option("--pixels", view.pixels, "side of one object's picture")
      ->check(CLI::Range(16, 2000))
      ->capture_default_str();
  command->add_option("--azimuth", view.azimuth, "of the camera about z, degrees from x")
      ->check(NumberIn(-360.0, 360.0))
      ->capture_default_str();
  command->add_option("--elevation", view.elevation, "of the camera, degrees above the xy plane")
      ->check(NumberIn(-90.0, 90.0))
      ->capture_default_str();
  command
      ->add_option("--crease", view.crease,
                   "faces that meet at less than this angle are shaded as one, degrees; 0 = facets")
      ->check(NumberIn(0.0, 180.0))
      ->capture_default_str();
  AddThreads(command, &flags->threads);
  command->callback([flags] { Sheet(*flags); });
}

}  // namespace antigrasp
