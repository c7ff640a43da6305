#include "antigrasp/python/python_judge.h"

#include "antigrasp/core/error.h"
#include "antigrasp/python/mesh_object.h"

namespace antigrasp::python {
namespace {

namespace py = pybind11;
using Function = std::shared_ptr<py::object>;

// Which may be the last one to let it go, wherever it is.
Function Shared(const py::object& function) {
  return {new py::object(function), [](py::object* held) {
            const py::gil_scoped_acquire lock;
            delete held;
          }};
}

std::string NameOf(const py::object& function) {
  return py::str(py::getattr(function, "__name__", py::type::handle_of(function).attr("__name__")));
}

class FunctionJudge : public Judge {
 public:
  FunctionJudge(Function function, std::string name)
      : function_(std::move(function)), name_(std::move(name)) {}

  std::string Name() const override { return "python:" + name_; }

  std::vector<Verdict> Score(const std::vector<JudgedObject>& objects) override {
    std::vector<Verdict> verdicts;
    const py::gil_scoped_acquire held;
    for (const JudgedObject& object : objects) verdicts.push_back(ScoreOne(object));
    return verdicts;
  }

 private:
  Verdict ScoreOne(const JudgedObject& object) const {
    const py::object answer = (*function_)(MeshOf(object.name, *object.mesh));
    if (answer.is_none()) return Verdict::None("no score");
    const double score = PyFloat_AsDouble(answer.ptr());
    if (PyErr_Occurred() == nullptr) return Verdict::Of(score);
    PyErr_Clear();
    throw InputError("the judge " + name_ + " said " + std::string(py::repr(answer)), object.name,
                     "a number or None");
  }

  Function function_;
  std::string name_;
};

}  // namespace

std::function<std::unique_ptr<Judge>()> JudgeOfFunction(const py::object& function) {
  return [shared = Shared(function), name = NameOf(function)] {
    return std::make_unique<FunctionJudge>(shared, name);
  };
}

}  // namespace antigrasp::python
