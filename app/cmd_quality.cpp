#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/quality/contact_table.h"

namespace antigrasp {
namespace {

struct QualityFlags {
  std::string table;
  std::string out;
  int threads = 0;
};

void Quality(const QualityFlags& flags, const OptionFlags& contact_flags) {
  ContactTableOptions options;
  OptionTable table;
  Bind(&table, &options);
  contact_flags.Apply(&table);
  if (!flags.out.empty()) const AtomicFile probe(flags.out);  // refused before the work
  RequireApart({flags.table, flags.out});
  const std::vector<ContactRow> rows = ReadContactTable(flags.table, options);
  ConsoleObserver console;
  const std::vector<ContactRowQuality> qualities =
      EvaluateAllContacts(rows, options.wrench, flags.threads, console.Phase("grasps"));
  if (flags.out.empty()) {
    std::printf("%s", ContactCsv(rows, qualities).c_str());
  } else {
    WriteFileAtomic(flags.out, ContactCsv(rows, qualities));
    WriteFileAtomic(flags.out + ".quality.toml", table.Dump());
  }
  std::fputs(ContactSummary(qualities).c_str(), stderr);
}

constexpr const char* kQualityColumns =
    "Columns by name, in any order, others ignored; lengths in one unit:\n"
    "  p1x p1y p1z p2x p2y p2z        the two contact points\n"
    "  n1x n1y n1z n2x n2y n2z        outward normals of the object there\n"
    "  comx comy comz                 centre of mass\n"
    "and, if there are such columns:\n"
    "  id                             else the number of the row\n"
    "  friction_coef num_cone_faces finger_radius torque_scaling force_limit\n"
    "                                 else the constants above\n"
    "  in1x ... in2z                  closing direction of each jaw, has_in_direction 0 or 1;\n"
    "                                 else unit normal forces and no slip\n"
    "  t1c1_x ... t1c2_z              first edge of each friction pyramid; else along +x\n"
    "  wfx wfy wfz wtx wty wtz        wrench to resist; else wrench_resisted stays empty\n";

}  // namespace

void AddQualityCommand(CLI::App* app) {
  const auto flags = std::make_shared<QualityFlags>();
  CLI::App* command = app->add_subcommand(
      "quality", "Score grasps given as contacts: epsilon, force closure, wrench resistance");
  command->add_option("TABLE", flags->table, "two contacts per row (CSV)")->required();
  command->add_option("--out", flags->out,
                      "scores (CSV); the constants go to the same name plus .quality.toml. "
                      "Without it the scores go to standard output");
  AddThreads(command, &flags->threads, "; scores do not depend on it");
  const auto contact_flags =
      std::make_shared<OptionFlags>(AddOptions<ContactTableOptions>(command, "Contacts"));
  command->footer(kQualityColumns);
  command->callback([flags, contact_flags] { Quality(*flags, *contact_flags); });
}

}  // namespace antigrasp
