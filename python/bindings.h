#pragma once

#include <pybind11/pybind11.h>

#include "antigrasp/core/error.h"
#include "antigrasp/python/mesh_object.h"
#include "antigrasp/python/metric_object.h"
#include "antigrasp/python/shapes_object.h"

// What the module antigrasp._geometry is put together of, in this order: a class before what
// mentions it.
namespace antigrasp::python {

void BindEvaluate(pybind11::module_& module);     // evaluate, Score, Grasps
void BindGivenGrasps(pybind11::module_& module);  // evaluate_grasps, GraspScores
void BindEpsilon(pybind11::module_& module);      // epsilon
void BindTrial(pybind11::module_& module);        // trial, Trial
void BindPerturb(pybind11::module_& module);      // perturb, shape, Perturbed, Polyhedron

}  // namespace antigrasp::python
