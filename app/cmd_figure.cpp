#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/report/figure_inputs.h"

namespace antigrasp {
namespace {

// What every figure's command has.
struct CommonFlags {
  std::string out;
  FigureOptions options;

  // Refuses an unknown ending, too many pixels and an unwritable target before the work.
  void Check() const {
    CheckPage(out, {options.Width(), 0.0, options.dpi});
    const AtomicFile probe(out);
  }
};

std::shared_ptr<CommonFlags> AddPageFlags(CLI::App* command) {
  const auto flags = std::make_shared<CommonFlags>();
  FigureOptions& o = flags->options;
  command->add_option("--out", flags->out, "picture, .svg or .png")->required();
  command->add_option("--width-mm", o.width_mm, "of the page, mm")
      ->check(NumberIn(20.0, 2000.0))
      ->capture_default_str();
  command->add_option("--dpi", o.dpi, "pixels per inch: of a PNG, of the objects in an SVG")
      ->check(NumberIn(30.0, 1200.0))
      ->capture_default_str();
  return flags;
}

// With the camera of those that show objects.
std::shared_ptr<CommonFlags> AddCommonFlags(CLI::App* command) {
  const auto flags = AddPageFlags(command);
  FigureOptions& o = flags->options;
  o.view.samples = 3;
  o.view.crease = 40.0;  // smoother than a contact sheet, as the paper shows its objects
  command->add_option("--azimuth", o.view.azimuth, "of the camera about z, degrees from x")
      ->check(NumberIn(-360.0, 360.0))
      ->capture_default_str();
  command->add_option("--elevation", o.view.elevation, "of the camera, degrees above the xy plane")
      ->check(NumberIn(-90.0, 90.0))
      ->capture_default_str();
  command
      ->add_option("--crease", o.view.crease,
                   "faces that meet at less than this angle are shaded as one, degrees; 0 = facets")
      ->check(NumberIn(0.0, 180.0))
      ->capture_default_str();
  AddThreads(command, &o.threads, "; the picture does not depend on it");
  return flags;
}

void Done(const CommonFlags& flags) { std::printf("%s\n", flags.out.c_str()); }

void AddFigure1(CLI::App* figure) {
  struct Flags {
    std::vector<std::string> inputs, labels;
    std::string history;
    int shown = 25;
    double cone_angle = 0.0;
    std::uint64_t seed = 1;
  };
  const auto own = std::make_shared<Flags>();
  CLI::App* command =
      figure->add_subcommand("1", "Objects with the axes of their most robust grasps");
  command->add_option("OBJECT", own->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option(
      "--history", own->history,
      "history.csv of antigrasp perturb --history: adds the plot of antipodal pairs");
  command->add_option("--label", own->labels, "instead of the objects' names, one each");
  command->add_option("--shown", own->shown, "most robust grasps drawn of each object")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  CLI::Option* angle =
      command
          ->add_option("--cone-angle", own->cone_angle,
                       "half angle of the friction cone, degrees (the paper's figure: 10), instead "
                       "of --friction")
          ->check(NumberIn(0.1, 80.0));
  command->add_option("--seed", own->seed, "random seed")->capture_default_str();
  const auto common = AddCommonFlags(command);
  command
      ->add_option("--columns", common->options.columns,
                   "panels beside each other; 0 = as many "
                   "as suit")
      ->check(CLI::Range(0, 50))
      ->capture_default_str();
  const auto metric_flags = std::make_shared<MetricFlags>(command);
  command->callback([own, common, metric_flags, angle] {
    common->Check();
    MetricOptions metric = metric_flags->Resolve();
    if (angle->count() > 0) metric.friction = std::tan(own->cone_angle * std::numbers::pi / 180.0);
    GraspFigure figure;
    ConsoleObserver console;
    if (!own->history.empty()) figure.histories = ReadHistories(own->history);
    figure.objects = GraspedObjects(own->inputs, own->labels, metric, own->seed,
                                    common->options.threads, &console);
    figure.shown = own->shown;
    figure.caption = GraspCaption(own->shown, metric);
    WriteGraspFigure(common->out, figure, common->options);
    Done(*common);
  });
}

enum class Axis { kX, kY, kZ };
constexpr auto ChoicesOf(Axis) {
  return std::to_array<Choice<Axis>>({{Axis::kX, "x"}, {Axis::kY, "y"}, {Axis::kZ, "z"}});
}

void AddFigure2(CLI::App* figure) {
  struct Flags {
    std::string input;
    Axis axis = Axis::kZ;
    double position = 0.0;
    int resolution = 32;
  };
  const auto own = std::make_shared<Flags>();
  CLI::App* command = figure->add_subcommand(
      "2", "A mesh, the mesh remeshed from its signed distances, and a section of them");
  command->add_option("MESH", own->input, "mesh; of a folder or an SDF file the first object")
      ->required();
  AddChoice(command, "--axis", &own->axis,
            "across which the section is taken: " + Alternatives(ChoiceNames<Axis>()));
  command
      ->add_option("--position", own->position,
                   "of the section on that axis, in sides of the unit cube from its middle")
      ->check(NumberIn(-0.5, 0.5))
      ->capture_default_str();
  command->add_option("--resolution", own->resolution, "nodes of the grid along a side")
      ->check(CLI::Range(8, 128))
      ->capture_default_str();
  const auto common = AddCommonFlags(command);
  command->callback([own, common] {
    common->Check();
    SdfFigure figure = SdfFigureOf(own->input, own->resolution, common->options.threads);
    figure.axis = static_cast<int>(own->axis);
    figure.position = own->position;
    WriteSdfFigure(common->out, figure, common->options);
    Done(*common);
  });
}

void AddFigure3(CLI::App* figure) {
  struct Flags {
    std::vector<std::string> folders, labels;
    int examples = 1;
  };
  const auto own = std::make_shared<Flags>();
  CLI::App* command = figure->add_subcommand(
      "3", "Objects before and after a perturbation, and how their graspability is distributed");
  command->add_option("FOLDER", own->folders, "folders that antigrasp perturb wrote, one a row")
      ->required();
  command->add_option("--label", own->labels, "instead of the folders' names, one each");
  command
      ->add_option("--examples", own->examples,
                   "objects of each row: those whose change is nearest to the median")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  const auto common = AddCommonFlags(command);
  command->callback([own, common] {
    common->Check();
    WriteRowFigure(common->out, PerturbFigure(own->folders, own->labels, own->examples),
                   common->options);
    Done(*common);
  });
}

void AddFigure4(CLI::App* figure) {
  struct Flags {
    std::string run;
    std::vector<int> episodes;
    int examples = 4;
  };
  const auto own = std::make_shared<Flags>();
  CLI::App* command = figure->add_subcommand(
      "4", "A run's samples stage by stage, and how their graspability is distributed");
  command->add_option("RUN", own->run, "folder of a run")->required();
  command->add_option("--episodes", own->episodes, "those shown beside the prior set, e.g. 0 2 4")
      ->check(CLI::Range(0, 1000));
  command->add_option("--examples", own->examples, "objects of each stage: its first usable ones")
      ->check(CLI::Range(1, 20))
      ->capture_default_str();
  const auto common = AddCommonFlags(command);
  command->callback([own, common] {
    common->Check();
    const FigureOptions& options = common->options;
    ConsoleObserver console;
    const RowFigure stages =
        RunFigure(own->run, own->episodes, own->examples, options.threads, &console);
    WriteRowFigure(common->out, stages, options);
    Done(*common);
  });
}

void AddFigureOfTrials(CLI::App* figure) {
  const auto folders = std::make_shared<std::vector<std::string>>();
  CLI::App* command =
      figure->add_subcommand("trial", "How many grasps hold, over friction and over load");
  command->add_option("FOLDER", *folders, "folders that antigrasp trial --out wrote")->required();
  const auto common = AddPageFlags(command);
  command->callback([folders, common] {
    common->Check();
    WriteTrialFigure(common->out, TriedFigure(*folders), common->options);
    Done(*common);
  });
}

}  // namespace

void AddFigureCommand(CLI::App* app) {
  CLI::App* figure = app->add_subcommand(kFigure.name, kFigure.description);
  figure->require_subcommand(1);
  figure->footer("antigrasp figure N --help shows a figure's options");
  AddFigure1(figure);
  AddFigure2(figure);
  AddFigure3(figure);
  AddFigure4(figure);
  AddFigureOfTrials(figure);
}

}  // namespace antigrasp
