#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"
#include "antigrasp/perturb/certificate.h"

namespace antigrasp {
namespace {

struct ShapeFlags {
  std::string kind;
  std::string out;
  PolyhedronOptions options;
  int threads = 0;
};

void Shape(ShapeFlags flags, const OptionFlags& search) {
  OptionTable table;
  Bind(&table, &flags.options);
  search.Apply(&table);
  const PolyhedronOptions& options = flags.options;
  RequireWritableFormat(flags.out);
  { const AtomicFile probe(flags.out); }  // refuses an unwritable target before the work
  ConsoleObserver console;
  const AdversarialPolyhedron solid = RequestedPolyhedron(
      *FindChoice<Polyhedron>(flags.kind), options, flags.threads, console.Phase("searching"));
  WriteMesh(flags.out, solid.mesh);
  std::printf("%s: %s, %s", flags.out.c_str(), flags.kind.c_str(),
              CertificateText(solid, options.phi).c_str());
}

constexpr const char* kAboutShapes =
    "The cube carries the paper's pyramids on three faces (up to 30 degrees); the corners of the\n"
    "others are moved at random until no two faces oppose each other under less than phi, and "
    "then\n"
    "as near to their old places as phi allows. phi is the angle between one face's normal and "
    "the\n"
    "reverse of the other's: parallel faces have 0. A gripper pinches two faces only up to twice\n"
    "the half angle of its friction cone.\n";

}  // namespace

void AddShapeCommand(CLI::App* app) {
  const auto flags = std::make_shared<ShapeFlags>();
  CLI::App* command =
      app->add_subcommand("shape", "Make a polyhedron whose faces do not oppose each other");
  command->add_option("KIND", flags->kind, "what to start from")
      ->required()
      ->check(CLI::IsMember(ChoiceNames<Polyhedron>()));
  command
      ->add_option("--phi", flags->options.phi,
                   "smallest antipodality angle of any two faces, degrees; 0 = the plain solid")
      ->required()
      ->check(CLI::Range(0.0, 90.0));
  command
      ->add_option("--size-mm", flags->options.size,
                   "edge of the cube that the plain solid is inscribed in, mm")
      ->check(NumberIn(0.001, 1e5))
      ->capture_default_str();
  command
      ->add_option("--out", flags->out,
                   "mesh file (" + Alternatives(WritableExtensions(), ".") + "), millimetres")
      ->required();
  command->add_option("--seed", flags->options.seed, "random seed")->capture_default_str();
  AddThreads(command, &flags->threads, "; the solid is the same");
  const auto search =
      std::make_shared<OptionFlags>(AddOptions<PolyhedronOptions>(command, "Search"));
  command->footer(kAboutShapes);
  command->callback([flags, search] { Shape(*flags, *search); });
}

}  // namespace antigrasp
